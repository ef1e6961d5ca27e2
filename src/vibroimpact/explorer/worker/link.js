// In place of the websocket to a server: a worker of this page, which computes all that is shown.

const text = (name) => document.getElementById(name).textContent;

export class Link {
  constructor({ told, changed, address }) {
    Object.assign(this, { told, changed, number: 0, open: false });
    this.begin(address).catch((error) => changed("lost", `The page cannot start here (${error}); open it in a newer browser`));
  }

  async begin(address) {
    const source = new Blob([text("worker")], { type: "text/javascript" });
    this.worker = new Worker(URL.createObjectURL(source));
    const failed = (why) => this.changed("lost", `The computation failed (${why}); reload the page`);
    this.worker.onerror = (event) => failed(event.message);
    this.worker.onmessage = ({ data }) => {
      if (data.failed) return failed(data.failed);
      if (data.hello) this.begun(address());
      this.told(data);
    };
    const packed = Uint8Array.from(atob(text("engine")), (sign) => sign.charCodeAt(0));
    const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const module = await new Response(unpacked).arrayBuffer();
    this.worker.postMessage({ module, facts: JSON.parse(text("facts")) });
  }

  begun(address) {
    this.open = true;
    this.changed("connected");
    if (address) this.send({ do: "open", address });
  }

  send(message) {
    if (!this.open) return 0;
    this.worker.postMessage({ ...message, n: ++this.number });
    return this.number;
  }
}
