// Resonance curves: both sweeps of a state, their jumps and hysteresis, and the panels that are drawn.

import { engineRig, engineState, equilibrium, freeFlight, movesBase, omegaOf, references, SIDES } from "./rig.js";
import { fitting, one, short } from "./units.js";

const DIRECTIONS = ["forward", "backward"];
// Outcomes of a hold after which there is nothing sound to carry on.
const LOST = [2, 3, 4];
const AT_RESONANCE = 1e-9;
const RESONANT = 1e-14;

// As many frequencies as asked for; the resonance of an undamped isolator moved half a step.
export function grid(state, count) {
  const [low, high] = state.span;
  const step = (high - low) / (count - 1);
  const all = Array.from({ length: count }, (_, k) => (k < count - 1 ? k * step + low : high));
  if (state.oscillator.isolator.damping) return all;
  const natural = omegaOf(state.oscillator) / (2 * Math.PI);
  return all.map((f) => (Math.abs(f / natural - 1) < AT_RESONANCE ? f + 0.5 * (all[1] - all[0]) : f));
}

// Whether the motion without stops has no bound at a frequency.
export function unbounded({ oscillator: rig }, frequency) {
  const ratio = (2 * Math.PI * frequency) / omegaOf(rig);
  return !rig.right && !rig.left && !rig.isolator.damping && Math.abs((1 - ratio) * (1 + ratio)) <= RESONANT;
}

// Both sweeps; `pause` is awaited after each hold.
export async function swept(engine, state, fine, facts, pause) {
  const { layout } = engine;
  const { coarse, fine: many, patience, window } = facts.sweeps;
  const frequencies = grid(state, fine ? many : coarse);
  const options = fine ? {} : { cycles: patience, window };
  const rig = engineRig(state, layout);
  const begin = engineState(state.oscillator, equilibrium(state.oscillator), 0, layout);
  const sweeps = { frequencies, rig };
  for (const direction of DIRECTIONS) {
    const [rows, states] = [[], []];
    let here = begin;
    for (const frequency of direction === "forward" ? frequencies : frequencies.toReversed()) {
      const held = engine.sweep(rig, [state.amplitude], [frequency], here, options);
      rows.push(held.rows[0]);
      states.push(held.states[0]);
      here = LOST.includes(held.rows[0][layout.hold.OUTCOME]) ? begin : held.states[0];
      const done = (direction === "backward" ? frequencies.length : 0) + rows.length;
      await pause(done, 2 * frequencies.length);
    }
    if (direction === "backward") for (const list of [rows, states]) list.reverse();
    sweeps[direction] = { rows, states };
  }
  return sweeps;
}

function runs(flags, split) {
  const ranges = [];
  flags.forEach((yes, k) => {
    if (!yes) return;
    if (k && flags[k - 1] && !split?.[k - 1]) ranges.at(-1)[1] = k;
    else ranges.push([k, k]);
  });
  return ranges;
}

// Ranges in which the directions follow different motions; see `response.resonance.hysteresis`.
function hysteresis(frequency, a, d, settled, { apart, unsettled_apart }) {
  const relative = (one, other) => one.map((x, k) => (x - other[k]) / (Math.max(Math.abs(x), Math.abs(other[k])) || 1));
  const [ra, rd] = [relative(...a), relative(...d)];
  const known = frequency.map((_, k) => k).filter((k) => Number.isFinite(ra[k] + rd[k]));
  const both = known.map((k) => settled[0][k] && settled[1][k]);
  const differ = known.map((k, i) => Math.max(Math.abs(ra[k]), Math.abs(rd[k])) > (both[i] ? apart : unsettled_apart));
  const turned = known.slice(1).map((k, i) => Math.sign(ra[k]) !== Math.sign(ra[known[i]]) && Math.sign(rd[k]) !== Math.sign(rd[known[i]]));
  return runs(differ, turned).map(([first, last]) => {
    const sum = known.slice(first, last + 1).reduce((total, k) => total + ra[k], 0);
    const at = (i) => (i >= 0 && i < known.length ? frequency[known[i]] : null);
    return { side: sum > 0 ? "right" : "left", low: at(first), high: at(last), below: at(first - 1), above: at(last + 1) };
  });
}

// Steps far steeper than both neighbours; see `response.resonance._breaks`.
function breaks(frequency, curves, settled, { apart, unsettled_apart, step }) {
  const places = new Map();
  for (const [by, curve] of curves.entries()) {
    const known = curve.map((_, k) => k).filter((k) => Number.isFinite(curve[k]));
    if (known.length < 4) continue;
    const slope = known.slice(1).map((k, i) => Math.abs((curve[k] - curve[known[i]]) / (frequency[k] - frequency[known[i]])));
    for (let i = 1; i < slope.length - 1; i++) {
      if (!(slope[i] > step * Math.max(slope[i - 1], slope[i + 1]))) continue;
      const [before, after] = [known[i], known[i + 1]];
      const [one, other] = [curve[before], curve[after]];
      const least = settled[before] && settled[after] ? apart : unsettled_apart;
      if (Math.abs(one - other) / Math.max(Math.abs(one), Math.abs(other)) <= least) continue;
      const place = `${before},${after}`;
      if (!places.has(place)) places.set(place, [before, after, by]);
    }
  }
  return places;
}

function jumps(frequency, a, d, settled, apart, limits) {
  return DIRECTIONS.flatMap((direction, k) => {
    const places = breaks(frequency, [a[k], d[k]], settled[k], limits);
    for (const item of apart) {
      const pair = (direction === "forward" ? [item.high, item.above] : [item.below, item.low]).map((f) => frequency.indexOf(f));
      if (pair.every((place) => place >= 0)) places.set(pair.join(), [...pair, 0]);
    }
    const ordered = [...places.values()].sort((one, other) => (direction === "forward" ? 1 : -1) * (one[0] - other[0] || one[1] - other[1]));
    return ordered.map(([low, high, by]) => {
      const [before, after] = direction === "forward" ? [low, high] : [high, low];
      const curve = [a, d][by][k];
      return { direction, before: one(frequency[before], 7), after: one(frequency[after], 7), upward: curve[after] > curve[before] };
    });
  });
}

// The picture of the curves, as `explorer/pictures/curves.py` makes it.
export function curves(state, data, fine, facts, layout) {
  const { frequencies } = data;
  const { oscillator: rig, of } = state;
  const at = layout.hold;
  const each = (value) => DIRECTIONS.map((direction) => data[direction].rows.map(value));
  const swing = each((row) => row[at.U_MOST] - row[at.U_LEAST]);
  const acceleration = each((row) => row[at.A_MOST] - row[at.A_LEAST]);
  const [swing0, acceleration0] = references(state);
  const settled = each((row) => row[at.PERIOD] > 0);
  const [a, d] = [acceleration.map((list) => list.map((x) => x / acceleration0)), swing.map((list) => list.map((x) => x / swing0))];
  const apart = hysteresis(frequencies, a, d, settled, facts.sweeps);
  const free = freeFlight(state, frequencies);
  const still = !movesBase(of);
  const labels = facts.labels[still ? "still" : "moving"];
  const panel = (name, values, beside, unit = "", levels = []) => ({
    name,
    label: labels[name].map((line) => line.replace("{}", unit)),
    curves: { forward: short(values[0]), backward: short(values[1]) },
    free: beside && short(beside),
    levels: levels.map((value) => ({ value: one(value) })),
  });
  const scaled = (lists, factor) => lists.map((list) => list.map((x) => x * factor));
  const peak = (low, high) => each((row) => Math.max(Math.abs(row[high]), Math.abs(row[low])));
  const panels = [];
  if (!state.physical) {
    panels.push(panel("η_a", a, free.acceleration.map((x) => x / acceleration0)), panel("η_d", d, free.swing.map((x) => x / swing0)));
    const carried = each((row) => row[at.T_MOST] - row[at.T_LEAST]).map((list) => list.map((x, k) => x / free.exciting[k]));
    if (still) panels.push(panel("transmissibility", carried, free.carried.map((x, k) => x / free.exciting[k])));
  } else {
    const { gravity, seen } = facts.sweeps;
    const swings = scaled(peak(at.U_LEAST, at.U_MOST), 1e3);
    const most = (lists) => Math.max(0, ...lists.flat().filter(Number.isFinite));
    const gaps = [...new Set(SIDES.filter((side) => rig[side]).map((side) => 1e3 * rig[side].gap))];
    const rest = 1e3 * Math.abs(rig.force / rig.isolator.stiffness);
    panels.push(
      panel("acceleration", scaled(peak(at.A_LEAST, at.A_MOST), 1 / gravity), free.acceleration.map((x) => (0.5 * x) / gravity)),
      panel("displacement", swings, free.swing.map((x) => 500 * x + rest), "", gaps.filter((gap) => gap > 0 && gap <= seen * most(swings))),
    );
    const inUnit = (name, lists, quantity, beside = null) => {
      const [, size, symbol] = fitting([most(lists)], facts.quantities[quantity]);
      panels.push(panel(name, scaled(lists, 1 / size), beside?.map((x) => x / size) ?? null, symbol));
    };
    const largest = (column) => each((row) => Math.max(...SIDES.map((side, number) => (rig[side] ? row[column + number] : 0))) * rig.mass);
    if (still) inUnit("transmitted force", scaled(peak(at.T_LEAST, at.T_MOST), rig.mass), "force", free.carried.map((x) => 0.5 * x * rig.mass + Math.abs(rig.force)));
    for (const [name, lists, quantity] of [["force", largest(at.FORCE), "force"], ["impulse", largest(at.IMPULSE), "impulse"]]) {
      const known = lists.map((list) => list.map((x) => (Number.isFinite(x) ? x : NaN)));
      if (most(known) > 0) inUnit(name, known, quantity);
    }
  }
  return {
    picture: "curves",
    fine,
    words: null,
    physical: state.physical,
    frequency: short(frequencies, 7),
    axis: facts.axes.frequency,
    panels,
    jumps: jumps(frequencies, a, d, settled, apart, facts.sweeps),
    hysteresis: apart.map(({ low, high, side }) => ({ low: one(low, 7), high: one(high, 7), side })),
  };
}

// The hold of the sweep that is nearest to the motion which is shown.
export function held(state, data) {
  let best = 0;
  data.frequencies.forEach((f, k) => {
    if (Math.abs(f - state.frequency) < Math.abs(data.frequencies[best] - state.frequency)) best = k;
  });
  const { rows, states } = data[state.direction];
  return { frequency: data.frequencies[best], row: rows[best], state: states[best] };
}

