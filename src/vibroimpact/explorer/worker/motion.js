// One motion: its history over some cycles, its kind, its spectrum and its impacts.

import { accelerationAt, movesBase, omegaOf, SIDES } from "./rig.js";
import { held } from "./sweep.js";
import { fitting, one, plain, short } from "./units.js";

const SIGN = { right: 1, left: -1 };
// Over the size of a motion: within this its mirror image is itself. Of a multiplier's logarithm: what is neither.
const [ANTISYMMETRIC, NEUTRAL] = [1e-8, 1e-6];
// A periodic motion's spectrum needs so many samples a cycle for each that is drawn.
const DENSER = 10;
const SQUARINGS = 40;

function drawn(state, made, frequency, count, samples, facts, layout) {
  const { oscillator: rig, of } = state;
  const at = layout.record;
  const rows = made.rows.map((row) => row.slice(0, count));
  const [u, v, acceleration] = [rows[at.DISPLACEMENT], rows[at.VELOCITY], rows[at.ACCELERATION]];
  const omega = 2 * Math.PI * frequency;
  const push = movesBase(of) ? 0 : state.amplitude * (of === "unbalance" ? omega ** 2 : 1);
  const force = Array.from(acceleration, (a, k) => push * Math.sin((2 * Math.PI * (k % samples)) / samples) + rig.force - rig.mass * a);
  const [, size, symbol] = fitting(force, facts.quantities.force);
  const drawing = {
    picture: "motion",
    direction: state.direction,
    frequency: one(frequency, 7),
    cycle: 1 / frequency,
    seconds: true,
    axes: { ...facts.axes.motion, force: facts.axes.motion.force.replace("{}", symbol) },
    time: short(Array.from(u, (_, k) => k / samples / frequency), 6),
    displacement: short(u.map((x) => 1e3 * x)),
    velocity: short(v.map((x) => 1e3 * x)),
    force: short(force.map((x) => x / size)),
    touching: {},
    gaps: {},
  };
  for (const [number, side] of SIDES.entries()) {
    const stop = rig[side];
    drawing.gaps[side] = stop ? one(1e3 * SIGN[side] * stop.gap) : null;
    drawing[side] = stop ? short(rows[at.DEFORMATION + number].map((depth) => 1e3 * SIGN[side] * (stop.gap + depth))) : null;
    if (stop) drawing.touching[side] = Array.from(rows[at.TOUCHED], (mode) => (mode >> number) & 1);
  }
  return drawing;
}

// The motion at the end of a hold of the sweep, while a knob is turned.
export function quick(engine, state, data, facts) {
  const { frequency, row, state: begin } = held(state, data);
  const { samples, most } = facts.motions;
  const period = row[engine.layout.hold.PERIOD];
  const cycles = period > 0 && period <= most ? period : most;
  const made = engine.trajectory(data.rig, state.amplitude, frequency, begin, cycles, samples);
  return { ...drawn(state, made, frequency, made.rows[0].length, samples, facts, engine.layout), fine: false };
}

// Largest multiplier of an orbit, in modulus, from the derivative of its map: by squaring.
export function largestMultiplier(columns, parts) {
  const get = (i, j) => columns[parts * i + j];
  const touched = [2, 3].filter((j) => [0, 1].some((i) => get(i, j) !== 0 || get(j, i) !== 0));
  const kept = [0, 1, ...touched];
  let matrix = kept.map((i) => kept.map((j) => get(i, j)));
  let logarithm = 0;
  for (let k = 0; k < SQUARINGS; k++) {
    const size = Math.max(...matrix.flat().map(Math.abs));
    if (!(size > 0)) return 0;
    logarithm += Math.log(size) / 2 ** k;
    const scaled = matrix.map((row) => row.map((x) => x / size));
    matrix = scaled.map((row) => scaled[0].map((_, j) => row.reduce((sum, x, m) => sum + x * scaled[m][j], 0)));
  }
  return Math.exp(logarithm);
}

export function mirrored(vector, { motion: at }) {
  const image = Array.from(vector);
  const mode = vector[at.MODE];
  image[at.MODE] = ((mode & 1) << 1) | (mode >> 1);
  image[at.U] = -vector[at.U];
  image[at.V] = -vector[at.V];
  [image[at.DEFORMATION], image[at.DEFORMATION + 1]] = [vector[at.DEFORMATION + 1], vector[at.DEFORMATION]];
  return image;
}

// Largest difference of two states, as a displacement over a size.
export function apart(one, other, omega, { motion: at }) {
  const differences = [[at.U, 1], [at.V, omega], [at.DEFORMATION, 1], [at.DEFORMATION + 1, 1]].map(([k, unit]) => Math.abs(one[k] - other[k]) / unit);
  return Math.max(...differences);
}

export function reach(state, vector, omega, { motion: at }) {
  const still = accelerationAt(state, omega) / omegaOf(state.oscillator) ** 2;
  return Math.max(Math.abs(vector[at.U]), Math.abs(vector[at.V]) / omega, 1e-3 * still, 1e-300);
}

// Kind, stability and symmetry of a periodic motion, in words.
function words(engine, rig, state, frequency, begin, period) {
  const { layout } = engine;
  const columns = engine.monodromy(rig, state.amplitude, frequency, begin, period);
  const largest = columns && largestMultiplier(columns, layout.parts);
  const growth = Math.log(largest);
  const stability = !columns ? [] : [Math.abs(growth) <= NEUTRAL ? "neutral (disturbances neither grow nor decay)" : growth < 0 ? "stable" : "unstable"];
  let mirror = false;
  if (period % 2 === 1) {
    const omega = 2 * Math.PI * frequency;
    const half = engine.trajectory(rig, state.amplitude, frequency, begin, period / 2, 0).state;
    mirror = apart(mirrored(half, layout), begin, omega, layout) <= ANTISYMMETRIC * reach(state, begin, omega, layout);
  }
  const kind = [`periodic, period ${period}`, ...stability, mirror ? "antisymmetric" : "not antisymmetric"].join(", ");
  const known = columns ? `; largest multiplier ${plain(largest)} in modulus` : "";
  return `${kind}: the section repeats after ${period} cycle${period === 1 ? "" : "s"}${known}`;
}

// Lines of the displacement: of a periodic motion over its period, of another with a Hann window.
function spectrum(values, cycles, periodic, frequency, highest) {
  const count = values.length - 1;
  const weights = Array.from({ length: count }, (_, k) => (periodic ? 1 : 0.5 - 0.5 * Math.cos((2 * Math.PI * k) / count)));
  const total = weights.reduce((sum, x) => sum + x, 0);
  const mean = values.slice(0, count).reduce((sum, x) => sum + x, 0) / count;
  const weighted = weights.map((weight, k) => weight * (values[k] - mean));
  const [cosines, sines] = [Math.cos, Math.sin].map((f) => Float64Array.from({ length: count }, (_, k) => f((2 * Math.PI * k) / count)));
  const lines = { frequency: [], displacement: [] };
  for (let n = 1; n <= highest * cycles + 1e-9; n++) {
    let [real, imaginary, place] = [0, 0, 0];
    for (let k = 0; k < count; k++) {
      real += weighted[k] * cosines[place];
      imaginary += weighted[k] * sines[place];
      place = (place + n) % count;
    }
    lines.frequency.push(one((n / cycles) * frequency));
    lines.displacement.push(one((2e3 * Math.hypot(real, imaginary)) / total));
  }
  return lines;
}

// The motion that the selected one settles on, classified, with its spectrum and its impacts.
export function careful(engine, state, data, facts) {
  const { layout } = engine;
  const { samples, most, window, highest } = facts.motions;
  const { frequency, state: near } = held(state, data);
  const { rig } = data;
  const settled = engine.sweep(rig, [state.amplitude], [frequency], near, { window: 1 });
  const [row, begin] = [settled.rows[0], settled.states[0]];
  const outcome = row[layout.hold.OUTCOME];
  const period = row[layout.hold.PERIOD];
  const usable = outcome === 0 || outcome === 1;
  const start = usable ? begin : near;
  const cycles = period || window;
  const made = engine.trajectory(rig, state.amplitude, frequency, start, cycles, samples);
  const count = Math.min(most * samples + 1, made.rows[0].length);
  const at = layout.record;
  const dense = period ? engine.trajectory(rig, state.amplitude, frequency, start, period, DENSER * samples) : made;
  const end = (count - 1) / samples / frequency;
  const impacts = made.events.filter((event) => event[at.E_KIND] !== at.DETACHMENT);
  const hits = impacts.map((event) => ({
    time: one(event[at.E_CYCLE] / frequency + event[at.E_TIME]),
    stop: SIDES[event[at.E_STOP]],
    speed: one(1e3 * Math.abs(event[at.E_V])),
  }));
  return {
    ...drawn(state, made, frequency, count, samples, facts, layout),
    fine: true,
    words: period ? words(engine, rig, state, frequency, start, period) : `not periodic: ${layout.advice[outcome]}`,
    table: null,
    spectrum: spectrum(dense.rows[at.DISPLACEMENT], cycles, period > 0, frequency, highest),
    hits: hits.filter((hit) => hit.time < end),
  };
}
