// A chart in SVG: axes, curves, bands and marks, redrawn in place. It knows no physics.

const NS = "http://www.w3.org/2000/svg";
const MARGIN = { left: 62, right: 10, top: 8, bottom: 34 };
// Of panels one above the other on a small screen: a label beside the axis is longer than the axis.
const SMALL_SCREEN = matchMedia("(max-width: 700px), (max-height: 500px)");
const STACKED = { left: 44, right: 10, top: 19, bottom: 18 };
const LAST = { ...STACKED, bottom: 32 };

// Parts of a text of which every second one is a subscript: "K_j" and "δ0" have one.
const SYMBOL = /(?<!\w)([A-Za-zα-ωΑ-Ω])_([a-z0-9]{1,3})(?!\w)|([δω])(0)(?!\d)/gu;
export function subscripts(text) {
  const parts = [""];
  let end = 0;
  for (const match of text.matchAll(SYMBOL)) {
    parts[parts.length - 1] += text.slice(end, match.index) + (match[1] ?? match[3]);
    parts.push(match[2] ?? match[4], "");
    end = match.index + match[0].length;
  }
  parts[parts.length - 1] += text.slice(end);
  return parts;
}

// A text of the page with its subscripts.
export function written(node, text) {
  node.replaceChildren(...subscripts(text).map((part, k) => (k % 2 ? Object.assign(document.createElement("sub"), { textContent: part }) : part)));
}

// The same where all signs are equally wide: a subscript is as wide as the signs that it replaces.
export function fixed(node, text) {
  const parts = subscripts(text);
  node.replaceChildren(
    ...parts.map((part, k) => {
      if (k % 2 === 0) return part;
      const box = Object.assign(document.createElement("span"), { className: "cell" });
      box.style.width = `${part.length + (/\d/.test(part) ? 0 : 1)}ch`;
      box.append(Object.assign(document.createElement("sub"), { textContent: part }));
      return box;
    }),
  );
}

export function element(name, attributes = {}, parent = null, text = "") {
  const made = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  const [first, ...others] = subscripts(text);
  if (first) made.textContent = first;
  others.forEach((part, k) => element("tspan", k % 2 ? { dy: "-0.22em" } : { dy: "0.3em", "font-size": "0.75em" }, made).append(part));
  if (parent) parent.append(made);
  return made;
}

// Round steps of 1, 2 or 5 times a power of ten.
export function ticks(low, high, about) {
  const raw = (high - low) / Math.max(about, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((one) => one >= raw * 0.999);
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) values.push(k * step);
  return values;
}

function decades(low, high) {
  const values = [];
  for (let k = Math.floor(Math.log10(low)); 10 ** k <= high * 1.001; k++)
    for (const digit of high / low > 100 ? [1] : [1, 2, 5]) if (digit * 10 ** k >= low * 0.999 && digit * 10 ** k <= high * 1.001) values.push(digit * 10 ** k);
  return values;
}

export const label = (value) => Number(value.toPrecision(6)).toString();
const SMALL = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const power = (value) => {
  const digits = -Math.round(Math.log10(value));
  return digits < 3 ? label(value) : `10⁻${[...digits.toString()].map((one) => SMALL[one]).join("")}`;
};

export class Chart {
  constructor(parent, { name, x, y, xlog = false, ylog = false, wide = false, stacked = false, last = false }) {
    this.box = document.createElement("div");
    this.box.className = wide ? "chart wide" : "chart";
    parent.append(this.box);
    this.svg = element("svg", { role: "img", "aria-label": name }, this.box);
    this.layers = Object.fromEntries(["bands", "axes", "lines", "marks", "over"].map((id) => [id, element("g", { class: id }, this.svg)]));
    Object.assign(this, { name, xlabel: x, ylabel: y, xlog, ylog, stacked, last, x: [0, 1], y: [0, 1], paths: new Map() });
    this.measure();
    new ResizeObserver(() => this.redraw && this.redraw()).observe(this.box);
  }

  // Looked up once a drawing: asking the page in between would let it lay out anew each time.
  measure() {
    this.size = [this.box.clientWidth || 400, this.box.clientHeight || 200];
    this.above = this.stacked && SMALL_SCREEN.matches;
    this.margin = this.above ? (this.last ? LAST : STACKED) : MARGIN;
  }

  toX(value) {
    const [low, high] = this.xlog ? this.x.map(Math.log10) : this.x;
    return this.margin.left + (((this.xlog ? Math.log10(value) : value) - low) / (high - low)) * (this.size[0] - this.margin.left - this.margin.right);
  }

  toY(value) {
    const [low, high] = this.ylog ? this.y.map(Math.log10) : this.y;
    return this.size[1] - this.margin.bottom - (((this.ylog ? Math.log10(value) : value) - low) / (high - low)) * (this.size[1] - this.margin.top - this.margin.bottom);
  }

  // Values under a point of the page.
  at(clientX, clientY) {
    const box = this.box.getBoundingClientRect();
    const across = (clientX - box.left - this.margin.left) / (box.width - this.margin.left - this.margin.right);
    const up = (box.bottom - this.margin.bottom - clientY) / (box.height - this.margin.top - this.margin.bottom);
    const along = ([low, high], share, log) => (log ? low * (high / low) ** share : low + share * (high - low));
    return [along(this.x, across, this.xlog), along(this.y, up, this.ylog)];
  }

  // Axes for these ranges; what was drawn before is redrawn by whoever calls.
  axes(x, y, ylabel = this.ylabel, xlabel = this.xlabel) {
    Object.assign(this, { x, y, ylabel, xlabel });
    this.measure();
    const [width, height] = this.size;
    const group = this.layers.axes;
    group.replaceChildren();
    const [left, right, top, bottom] = [this.margin.left, width - this.margin.right, this.margin.top, height - this.margin.bottom];
    const xs = this.xlog ? decades(...x) : ticks(...x, Math.max(width / 75, 4));
    const ys = this.ylog ? decades(...y) : ticks(...y, height / 33);
    for (const value of xs) {
      element("path", { class: "grid", d: `M${this.toX(value)} ${top}V${bottom}` }, group);
      element("text", { x: this.toX(value), y: bottom + 13, "text-anchor": "middle" }, group, label(value));
    }
    for (const value of ys) {
      element("path", { class: "grid", d: `M${left} ${this.toY(value)}H${right}` }, group);
      element("text", { x: left - 5, y: this.toY(value) + 4, "text-anchor": "end" }, group, this.ylog ? power(value) : label(value));
    }
    element("path", { class: "axis", d: `M${left} ${top}V${bottom}H${right}` }, group);
    if (!this.above || this.last) element("text", { x: (left + right) / 2, y: height - 6, "text-anchor": "middle", class: "soft" }, group, this.xlabel);
    if (this.above) {
      element("text", { x: 2, y: 12, class: "soft" }, group, [ylabel].flat().join(" "));
      return;
    }
    [ylabel].flat().forEach((words, i, all) => {
      const place = `translate(${(all.length > 1 ? 11 : 20) + 13 * i} ${(top + bottom) / 2}) rotate(-90)`;
      element("text", { transform: place, "text-anchor": "middle", class: "soft" }, group, words);
    });
  }

  path(name, kind, d, layer = "lines") {
    let path = this.paths.get(name);
    if (!path) this.paths.set(name, (path = element("path", { "data-name": name }, this.layers[layer])));
    path.setAttribute("class", kind);
    path.setAttribute("d", d);
    return path;
  }

  // A curve; it is interrupted where there is no number.
  line(name, kind, xs, ys) {
    let d = "";
    let pen = "M";
    for (let i = 0; i < xs.length; i++) {
      if (ys[i] === null || xs[i] === null || (this.ylog && !(ys[i] > 0))) {
        pen = "M";
        continue;
      }
      d += `${pen}${this.toX(xs[i]).toFixed(1)} ${this.toY(ys[i]).toFixed(1)}`;
      pen = "L";
    }
    return this.path(name, `line ${kind}`, d);
  }

  // Dots or open squares at every so manieth point.
  marks(name, kind, xs, ys, every = 1) {
    let d = "";
    for (let i = 0; i < xs.length; i += every) {
      if (ys[i] === null) continue;
      const [x, y] = [this.toX(xs[i]), this.toY(ys[i])];
      d += kind.includes("forward") ? `M${(x - 2).toFixed(1)} ${y.toFixed(1)}a2 2 0 1 0 4 0a2 2 0 1 0 -4 0` : `M${(x - 3).toFixed(1)} ${(y - 3).toFixed(1)}h6v6h-6z`;
    }
    return this.path(`${name} marks`, `mark ${kind}`, d, "marks");
  }

  upright(name, kind, x) {
    return this.path(name, kind, `M${this.toX(x)} ${this.margin.top}V${this.size[1] - this.margin.bottom}`);
  }

  level(name, kind, y) {
    return this.path(name, kind, `M${this.margin.left} ${this.toY(y)}H${this.size[0] - this.margin.right}`);
  }

  bands(spans) {
    let d = "";
    for (const [low, high] of spans) d += `M${this.toX(low)} ${this.margin.top}H${this.toX(high)}V${this.size[1] - this.margin.bottom}H${this.toX(low)}Z`;
    return this.path("bands", "band", d, "bands");
  }

  // Takes away what has a name that begins so.
  drop(prefix) {
    for (const [name, path] of this.paths)
      if (name.startsWith(prefix)) {
        path.remove();
        this.paths.delete(name);
      }
  }
}

// A range that holds all numbers, with room; it grows at once and shrinks only when told to.
export function range(lists, { zero = false, old = null, shrink = true, even = false } = {}) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists)
    for (const value of list || [])
      if (value !== null) [low, high] = [Math.min(low, value), Math.max(high, value)];
  if (zero) low = Math.min(low, 0);
  if (!(low < high)) [low, high] = Number.isFinite(low) ? [low - 0.5 * Math.abs(low || 1), low + 0.5 * Math.abs(low || 1)] : [0, 1];
  const room = 0.06 * (high - low);
  [low, high] = [zero && low === 0 ? 0 : low - room, high + room];
  if (even) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
  if (old && !shrink) return [Math.min(low, old[0]), Math.max(high, old[1])];
  return [low, high];
}
