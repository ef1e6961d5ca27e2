"""Findings of a fit, in words."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.errors import in_one_line
from vibroimpact.identification.fit_inputs import BASE
from vibroimpact.identification.global_search import SearchResult
from vibroimpact.identification.least_squares import Array, Problem
from vibroimpact.identification.repeated_dwells import stray_values
from vibroimpact.identification.residual_structure import CERTAIN, HINT, Structure
from vibroimpact.identification.sensor_checks import BAD, sensor_doubts
from vibroimpact.identification.untouched_stops import Untouched
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.frequency_text import forcings
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import ACCELERATION, LENGTH
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import unit

_WEAK = 0.25
"""Of a value: an interval whose half is wider leaves a parameter all but undetermined."""
_BOUND = 0.95
"""Correlation above which two parameters are reported as interchangeable."""
_SAME = 1e-3
"""Difference, as a share, up to which a value of another rig is the same."""
_BLIND = "excursions do not distinguish right from left; maxima and minima, or time histories, do"
_FEW = 2
_ABSURD = 100.0
"""Gap over the largest displacement that was measured, from which on it is reported as absurd."""
_FAR = 5.0
"""So many times the noise: some input is wrong, such as the amplitude."""


def findings(
    data: xr.Dataset,
    problem: Problem,
    x: Array,
    fits: SearchResult,
    judged: list[Structure],
    idle: Untouched,
) -> list[str]:
    """Lines about how well a fit is known, what is not determined, and what the model lacks."""
    first: list[str] = []  # what makes the rest meaningless
    lines = [
        f"{fits.alike} of {fits.starts} start{'' if fits.starts == 1 else 's'} reached this fit"
        + ("" if fits.alike >= _FEW else "; more starts may find a better one")
    ]
    lines += _alternatives(data, problem, x)
    lines += [
        line for number in range(len(problem.free)) if (line := _of(data, problem, number, idle))
    ]
    correlation = data["correlation"].values
    for i in range(len(correlation)):
        for j in range(i):
            if abs(correlation[i, j]) > _BOUND and not {i, j} & idle.all:
                one, other = problem.free[j].key, problem.free[i].key
                both = "ratio" if correlation[i, j] > 0 else "product"
                lines.append(
                    f"{one} and {other} can hardly be distinguished (correlation "
                    f"{correlation[i, j]:.3f}): their {both} is known better than either value"
                )
    for number, (test, what) in enumerate(zip(problem.tests, judged, strict=True)):
        if left := str(test.data.attrs.get("left_out", "")).splitlines():
            lines.append(
                f"{test.name}: columns of the file were not understood and were left out: "
                f"{', '.join(map(repr, left))}; state their content with columns= of "
                "read_measurement"
            )
        unused = str(test.data.attrs["unused_shaking"]).splitlines()
        lines += [f"{test.name}: {line}" for line in unused]
        if test.kind == "curves":
            lines += stray_values(test.name, test.data)
        shaken = problem.rig_of(x, test)[0].periodic
        source = str(test.data.attrs["amplitude_source"])
        amplitude = "" if source == BASE else amplitude_words(shaken, source)
        lines += _shape(test.name, test.kind, what, amplitude)
        if what.excess > BAD and what.excess_chance < CERTAIN:
            first += sensor_doubts(problem, x, number)
    return [*first, *_absurd_gaps(data, problem), *lines]


def _absurd_gaps(data: xr.Dataset, problem: Problem) -> list[str]:
    """Gaps far beyond the measured displacements, which indicate an error in the input."""
    lines = []
    for one, value in zip(problem.free, data["fitted_value"].values.tolist(), strict=True):
        swings = [test.swing for test in problem.tests if one.test in (None, test.name)]
        swing = max(swings, default=0.0)
        if one.name.endswith("gap") and swing > 0.0 and abs(value) > _ABSURD * swing:
            lines.append(
                f"{one.key} {pretty(value, one.quantity, 3)} is implausible: "
                f"{abs(value) / swing:.3g} times the largest displacement that was measured, "
                f"{pretty(swing, LENGTH, 3)}"
            )
    return lines


def _alternatives(data: xr.Dataset, problem: Problem, x: Array) -> list[str]:
    """Other rigs that fit as well, by what differs in them."""
    here = data["fitted_value"].values
    lines, exchanged = [], False
    if "alternative_value" in data:
        for number in range(data.sizes["alternative"]):
            rival = data.isel(alternative=number)
            values = rival["alternative_value"].values
            changes = ", ".join(
                f"{free.key} {pretty(float(values[i]), free.quantity, 4)} (instead of "
                f"{pretty(float(here[i]), free.quantity, 4)})"
                for i, free in enumerate(problem.free)
                if abs(values[i] - here[i]) > _SAME * abs(here[i])
            )
            mirrored = bool(rival["alternative_mirrored"])
            exchanged = exchanged or mirrored
            lines.append(
                f"with right and left exchanged, the rig fits equally well: {changes}; {_BLIND}"
                if mirrored
                else f"another rig fits equally well: {changes}"
            )
    asked = any(one.name.startswith(("stops.right.", "stops.left.")) for one in problem.free)
    uneven = any(not problem.rig_of(x, test)[0].oscillator.symmetric for test in problem.tests)
    if asked and uneven and not exchanged and all(test.blind for test in problem.tests):
        lines.append(
            f"only the values that you passed determine which side is the right one: {_BLIND}"
        )
    return lines


def _of(data: xr.Dataset, problem: Problem, number: int, idle: Untouched) -> str:
    one = problem.free[number]
    value = float(data["fitted_value"][number])
    low, high = data["interval"][number].values.tolist()
    open_low, open_high = (bool(v) for v in data["interval_open"][number].values)
    meaning = PARAMETERS[one.name].long_name if one.name in PARAMETERS else one.name
    named = f"{one.key} ({meaning.replace('_', ' ')})"
    weak = abs(high - low) > 2.0 * _WEAK * abs(value) and one.quantity.symbol != ""
    if number in idle.others:
        return f"{named} is not determined: in these tests the mass does not touch the stop"
    if number in idle.gaps:
        return (
            f"{named} has only a lower limit: in these tests the mass does not touch the stop, "
            f"and all values from {pretty(low, one.quantity, 3)} upward fit equally well (with the "
            "other values of the stop unchanged)"
        )
    if not (open_low or open_high or weak):
        return ""
    ends = f"{pretty(low, one.quantity, 3)} to {pretty(high, one.quantity, 3)}"
    if open_low and open_high:
        return f"{named} is not determined: all values from {ends} fit equally well"
    if open_low:
        return f"{named} has only an upper limit: values from {ends} fit equally well"
    if open_high and high < one.high:
        return (
            f"{named} has only a lower limit: values from {pretty(low, one.quantity, 3)} upward "
            f"fit equally well (values up to {pretty(high, one.quantity, 3)} were tried)"
        )
    if open_high:
        return f"{named} has only a lower limit: values from {ends} fit equally well"
    return f"{named} is poorly determined: values from {ends} fit equally well"


def amplitude_words(shaken: Any, source: str) -> str:
    """The peak base acceleration of a test, and where it is from; that alone if it was measured."""
    origin = f"from {in_one_line(source)}" if source else ""
    if source == BASE or not isinstance(shaken, Harmonic):
        return origin
    return ", ".join(filter(None, [pretty(shaken.amplitude, ACCELERATION, 4), origin]))


def _shape(name: str, kind: str, what: Structure, amplitude: str) -> list[str]:
    low, high = what.worst[0], what.worst[1]
    place = (
        forcings(low, high, 4, " and ")
        if kind == "curves"
        else f"{low:.4g} and {high:.4g}{unit(' s')}"
    )
    lines = []
    if what.chance < CERTAIN:
        lines.append(
            f"{name}: the residuals are not noise: neighbouring residuals are alike (correlation "
            f"{what.correlation:.2f}), mostly between {place}; "
            f"the model is incomplete there"
        )
    elif what.chance < HINT:
        lines.append(
            f"{name}: neighbouring residuals are alike; with pure noise, they would be so alike in "
            f"only {100.0 * what.chance:.1g} % of tests: compare other laws of the stops or the "
            "isolator"
        )
    if what.excess_chance < CERTAIN and np.isfinite(what.excess):
        lines.append(
            f"{name}: the residuals are {what.excess:.3g} times the noise of the measurement"
            + (
                f"; the fit used the amplitude {amplitude}"
                if amplitude and what.excess > _FAR
                else ""
            )
        )
    return lines
