"""Dims, units and meaning of every output variable.

A new variable is an entry, with its dims, here (sweeps), or in `motion_variables` (one motion,
contacts, orbits and branches), `fit_variables` (measurements and fits), `design_variables`
(earthquakes, stops, ensembles), `batch_variables` (basins, manifolds, maps), `stop_variables` (dim
``stop``) or `assembly_variables`. `describe` of `datasets/description.py` raises an error if a
dataset has an unknown one, and in tests if a variable has other dims.

An output is an entry, and the place that computes it: `response/simulate.py` for histories;
`measured` of `response/one_mass.py` and `response/several_masses.py` for what the engine measures
of steady motions, `sweep_dataset` of `response/sweep_dataset.py` for what follows from it, and
`_measured` of `stability/steady.py` (also for `coexisting_motions` and `basins`). What Python
computes from one motion is a module of `response/`, which follows the contacts of the motion again
(example: `totals.py`); the first velocity of a contact is the closing speed of a law with a
coefficient of restitution. What it computes so at each hold of a sweep is an option, for it takes
ten times as long as the hold (example: `response/sweep_outputs.py`). `engine.observers` states what
the engine needs.

Dims and attributes follow from the entry; tables of the reference from it and from the call in
`tests/arguments.py`, which has every option turned on. Enter a variable of stops whose value for
all of them is their sum in `_SUMS` of `datasets/stops.py`.

The command ``motion`` prints each number of `_measured` (by stop, if it has this dim); its rows are
in `_ROWS` of `facts/motions.py`, those of an assembly in `_LARGEST` and `largest` of
`facts/assembly.py`. An entry of `_LINES` of `facts/largest.py` prints the largest value of sweeps
of one mass; for assemblies, `_WORDS` and `_largest` of `facts/assembly_sweep.py` do, and
`draw_sweep` of `cli/assembly.py` draws.
"""

from __future__ import annotations

from vibroimpact.datasets.assembly_variables import ASSEMBLIES
from vibroimpact.datasets.batch_variables import MANY_MOTIONS
from vibroimpact.datasets.design_variables import DESIGN
from vibroimpact.datasets.fit_variables import FITS
from vibroimpact.datasets.motion_variables import MOTIONS, STATE_UNITS
from vibroimpact.datasets.stop_variables import OF_STOPS
from vibroimpact.datasets.variable import ANY_PEAKS, STEADY, Variable, along, each, integer, text
from vibroimpact.model.parameters import PARAMETERS

_OVER = (
    "divided by the largest excursion at any frequency without stops, for the same isolator and "
    "amplitude"
)
_CARRIED = (
    "of the isolator and the stops together, positive to the right; the infinite force of an "
    "impact on a rigid stop is excluded"
)


VARIABLES: dict[str, Variable] = {
    **along(
        ("*", "point"),
        **{p.name: Variable(p.units, p.long_name, p.comment) for p in PARAMETERS.values()},
    ),
    **along(("direction", ""), direction=text("sweep direction")),
    **along("rig", rig=text("rig")),
    **along(
        "time",
        time=Variable("s", "time"),
        cycle=Variable("1", "time in forcing cycles"),
    ),
    **along(
        "start",
        start=text(
            "initial state of the motions", "up, down: the final state at the previous value"
        ),
    ),
    **along(
        "component",
        component=text(
            "component of the state",
            "deformation.STOP is positive when compressed; touching.STOP is 1 if the bodies of the "
            "stop touch, and 0 otherwise; isolator and memory.LINK are the memories of the laws",
        ),
    ),
    **along(
        STEADY,
        displacement_excursion=Variable(
            "m",
            "excursion of relative displacement",
            "exact maximum minus exact minimum",
            part="mass",
        ),
        acceleration_excursion=Variable(
            "m s-2",
            "excursion of absolute acceleration",
            "exact maximum minus exact minimum, including one-sided values at contact and "
            "detachment",
            part="mass",
        ),
        eta_d=Variable("1", "normalised excursion of relative displacement", _OVER),
        eta_a=Variable("1", "normalised excursion of absolute acceleration", _OVER),
        acceleration_max=Variable("m s-2", "largest absolute acceleration", part="mass"),
        acceleration_min=Variable("m s-2", "smallest absolute acceleration", part="mass"),
        transmitted_force_max=Variable("N", "largest force transmitted to the base", _CARRIED),
        transmitted_force_min=Variable("N", "smallest force transmitted to the base", _CARRIED),
        transmitted_force_excursion=Variable(
            "N",
            "excursion of the force transmitted to the base",
            "exact maximum minus exact minimum",
        ),
        transmissibility=Variable(
            "1",
            "transmissibility of the force",
            "excursion of the force transmitted to the base divided by that of the exciting force: "
            "of the force on the mass, or of M A_t if the base moves",
        ),
        eccentricity=Variable(
            "m", "eccentricity", "half the sum of the displacement's extremes", part="mass"
        ),
        motion=text(
            "kind of motion",
            "periodic, quasi-periodic, chaotic or undecided; a sweep distinguishes periodic and "
            "undecided only",
        ),
        period=integer("period in forcing cycles", "0 where the motion did not settle"),
        cycles=integer(
            "number of forcing cycles simulated, including the measured ones",
            "0 where the free motion was computed in closed form",
        ),
    ),
    **along(
        ANY_PEAKS,
        displacement_max=Variable(
            "m", "largest relative displacement", "largest displacement to the right", part="mass"
        ),
        displacement_min=Variable(
            "m",
            "smallest relative displacement",
            "minus the largest displacement to the left",
            part="mass",
        ),
        peak_transmitted_force=Variable(
            "N", "largest force transmitted to the base, without sign", _CARRIED
        ),
        status=integer("how the computation ended"),
    ),
    **along(
        ("*", "rig *"),
        free_displacement_excursion=Variable(
            "m", "excursion of relative displacement in steady free flight"
        ),
        free_acceleration_excursion=Variable(
            "m s-2", "excursion of absolute acceleration in steady free flight"
        ),
        free_transmitted_force_excursion=Variable(
            "N", "excursion of the force transmitted to the base in steady free flight"
        ),
    ),
    **along(
        ("", "rig"),
        largest_free_displacement_excursion=Variable(
            "m", "largest excursion of relative displacement in free flight at any frequency"
        ),
        largest_free_acceleration_excursion=Variable(
            "m s-2", "largest excursion of absolute acceleration in free flight at any frequency"
        ),
    ),
    **along(
        each(STEADY, "component"),
        section=Variable(
            "1",
            "state at the stroboscopic section at the end of each frequency step",
            STATE_UNITS,
        ),
    ),
    **OF_STOPS,
    **ASSEMBLIES,
    **MOTIONS,
    **FITS,
    **DESIGN,
    **MANY_MOTIONS,
}

NAMED_DIMS = {word for one in VARIABLES.values() for dims in one.dims for word in dims.split()} - {
    "*",
    "...",
    "part",
    "frequency",
}
"""Dims that are not parameters."""
