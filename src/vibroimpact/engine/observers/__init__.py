"""Observers: what is measured along a motion, one file each. None of them influences it.

An observer is a kernel `(plan, before, ended, after, notes)`, called for each stretch of motion
between two events. `before` and `after` are the states at its ends (a vector, see `state`), `ended`
holds its length, its event and when it begins (`state.stretch_buffer`); it writes to its notes
alone. What happens in between it reads from the channels of the stretch (`channels`), the same for
one mass and several: series of displacements, velocities, accelerations, clearances, forces and
deformations, with exact extremes, and when (`channels.extremes`; `channels.widen` of a range that
begins as +inf, -inf or 0, 0).
A piece is touched as a whole or not at all: its clearance is 0 throughout, or positive inside. The
deformation's slope is the closing speed only then; untouched it fades, at rigid stops it is 0.

    largest_power = observed(see_power)         # the loop of `event_loop`, for all flows

    @entry("i8(f8[::1], f8, f8, f8, f8[::1], i8, f8[::1])", "measured")
    def find_power(memory, rig, amplitude, frequency, phase, state, cycles, notes): ...

`tests/engine/observers/test_power.py` is all that one takes: the kernel, its loop, an entry that
starts with `opening.open_entry`, the numbers of a rig and of a state, and a comparison with dense
samples. Of one mass forces are per unit mass, and stop 0 is the right one. A file outside of
`engine/` leaves the library of machine code in use. numba compiles the entry when
it is first called, outside of the tests if `VIBROIMPACT_KERNELS=1` is set; the library of machine
code has those of this package (`make kernels`). Without the compiler (`NUMBA_DISABLE_JIT=1`) a
first try is quicker.

Some observers here are functions of the flow (`flow`) instead: one mass has bounds that let
`extremes` pass over most of a motion, and channels show no disturbances.

An output variable that the engine must measure (else: `datasets.vocabulary`) is a number more of
one of them; of several masses, of the modules of `assembly` in brackets:

- histories: a row of `record` (SAMPLE: `write`, `sample`; EVENT: `record`), named in
  `response/history_variables.py` (`record`);
- sweeps: a note of `extremes`, begun by `nothing`, which `measured` of `one_mass.table` writes into
  the result of a hold; `undisturbed` there writes that of a motion that touches no stop, 0 unless
  it is set. `steady_response` has its position, `response/hold_rows.py` and
  `response/one_mass.py` its name (`measures`, named in `response/several_masses.py`);
- contacts and flights: a column of `phases`, which `measure` writes (`stretches`), and which
  `response/contacts.py` and `response/totals.py` read.
"""
