// The map of scenarios with the rig as a point that can be dragged, and the basins.

import { Chart, element } from "./plot.js";

// Told apart by how light they are as well.
const BASINS = ["#fbe9c0", "#3f6ea3", "#a6c8e4", "#7d3340", "#c99a6b", "#275a45", "#d8b4cf", "#555"];
const short = (name) => (name === "unclassified" ? "?" : name);
const letter = (k) => String.fromCharCode(65 + k);

// Edges of cells half-way between the nodes.
function edges(nodes, log) {
  const at = log ? nodes.map(Math.log) : nodes;
  const inner = at.slice(1).map((value, i) => (value + at[i]) / 2);
  const all = [at[0], ...inner, at.at(-1)];
  return log ? all.map(Math.exp) : all;
}

export class Plane {
  constructor(parent, move) {
    this.chart = new Chart(parent, { name: "Scenarios over stiffness ratio and gap ratio. The point marks the rig.", x: "stiffness ratio λ (–)", y: "gap ratio δ0 (–)", xlog: true });
    this.chart.redraw = () => this.draw();
    this.move = move;
    this.legend = parent.appendChild(document.createElement("ul"));
    this.legend.className = "basins";
    this.gesture = 0;
    const box = this.chart.box;
    box.tabIndex = 0;
    box.setAttribute("role", "application");
    box.setAttribute("aria-label", "Map of scenarios. Drag the point, or move it with the arrow keys.");
    box.addEventListener("pointerdown", (event) => {
      box.setPointerCapture(event.pointerId);
      this.gesture++;
      this.held = true;
      this.to(event, true);
    });
    box.addEventListener("pointermove", (event) => this.held && this.to(event, true));
    box.addEventListener("pointerup", (event) => {
      if (this.held) this.to(event, false);
      this.held = false;
    });
    box.addEventListener("keydown", (event) => this.key(event));
  }

  to(event, dragging) {
    const clip = (value, [low, high]) => Math.min(Math.max(value, low), high);
    const [x, y] = this.chart.at(event.clientX, event.clientY);
    this.move(Number(clip(x, this.chart.x).toPrecision(4)), Number(clip(y, this.chart.y).toFixed(4)), dragging, this.gesture);
  }

  key(event) {
    const steps = { ArrowLeft: [1 / 1.1, 0], ArrowRight: [1.1, 0], ArrowUp: [1, 0.02], ArrowDown: [1, -0.02] }[event.key];
    if (!steps || !this.point) return;
    event.preventDefault();
    this.move(this.point[0] * steps[0], Math.max(this.point[1] + steps[1], 0), false, ++this.gesture);
  }

  show(picture) {
    this.picture = picture;
    this.draw();
  }

  // Where the rig is; nowhere if it has no λ and δ0 of both sides.
  at(point, ranges, { scenarios, meanings }) {
    if (scenarios && !this.colours) {
      this.legend.replaceChildren(
        ...Object.entries(meanings).map(([name, meaning]) => {
          const item = document.createElement("li");
          const key = Object.assign(document.createElement("b"), { textContent: short(name) });
          key.style.background = scenarios[name];
          item.append(key, " ", meaning);
          return item;
        }),
      );
    }
    Object.assign(this, { point, ranges, colours: scenarios });
    this.draw();
  }

  draw() {
    const { chart, picture, point, ranges } = this;
    if (!ranges || !chart.box.offsetParent) return;
    chart.axes(ranges.x, ranges.y);
    chart.layers.bands.replaceChildren();
    if (picture?.cells) {
      const [xs, ys] = [edges(picture.x, true), edges(picture.y, false)];
      picture.cells.forEach((row, j) =>
        row.forEach((cell, i) => {
          const [x, y] = [chart.toX(xs[i]), chart.toY(ys[j + 1])];
          const [width, height] = [chart.toX(xs[i + 1]) - x, chart.toY(ys[j]) - y];
          const name = picture.names[cell];
          element("rect", { x, y, width: width + 0.5, height: height + 0.5, fill: this.colours[name] }, chart.layers.bands);
          if (width > 17) element("text", { x: x + width / 2, y: y + height / 2 + 4, "text-anchor": "middle", class: "on-colour" }, chart.layers.bands, short(name));
        }),
      );
    }
    if (!point) return chart.drop("point");
    const [x, y] = [chart.toX(Math.min(Math.max(point[0], ranges.x[0]), ranges.x[1])), chart.toY(Math.min(point[1], ranges.y[1]))];
    chart.path("point", "dot rig", `M${x - 7} ${y}a7 7 0 1 0 14 0a7 7 0 1 0 -14 0`, "over");
  }
}

export class Basins {
  constructor(parent) {
    this.chart = new Chart(parent, { name: "Basins of attraction" });
    this.chart.redraw = () => this.draw();
    this.legend = parent.appendChild(document.createElement("ul"));
    this.legend.className = "basins";
  }

  show(picture) {
    this.picture = picture;
    const about = picture.motions.map((words, k) => `${words}, excursion ${picture.excursions[k]}: ${(100 * picture.shares[k]).toPrecision(3)} % of the initial states`);
    this.legend.replaceChildren(
      ...about.map((words, k) => {
        const item = document.createElement("li");
        const key = Object.assign(document.createElement("b"), { textContent: letter(k) });
        key.style.background = BASINS[k % BASINS.length];
        item.append(key, " ", words);
        return item;
      }),
    );
    this.draw();
  }

  draw() {
    const { chart, picture } = this;
    if (!picture || !chart.box.offsetParent) return;
    chart.axes([picture.x[0], picture.x.at(-1)], [picture.y[0], picture.y.at(-1)], picture.axes.y, picture.axes.x);
    const [height, width] = [picture.cells.length, picture.cells[0].length];
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    const pen = canvas.getContext("2d");
    picture.cells.forEach((row, j) =>
      row.forEach((cell, i) => {
        pen.fillStyle = cell >= 0 ? BASINS[cell % BASINS.length] : cell === -1 ? "#888" : "#ccc";
        pen.fillRect(i, height - 1 - j, 1, 1);
      }),
    );
    const [x, y] = [chart.toX(picture.x[0]), chart.toY(picture.y.at(-1))];
    chart.layers.bands.replaceChildren();
    element("image", { href: canvas.toDataURL(), x, y, width: chart.toX(picture.x.at(-1)) - x, height: chart.toY(picture.y[0]) - y, preserveAspectRatio: "none", class: "cells" }, chart.layers.bands);
  }
}
