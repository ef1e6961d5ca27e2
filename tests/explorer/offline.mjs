// Runs the worker's modules in node: `node offline.mjs WORKER MODULE FACTS < STATES > NUMBERS`.

import fs from "node:fs";

const [program, module, facts] = process.argv.slice(2).map((path) => fs.readFileSync(path));
globalThis.self = {};
const modules = new Function(`${program}; return modules;`)();
const known = JSON.parse(facts);
const { instance } = await WebAssembly.instantiate(module, {});
const engine = new modules["engine.js"].Engine(instance, known.engine);
const nothing = async () => {};
const { swept, held, curves } = modules["sweep.js"];
const found = [];
for (const state of JSON.parse(fs.readFileSync(0))) {
  const data = await swept(engine, state, false, known, nothing);
  const { rows, states } = data[state.direction];
  const begin = held(state, data);
  const motion = engine.trajectory(data.rig, state.amplitude, begin.frequency, begin.state, 3, 40);
  const plain = (lists) => lists.map((list) => Array.from(list, (x) => (Number.isFinite(x) ? x : null)));
  found.push({
    rows: plain(rows),
    states: plain(states),
    motion: plain(motion.rows),
    quick: modules["motion.js"].quick(engine, state, data, known),
    careful: modules["motion.js"].careful(engine, state, data, known),
    curves: curves(state, data, false, known, engine.layout),
    controls: modules["rig.js"].controls(state, state, known),
    basins: state.shown.includes("basins") ? await modules["basins.js"].basins(engine, state, false, known, nothing) : null,
  });
}
// The worker waits for messages.
process.stdout.write(JSON.stringify(found), () => process.exit());
