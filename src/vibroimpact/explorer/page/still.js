// One knob over curves that were computed before.

import { Curves } from "./curves.js";

const find = (name) => document.getElementById(name);
const family = JSON.parse(find("family").textContent);
const panels = new Curves(() => {});
// One scale for all, so that the curves can be compared.
const tops = family.members[0].curves.panels.map((panel, k) =>
  Math.max(...family.members.flatMap((member) => Object.values(member.curves.panels[k].curves).flat())),
);

function turn() {
  const member = family.members[find("knob").value];
  find("value").textContent = member.text;
  find("knob").setAttribute("aria-valuetext", member.text);
  find("scenario-name").textContent = member.scenario.scenario;
  find("scenario-meaning").textContent = member.scenario.meaning;
  find("evidence").replaceChildren(...member.scenario.evidence.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
  panels.show(member.curves, false);
  panels.charts.forEach((chart, k) => (chart.y = [0, 1.05 * tops[k]]));
  panels.draw(false);
}

find("label").textContent = family.label;
find("knob").max = family.members.length - 1;
find("knob").value = family.start;
find("knob").addEventListener("input", turn);
turn();
