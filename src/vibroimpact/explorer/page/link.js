// The websocket to the server: it opens again when it was cut, and gives back the state that was shown.

const WAITS = [300, 600, 1200, 2500];

export class Link {
  // `told` gets each message; `state` says what to ask for when a new server knows nothing of us.
  constructor({ told, changed, address }) {
    Object.assign(this, { told, changed, address, number: 0, tries: 0, open: false });
    this.connect();
  }

  connect() {
    const url = new URL("live", location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    url.hash = "";
    url.search = location.search;
    const socket = (this.socket = new WebSocket(url));
    socket.onopen = () => {
      this.tries = 0;
      this.open = true;
      this.changed("connected");
      const held = this.address();
      if (held) this.send({ do: "open", address: held });
    };
    socket.onmessage = (event) => this.told(JSON.parse(event.data));
    socket.onclose = (event) => {
      this.open = false;
      const wait = WAITS[Math.min(this.tries++, WAITS.length - 1)];
      const why = event.reason || "the server does not answer";
      this.changed("lost", `Connection lost: ${why}. Trying again …`);
      setTimeout(() => this.connect(), wait);
    };
  }

  send(message) {
    if (!this.open) return 0;
    this.socket.send(JSON.stringify({ ...message, n: ++this.number }));
    return this.number;
  }
}
