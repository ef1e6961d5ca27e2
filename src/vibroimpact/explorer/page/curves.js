// The resonance curves: panels one above the other, the hysteresis shaded, the chosen motion marked.

import { Chart, range } from "./plot.js";

const SWEEPS = ["backward", "forward"];

export class Curves {
  constructor(choose) {
    this.box = document.getElementById("panels");
    this.choose = choose;
    this.charts = [];
    this.names = "";
    this.box.addEventListener("click", (event) => this.clicked(event));
    this.box.addEventListener("keydown", (event) => this.key(event));
  }

  show(picture, resting) {
    const names = picture.panels.map((panel) => panel.name).join();
    if (names !== this.names) {
      this.box.replaceChildren();
      const count = picture.panels.length;
      this.charts = picture.panels.map((panel, k) => new Chart(this.box, { name: `${panel.label.join(" ")} over frequency`, x: picture.axis, y: panel.label, stacked: true, last: k === count - 1 }));
      this.box.parentElement.style.setProperty("--panels", count);
      for (const chart of this.charts) chart.redraw = () => this.draw(true);
      this.names = names;
    }
    this.picture = picture;
    this.draw(resting);
  }

  // While a knob is turned the scale only grows, or every curve would look the same.
  draw(resting) {
    const { picture } = this;
    if (!picture) return;
    const { frequency } = picture;
    picture.panels.forEach((panel, i) => {
      const chart = this.charts[i];
      const levels = panel.levels.map((level) => level.value);
      const lists = [...Object.values(panel.curves), panel.free, levels];
      const old = chart.drawn ? chart.y : null;
      chart.axes([frequency[0], frequency.at(-1)], range(lists, { zero: true, old, shrink: resting }), panel.label, picture.axis);
      chart.drawn = true;
      chart.bands(picture.hysteresis.map((item) => [item.low, item.high]));
      chart.drop("level");
      panel.levels.forEach((level, k) => chart.level(`level ${k}`, "level", level.value));
      if (panel.free) chart.line("free", "free", frequency, panel.free);
      else chart.drop("free");
      for (const direction of SWEEPS) {
        chart.line(direction, direction, frequency, panel.curves[direction]);
        chart.marks(direction, direction, frequency, panel.curves[direction], picture.fine ? 4 : 1);
      }
    });
    this.mark();
    this.orbits();
  }

  // Where the motion that is shown lies on the curves.
  mark(chosen = this.chosen) {
    this.chosen = chosen;
    const { picture } = this;
    if (!picture || !chosen) return;
    const i = this.nearest(chosen.frequency);
    picture.panels.forEach((panel, k) => {
      const chart = this.charts[k];
      chart.upright("chosen", "chosen", picture.frequency[i]);
      const value = panel.curves[chosen.direction][i];
      const [x, y] = value === null ? [-99, -99] : [chart.toX(picture.frequency[i]), chart.toY(value)];
      chart.path("chosen dot", "dot", `M${x - 5} ${y}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0`, "over");
    });
  }

  // Branches of orbits, stable and not, where they are asked for.
  orbits(picture = this.branches) {
    this.branches = picture;
    for (const chart of this.charts) chart.drop("orbit");
    if (!picture || picture.physical !== this.picture?.physical) return;
    picture.panels.forEach((pieces, k) => {
      const chart = this.charts[k];
      if (chart) pieces.forEach((piece, j) => chart.line(`orbit ${j}`, piece.stable ? "stable" : "unstable", piece.frequency, piece.value));
    });
  }

  nearest(frequency) {
    const all = this.picture.frequency;
    let best = 0;
    all.forEach((value, i) => {
      if (Math.abs(value - frequency) < Math.abs(all[best] - frequency)) best = i;
    });
    return best;
  }

  clicked(event) {
    const k = this.charts.findIndex((chart) => chart.box.contains(event.target));
    if (k < 0 || !this.picture) return;
    const chart = this.charts[k];
    const [x, y] = chart.at(event.clientX, event.clientY);
    const i = this.nearest(x);
    const [low, high] = chart.x;
    if (x < low || x > high) return;
    const apart = (direction) => {
      const value = this.picture.panels[k].curves[direction][i];
      return value === null ? Infinity : Math.abs(value - y);
    };
    this.choose(apart("forward") <= apart("backward") ? "forward" : "backward", this.picture.frequency[i]);
  }

  key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const direction = { ArrowUp: "forward", ArrowDown: "backward" }[event.key];
    if (!this.picture || !this.chosen || !(step || direction)) return;
    event.preventDefault();
    const all = this.picture.frequency;
    const i = Math.min(Math.max(this.nearest(this.chosen.frequency) + (step || 0), 0), all.length - 1);
    this.choose(direction || this.chosen.direction, all[i]);
  }
}
