// A rig of one mass with linear laws: a table as in an address, its numbers for the engine, its free
// flight, and the changes of a knob. Each function stands for one of the package of the same purpose.

import { plain, pretty, read, Refused } from "./units.js";

export const SIDES = ["right", "left"];
const SIGN = { right: 1, left: -1 };
// A mass this close to a stop touches it, over the gap and the motion's size.
const TOUCHING = 1e-12;
// The mode in which both stops are touched, a bit each.
const BOTH = 3;

export const kindOf = (stop) => (stop ? (stop.kind ?? "kelvin-voigt") : "none");
const rigid = (stop) => kindOf(stop) === "rigid";
export const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
export const stopsOf = (rig) => SIDES.filter((side) => rig[side]).map((side) => rig[side]);
export const movesBase = (of) => of === "acceleration" || of === "displacement";
const grows = (of) => of === "displacement" || of === "unbalance";
export const omegaOf = (rig) => Math.sqrt(rig.isolator.stiffness / rig.mass);
const critical = (rig) => 2 * Math.sqrt(rig.isolator.stiffness * rig.mass);
export const dampingRatio = (rig) => rig.isolator.damping / critical(rig);

// The peak base acceleration that does the same as the shaking of a state, at ω.
export function accelerationAt({ oscillator, amplitude, of }, omega) {
  return (movesBase(of) ? amplitude : amplitude / oscillator.mass) * (grows(of) ? omega ** 2 : 1);
}

// The largest amplitudes of displacement and acceleration without stops, at any frequency.
export function largestFlight(omega, xi, amplitude) {
  const fixed = amplitude / omega ** 2;
  const swing = xi < Math.SQRT1_2 ? fixed / (2 * xi * Math.sqrt(1 - xi ** 2)) : fixed;
  const square = 2 / (1 + Math.sqrt(1 + 8 * xi ** 2));
  const damped = 4 * xi ** 2 * square;
  return [swing, amplitude * Math.sqrt((1 + damped) / ((1 - square) ** 2 + damped))];
}

// Excursions of displacement, acceleration and transmitted force per unit mass in free flight.
export function freeFlight(state, frequencies) {
  const { oscillator: rig, of } = state;
  const [omega0, xi] = [omegaOf(rig), dampingRatio(rig)];
  const excursions = { swing: [], acceleration: [], carried: [], exciting: [] };
  for (const frequency of frequencies) {
    const omega = 2 * Math.PI * frequency;
    const size = 2 * accelerationAt(state, omega);
    const ratio = omega / omega0;
    const damping = 2 * xi * ratio;
    const gain = size / Math.hypot((1 - ratio) * (1 + ratio), damping);
    const swing = gain / omega0 ** 2;
    const acceleration = gain * (movesBase(of) ? Math.sqrt(1 + damping ** 2) : ratio ** 2);
    excursions.swing.push(swing);
    excursions.acceleration.push(acceleration);
    excursions.carried.push(movesBase(of) ? acceleration : Math.hypot(rig.isolator.stiffness / rig.mass, (rig.isolator.damping / rig.mass) * omega) * swing);
    excursions.exciting.push(size);
  }
  return excursions;
}

// The excursions over which η is taken.
export function references(state) {
  const { oscillator: rig, of } = state;
  const [omega0, xi] = [omegaOf(rig), dampingRatio(rig)];
  const size = accelerationAt(state, omega0);
  const slow = [(2 * size) / omega0 ** 2, 2 * size];
  if (xi === 0) return slow;
  if (of === "acceleration") return largestFlight(omega0, xi, size).map((one) => 2 * one);
  const peaked = xi < Math.SQRT1_2;
  const peak = peaked ? 1 / (2 * xi * Math.sqrt(1 - xi ** 2)) : 1;
  if (of === "force") return slow.map((one) => peak * one);
  if (!peaked) return slow;
  const at = 1 / Math.sqrt(1 - 2 * xi ** 2);
  return [peak * slow[0], peak * slow[1] * (movesBase(of) ? Math.hypot(1, 2 * xi * at) : at ** 2)];
}

// Where laws and ranges of knobs are compared: the largest displacement without stops.
export function freeDisplacement(state) {
  const { oscillator: rig } = state;
  const omega = omegaOf(rig);
  const ratio = rig.isolator.damping / (2 * rig.mass * omega);
  return largestFlight(omega, Math.min(Math.max(ratio, 0.05), 0.7), accelerationAt(state, omega))[0];
}

// What gaps are scaled by; null if there is no finite resonance.
function peakDisplacement(state) {
  const { oscillator: rig } = state;
  const xi = dampingRatio(rig);
  if (!(xi > 0 && xi < Math.SQRT1_2)) return null;
  const [peak] = largestFlight(omegaOf(rig), xi, accelerationAt(state, omegaOf(rig)));
  return peak > 0 && Number.isFinite(peak) ? peak : null;
}

// The rig as the engine reads it, and which of its flows carries it.
export function engineRig(state, layout) {
  const { oscillator: rig, of } = state;
  const at = layout.rig;
  const vector = layout.free.map(Number);
  vector[at.STIFFNESS] = rig.isolator.stiffness / rig.mass;
  vector[at.DAMPING] = rig.isolator.damping / rig.mass;
  vector[at.LOAD] = rig.force / rig.mass;
  vector[at.BASE] = movesBase(of) ? 1 : 0;
  vector[at.SCALE] = { acceleration: 1, displacement: -1 }[of] ?? -1 / rig.mass;
  vector[at.POWER] = grows(of) ? 2 : 0;
  SIDES.forEach((side, k) => {
    const stop = rig[side];
    const block = at.BUMPER + at.WIDTH * k;
    if (!stop) return;
    vector[block + at.GAP] = stop.gap;
    if (rigid(stop)) {
      vector[block + at.KIND] = at.RIGID;
      vector[block + at.RESTITUTION] = stop.restitution;
      return;
    }
    vector[block + at.KIND] = at.KELVIN_VOIGT;
    vector[block + at.BUMPER_STIFFNESS] = stop.stiffness / rig.mass;
    vector[block + at.BUMPER_DAMPING] = stop.damping / rig.mass;
    if (stop.damping) vector[block + at.RATE] = stop.stiffness / stop.damping;
  });
  const overlap = rig.right && rig.left && rig.right.gap + rig.left.gap < 0;
  return { vector, flow: stopsOf(rig).some(rigid) || overlap ? "AnyStops" : "Bumpers" };
}

// The displacement of rest that a slow loading reaches.
export function equilibrium(rig) {
  if (rig.force === 0 && stopsOf(rig).every((stop) => stop.gap >= 0)) return 0;
  const bumpers = SIDES.filter((side) => rig[side] && !rigid(rig[side])).map((side) => [SIGN[side], rig[side]]);
  let [least, u] = [Infinity, 0];
  for (let pressed = 0; pressed < 1 << bumpers.length; pressed++) {
    let [stiffness, push] = [rig.isolator.stiffness, rig.force];
    bumpers.forEach(([sign, stop], k) => {
      if (!((pressed >> k) & 1)) return;
      stiffness += stop.stiffness;
      push += sign * stop.stiffness * stop.gap;
    });
    const there = push / stiffness;
    const wrong = Math.max(0, ...bumpers.map(([sign, stop], k) => (sign * there - stop.gap) * ((pressed >> k) & 1 ? -1 : 1)));
    if (wrong < least || (wrong === least && there < u)) [least, u] = [wrong, there];
  }
  if (rigid(rig.right)) u = Math.min(u, rig.right.gap);
  if (rigid(rig.left)) u = Math.max(u, -rig.left.gap);
  return u;
}

// A displacement and a velocity as the engine's state: bumpers are pressed as far as the mass is in.
export function engineState(rig, u, v, layout) {
  const at = layout.motion;
  const faces = { right: 0, left: 0 };
  let [mode, parted] = [at.FLIGHT, at.FLIGHT];
  for (const [number, side] of SIDES.entries()) {
    const stop = rig[side];
    if (!stop) continue;
    const [sign, bit] = [SIGN[side], 1 << number];
    const slack = TOUCHING * Math.max(Math.abs(stop.gap), Math.abs(u), Math.abs(v) / omegaOf(rig));
    const [reach, closing] = [sign * u - stop.gap, sign * v];
    let touches = false;
    let depth = 0;
    if (rigid(stop)) {
      touches = reach >= -slack && v === 0;
      if (touches) u = sign * stop.gap;
    } else {
      depth = Math.max(reach, 0);
      const near = depth - reach <= slack;
      if (stop.damping === 0 && !near) depth = 0;
      touches = near && stop.stiffness * depth + stop.damping * closing > 0 && !(depth <= slack && closing > 0);
    }
    if (touches) mode |= bit;
    else if (Math.abs(reach - depth) <= slack) {
      const [spring, dashpot] = [stop.stiffness * depth, stop.damping * closing];
      if (!rigid(stop) && depth > 0 ? Math.abs(spring + dashpot) <= TOUCHING * spring : closing <= 0) parted |= bit;
    }
    faces[side] = depth;
  }
  if (mode === BOTH && rig.right.gap + rig.left.gap >= 0) {
    const [right, left] = [u - rig.right.gap, -u - rig.left.gap];
    mode = 1 << (right > left || (right === left && v >= -v) ? 0 : 1);
  }
  const state = new Array(layout.state).fill(0);
  state[at.MODE] = mode;
  state[at.FRESH] = parted && parted !== BOTH ? parted : mode;
  [state[at.U], state[at.V]] = [u, v];
  for (const [number, side] of SIDES.entries()) state[at.DEFORMATION + number] = faces[side];
  return state;
}

// A dimensionless number of the rig; null if it has none.
export function ratio(state, rig, name) {
  if (name === "isolator_period") return (2 * Math.PI) / omegaOf(rig);
  if (name === "damping_ratio") return dampingRatio(rig);
  const [stop] = stopsOf(rig);
  if (!stop || (name !== "gap_ratio" && rigid(stop))) return null;
  if (name === "stiffness_ratio") return stop.stiffness / rig.isolator.stiffness;
  if (name === "relaxation_time") return omegaOf(rig) * (stop.damping / stop.stiffness);
  const peak = peakDisplacement({ ...state, oscillator: rig });
  return peak === null ? null : stop.gap / peak;
}

function withRatio(state, stop, name, value) {
  const { oscillator: rig } = state;
  if (name === "gap_ratio") {
    const peak = peakDisplacement(state);
    if (peak === null) throw new Refused(`gap_ratio: at a damping ratio of ${plain(dampingRatio(rig))} the motion without stops has no finite resonance peak`);
    return { ...stop, gap: value * peak };
  }
  if (name === "relaxation_time") return { ...stop, damping: (value * stop.stiffness) / omegaOf(rig) };
  const stiffness = value * rig.isolator.stiffness;
  return { ...stop, stiffness, damping: stiffness * (stop.damping / stop.stiffness) };
}

// Refuses what cannot be computed.
function checked(state) {
  const { oscillator: rig } = state;
  if (!(rig.isolator.stiffness > 0)) throw new Refused("isolator.stiffness: 0, so there is no natural frequency; use a stiffness greater than 0");
  if (rigid(rig.right) && rigid(rig.left) && !(rig.right.gap + rig.left.gap > 0)) throw new Refused("right.gap and left.gap leave no room between two rigid stops; use gaps with a sum greater than 0");
  return state;
}

// The state with another value of one knob.
export function moved(state, path, value, facts) {
  const { oscillator: rig } = state;
  const [part, name] = path.includes(".") ? path.split(".") : ["", path];
  const get = (accepts) => read(value, accepts, facts.quantities, path, facts.limits);
  const placed = (changes) => checked({ ...state, oscillator: { ...rig, ...changes } });
  if (path === "amplitude") return { ...state, ...sized(state, value, facts) };
  if (path === "isolator_period") {
    const number = get(facts.ratios[path]);
    const stiffness = rig.mass * ((2 * Math.PI) / number) ** 2;
    return placed({ isolator: { ...rig.isolator, stiffness, damping: 2 * dampingRatio(rig) * Math.sqrt(stiffness * rig.mass) } });
  }
  if (path === "damping_ratio") return placed({ isolator: { ...rig.isolator, damping: get(facts.ratios[path]) * critical(rig) } });
  if (!part && facts.fields[""][name]) return placed({ [name]: get(facts.fields[""][name]) });
  if (part === "isolator" && facts.fields.isolator[name]) return placed({ isolator: { ...rig.isolator, [name]: get(facts.fields.isolator[name]) } });
  const changes = {};
  for (const side of part === "stops" ? SIDES : [part]) {
    const stop = rig[side];
    if (!SIDES.includes(side) || !stop) continue;
    const field = facts.fields[kindOf(stop)][name];
    if (facts.ratios[name]) changes[side] = withRatio(state, stop, name, get(facts.ratios[name]));
    else if (field) changes[side] = { ...stop, [name]: get(field) };
  }
  if (!Object.keys(changes).length) throw new Refused(`knob: '${path}' is not a parameter of this rig; reload the page`);
  return placed(changes);
}

// The amplitude, of the quantity that its unit implies.
function sized(state, value, facts) {
  let first = null;
  for (const of of [state.of, ...Object.keys(facts.amplitudes)]) {
    const [, , quantity, accepted] = facts.amplitudes[of];
    try {
      return { amplitude: read(value, { quantity, accepted, above: 0 }, facts.quantities, "amplitude", facts.limits), of };
    } catch (error) {
      first ??= error;
    }
  }
  throw first;
}

// A stop of another law, about as strong.
function stopOf(kind, state, side, facts) {
  const { oscillator: rig } = state;
  const old = rig[side];
  if (old && kind === kindOf(old)) return old;
  if (kind === "none") return null;
  const u = freeDisplacement(state);
  const gap = old ? old.gap : 0.5 * u;
  const depth = facts.laws.pressed * u;
  const force = old && !rigid(old) ? old.stiffness * depth : facts.laws.stiffer * rig.isolator.stiffness * depth;
  if (kind === "rigid") return { kind, restitution: old?.restitution || facts.laws.restitution, gap };
  return { stiffness: force / depth, damping: (facts.laws.relaxation * force) / depth / omegaOf(rig), gap };
}

export function withLaw(state, part, kind, facts) {
  if (part === "isolator") return state;
  if (!facts.stops.includes(kind)) throw new Refused(`${part}.kind: '${kind}' is not computed here; use one of ${facts.stops.join(", ")}`);
  const changed = Object.fromEntries((part === "stops" ? SIDES : [part]).map((side) => [side, stopOf(kind, state, side, facts)]));
  return checked({ ...state, oscillator: { ...state.oscillator, ...changed } });
}

export function joined(state, together) {
  if (!together) return { ...state, together };
  const one = state.oscillator.right ?? state.oscillator.left;
  return checked({ ...state, together, oscillator: { ...state.oscillator, right: one, left: one } });
}

export function chosen(state, direction, frequency, facts) {
  if (direction !== "forward" && direction !== "backward") throw new Refused(`direction: '${direction}' is unknown; use 'forward' or 'backward'`);
  const accepts = { quantity: "frequency", above: 0, accepted: facts.frequency };
  const wanted = read(frequency, accepts, facts.quantities, "frequency", facts.limits);
  // The page has frequencies with some digits only, also those of both ends.
  const hertz = state.span.find((end) => Math.abs(wanted - end) <= facts.limits.rounded * Math.max(wanted, end)) ?? wanted;
  const [low, high] = state.span;
  if (!(hertz >= low && hertz <= high)) throw new Refused(`frequency: ${plain(hertz)} Hz is outside the range of the sweeps; use a frequency from ${plain(low)} to ${plain(high)} Hz`, "frequency");
  return { ...state, direction, frequency: hertz };
}

// The knobs of a state; their ranges hold what the page began with.
export function controls(state, first, facts) {
  const { oscillator: rig } = state;
  const [old, { knobs, quantities }] = [first.oscillator, facts];
  const [u, k] = [freeDisplacement(state), rig.isolator.stiffness];
  const sizes = { force: k * u, length: 1.2 * u, damping: Math.sqrt(k * rig.mass) };
  const list = [];
  const add = (path, group, label, value, quantity, [low, high, log], symbol) => {
    const [, name] = path.includes(".") ? path.split(".") : ["", path];
    const own = knobs.symbols[path];
    list.push({
      path,
      group,
      label,
      symbol: symbol ?? own ?? (path.startsWith("isolator.") ? "" : (knobs.symbols[name] ?? "")),
      value,
      text: pretty(value, quantities[quantity], 4),
      low: value > 0 || !log ? Math.min(low, value) : low,
      high: Math.max(high, value),
      log,
    });
  };
  const [label, symbol, quantity] = facts.amplitudes[state.of];
  const begun = first.of === state.of ? first.amplitude : state.amplitude;
  add("amplitude", "shaking", label, state.amplitude, quantity, [begun / knobs.factor, begun * knobs.factor, true], symbol);
  const fields = (part, before, kind, name, group) => {
    for (const [field, accepts] of Object.entries(facts.fields[kind])) {
      const path = name ? `${name}.${field}` : field;
      const value = part[field];
      const start = (before ? before[field] : value) || 0;
      const factor = name && name !== "isolator" ? knobs.wide : knobs.factor;
      const large = Math.max(sizes[accepts.quantity] ?? 1, 2 * Math.abs(start));
      const below = accepts.minimum === null && accepts.above === null && field !== "gap";
      const linear = !(start > 0) || accepts.quantity === "length";
      const ends = knobs.ranges[field] ?? (linear ? [below ? -large : 0, large, false] : [start / factor, start * factor, true]);
      add(path, group, knobs.labels[path] ?? field.replaceAll("_", " "), value, accepts.quantity, ends);
    }
  };
  fields(rig, old, "", "", "mass and isolator");
  fields(rig.isolator, old.isolator, "isolator", "isolator", "mass and isolator");
  const both = state.together && same(rig.right, rig.left);
  for (const side of both ? ["stops"] : SIDES) {
    const [stop, before] = both ? [rig.right, old.right] : [rig[side], old[side]];
    if (stop) fields(stop, kindOf(before) === kindOf(stop) ? before : null, kindOf(stop), side, both ? "both stops" : `${side} stop`);
  }
  for (const name of ["isolator_period", "damping_ratio"]) {
    const value = ratio(state, rig, name);
    add(name, "dimensionless", name.replaceAll("_", " "), value, facts.ratios[name].quantity, knobs.ranges[name] ?? [value / knobs.factor, value * knobs.factor, true]);
  }
  for (const side of both ? ["stops"] : SIDES) {
    const alone = both ? rig : { ...rig, [side === "right" ? "left" : "right"]: null };
    for (const name of ["stiffness_ratio", "gap_ratio", "relaxation_time"]) {
      const value = ratio(state, alone, name);
      const words = name.replaceAll("_", " ");
      if (value !== null) add(`${side}.${name}`, "dimensionless", both ? words : `${words}, ${side}`, value, facts.ratios[name].quantity, knobs.ranges[name]);
    }
  }
  if (list.some((knob) => !Number.isFinite(knob.value) || !Number.isFinite(knob.high - knob.low) || (knob.log && !(knob.low > 0))))
    throw new Refused("value: with this value, some numbers of the rig are not finite; choose a less extreme value");
  return list;
}
