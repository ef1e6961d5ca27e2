// The page: what is done is sent, what comes back is drawn. Nothing is computed here.

import { Curves } from "./curves.js";
import { Knobs } from "./knobs.js";
import { Link } from "./link.js";
import { Motion } from "./motion.js";
import { Basins, Plane } from "./plane.js";
import { fixed } from "./plot.js";
import { asPicture, copy, keep } from "./save.js";

// Milliseconds after which a page that waits says so, and says why it may take so long.
const PATIENCE = 400;
const LONG = 3000;
const OFFLINE = document.body.classList.contains("offline");
const COMPILING = "computing … (compiling on first use: up to a minute, only once)";
const id = (name) => document.getElementById(name);
const status = id("status");
let state = null;
let choices = { presets: [], isolators: [], stops: [] };
let resting = true;
let waiting = [];
let asked = 0;

say(OFFLINE ? "loading …" : "connecting …");
const link = new Link({
  told,
  changed(how, why) {
    document.body.dataset.link = how;
    patient(how === "connected");
    if (how === "lost") say(why, true);
    else say("");
  },
  address: () => state?.address ?? location.hash.slice(1),
});
const send = (message) => {
  resting = !message.dragging;
  patient(true);
  document.body.dataset.asked = asked = link.send(message);
  return asked;
};
const knobs = new Knobs(send);
const curves = new Curves((direction, frequency) => send({ do: "choose", direction, frequency }));
const motion = new Motion();
const plane = new Plane(id("map"), (x, y, dragging, gesture) => send({ do: "place", x, y, dragging, gesture: `place ${gesture}` }));
const basins = new Basins(id("basins"));
const TABS = ["motion", "words", "map", "basins"].filter((name) => !OFFLINE || !id(`tab-${name}`).classList.contains("served"));
let beside = "motion"; // of those that are there already

// What is drawn fades while it is not yet that of the knobs.
function patient(begin) {
  waiting.forEach(clearTimeout);
  waiting = [];
  if (!begin) return;
  waiting.push(setTimeout(() => document.body.classList.add("late"), PATIENCE));
  for (const [when, words] of [[PATIENCE, "computing …"], [LONG, choices.compiles ? COMPILING : "computing …"]]) waiting.push(setTimeout(() => say(words), when));
}

function say(text, lost = false) {
  if (status.textContent !== text) status.textContent = text;
  status.classList.toggle("lost", lost);
}

function told(message) {
  if (message.hello) begin(message);
  if (message.state) show(message.state);
  if (message.refused) refused(message);
  if (message.picture) drawn(message);
  if (message.progress) say(`${message.progress}: ${Math.round(100 * message.share)} %`);
  if (message.file) keep(message.file, message.mime, message.bytes);
  if (message.settled) {
    patient(false);
    document.body.classList.remove("late");
    if (!status.classList.contains("lost")) say("");
    document.body.dataset.settled = message.n ?? "";
  }
}

function begin(message) {
  choices = message;
  const select = id("presets");
  select.replaceChildren(new Option("choose …", ""));
  for (const [group, names] of message.presets) {
    const box = document.createElement("optgroup");
    box.label = group;
    for (const name of names) box.append(new Option(name, name));
    select.append(box);
  }
}

function show(next) {
  state = next;
  if (status.classList.contains("lost")) say(""); // what was refused before
  id("frequency-why").textContent = "";
  id("frequency").setAttribute("aria-invalid", "false");
  knobs.show(state, choices);
  const select = id("presets");
  if (document.activeElement !== select) select.value = [...select.options].some((one) => one.value === state.name) ? state.name : "";
  id("undo").disabled = !state.undo;
  id("redo").disabled = !state.redo;
  id("physical").checked = state.physical;
  id("physical-label").textContent = state.without_units ? "not normalised" : "in mm and g";
  id("omega").hidden = !state.without_units;
  id("branch").checked = state.shown.includes("branch");
  if (!state.shown.includes("branch")) curves.orbits(null);
  if (document.activeElement !== id("frequency")) id("frequency").value = state.frequency_text;
  id("direction").value = state.direction;
  const ratio = (name) => state.controls.find((knob) => knob.path === `stops.${name}`)?.value;
  const point = [ratio("stiffness_ratio"), ratio("gap_ratio")];
  tab(TABS.find((name) => state.shown.includes(name)) ?? beside);
  plane.at(point.includes(undefined) ? null : point, choices.plane, choices);
  document.title = `${state.name} – vibroimpact explorer`;
  history.replaceState(null, "", `#${state.address}`);
}

// A line of evidence, in which other scenarios show their meaning.
function explained(text) {
  const line = document.createElement("li");
  for (const part of text.split(/\b(S[0-6])\b/)) {
    line.append(choices.meanings?.[part] ? Object.assign(document.createElement("abbr"), { textContent: part, title: choices.meanings[part] }) : part);
  }
  return line;
}

function tab(name) {
  document.querySelector("main").classList.toggle("reading", name === "words");
  for (const one of TABS) {
    id(one).hidden = one !== name;
    id(`tab-${one}`).setAttribute("aria-selected", one === name);
    id(`tab-${one}`).tabIndex = one === name ? 0 : -1;
  }
}

function refused({ refused: why, path }) {
  patient(false);
  if (path === "frequency") {
    id("frequency-why").textContent = why;
    id("frequency").setAttribute("aria-invalid", "true");
  } else if (!path || !knobs.refuse(path, why)) say(why, true);
}

function drawn(message) {
  if (message.none) {
    say(message.none, true);
    if (message.picture === "map") plane.show(null);
    if (message.picture === "branch") curves.orbits(null);
    return;
  }
  if (message.picture === "curves") {
    curves.show(message, resting);
    if (message.n === asked) document.body.classList.remove("late");
    if (message.words) fixed(id("words-curves"), message.words);
    requestAnimationFrame(() => {
      document.body.dataset.drawn = message.n ?? "";
      document.body.dataset.fine = message.fine;
    });
  } else if (message.picture === "motion") {
    motion.show(message);
    if (message.table) fixed(id("words-motion"), message.table.trim());
    curves.mark({ direction: message.direction, frequency: message.frequency });
  } else if (message.picture === "scenario") {
    id("scenario-name").textContent = message.scenario;
    id("scenario-meaning").textContent = message.meaning + (message.confidence === null ? "" : ` (confidence ${Math.round(100 * message.confidence)} %)`);
    id("evidence").replaceChildren(...message.evidence.map(explained));
  } else if (message.picture === "branch") curves.orbits(message);
  else if (message.picture === "map") plane.show(message);
  else if (message.picture === "basins") basins.show(message);
}

id("presets").addEventListener("change", (event) => event.target.value && send({ do: "preset", name: event.target.value }));
for (const what of ["undo", "redo", "reset"]) id(what).addEventListener("click", () => send({ do: what }));
for (const what of ["physical", "branch"]) id(what).addEventListener("change", (event) => send({ do: "look", what, on: event.target.checked }));
for (const name of TABS) {
  id(`tab-${name}`).addEventListener("click", () => {
    if (name === "motion" || name === "words") tab((beside = name));
    for (const one of ["map", "basins"]) if (state.shown.includes(one) !== (one === name)) send({ do: "look", what: one, on: one === name });
  });
  id(`tab-${name}`).addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const next = id(`tab-${TABS[(TABS.indexOf(name) + step + TABS.length) % TABS.length]}`);
    next.click();
    next.focus();
  });
}
id("frequency").addEventListener("change", (event) => send({ do: "choose", path: "frequency", direction: state.direction, frequency: event.target.value }));
id("direction").addEventListener("change", (event) => send({ do: "choose", direction: event.target.value, frequency: state.frequency }));
for (const button of document.querySelectorAll("[data-file]")) button.addEventListener("click", () => link.send({ do: "file", kind: button.dataset.file }));
id("link").addEventListener("click", async () => say((await copy(location.href)) ? "The address is copied." : "The address could not be copied. Copy it from the address bar."));
id("svg").addEventListener("click", () => asPicture(id("panels"), state.name, "svg"));
id("png").addEventListener("click", () => asPicture(id("panels"), state.name, "png"));
addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.type === "text") return;
  event.preventDefault();
  send({ do: event.shiftKey ? "redo" : "undo" });
});
// Another address in the address bar is another state.
addEventListener("hashchange", () => location.hash.slice(1) !== state?.address && send({ do: "open", address: location.hash.slice(1) }));
