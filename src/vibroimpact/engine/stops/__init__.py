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
- a deformable one with a memory, three files: three formulas, with their entry in `LAWS`, in
  `engine/stops/memory_laws.py`, which states what they return; a class derived from
  `StopWithMemory`, whose `engine_numbers` name them; and its entry in `STOPS`. Assemblies have it.
  `tests/model/test_registered_memory.py` makes these edits, and states what to test: the motion and
  the losses against a general integrator, a motion that goes on from its state, and the derivative
  of a cycle against differences.
"""
