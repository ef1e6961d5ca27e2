"""The stops of one mass, a file a kind: what does not depend on how a flow finds a motion.

A new stop is

- one whose force is a formula: a class derived from `FormulaStop` (`model/stops/law.py`), without
  engine code. A function that formulas lack, but is made of those that they have, as cosh is of
  exp, takes entries in three files: at the end of `SYMBOLS` (`law_numbers.py`), in `FUNCTIONS` and
  `_SLOPES` (`model/formula.py`), and in `_FUNCTIONS` (`engine/series/program.py`);
- a rigid one with another rebound, three files: a function of the law's numbers and the closing
  speed, with its entry in `LAWS`, in `engine/stops/rebound.py`, which states what it returns; a
  class derived from `WallLaw`, whose `engine_numbers` name the function; and its entry in `STOPS`
  (`model/stops/__init__.py`). One mass and several, disturbances, chatter, records and measures ask
  that function. `tests/model/test_registered_wall.py` makes these edits, and states what to test:
  impacts, losses, the derivative of a cycle against differences, and where a chatter ends;
- a deformable one that remembers more than how fast it was met. Without engine code it is a light
  mass between the mass and links that remember, in an `Assembly` (docs/laws/formula.md). As a kind:

  - *numbers*: positions and a code next to `FORMULA` in `engine/parameters.py`, which `rig_vector`
    writes; `engine_state` of `response/engine_input.py` checks initial states;
  - *contact*: if linear, a table of `build` in `engine/linear/tables.py`, with its force, whose
    zero ends the contact; if curved, a term of `engine/series/laws/contact.py`. Several masses:
    `assembly/plan.py`, or for a curved law `assembly/curved/numbers.py`;
  - *at the stop*: a file here (force, losses, what an event there does, where a state is possible;
    examples: `engine/stops/rigid.py`, `engine/stops/rigid_events.py`), with a kind of event in
    `engine/event.py` if none fits. `advance_any` of `engine/linear/any_stops.py` calls it, and
    `one_mass_flow` of `engine/flow_dispatch.py` selects the flow; `engine/linear/advance.py` stays
    fast for bumpers;
  - *disturbances*: the saltation matrix (docs/theory/growth.md, section 6.2), a function of
    `engine/saltation.py` with a test of its own, called from `meet` of
    `engine/one_mass/disturbed_events.py` or `_event` of `engine/taylor/carry.py`, and `contraction`
    of the former. Without it, exponents, orbits and types of motion are wrong
    without an error; compare with differences (`tests/engine/one_mass/test_tangent.py`);
  - *Newton's method*: `place` of `engine/one_mass/table.py` moves an impossible state to the
    nearest possible one (`nearest_possible` of the stop's file);
  - *results*: events in `engine/one_mass/record.py`, forces and losses in
    `engine/one_mass/measure.py`.
"""
