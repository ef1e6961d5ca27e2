"""Search for the least acceleration within ranges of parameters: the best bumper for a gap."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, system_parameters
from vibroimpact.datasets.stops import by_stop, has_stops
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.design.design_shaking import AnyRecords, Asked, design_system, split_frequency
from vibroimpact.design.limits import limits_of, severity
from vibroimpact.design.worst_sine import STEP
from vibroimpact.earthquakes.run_plan import runs
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_input
from vibroimpact.model import Oscillator
from vibroimpact.model.argument_types import Fractile, NonNegativeInt, Share, Tail
from vibroimpact.model.parameter_ranges import Ranges, read_ranges, stated
from vibroimpact.model.parameters import in_units, parameter, set_values
from vibroimpact.model.public import public
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.rig import Rig, one_mass_only, with_stated_units
from vibroimpact.model.units import pretty, to_si
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress, Workers

_Array = NDArray[np.float64]

_STIFFNESSES = (0.1, 100.0)
"""Default range of a bumper's stiffness over that of the isolator."""
_DAMPINGS = (0.01, 10.0)
"""Default range of a bumper's damping over the critical damping on the isolator."""
_WIDE = 10.0
"""Ratio of the ends of a range from which it is searched logarithmically."""
_EACH, _TIMES, _TOLERANCE = 12, 60, 1e-3
"""Designs for each parameter in a generation, generations, and the spread of the last one."""


class _Space(NamedTuple):
    """The ranges that are searched."""

    rig: Oscillator
    names: tuple[str, ...]
    low: _Array
    high: _Array
    logarithmic: NDArray[np.bool_]

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Bounds in the coordinates of the search."""
        ends = (
            np.where(self.logarithmic, np.log(np.where(self.logarithmic, end, 1.0)), end)
            for end in (self.low, self.high)
        )
        return list(zip(*ends, strict=True))

    def values(self, x: _Array) -> _Array:
        """Return the values of the parameters for columns in the coordinates of the search."""
        logs = self.logarithmic[:, np.newaxis]
        numbers = np.where(logs, np.exp(np.where(logs, x, 0.0)), x)
        return np.clip(numbers, self.low[:, np.newaxis], self.high[:, np.newaxis])

    def rigs(self, x: _Array) -> list[Oscillator]:
        """Return the rig of each column."""
        whole = Rig(self.rig)
        return [
            set_values(whole, dict(zip(self.names, one, strict=True))).oscillator
            for one in self.values(x).T.tolist()
        ]


class _Known:
    """Results of the designs that were tried, each computed once."""

    def __init__(
        self, what: Asked, space: _Space, workers: Workers, progress: Progress | None
    ) -> None:
        self.what, self.space, self.workers, self.progress = what, space, workers, progress
        self.rows: dict[bytes, dict[str, Any]] = {}

    def __call__(self, x: _Array) -> list[dict[str, Any]]:
        """Return the results per column; an unbounded or abandoned motion counts as infinite."""
        columns = np.ascontiguousarray(x.reshape(len(self.space.names), -1).T)
        new = [one for one in columns if one.tobytes() not in self.rows]
        new = list({one.tobytes(): one for one in new}.values())
        if new:
            responses = self.what.peaks(self.space.rigs(np.array(new).T), self.workers, None)
            for i, one in enumerate(new):
                self.rows[one.tobytes()] = {name: v[i] for name, v in responses.items()}
            if self.progress:
                self.progress(len(self.rows), None)
        return [self.rows[one.tobytes()] for one in columns]

    def of(self, name: str, x: _Array) -> _Array:
        """Return the severity of one quantity per column."""
        severities = severity(name, np.array([one[name] for one in self(x)]))
        return np.where(np.isfinite(severities), severities, _VAST)


_NEAR = 0.01
"""Share of a limit, or of a range, within which the best design is at its end."""
_VAST = 1e30
"""Finite stand-in for infinity, for the search."""


@public
def least_acceleration(
    rig: AnyRig | Oscillator,
    vary: Ranges | None = None,
    *,
    records: AnyRecords | None = None,
    gap: float | str | None = None,
    limits: Mapping[str, float | str] | None = None,
    fractile: Fractile = 1.0,
    step: Share = STEP,
    tail: Tail | None = None,
    seed: NonNegativeInt = 0,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Find the design with the least peak acceleration, such as the best bumper for a gap.

    The peak acceleration jumps where the motion jumps, and it has several local minima. Each value
    requires a sweep or the motions through all records. Therefore the search uses differential
    evolution (Storn and Price 1997, in ``scipy.optimize``). This method needs no derivative, can
    leave local minima, and evaluates a whole generation of designs at once on all threads. The same
    seed gives the same result. It is not proved that the result is the global minimum: another
    ``seed`` may find a lower acceleration.

    Parameters
    ----------
    rig, records, fractile, step, tail, threads, where
        As in `design_chart`.
    vary
        Parameters of the search, as a mapping from names to the lowest and the highest value. The
        names are those of `design_chart`; ``"frequency"`` is the range of the sine, and is not
        searched. Default: the stiffness of the bumpers from 0.1 to 100
        times the stiffness of the isolator, and the damping of the bumpers from 0.01 to 10 times
        the critical damping of the mass on the isolator.
    gap
        Gap on each side (m). Default: the gaps of the oscillator.
    limits
        Largest accepted values, by name: ``"peak_force"`` (N) of each stop, ``"penetration"``,
        ``"peak_displacement"`` and ``"displacement_max"`` (m). ``"displacement_min"`` (m) is the
        lowest accepted value, at most 0.
    seed
        Random seed of the search.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the number of
        designs that were tried and None, because the total is unknown.

    Returns
    -------
    xarray.Dataset
        It contains the parameters of the best design by name, and the
        variables of `design_chart` for this design. ``evaluations`` is the number of designs that
        were tried. The attribute ``notes`` reports whether the best design touches no stop, which
        limits are not active, and which parameters lie at an end of their range.

    Warns
    -----
    InputWarning
        If the best design touches no stop. In that case the properties of the stops do not affect
        the result.

    Raises
    ------
    InputError
        If a value is invalid, or if no design was found that keeps the limits.
    """
    from scipy.optimize import NonlinearConstraint, differential_evolution

    vary, frequencies = split_frequency(vary)
    as_rig(rig, oscillator_alone=records is not None)  # refuses an assembly
    system, what = design_system(rig, records, frequencies, fractile=fractile, step=step, tail=tail)
    oscillator = one_mass_only(system)
    if gap is not None:
        oscillator = with_stated_units(oscillator, {"gap": gap})
        size = to_si(gap, LENGTH, "gap", minimum=0.0)
        oscillator = parameter("gap", oscillator, "gap").vary(Rig(oscillator), size).oscillator
    space = _space(oscillator, vary or None if frequencies else vary)
    oscillator = space.rig
    most = limits_of(limits)
    known = _Known(what, space, workers_for(threads, where), progress)
    constraints = tuple(
        NonlinearConstraint(
            lambda x, name=name: known.of(name, x)[np.newaxis], -np.inf, severity(name, limit)
        )
        for name, limit in most.items()
    )
    optimum = differential_evolution(
        lambda x: known.of("peak_acceleration", x),
        space.bounds,
        popsize=_EACH,
        maxiter=_TIMES,
        tol=_TOLERANCE,
        rng=seed,
        polish=False,
        updating="deferred",
        vectorized=True,
        constraints=constraints,
    )
    (best,) = known(np.asarray(optimum.x)[:, np.newaxis])
    _refuse(best, most)
    values = space.values(np.asarray(optimum.x)[:, np.newaxis])[:, 0]
    notes = [*_untouched(oscillator, best), *_slack(best, most), *_at_ends(space, values)]
    if oscillator.stops and not best["hitting"]:
        warn_of_input("least_acceleration", notes)
    data = xr.Dataset(
        {
            **dict(zip(space.names, values.tolist(), strict=True)),
            **best,
            **{name: ("stop", by_stop(oscillator, best[name])) for name in filter(has_stops, best)},
            "status": int(best["status"]),
            "evaluations": len(known.rows),
        },
        oscillator.part_names,
    )
    parameters = {
        **system_parameters(oscillator),
        "ranges": {
            name: [float(low), float(high)]
            for name, low, high in zip(space.names, space.low, space.high, strict=True)
        },
        "limits": most,
        "seed": seed,
        **what.parameters(),
    }
    varied = [parameter(name, oscillator) for name in space.names]
    all_notes = [*what.notes(), *notes]
    return describe(data, "vibroimpact.least_acceleration", parameters, all_notes, varied)


def _space(rig: Oscillator, vary: Any) -> _Space:
    vary = _bumper_ranges(rig) if vary is None else vary
    rig = with_stated_units(rig, stated(vary))
    ranges = read_ranges(vary, rig, None)
    names = tuple(one.parameter.name for one in ranges)
    low, high = np.array([one.ends for one in ranges]).T
    runs(rig, {one.parameter.name: one.ends for one in ranges})  # refused before a search
    wide = (low > 0.0) & (high >= _WIDE * np.maximum(low, 0.0))
    return _Space(rig, names, low, high, wide)


def _bumper_ranges(rig: Oscillator) -> dict[str, tuple[float, float]]:
    """Return the default ranges of a bumper for this isolator."""
    if not rig.stops or not all(stop.spring_and_dashpot for stop in rig.stops.values()):
        raise InputError(
            "vary: missing; by default the search for the best design varies linear bumpers, but "
            + ("this rig has no stop" if not rig.stops else "a stop of this rig is of another kind")
            + "; in Python, pass the ranges of other parameters"
        )
    spring = rig.isolator.initial_stiffness
    if spring == 0.0:
        raise InputError(
            "vary: missing; for an isolator without a spring there are no default ranges; in "
            "Python, pass the ranges of the parameters"
        )
    critical = 2.0 * math.sqrt(spring * rig.mass)
    return {
        "stops.stiffness": (_STIFFNESSES[0] * spring, _STIFFNESSES[1] * spring),
        "stops.damping": (_DAMPINGS[0] * critical, _DAMPINGS[1] * critical),
    }


def _untouched(rig: Oscillator, best: Mapping[str, Any]) -> Iterator[str]:
    if rig.stops and not best["hitting"]:
        yield "the best design touches no stop, so the properties of the stops do not matter"


def _slack(best: Mapping[str, Any], limits: Mapping[str, float]) -> Iterator[str]:
    """Describe the limits that do not bind."""
    for name, limit in limits.items():
        worst, most = float(severity(name, best[name])), severity(name, limit)
        if worst < (1.0 - _NEAR) * most:
            quantity = in_units(VARIABLES[name].units)
            reached, allowed = (
                pretty(float(f"{value:.4g}"), quantity) for value in (severity(name, worst), limit)
            )
            words = name.replace("_", " ")
            yield f"the design stays below the limit of {words}: {reached} of {allowed}"


def _at_ends(space: _Space, values: _Array) -> Iterator[str]:
    """Describe the parameters that ended at an end of their range."""
    for name, value, low, high, logs in zip(
        space.names, values, space.low, space.high, space.logarithmic, strict=True
    ):
        at, first, last = np.log([value, low, high]) if logs else (value, low, high)
        share = (at - first) / (last - first)
        if not _NEAR < share < 1.0 - _NEAR:
            end = pretty(
                float(low if share <= _NEAR else high), parameter(name, space.rig).quantity
            )
            which = "lower" if share <= _NEAR else "upper"
            yield f"{name} lies at the {which} end of its range, {end}"


def _refuse(best: Mapping[str, Any], limits: Mapping[str, float]) -> None:
    if not math.isfinite(best["peak_acceleration"]):
        raise InputError(f"vary: no design could be computed: {Status(int(best['status'])).advice}")
    for name, limit in limits.items():
        worst = float(severity(name, best[name]))
        if worst > severity(name, limit):
            quantity = in_units(VARIABLES[name].units)
            raise InputError(
                f"limits[{name!r}]: no design that was tried meets this limit of "
                f"{pretty(limit, quantity)} and all other limits (the best design has "
                f"{pretty(severity(name, worst), quantity, 3)}); raise the limits or widen the "
                "ranges of the parameters"
            )
