// The engine as machine code of WebAssembly, called as `engine/native.py` calls it in Python.

const WORD = 8;
const LINE = 64;
const ARGUMENT = /(?:UniTuple\((?:f8|i8), (\d)\))|(f8|i8|boolean|void)(\[[:, 1]*\])?/g;

export class Engine {
  // `layout` is what Python states of the engine: signatures, positions and sizes.
  constructor(instance, layout) {
    this.code = instance.exports;
    this.layout = layout;
    this.signatures = Object.fromEntries(Object.entries(layout.entries).map(([name, text]) => [name, [...text.matchAll(ARGUMENT)]]));
    this.end = this.code.__heap_base.value;
    this.tables = Object.fromEntries(layout.flows.map((flow) => [flow, this.table(flow)]));
    this.begin = this.end;
  }

  // Memory for so many numbers, at the start of a cache line.
  room(count) {
    const at = Math.ceil(this.end / LINE) * LINE;
    this.end = at + WORD * count;
    const { memory } = this.code;
    const lacking = this.end - memory.buffer.byteLength;
    if (lacking > 0) memory.grow(Math.ceil(lacking / 65536) + 16);
    return at;
  }

  put(values) {
    const at = this.room(values.length);
    new values.constructor(this.code.memory.buffer, at, values.length).set(values);
    return at;
  }

  numbers(at, count) {
    return new Float64Array(this.code.memory.buffer, at, count);
  }

  // The addresses of a flow's functions.
  table(flow) {
    const at = this.put(new BigInt64Array(this.layout.functions));
    const [plan, words] = [this.plan(flow), this.array(at, [this.layout.functions])];
    for (const group of this.layout.groups) this.code[`${flow}_flow_tables__${group}`](0, 0, ...plan, ...words);
    return at;
  }

  // The words of an array, as numba passes it.
  array(at, shape) {
    const strides = shape.map((_, k) => BigInt(WORD * shape.slice(k + 1).reduce((product, n) => product * n, 1)));
    const size = shape.reduce((product, n) => product * n, 1);
    return [0, 0, BigInt(size), BigInt(WORD), at, ...shape.map(BigInt), ...strides];
  }

  // Room for a plan; the word before it is the address of its flow's functions.
  plan(flow) {
    const at = this.room(this.layout.plan + LINE / WORD) + LINE;
    new BigInt64Array(this.code.memory.buffer, at - WORD, 1)[0] = BigInt(this.tables?.[flow] ?? 0);
    return this.array(at, [this.layout.plan]);
  }

  // Calls an entry. Arrays are {at, shape}; what is written stays in memory until the next call.
  call(name, flow, ...given) {
    const [result, ...kinds] = this.signatures[name];
    const returned = this.room(4);
    const words = [...this.plan(flow)];
    kinds.forEach((kind, k) => {
      const value = given[k];
      if (kind[3]) words.push(...this.array(value.at, value.shape));
      else words.push(kind[2] === "i8" ? BigInt(value) : kind[2] === "boolean" ? Number(value) : value);
    });
    const status = this.code[`ndarray_${name}`](returned, this.room(1), ...words);
    if (status !== 0 && status !== -2) throw new Error(`${name} ended with status ${status}`);
    return [...new BigInt64Array(this.code.memory.buffer, returned, Number(result[1] ?? 1))].map(Number);
  }

  // An array in memory with these numbers; of zeros, with its shape.
  vector(values) {
    return { at: this.put(Float64Array.from(values)), shape: [values.length] };
  }

  zeros(...shape) {
    const count = shape.reduce((product, n) => product * n, 1);
    const at = this.room(count);
    this.numbers(at, count).fill(0);
    return { at, shape };
  }

  fresh() {
    this.end = this.begin;
  }

  // Rows of what was measured at each frequency, and the state at its end; see `batch.sweep`.
  sweep(rig, amplitudes, frequencies, state, { phase = 0, tolerance = 1e-12, cycles = 2000, window = 500, events = 10000 } = {}) {
    this.fresh();
    const [count, { results, state: width }] = [frequencies.length, this.layout];
    const [rows, states] = [this.zeros(count, results), this.zeros(count, width)];
    const progress = { at: this.put(new BigInt64Array(2)), shape: [2] };
    const [levels, grid, begin] = [amplitudes, frequencies, state].map((values) => this.vector(values));
    this.call("batch_sweep", rig.flow, this.vector(rig.vector), levels, grid, phase, begin, tolerance, cycles, window, events, Infinity, rows, states, progress);
    const split = (one, length) => Array.from({ length: count }, (_, k) => this.numbers(one.at + WORD * length * k, length).slice());
    return { rows: split(rows, results), states: split(states, width) };
  }

  // A motion written down: samples, a row a variable, and events; see `batch.trajectory`.
  trajectory(rig, amplitude, frequency, state, cycles, samples, { phase = 0, events = 10000 } = {}) {
    this.fresh();
    const { sample, event } = this.layout.record;
    const columns = samples ? Math.ceil(cycles * samples - 1e-9) + 1 : 0;
    const room = 2 * events + 1;
    const [out, list] = [this.zeros(sample, columns), { at: this.room(room * event), shape: [room, event] }];
    const [vector, here] = [this.vector(rig.vector), this.vector(state)];
    const listed = [];
    let [next, count, outcome] = [0, 0, 0];
    const mark = this.end;
    while (next < cycles && outcome === 0) {
      this.end = mark;
      [next, count, outcome] = this.call("batch_trajectory", rig.flow, vector, amplitude, frequency, phase, here, next, cycles, samples, events, out, list);
      for (let k = 0; k < count; k++) listed.push(this.numbers(list.at + WORD * event * k, event).slice());
    }
    const rows = Array.from({ length: sample }, (_, k) => this.numbers(out.at + WORD * columns * k, columns).slice());
    return { rows, events: listed, outcome, state: this.numbers(here.at, state.length).slice() };
  }

  // Derivative of the state after some cycles by the state now, row by row; null if it is given up.
  monodromy(rig, amplitude, frequency, state, cycles, { phase = 0, events = 10000 } = {}) {
    this.fresh();
    const { parts } = this.layout;
    const [columns, damping] = [this.zeros(parts, parts), this.zeros(1)];
    const [outcome] = this.call("lyapunov_monodromy", rig.flow, this.vector(rig.vector), amplitude, frequency, phase, this.vector(state), cycles, events, columns, damping);
    return outcome === 0 ? this.numbers(columns.at, parts * parts).slice() : null;
  }
}
