// The worker of the page: it holds the engine and the session, and answers messages of the page.

import { Engine } from "./engine.js";
import { Session } from "./session.js";

let session = null;
const { port1: here, port2: there } = new MessageChannel();
let resting = null;
here.onmessage = () => resting();
// Messages of the page arrive while this is awaited.
const rest = () => new Promise((done) => ((resting = done), there.postMessage(null)));
const tell = (message) => self.postMessage(message);

async function answer(data) {
  if (data.module) {
    const { instance } = await WebAssembly.instantiate(data.module, {});
    instance.exports._initialize?.();
    session = new Session(new Engine(instance, data.facts.engine), data.facts, tell, rest);
    tell({ ...session.hello(), ...session.told() });
  } else tell(session.take(data));
  await session.work();
}

// What is thrown in an asynchronous function does not reach the page by itself.
self.onmessage = ({ data }) => answer(data).catch((error) => tell({ failed: String(error) }));
