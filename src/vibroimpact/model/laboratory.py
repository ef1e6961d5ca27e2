"""The published shaking-table rig: its parameters, case codes and campaign.

A case code such as ``B2-G1-A3`` consists of a bumper, a total gap and a peak table acceleration.
Each part may be a value with a unit instead of a name: ``B3-10mm-A3``, ``510kN/m-G1-0.05g``.

The paper has two parameter sets. ``"table"`` exists for all cases: the isolator has an equivalent
stiffness for each acceleration, and ξ = 0.15 and τ_r = 0.01 (Section 7 and Table 1).
``"identified"`` exists for the two cases of Section 5 whose parameters were fitted individually.
These parameters differ slightly from the table. A third set, ``"refined"``, has an isolator that
softens; it was fitted to the table.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

from vibroimpact.errors import InputError, shown
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.html_table import table
from vibroimpact.model.isolators import (
    AnyIsolator,
    BilinearIsolator,
    BoucWenIsolator,
    ExponentialIsolator,
    Isolator,
)
from vibroimpact.model.largest_free_response import peak_displacement
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.periodic_shaking import ANY_FREQUENCY
from vibroimpact.model.quantities import ACCELERATION, LENGTH, STIFFNESS, Quantity
from vibroimpact.model.rig import Rig
from vibroimpact.model.stops import Bumper
from vibroimpact.model.units import pretty, to_si

Parameters: TypeAlias = Literal["table", "identified", "refined"]

MASS = 550.0
"""Mass M in kg."""
DAMPING_RATIO = 0.15
"""Damping ratio ξ of the isolator."""
RELAXATION_TIME = 0.01
"""Relaxation time τ_r = ω0 C_j/K_j of all bumpers."""
BUMPERS: Mapping[str, float] = {"B1": 100e3, "B2": 510e3, "B3": 680e3, "B4": 2300e3}
"""Stiffness K_j of the bumpers in N/m."""
GAPS: Mapping[str, float] = {"G1": 0.015, "G2": 0.020, "G3": 0.025, "G4": 0.030}
"""Total gap G in m. Each side has half of it."""
ACCELERATIONS: Mapping[str, float] = {"A1": 0.2941995, "A2": 0.392266, "A3": 0.4903325}
"""Peak table acceleration A in m/s²: 0.03, 0.04 and 0.05 g."""
ISOLATOR_STIFFNESS: Mapping[str, float] = {"A1": 33920.0, "A2": 28732.0, "A3": 26290.0}
"""Equivalent stiffness K of the isolator in N/m. The rubber isolator softens as the acceleration
increases."""
FREQUENCIES: tuple[float, ...] = tuple(round(0.1 * k, 10) for k in range(5, 51))
"""Frequencies of the stepped sweep in the tests: from 0.5 to 5 Hz in steps of 0.1 Hz."""

_NO_GAP_LIMIT = ("GINF", "G∞", "INF", "∞", "FREE")
_ACCEPTED = (
    "use bumper-gap-acceleration, such as B2-G1-A3; bumper: B1 to B4, or a stiffness such as "
    "510kN/m; total gap: G1 to G4, a length such as 10mm, or Ginf (no bumpers); acceleration: A1 "
    "to A3, or from 0.03g to 0.05g"
)


class _Identified(NamedTuple):
    """A parameter set of Section 5, in N/m and N s/m."""

    stiffness: float
    damping: float
    bumper_stiffness: float
    bumper_damping: float


IDENTIFIED: Mapping[str, _Identified] = {
    "B2-G1-A3": _Identified(26800.0, 1100.0, 510e3, 900.0),
    "B2-G2-A2": _Identified(31900.0, 1100.0, 510e3, 900.0),
}
"""The two cases whose parameters were fitted individually in the paper (Section 5)."""


REFINED: Mapping[str, AnyIsolator] = {
    "exponential": ExponentialIsolator(63.8e3, 21.7e3, 102.4, 333.0),
    "Bouc-Wen": BoucWenIsolator(46.5e3, 22.8e3, 336.0, 445.0),
    "bilinear": BilinearIsolator(41.2e3, 23.4e3, 347.0, 514.0),
}
"""Isolators that soften with the displacement. One parameter set applies to all accelerations.

Each was fitted to the resonance peaks without stops that follow from `ISOLATOR_STIFFNESS` and
`DAMPING_RATIO` at the three accelerations: to the frequency and the height of the peaks of
displacement and acceleration. The relative root mean square deviations are 2.5 %, 2.6 % and 2.7 %.
The best isolator (the first one) is used in the parameter set ``"refined"``.
"""


@dataclass(frozen=True, slots=True)
class Case:
    """One test of the published rig.

    Attributes
    ----------
    code
        Code of the case. Names are written in capitals, and values as they were passed.
    oscillator
        The oscillator.
    amplitude
        Peak table acceleration A in m/s².
    frequencies
        The rising frequencies of the stepped sweep, in Hz.
    parameters
        The parameter set: ``"table"``, ``"identified"`` or ``"refined"``.
    """

    code: str
    oscillator: Oscillator
    amplitude: float
    frequencies: tuple[float, ...]
    parameters: Parameters

    @property
    def rig(self) -> Rig:
        """The rig of this test, with an open frequency."""
        shaking = Harmonic(self.amplitude, ANY_FREQUENCY)
        return Rig.of_open_frequency(self.oscillator, shaking, self.code, published=True)

    @property
    def slug(self) -> str:
        """The code as a file name, without slashes, spaces and non-ASCII characters."""
        return re.sub(r"[^A-Za-z0-9.+-]+", "_", self.code).strip("_")

    def __repr__(self) -> str:
        return f"case({self.code!r}, parameters={self.parameters!r})"

    def __str__(self) -> str:
        return (
            f"Case({self.code}, oscillator={self.oscillator}, "
            f"amplitude={pretty(self.amplitude, ACCELERATION)}, "
            f"frequencies={self.frequencies[0]:g} to {self.frequencies[-1]:g} Hz, "
            f"parameters={self.parameters})"
        )

    def _repr_html_(self) -> str:
        return table(
            f"Case {self.code}",
            [
                *self.oscillator.rows(),
                ("amplitude", pretty(self.amplitude, ACCELERATION)),
                ("frequencies", f"{self.frequencies[0]:g} to {self.frequencies[-1]:g} Hz"),
                ("parameters", self.parameters),
            ],
        )


class Table1(NamedTuple):
    """The dimensionless parameters of the paper's Table 1.

    The paper states the gaps to 0.01 and the stiffness ratios to 0.1.
    """

    gap: dict[str, dict[str, float]]
    """δ by acceleration and gap, such as ``gap["A3"]["G1"]``. It is G/(2 u_max), which is the gap
    of one side. The numbers in the paper's table are the same, although its text defines δ as the
    sum of both sides."""
    stiffness_ratio: dict[str, dict[str, float]]
    """λ by acceleration and bumper, such as ``stiffness_ratio["A3"]["B2"]``."""

    def __str__(self) -> str:
        head = "".join(f"{name:>7}" for name in (*GAPS, *BUMPERS))
        rows = [
            f"{a:2}"
            + "".join(f"{self.gap[a][g]:7.2f}" for g in GAPS)
            + "".join(f"{self.stiffness_ratio[a][b]:7.1f}" for b in BUMPERS)
            for a in ACCELERATIONS
        ]
        return "\n".join((f"  {head}", *rows))


def case(code: str, parameters: Parameters = "table") -> Case:
    """Return the published test with a given case code.

    Parameters
    ----------
    code
        Bumper, total gap and table acceleration joined by hyphens, such as ``B2-G1-A3``. Each part
        may be a value with its unit: ``B3-10mm-A3``, ``510kN/m-G1-0.05g``. ``Ginf`` is a rig
        without stops. Names may be written in upper or lower case. Units must be written in the
        correct case.
    parameters
        Parameter set. ``"table"`` (the default) uses the equivalent stiffness of the isolator at
        the acceleration, with ξ = 0.15 and τ_r = 0.01. Between two tested accelerations the
        stiffness is interpolated linearly. Outside 0.03 to 0.05 g nothing was measured, and an
        error is raised. ``"identified"`` uses the fitted parameters of Section 5. It exists only
        for B2-G1-A3 and B2-G2-A2. ``"refined"`` uses the bumpers of ``"table"``, and the first
        isolator of ``REFINED``, which softens.

    Returns
    -------
    Case
        The test, with ``.rig``, ``.oscillator``, ``.amplitude`` and ``.frequencies``.

    Raises
    ------
    InputError
        If the code or the parameter set is unknown, or if a value is invalid. Also if the case has
        no identified parameters.
    """
    if not is_code(code):
        raise InputError(f"case: {shown(code)} is not a case code; {_ACCEPTED}")
    parts = _split(code)
    if parameters not in get_args(Parameters):
        raise InputError(
            f"parameters: {shown(parameters)} is unknown; use 'table', 'identified' or 'refined'"
        )
    bumper_name, bumper_stiffness = _part(code, "bumper", parts[0], BUMPERS, STIFFNESS)
    if parts[1].upper() in _NO_GAP_LIMIT:
        gap_name, total_gap = "Ginf", math.inf
    else:
        gap_name, total_gap = _part(code, "gap", parts[1], GAPS, LENGTH)
    acceleration_name, amplitude = _part(
        code, "acceleration", parts[2], ACCELERATIONS, ACCELERATION
    )
    if parameters == "identified":
        names = f"{bumper_name}-{gap_name}-{acceleration_name}"
        if names not in IDENTIFIED:
            raise InputError(
                f"parameters: 'identified' exists only for the cases {' and '.join(IDENTIFIED)}, "
                f"and not for {shown(code)}; use 'table'"
            )
        fitted = IDENTIFIED[names]
        isolator = Isolator(fitted.stiffness, fitted.damping)
        bumper = Bumper(fitted.bumper_stiffness, fitted.bumper_damping, total_gap / 2.0)
        oscillator = Oscillator(MASS, isolator, bumper, bumper)
    else:
        oscillator = _from_table(
            bumper_stiffness, total_gap, _isolator_stiffness(code, parts[2], amplitude)
        )
        if parameters == "refined":
            oscillator = oscillator.replace(isolator=next(iter(REFINED.values())))
    written = (
        bumper_name if parts[0].upper() in BUMPERS else parts[0],
        gap_name if gap_name == "Ginf" or parts[1].upper() in GAPS else parts[1],
        acceleration_name if parts[2].upper() in ACCELERATIONS else parts[2],
    )
    return Case("-".join(written), oscillator, amplitude, FREQUENCIES, parameters)


def campaign(parameters: Parameters = "table") -> tuple[Case, ...]:
    """Return the 48 tests of the published campaign.

    Parameters
    ----------
    parameters
        As in `case`. ``"identified"`` is not accepted, because it does not exist for all tests.

    Returns
    -------
    tuple of Case
        The tests, ordered by acceleration, then by bumper, then by gap: B1-G1-A1, B1-G2-A1, ...,
        B4-G4-A3.

    Raises
    ------
    InputError
        If the parameter set is unknown, or if it does not exist for all tests.
    """
    return tuple(
        case(f"{b}-{g}-{a}", parameters) for a in ACCELERATIONS for b in BUMPERS for g in GAPS
    )


def table_1() -> Table1:
    """Compute the dimensionless parameters in the paper's Table 1.

    Returns
    -------
    Table1
        δ = G/(2 u_max) and λ = K_j/K for each acceleration.
    """
    rigs = {a: _from_table(BUMPERS["B1"], math.inf, k) for a, k in ISOLATOR_STIFFNESS.items()}
    return Table1(
        gap={
            a: {
                g: total / 2.0 / peak_displacement(rig, ACCELERATIONS[a])
                for g, total in GAPS.items()
            }
            for a, rig in rigs.items()
        },
        stiffness_ratio={
            a: {b: k / rig.isolator.initial_stiffness for b, k in BUMPERS.items()}
            for a, rig in rigs.items()
        },
    )


def is_code(text: object) -> bool:
    """Return whether a value has the form of a case code: a text of three parts."""
    parts = _split(text) if isinstance(text, str) else []
    return len(parts) == 3 and all(parts)


def _split(code: str) -> list[str]:
    """Split a code at its hyphens, but not inside 1e-3m or m/s^-2, nor at a minus sign."""
    plain = re.sub("[‐‑‒–—−]", "-", code)
    return [" ".join(part.split()) for part in re.split(r"(?<![\d.][eE])(?<![\^*-])(?<!^)-", plain)]


def _part(
    code: str, role: str, text: str, names: Mapping[str, float], quantity: Quantity
) -> tuple[str, float]:
    """Return the name (or the text, for a value that has none) and the SI value of a part."""
    name = text.upper()
    if name in names:
        return name, names[name]
    known_names = ", ".join((*names, "Ginf") if role == "gap" else names)
    wanted = f"use {known_names} or {quantity.phrase} such as {quantity.example.replace(' ', '')}"
    if text[0].isalpha():
        raise InputError(f"case {shown(code)}: {role} {shown(text)} is unknown; {wanted}")
    least: dict[str, Any] = {"minimum": 0.0} if quantity is LENGTH else {"above": 0.0}
    value = to_si(text, quantity, f"case {shown(code)}: {role}", **least)
    # A bare number would be in SI units: B3-10-A3 would be a gap of ten metres.
    if value != 0.0 and not any(c.isalpha() for c in text.lstrip("+-.0123456789eE")):
        raise InputError(f"case {shown(code)}: {role} {shown(text)} has no unit; {wanted}")
    for known, exact in names.items():
        if math.isclose(value, exact, rel_tol=1e-12):
            return known, exact
    return text, value


def _isolator_stiffness(code: str, text: str, amplitude: float) -> float:
    """Return the isolator's equivalent stiffness, interpolated between tested accelerations."""
    tested = [(a, ISOLATOR_STIFFNESS[name]) for name, a in ACCELERATIONS.items()]
    for (low, k_low), (high, k_high) in pairwise(tested):
        if low <= amplitude <= high:
            share = (amplitude - low) / (high - low)
            return (1.0 - share) * k_low + share * k_high
    raise InputError(
        f"case {shown(code)}: acceleration {shown(text)} is outside the tested range, in which "
        "the stiffness of the isolator is known; use an acceleration from 0.03g to 0.05g"
    )


def _from_table(bumper_stiffness: float, total_gap: float, stiffness: float) -> Oscillator:
    """Build the symmetric rig from ξ and τ_r; an infinite gap is a rig without bumpers."""
    isolator = Isolator(stiffness, 2.0 * DAMPING_RATIO * math.sqrt(stiffness * MASS))
    free = Oscillator(MASS, isolator)
    if math.isinf(total_gap):
        return free
    damping = RELAXATION_TIME * bumper_stiffness / free.angular_frequency
    bumper = Bumper(bumper_stiffness, damping, total_gap / 2.0)
    return free.replace(right=bumper, left=bumper)
