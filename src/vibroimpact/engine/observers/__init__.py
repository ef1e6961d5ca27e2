"""Observers: what is measured along a motion, one file each. None of them influences it.

An observer is a kernel `(plan, before, ended, after, notes)`, called for each stretch of motion
between two events. `before` and `after` are the states at its ends (a vector, see `state`), `ended`
holds its length, its event and when it begins (`state.stretch_room`); it writes to its notes alone.
`event_loop.observed(kernel)` is a loop that follows a motion under its eyes, for all flows;
`tests/engine/test_event_loop.py` has one, an entry that calls it (`entry.py`, `opening.py`) and a
start.

An observer that looks between the ends of a stretch asks for its pieces, in which flows differ:

- a file here, for one mass, as `margin`: a piece is a series of x in the mode's own coordinate and
  in steps (`linear.pieces`); its velocity is `motion.direction(mode)` × slope × RATE, and
  `expanded_force` the series of what a pressed stop that is not rigid pushes with, towards the
  mass, per unit mass. A product of two series is cut after ORDER terms, `extremes.series_extremes`
  finds the largest and smallest value of one;
- declared in `flow`, with a group of those that are compiled together: `motion` (what every
  analysis needs), `recorded` (samples and events), `disturbed` (exponents, orbits), `measured`
  (contacts, totals, demands). An entry names the groups that it calls;
- defined in `one_mass` by a line, and in `assembly.table` and `assembly.curved.table`, where the
  flows of several masses answer: over `assembly.channels`, as `demand`, or NaN, as `margin`;
- made into a loop by a line in `event_loop`.

Try it without the compiler first (`NUMBA_DISABLE_JIT=1`), against dense samples.
"""
