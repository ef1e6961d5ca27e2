// The knobs: a slider and a text for each number of the rig, in groups, and the laws.

import { written } from "./plot.js";

const STEPS = 1000;

function made(tag, properties = {}, parent = null) {
  const node = Object.assign(document.createElement(tag), properties);
  if (parent) parent.append(node);
  return node;
}

const toShare = (knob, value) => (knob.log ? Math.log(Math.max(value, knob.low) / knob.low) / Math.log(knob.high / knob.low) : (value - knob.low) / (knob.high - knob.low));
// Four digits: nobody can turn a knob more exactly.
const fromShare = (knob, share) => Number((knob.log ? knob.low * (knob.high / knob.low) ** share : knob.low + share * (knob.high - knob.low)).toPrecision(4));

export class Knobs {
  constructor(send) {
    this.send = send;
    this.rows = new Map();
    this.shape = "";
    this.gesture = 0;
  }

  show(state, choices) {
    const shape = JSON.stringify([state.controls.map((knob) => [knob.path, knob.group, knob.label]), state.laws, state.together]);
    if (shape !== this.shape) this.build(state, choices);
    this.shape = shape;
    for (const knob of state.controls) {
      const row = this.rows.get(knob.path);
      row.knob = knob;
      if (row.held === undefined) row.slider.value = Math.round(STEPS * toShare(knob, knob.value));
      row.slider.setAttribute("aria-valuetext", knob.text);
      if (document.activeElement !== row.text || row.asked) row.text.value = knob.text;
      row.asked = false;
      this.told(row, "");
    }
  }

  build(state, choices) {
    const focused = document.activeElement?.id;
    const typed = [...this.rows.values()].find((row) => row.text.id === focused && !row.asked);
    this.rows.clear();
    this.laws(state, choices);
    const groups = document.getElementById("groups");
    groups.replaceChildren();
    let name = "";
    let group = null;
    for (const knob of state.controls) {
      if (knob.group !== name) {
        group = made("div", { role: "group" }, groups);
        group.setAttribute("aria-label", knob.group);
        made("h2", { textContent: knob.group }, group);
        name = knob.group;
      }
      this.row(knob, group);
    }
    if (!focused) return;
    const field = document.getElementById(focused);
    if (typed && field) field.value = typed.text.value; // what is being typed is not finished
    field?.focus();
  }

  row(knob, group) {
    const id = knob.path.replaceAll(".", "-");
    const box = made("div", { className: "knob" }, group);
    const title = made("label", { htmlFor: `text-${id}`, textContent: `${knob.label} ` }, box);
    if (knob.symbol) written(made("i", {}, title), knob.symbol);
    const text = made("input", { type: "text", id: `text-${id}`, value: knob.text, autocomplete: "off", spellcheck: false }, box);
    text.setAttribute("aria-describedby", `why-${id}`);
    const slider = made("input", { type: "range", id: `knob-${id}`, min: 0, max: STEPS, step: 1 }, box);
    slider.setAttribute("aria-label", `${knob.label}, ${knob.group}`);
    const why = made("p", { className: "why", id: `why-${id}` }, box);
    why.setAttribute("role", "alert");
    const row = { knob, text, slider, why };
    this.rows.set(knob.path, row);
    slider.addEventListener("input", () => {
      if (row.held === undefined) row.held = ++this.gesture;
      this.turn(row, true);
    });
    slider.addEventListener("change", () => {
      this.turn(row, false);
      row.held = undefined;
    });
    text.addEventListener("change", () => {
      row.asked = true;
      this.send({ do: "change", path: knob.path, value: text.value });
    });
    text.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      text.value = row.knob.text;
      this.told(row, "");
    });
  }

  turn(row, dragging) {
    const value = fromShare(row.knob, row.slider.value / STEPS);
    row.sent = this.send({ do: "change", path: row.knob.path, value, dragging, gesture: `${row.knob.path} ${row.held}` });
  }

  laws(state, choices) {
    const box = document.getElementById("laws");
    box.replaceChildren();
    const choose = (title, part, kinds, kind) => {
      made("label", { htmlFor: `law-${part}`, textContent: title }, box);
      const select = made("select", { id: `law-${part}` }, box);
      for (const one of kinds) made("option", { value: one, textContent: choices.words?.[one] ?? one, selected: one === kind }, select);
      select.addEventListener("change", () => this.send({ do: "law", part, kind: select.value }));
    };
    choose("isolator", "isolator", choices.isolators, state.laws.isolator);
    if (state.together) choose("both stops", "stops", choices.stops, state.laws.right);
    else for (const side of ["left", "right"]) choose(`${side} stop`, side, choices.stops, state.laws[side]);
    const both = made("label", { className: "wide" }, box);
    const check = made("input", { type: "checkbox", id: "together", checked: state.together }, both);
    both.append(" symmetric: one knob for both stops");
    check.addEventListener("change", () => this.send({ do: "together", on: check.checked }));
  }

  // What was refused stands beside the field, which keeps what was typed.
  refuse(path, why) {
    const row = this.rows.get(path);
    if (!row) return false;
    row.asked = false;
    this.told(row, why);
    return true;
  }

  told(row, why) {
    if (row.why.textContent !== why) row.why.textContent = why;
    row.text.setAttribute("aria-invalid", why ? "true" : "false");
  }
}
