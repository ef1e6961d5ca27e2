"""Own outputs: numbers that a user computes from one period of each motion."""

from __future__ import annotations

import keyword
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import xarray as xr

from vibroimpact.datasets.description import describe, noted
from vibroimpact.datasets.stops import quantity
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.errors import InputError, shown
from vibroimpact.model import AssemblyState, Rig, State
from vibroimpact.model.parameters import parameter, parameters
from vibroimpact.response.output_formula import OutputFormula, read_output_formula
from vibroimpact.response.simulate import compute_history

SAMPLES = 256
"""Samples per forcing cycle of the motion from which an output is computed."""
_RESERVED = ("point", "bifurcation", "branch", "piece", "section_point", "multiplier", "exponent")
"""Names of dims and variables of datasets that are not in the vocabulary, or are prefixes there."""


@dataclass(frozen=True)
class Output:
    """A number that is computed from one period of each steady motion.

    Parameters
    ----------
    function
        A formula, as text, or a function.

        - A formula contains the time histories of `simulate` (``displacement``, ``velocity``,
          ``acceleration``, ``base_acceleration``, ``clearance.right``, …), parameters of the rig
          such as ``damping`` or ``frequency``, and ``mass``, all in SI units. ``max``, ``min``,
          ``mean``, ``rms`` and ``integral`` (over the time) make a number of a time history.
          Further functions are ``abs``, ``sqrt``, ``exp``, ``log``, ``sin``, ``cos``, ``tanh`` and
          ``sign``. An example is
          ``"mean(isolator.damping*velocity**2)"``, the mean power of the dashpot. Of an assembly,
          the time histories have names such as ``velocity.roof`` and ``contact_force.moat_right``.
        - A function receives the dataset of `simulate` over one period, and returns a number. It
          may call functions such as `contacts` and `totals`.
    units
        Units of the result, such as ``"W"``. Default: ``"1"``, no units.
    long_name
        Description of the result, for axes of figures. Default: the name of the output.

    Notes
    -----
    The motion has 256 samples per forcing cycle. The maximum of a formula is the largest sample,
    unlike the exact extremes in results such as ``displacement_max``.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> power = vi.Output("mean(isolator.damping*velocity**2)", units="W", long_name="mean power")
    >>> swept = vi.sweep("B2-G1-A3", [2.0], "forward", outputs={"power": power})
    >>> round(float(swept["power"][0, 0]), 2)
    9.14
    """

    function: str | Callable[[xr.Dataset], float]
    units: str = "1"
    long_name: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.function, type) or not (
            isinstance(self.function, str) or callable(self.function)
        ):
            raise InputError(
                f"function: {shown(self.function)} is neither a formula nor a function; pass a "
                "string such as 'max(abs(velocity))', or a function of a dataset"
            )
        for name in ("units", "long_name"):
            if not isinstance(getattr(self, name), str):
                raise InputError(f"{name}: {shown(getattr(self, name))} is not a string")


AnyOutput: TypeAlias = Output | str | Callable[[xr.Dataset], float]
"""An `Output`, or only its formula or function."""
Outputs: TypeAlias = Mapping[str, AnyOutput]
"""Own outputs by name."""


class NamedOutput(NamedTuple):
    """An own output that has been checked."""

    name: str
    function: OutputFormula | Callable[[xr.Dataset], float]
    units: str
    long_name: str

    @property
    def comment(self) -> str:
        """The formula, or the name of the function."""
        if isinstance(self.function, OutputFormula):
            return self.function.text
        return f"function {getattr(self.function, '__name__', type(self.function).__name__)}"

    def value(self, rig: Rig, motion: xr.Dataset) -> float:
        """Compute the number of a motion.

        Raises
        ------
        InputError
            If the function fails or does not return a number.
        """
        try:
            if isinstance(self.function, OutputFormula):
                return self.function.value(motion["time"].values, _values(self, rig, motion))
            output = self.function(motion)
        except InputError as error:
            raise InputError(f"outputs[{self.name!r}]: {error}") from None
        except Exception as error:
            raise InputError(
                f"outputs[{self.name!r}]: the function failed at {rig.periodic.frequency:.6g} Hz "
                f"with {type(error).__name__}: {error}; correct the function"
            ) from error
        try:
            number = np.asarray(output)
            if number.ndim == 0 and number.dtype.kind in "bifu":
                return float(number)
        except (TypeError, ValueError):
            pass
        raise InputError(
            f"outputs[{self.name!r}]: the function returned {shown(output)}; return one number"
        )


def read_outputs(outputs: Outputs | None, rig: Rig) -> tuple[NamedOutput, ...]:
    """Read own outputs of motions of a rig.

    Raises
    ------
    InputError
        If a name cannot be that of a variable, or a formula or function is invalid.
    """
    if outputs is None:
        return ()
    if not isinstance(outputs, Mapping):
        raise InputError(
            f"outputs: {shown(outputs)} is not a mapping; pass names and formulas or functions, "
            "such as {'top_speed': 'max(abs(velocity))'}"
        )
    named_outputs = []
    for name, entry in outputs.items():
        where = f"outputs[{name!r}]"
        if not isinstance(name, str) or not name.isidentifier() or keyword.iskeyword(name):
            raise InputError(
                f"outputs: {shown(name)} is not a name; pass letters, digits and underscores, such "
                "as 'mean_power'"
            )
        if name in VARIABLES or name in _RESERVED or name.startswith("bifurcation_"):
            raise InputError(f"{where}: {name!r} is a variable of some results; use another name")
        try:
            one = entry if isinstance(entry, Output) else Output(entry)
            function = (
                read_output_formula(one.function, histories_of(rig), _parameters_of(rig))
                if isinstance(one.function, str)
                else one.function
            )
        except InputError as error:
            raise InputError(f"{where}: {error}") from None
        named_outputs.append(
            NamedOutput(name, function, one.units, one.long_name or name.replace("_", " "))
        )
    return tuple(named_outputs)


def computed(
    outputs: tuple[NamedOutput, ...],
    rig: Rig,
    start: State | AssemblyState,
    cycles: int,
    *,
    periodic: bool,
) -> tuple[float, ...]:
    """Compute own outputs of the motion of a rig from a state over some forcing cycles.

    `periodic` says that these are one period: a contact that its start cuts is then whole.

    Raises
    ------
    InputError
        If a function fails.
    """
    if not outputs:
        return ()
    motion = compute_history(rig, cycles, start, SAMPLES)
    if periodic:
        motion = describe(motion.assign(period=cycles), "vibroimpact.simulate", notes=noted(motion))
    return tuple(one.value(rig, motion) for one in outputs)


def add_outputs(data: xr.Dataset, outputs: tuple[NamedOutput, ...], values: Any) -> None:
    """Add own outputs to a dataset of motions.

    `values` has a last dim for the outputs; its other dims are those of ``period``.
    """
    for k, one in enumerate(outputs):
        data[one.name] = (data["period"].dims, np.asarray(values, dtype=np.float64)[..., k])
        data[one.name].attrs["output"] = one.comment


def about(outputs: tuple[NamedOutput, ...]) -> dict[str, Any]:
    """Return own outputs for the parameters of a dataset."""
    if not outputs:
        return {}
    return {"outputs": {one.name: one.comment for one in outputs}}


def histories_of(rig: Rig) -> tuple[str, ...]:
    """Return the names of the time histories of `simulate` that a formula may contain."""
    system = rig.system
    of_masses, of_stops = ["displacement", "velocity", "acceleration"], ["deformation", "clearance"]
    of_rig = ["base_acceleration" if rig.hardest.periodic.moves_base else "applied_force"]
    of_rig.append("transmitted_force")
    if system.by_mass:
        of_masses = [f"{name}.{mass}" for name in of_masses for mass in system.names]
        of_stops.append("contact_force")
    else:
        of_stops.append("touching")
        of_rig += ["isolator_memory"] if rig.oscillator.isolator.remembers else []
    each = [f"{name}.{stop}" for name in of_stops for stop in system.stops]
    return (*of_masses, *of_rig, *each, "time")


def _parameters_of(rig: Rig) -> tuple[str, ...]:
    """Return the names of the parameters that a formula may contain."""
    return tuple(name for name in parameters(rig) if name == "frequency" or _has(rig.hardest, name))


def _has(rig: Rig, name: str) -> bool:
    try:
        parameter(name, rig).read(rig)
    except InputError:
        return False
    return True


def _values(output: NamedOutput, rig: Rig, motion: xr.Dataset) -> dict[str, Any]:
    assert isinstance(output.function, OutputFormula)
    made = output.function
    histories = {name: quantity(motion, name).values * 1.0 for name in made.histories}
    return histories | {name: parameter(name, rig).read(rig) for name in made.parameters}
