// The session of the page: messages as `explorer/session.py` takes them, answers of the same form.

import { basins } from "./basins.js";
import { careful, quick } from "./motion.js";
import { chosen, controls, joined, kindOf, moved, withLaw } from "./rig.js";
import { curves, swept, unbounded } from "./sweep.js";
import { plain, Refused } from "./units.js";

// Milliseconds: between two looks at what has arrived; for which a coarse picture is finished though
// another was asked for; and that one picture may take.
const [LOOK, PATIENCE, MOST] = [25, 250, 60_000];
const SELDOM = 300;
const ELSEWHERE = "computed by the command vibroimpact explore";

class Stopped extends Error {}

const encoded = (table) => btoa(String.fromCharCode(...new TextEncoder().encode(JSON.stringify(table)))).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
const decoded = (text) => JSON.parse(new TextDecoder().decode(Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (sign) => sign.charCodeAt(0))));

export class Session {
  // `tell` sends a message to the page; `rest` lets messages of the page arrive.
  constructor(engine, facts, tell, rest) {
    Object.assign(this, { engine, facts, tell, rest, asked: 0, calls: 0, working: false, dragging: false, sent: {}, sweeps: {} });
    this.start(facts.first);
  }

  start(state) {
    Object.assign(this, { first: state, now: state, past: [], future: [], gesture: "" });
  }

  hello() {
    return { hello: true, presets: this.facts.presets, isolators: ["linear"], stops: this.facts.stops, words: this.facts.words };
  }

  take(message) {
    const { n = null, path = null } = message;
    const before = { first: this.first, now: this.now, past: this.past, future: this.future, gesture: this.gesture };
    let answer;
    try {
      this.do(message);
      answer = this.told();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      Object.assign(this, before);
      const refused = { refused: error.message, path: message.path ?? error.path ?? path, n };
      return message.do === "open" ? { ...this.told(), ...refused } : refused;
    }
    this.asked++;
    this.dragging = message.dragging === true;
    this.number = n;
    if (!this.now.shown.includes("basins")) delete this.sent.basins;
    return { ...answer, n };
  }

  to(state, gesture = "") {
    if (JSON.stringify(state) !== JSON.stringify(this.now)) {
      if (!gesture || gesture !== this.gesture) this.past = [...this.past, this.now].slice(-this.facts.limits.steps);
      this.future = [];
    }
    Object.assign(this, { now: state, gesture });
  }

  do(message) {
    const { now, facts } = this;
    const actions = {
      undo: () => {
        if (!this.past.length) return;
        this.future = [now, ...this.future];
        Object.assign(this, { now: this.past.at(-1), past: this.past.slice(0, -1), gesture: "" });
      },
      redo: () => {
        if (!this.future.length) return;
        this.past = [...this.past, now];
        Object.assign(this, { now: this.future[0], future: this.future.slice(1), gesture: "" });
      },
      reset: () => this.to(this.first),
      preset: () => {
        const table = facts.tables[message.name];
        if (!table) throw new Refused(`preset: '${message.name}' is unknown; choose a name in the list of the page`);
        this.to(table);
        this.first = table;
      },
      open: () => this.start(this.opened(message.address)),
      change: () => this.to(moved(now, message.path, message.value, facts), message.gesture ?? ""),
      law: () => this.to(withLaw(now, message.part, message.kind, facts)),
      together: () => this.to(joined(now, message.on === true)),
      choose: () => this.to(chosen(now, message.direction, message.frequency, facts), "choose"),
      look: () => this.to(this.looked(message.what, message.on === true), "look"),
    };
    const action = actions[message.do];
    if (!action) throw new Refused(`${message.do}: this is ${ELSEWHERE}`);
    action();
  }

  looked(what, on) {
    const { now } = this;
    if (what === "physical") return { ...now, physical: on };
    if (what !== "basins") throw new Refused(`${what}: this is ${ELSEWHERE}`);
    return { ...now, shown: on ? ["basins"] : [] };
  }

  // The state of an address; each of its numbers is checked as one that is typed.
  opened(address) {
    const wrong = () => new Refused("address: it cannot be read; copy the whole address of the page again");
    const { facts } = this;
    if (typeof address !== "string" || address.length > facts.limits.address) throw wrong();
    let table;
    try {
      table = decoded(address);
    } catch {
      throw wrong();
    }
    const fields = Object.keys(facts.first);
    if (!table || fields.some((name) => !(name in table)) || Object.keys(table).length !== fields.length) throw wrong();
    const { oscillator: rig, span, of } = table;
    const numbers = (part, kind) => Object.keys(facts.fields[kind]).every((name) => typeof part?.[name] === "number");
    const linear = [undefined, "linear"].includes(rig?.isolator?.kind) && (rig?.isolator?.damping_exponent ?? 1) === 1 && (rig?.units ?? "SI") === "SI";
    const known = ["right", "left"].every((side) => facts.stops.includes(kindOf(rig?.[side])));
    if (!linear || !known) throw new Refused(`address: a law of this rig is not computed here; it is ${ELSEWHERE}`);
    const sound = numbers(rig, "") && numbers(rig.isolator, "isolator") && ["right", "left"].every((side) => !rig[side] || numbers(rig[side], kindOf(rig[side])));
    const whole = Array.isArray(span) && span.length === 2 && 0 < span[0] && span[0] < span[1] && of in facts.amplitudes && typeof table.name === "string" && Array.isArray(table.shown);
    if (!sound || !whole) throw wrong();
    let state = { ...table, phase: 0, together: table.together === true, physical: table.physical === true, shown: table.shown.includes("basins") ? ["basins"] : [] };
    // What is not a number of the law is left out.
    const only = (part, kind) => Object.fromEntries([...(part.kind ? [["kind", part.kind]] : []), ...Object.keys(facts.fields[kind]).map((name) => [name, part[name]])]);
    state.oscillator = { mass: rig.mass, isolator: only(rig.isolator, "isolator"), right: null, left: null, force: rig.force };
    for (const side of ["right", "left"]) if (rig[side]) state.oscillator[side] = only(rig[side], kindOf(rig[side]));
    for (const [path, value] of this.values(state)) state = moved(state, path, value, facts);
    return chosen(state, table.direction, table.frequency, facts);
  }

  *values({ oscillator: rig, amplitude }) {
    yield ["amplitude", amplitude];
    for (const name of Object.keys(this.facts.fields[""])) yield [name, rig[name]];
    for (const name of Object.keys(this.facts.fields.isolator)) yield [`isolator.${name}`, rig.isolator[name]];
    for (const side of ["right", "left"]) for (const name of rig[side] ? Object.keys(this.facts.fields[kindOf(rig[side])]) : []) yield [`${side}.${name}`, rig[side][name]];
  }

  told() {
    const { now, first, facts } = this;
    const { right, left } = now.oscillator;
    return {
      state: {
        name: now.name,
        controls: controls(now, first, facts),
        laws: { isolator: "linear", right: kindOf(right), left: kindOf(left) },
        together: now.together,
        physical: now.physical,
        direction: now.direction,
        without_units: false,
        frequency: Number(now.frequency.toPrecision(7)),
        frequency_text: `${plain(now.frequency, 5)} Hz`,
        shown: now.shown,
        undo: this.past.length,
        redo: this.future.length,
        address: encoded(now),
      },
    };
  }

  // Makes the pictures of the newest state, the quick ones first.
  async work() {
    this.calls++;
    if (this.working) return;
    this.working = true;
    for (let calls = 0; calls !== this.calls; ) {
      calls = this.calls;
      const { asked } = this;
      try {
        for (const stage of this.stages()) await this.made(stage, asked);
        this.tell({ settled: true, n: this.number ?? null });
      } catch (error) {
        if (!(error instanceof Stopped)) throw error;
      }
      await this.rest();
    }
    this.working = false;
  }

  *stages() {
    const { now, engine, facts } = this;
    const rig = [now.oscillator, now.amplitude, now.of, now.span];
    const look = JSON.stringify([rig, now.physical]);
    const seen = JSON.stringify([rig, now.direction, now.frequency]);
    const stage = (kind, fine, key, make) => ({ kind, fine, key, make });
    yield stage("curves", false, look, async (pause) => curves(now, await this.swept(now, false, pause), false, facts, engine.layout));
    yield stage("motion", false, seen, async (pause) => quick(engine, now, await this.best(now, pause), facts));
    if (this.dragging) return;
    yield stage("curves", true, look, async (pause) => curves(now, await this.swept(now, true, pause), true, facts, engine.layout));
    yield stage("motion", true, seen, async (pause) => careful(engine, now, await this.best(now, pause), facts));
    if (now.shown.includes("basins")) for (const fine of [false, true]) yield stage("basins", fine, seen, (pause) => basins(engine, now, fine, facts, pause));
  }

  async made({ kind, fine, key, make }, asked) {
    const sent = this.sent[kind];
    if (sent && sent.key === key && (sent.fine || !fine)) return;
    const begun = performance.now();
    let [looked, said] = [begun, begun];
    const pause = async (done, total) => {
      const now = performance.now();
      if (now - looked < LOOK) return;
      await this.rest();
      looked = performance.now();
      if (this.asked !== asked && (fine || looked - begun > PATIENCE)) throw new Stopped();
      if (looked - begun > MOST) throw new Refused(`${kind}: the computation took longer than ${MOST / 1000} s and was stopped; to reduce the time, add damping`);
      if (total && looked - said > SELDOM) {
        said = looked;
        this.tell({ progress: kind, share: Math.round((1000 * done) / total) / 1000 });
      }
    };
    if (this.asked !== asked) throw new Stopped();
    const number = this.number ?? null;
    try {
      if (unbounded(this.now, this.now.frequency)) throw new Refused(`${kind}: the motion without stops grows without bound at the natural frequency of an undamped isolator; add damping`);
      this.tell({ ...(await make(pause)), n: number });
      this.sent[kind] = { key, fine };
    } catch (error) {
      if (error instanceof Stopped) throw error;
      this.tell({ picture: kind, none: error instanceof Refused ? error.message : `${kind}: the computation failed (${error.message})` });
    }
    await this.rest();
    if (this.asked !== asked) throw new Stopped();
  }

  // The sweep of a state; the last one of either fineness is kept.
  async swept(state, fine, pause) {
    const key = JSON.stringify([state.oscillator, state.amplitude, state.of, state.span]);
    if (this.sweeps[fine]?.key !== key) this.sweeps[fine] = { key, data: await swept(this.engine, state, fine, this.facts, pause) };
    return this.sweeps[fine].data;
  }

  async best(state, pause) {
    const key = JSON.stringify([state.oscillator, state.amplitude, state.of, state.span]);
    return this.sweeps.true?.key === key ? this.sweeps.true.data : this.swept(state, false, pause);
  }
}
