"""Read a rig: a `Rig`, a laboratory case or its code, or the path of a study file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from vibroimpact.arguments import check_list, is_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model import laboratory
from vibroimpact.model.assembly import Assembly
from vibroimpact.model.excitation import Harmonic, Periodic
from vibroimpact.model.laboratory import Case
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.parameter_ranges import ParameterRange
from vibroimpact.model.record import Record
from vibroimpact.model.rig import Rig, one_mass_only, several_masses_only
from vibroimpact.model.study import read_rig_study
from vibroimpact.model.system import System

_ACCEPTED = (
    'pass a Rig, a laboratory case or its code, such as "B2-G1-A3", or the path of a study file, '
    'such as "rig.toml"'
)


def as_rig(
    value: Any,
    frequency: float | str | None = None,
    *,
    oscillator_alone: bool = False,
) -> Rig:
    """Return the rig with one mass that an argument describes.

    Parameters
    ----------
    value
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    frequency
        Forcing frequency in Hz, or a string with a unit. Default: the frequency of the rig.
    oscillator_alone
        Whether an `Oscillator` without shaking is accepted. Default: False.

    Raises
    ------
    InputError
        If the value is not a rig, or if the study file is invalid. Also if a frequency is passed,
        but a record shakes the rig.
    """
    rig = _read(value, "rig", oscillator_alone)
    one_mass_only(rig.system)
    return rig if frequency is None else rig.at(frequency)


def as_rig_of_any_masses(
    value: Any,
    where: str = "rig",
    *,
    frequency: float | str | None = None,
    oscillator_alone: bool = False,
) -> Rig:
    """Do what `as_rig` does, also if the system is an assembly. `where` names the argument."""
    rig = _read(value, where, oscillator_alone)
    return rig if frequency is None else rig.at(frequency)


AnyRig: TypeAlias = Annotated[Rig | Case | str | Path, as_rig_of_any_masses]
"""A `Rig`, a laboratory case, its code such as ``"B2-G1-A3"``, or the path of a study file."""
RigOrSystem: TypeAlias = AnyRig | Oscillator | Assembly
"""The same, or what vibrates alone, if another argument states the shaking."""


def as_assembly(value: Any, where: str = "rig") -> Assembly:
    """Return the assembly that an argument describes: an `Assembly`, or a rig with one."""
    return several_masses_only(_read(value, where, oscillator_alone=True).system, where)


AnyAssembly: TypeAlias = Annotated[Assembly | Rig | str | Path, as_assembly]
"""An `Assembly`, a `Rig` with one, or the path of a study file."""


def as_rigs(rigs: Any, where: str = "rigs", oscillator_alone: bool = False) -> dict[str, Rig]:
    """Return one or several rigs by their names. Several rigs are a list or a mapping from names.

    Returns
    -------
    dict
        Mapping from names to rigs, in the same order. The name of a rig without a name is its
        position.

    Raises
    ------
    InputError
        If there are no rigs, or if one of them is not a rig.
    """
    alone = is_one_rig(rigs) or not (is_list(rigs) or isinstance(rigs, Mapping))
    if isinstance(rigs, Mapping):
        items = [(str(name), rig) for name, rig in rigs.items()]
    elif alone:
        items = [("", rigs)]
    else:
        items = [("", rig) for rig in check_list(rigs, where)]
    if not items:
        raise InputError(f"{where}: the list is empty; pass at least one rig")
    read = []
    for i, (name, item) in enumerate(items):
        place = where if alone else f"{where}[{name or i}]"
        rig = _read(item, place, oscillator_alone)
        read.append((name or rig.name or str(i), rig))
    # As of two study files of one name in two folders.
    counts = Counter(name for name, _ in read)
    return {
        f"{name} ({i})" if counts[name] > 1 else name: rig for i, (name, rig) in enumerate(read)
    }


def is_one_rig(value: object) -> bool:
    """Return whether a value is one rig, or part of one rig, instead of several rigs."""
    return isinstance(value, Rig | Case | System | str | Path)


def _read(value: Any, where: str, oscillator_alone: bool) -> Rig:
    if isinstance(value, Rig):
        return value
    if isinstance(value, Case):
        return value.rig
    if isinstance(value, Path) or (isinstance(value, str) and value.lower().endswith(".toml")):
        return read_rig_study(Path(value))
    why = ""
    if isinstance(value, str):
        try:
            return laboratory.case(value).rig
        except InputError as error:
            why = f" ({error})" if laboratory.is_code(value) else ""
    if isinstance(value, System):
        if oscillator_alone or value.by_mass:
            return Rig(value)
        raise InputError(
            f"{where}: an Oscillator alone has no shaking; pass a Rig with a shaking, such as "
            'Rig(oscillator, "0.05 g")'
        )
    if isinstance(value, Harmonic | Periodic | Record):
        raise InputError(
            f"{where}: a {type(value).__name__} alone has no oscillator; pass Rig(oscillator, "
            "shaking)"
        )
    raise InputError(f"{where}: {shown(value)} is not a rig; {_ACCEPTED}{why}")


def from_lowest(rig: Rig, along: ParameterRange) -> Rig:
    """Return the rig. If its frequency is open and varied, set the lowest frequency."""
    if rig.frequency is None and along.parameter.name == "frequency":
        return rig.at(along.low)
    return rig
