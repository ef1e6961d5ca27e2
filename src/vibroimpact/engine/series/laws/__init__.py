"""Laws as formulas, one per file: forces, computed with numbers and with series alike.

A sum of the terms of `law_numbers.IsolatorNumbers` needs no file, nor does a stop whose force is a
formula. Another term of an isolator is a file with

    shape(rig)                what a rig has of it, () if nothing
    force(law, shape, u, v, z)  its formula, odd in (u, v, z), because left contacts are mirrored

and an entry of `LAWS` of `series.step`; `law.NAME` is a number of `series.layout.NAMES`. Further:

- its numbers: fields of `IsolatorNumbers` before `own`, and positions of `parameters` before CURVED
  in the same order (`rig_vector` of `parameters` copies them; forces also in `_PER_MASS`), with
  which `laws` of `parameters` returns BENT;
- in NAMES, last, because some code counts them, with the lists of places in `series.step_control`
  and `assembly.curved.numbers`; `number_isolator` of `series.step_control` writes them in units of
  time, `_TIMES` of `series.slopes` has the power p of the factor hᵖ that makes them those of steps;
- `laws_code` of `series.kernels`: a bit below those of the memory's power, which move up;
- `isolator_force` and `stiffness_at` of `taylor.mode_forces`, its value and a bound on its slope;
  `stiff_rate` of `taylor.plan`, its slope at rest; `isolator_power` of `taylor.power`, its loss;
- `turns` of `taylor.step_events`: the ends of its branches;
- `link_rows` of `assembly.curved.laws` and `_link_numbers` of `assembly.curved.numbers`: links.

A series cannot detect a bend beyond which the force is constant to rounding (tanh): limit arguments
within a step, as `bends_of` of `series.step` and `series.root_variable` do for formulas. Write no
small quantity as a difference (1/cosh², not 1 − tanh²). Test the formula in floats
(`tests/engine/series/test_kernels.py`) and motions fifty bends wide.
"""
