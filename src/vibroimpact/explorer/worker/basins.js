// Basins of attraction: each initial state is followed until its motion repeats itself.

import { apart, reach } from "./motion.js";
import { accelerationAt, engineRig, engineState, kindOf, omegaOf, stopsOf } from "./rig.js";
import { Refused, one, plain, short } from "./units.js";

const [UNDECIDED, NOWHERE] = [-1, -2];
// Over its size: within this a point of a motion is that of another.
const SAME = 1e-6;
const SAMPLES = 64;

const along = ([low, high], count) => Array.from({ length: count }, (_, k) => (k < count - 1 ? low + (k * (high - low)) / (count - 1) : high));

class Search {
  constructor(engine, state, facts) {
    Object.assign(this, { engine, state, facts, layout: engine.layout, known: [] });
    this.rig = engineRig(state, engine.layout);
    this.omega = 2 * Math.PI * state.frequency;
  }

  follow(u, v) {
    const { engine, rig, state, facts } = this;
    const begin = engineState(state.oscillator, u, v, this.layout);
    const held = engine.sweep(rig, [state.amplitude], [state.frequency], begin, { cycles: facts.basins.patience, window: 1 });
    return { row: held.rows[0], state: held.states[0] };
  }

  // Number of the motion that an initial state leads to.
  label(u, v) {
    const { hold } = this.layout;
    const { row, state } = this.follow(u, v);
    if (row[hold.OUTCOME] > 1) return UNDECIDED;
    const period = row[hold.PERIOD];
    const size = reach(this.state, state, this.omega, this.layout);
    const index = this.known.findIndex((other) => other.period === period && (!period || other.points.some((point) => apart(point, state, this.omega, this.layout) <= SAME * Math.max(size, other.size))));
    if (index >= 0) return index;
    this.known.push(this.motion(state, period, size));
    return this.known.length - 1;
  }

  motion(state, period, size) {
    const { engine, rig, state: now, facts } = this;
    const at = this.layout.record;
    const points = [state];
    for (let k = 1; k < period; k++) points.push(engine.trajectory(rig, now.amplitude, now.frequency, points.at(-1), 1, 0).state);
    const cycles = period || facts.basins.window;
    const made = engine.trajectory(rig, now.amplitude, now.frequency, state, cycles, SAMPLES);
    const measured = engine.sweep(rig, [now.amplitude], [now.frequency], state, period ? {} : { cycles: 1, window: cycles }).rows[0];
    const { U_LEAST, U_MOST } = this.layout.hold;
    const fastest = made.rows[at.VELOCITY].reduce((most, v) => Math.max(most, Math.abs(v)), 0);
    return { period, points, size, least: measured[U_LEAST], most: measured[U_MOST], fastest };
  }

  walls() {
    const { right, left } = this.state.oscillator;
    return [kindOf(left) === "rigid" ? -left.gap : -Infinity, kindOf(right) === "rigid" ? right.gap : Infinity];
  }

  // Around all motions that starts in a larger window lead to.
  async window(pause) {
    const { state, facts, layout, omega } = this;
    const { first, wider, lattice } = facts.basins;
    const rest = this.follow(0, 0);
    let size = accelerationAt(state, omega) / omegaOf(state.oscillator) ** 2;
    if (rest.row[layout.hold.OUTCOME] <= 1) size = Math.max(size, reach(state, rest.state, omega, layout));
    size = first * Math.max(size, ...stopsOf(state.oscillator).map((stop) => Math.abs(stop.gap)));
    const [low, high] = this.walls();
    const clipped = (ends) => [Math.max(ends[0], low), Math.min(ends[1], high)];
    const wide = clipped([-size, size]);
    let fast = size * omega;
    for (const v of along([-fast, fast], lattice)) for (const u of along(wide, lattice)) {
      this.label(u, v);
      await pause();
    }
    if (!this.known.length) return [wide, [-fast, fast]];
    const [most, least] = [Math.max(...this.known.map((motion) => motion.most)), Math.min(...this.known.map((motion) => motion.least))];
    fast = wider * Math.max(...this.known.map((motion) => motion.fastest));
    const [middle, half] = [0.5 * (most + least), 0.5 * wider * (most - least)];
    return [clipped([middle - half, middle + half]), [-fast, fast]];
  }
}

// The picture of the basins, as `explorer/pictures/basins.py` makes it.
export async function basins(engine, state, fine, facts, pause) {
  const { isolator } = state.oscillator;
  const lossy = isolator.damping > 0 || stopsOf(state.oscillator).some((stop) => stop.damping > 0 || (kindOf(stop) === "rigid" && stop.restitution < 1));
  if (!lossy) throw new Refused("basins: the rig loses no energy, so every initial state has its own motion; give the isolator damping");
  const search = new Search(engine, state, facts);
  const count = fine ? facts.basins.fine : facts.basins.coarse;
  const [wide, fast] = await search.window(pause);
  const [us, vs] = [along(wide, count), along(fast, count)];
  const [low, high] = search.walls();
  const labels = [];
  for (const [k, v] of vs.entries()) {
    const row = [];
    for (const u of us) {
      row.push(u < low || u > high ? NOWHERE : search.label(u, v));
      await pause(k, count);
    }
    labels.push(row);
  }
  const flat = labels.flat();
  const excursion = ({ most, least }) => most - least;
  const order = search.known.map((_, k) => k).filter((k) => flat.includes(k));
  // To nine digits, for of a mirrored pair rounding decides; then by the side.
  const rank = (k) => [-Number(excursion(search.known[k]).toPrecision(9)), -(search.known[k].most + search.known[k].least)];
  order.sort((i, j) => rank(i)[0] - rank(j)[0] || rank(i)[1] - rank(j)[1]);
  const number = new Map(order.map((old, k) => [old, k]));
  const total = flat.filter((cell) => cell >= UNDECIDED).length;
  return {
    picture: "basins",
    fine,
    frequency: one(state.frequency, 7),
    axes: facts.axes.basins,
    x: short(us.map((u) => 1e3 * u)),
    y: short(vs.map((v) => 1e3 * v)),
    cells: labels.map((row) => row.map((cell) => number.get(cell) ?? cell)),
    motions: order.map((k) => (search.known[k].period ? `periodic, period ${search.known[k].period}` : "not periodic")),
    shares: order.map((k) => one(flat.filter((cell) => cell === k).length / Math.max(total, 1), 3)),
    excursions: order.map((k) => `${plain(1e3 * excursion(search.known[k]), 3)} mm`),
  };
}
