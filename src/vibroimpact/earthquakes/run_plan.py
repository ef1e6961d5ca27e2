"""Which runs many rigs, records and scales make, and in which blocks they are done."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, is_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Record, Rig
from vibroimpact.model.parameter_ranges import ParameterValues, Values, read_values, stated
from vibroimpact.model.parameters import set_values
from vibroimpact.model.read_rig import as_rigs, is_one_rig
from vibroimpact.model.rig import with_stated_units
from vibroimpact.model.system import System

_Array = NDArray[np.float64]

NOT_VARIED = ("frequency", "amplitude", "gap_ratio")
"""Parameters of what shakes it, which a record does not have."""
WHY_NOT = "depends on the shaking, which is not varied here"


class Runs(NamedTuple):
    """Rigs, and what is varied of them."""

    rigs: dict[str, System]
    varied: tuple[ParameterValues, ...]
    several: bool
    """Whether the rigs are a dim."""

    @property
    def dims(self) -> tuple[str, ...]:
        """Those of the rigs, after record and scale."""
        return (*(("rig",) if self.several else ()), *(one.name for one in self.varied))

    @property
    def shape(self) -> tuple[int, ...]:
        """Their lengths."""
        return (
            *((len(self.rigs),) if self.several else ()),
            *(len(one.values) for one in self.varied),
        )

    def system(self, at: tuple[int, ...]) -> System:
        """The oscillator or the assembly at a place along the dims.

        Raises
        ------
        InputError
            If a rig has no such parameter, or cannot have that value.
        """
        names = list(self.rigs)
        rig = self.rigs[names[at[0] if self.several else 0]]
        places = zip(self.varied, at[self.several :], strict=True)
        return set_values(Rig(rig), {one.name: float(one.values[k]) for one, k in places}).system


def runs(
    rig: Any,
    vary: Values | None,
    others: Mapping[str, object] | None = None,
    least: int = 0,
) -> Runs:
    """Read the rigs: one, or several by name or in a list; and what is varied of each.

    ``others`` are values, by their names in messages, that may state a unit, too. ``least`` is the
    least number of parameters that are varied.

    Raises
    ------
    InputError
        If one cannot be used.
    """
    read = as_rigs(rig, "rig", oscillator_alone=True)
    rigs: dict[str, System] = {name: one.system for name, one in read.items()}
    if is_one_rig(rig):
        rigs = {"rig": next(iter(rigs.values()))}
    values = {**(others or {}), **stated(vary)}
    rigs = {name: with_stated_units(one, values) for name, one in rigs.items()}
    one = next(iter(rigs.values()))
    every = read_values(vary, one, least=least, but=NOT_VARIED, why=WHY_NOT)
    plan = Runs(rigs, every, not is_one_rig(rig))
    for at in itertools.product(*((0, n - 1) for n in plan.shape)):
        plan.system(at)  # refused before anything is computed
    return plan


def in_words(records: Mapping[str, Record]) -> dict[str, Record]:
    """Return records by their names in messages."""
    return {f"records[{name!r}]": record for name, record in records.items()}


def suite(records: Any) -> dict[str, Record]:
    """Read records: one, several by name, or a list, whose names are those of their files.

    Raises
    ------
    InputError
        If one is not a record, or there is none.
    """
    if isinstance(records, Record):
        records = [records]
    if isinstance(records, Mapping):
        by_name = {str(name): one for name, one in records.items()}
    else:
        listed = check_list(records, "records") if is_list(records) else [records]
        by_name = {}
        for i, one in enumerate(listed):
            about = one.about if isinstance(one, Record) else None
            parts = (Path(about.source).name, about.component) if about else ()
            name = " ".join(part for part in parts if part) or str(i)
            by_name[name if name not in by_name else f"{name} ({i})"] = one
    for name, one in by_name.items():
        if not isinstance(one, Record):
            raise InputError(
                f"records[{name!r}]: {shown(one)} is not a record; pass a Record, such as the "
                "result of Record.read"
            )
    if not by_name:
        raise InputError("records: missing; pass at least one Record")
    return by_name


def digest(record: Record) -> str:
    """Content that distinguishes a record from others."""
    return hashlib.sha256(record.acceleration.tobytes() + repr(record.step).encode()).hexdigest()


class Block(NamedTuple):
    """Part of all runs, with every scale."""

    number: int
    records: slice
    rigs: tuple[slice, ...]
    """Along each dim of the rigs."""

    @property
    def place(self) -> tuple[slice, ...]:
        """In arrays over records, scales and the dims of the rigs."""
        return (self.records, slice(None), *self.rigs)


def chunks(shape: tuple[int, ...], most: int) -> tuple[int, ...]:
    """How long blocks are along each dim: filled from the last on, `most` places in all."""
    lengths = []
    left = most
    for length in reversed(shape):
        lengths.append(max(1, min(length, left)))
        left = max(1, left // lengths[-1])
    return tuple(reversed(lengths))


def blocks(shape: tuple[int, ...], most: int) -> Iterator[Block]:
    """All of them, in turn; `shape` is that of records and rigs."""
    sizes = chunks(shape, most)
    ranges = [
        [slice(i, min(i + size, length)) for i in range(0, length, size)]
        for length, size in zip(shape, sizes, strict=True)
    ]
    for number, (first, *others) in enumerate(itertools.product(*ranges)):
        yield Block(number, first, tuple(others))
