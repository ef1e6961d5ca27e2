// What the worker's modules compute of some states, as JSON: for node, and for any browser.
(async ({ program, module, facts, states }) => {
  const modules = new Function("self", `${program}; return modules;`)({});
  const bytes = Uint8Array.from(atob(module), (sign) => sign.charCodeAt(0));
  const { instance } = await WebAssembly.instantiate(bytes, {});
  const engine = new modules["engine.js"].Engine(instance, facts.engine);
  const nothing = async () => {};
  const { swept, held, curves } = modules["sweep.js"];
  const answers = [];
  for (const state of states) {
    const data = await swept(engine, state, false, facts, nothing);
    const { rows, states } = data[state.direction];
    const begin = held(state, data);
    const motion = engine.trajectory(data.rig, state.amplitude, begin.frequency, begin.state, 3, 40);
    const plain = (lists) => lists.map((list) => Array.from(list, (x) => (Number.isFinite(x) ? x : null)));
    answers.push({
      rows: plain(rows),
      states: plain(states),
      motion: plain(motion.rows),
      quick: modules["motion.js"].quick(engine, state, data, facts),
      careful: modules["motion.js"].careful(engine, state, data, facts),
      curves: curves(state, data, false, facts, engine.layout),
      controls: modules["rig.js"].controls(state, state, facts),
      basins: state.shown.includes("basins") ? await modules["basins.js"].basins(engine, state, false, facts, nothing) : null,
    });
  }
  return JSON.stringify(answers);
})
