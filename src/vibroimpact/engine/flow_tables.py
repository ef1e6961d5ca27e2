"""The tables of the flows' functions: a group of them is compiled when it is first needed."""

from __future__ import annotations

import ctypes
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import flow
from vibroimpact.engine.assembly import table as several_masses
from vibroimpact.engine.assembly.curved import table as curved_masses
from vibroimpact.engine.compilation import Compiled
from vibroimpact.engine.compiler import PLAIN
from vibroimpact.engine.flow_dispatch import SEVERAL_MASSES, PlanType, flow_of
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.one_mass import table as one_mass

flow.FLOWS += [one_mass, several_masses, curved_masses]


def _plan_type(given: Any) -> Any:
    kind = given.instance_class
    return flow.P if kind in SEVERAL_MASSES else PlanType(kind)


def _module(kind: type) -> ModuleType:
    return flow.FLOWS[1 + SEVERAL_MASSES.index(kind) if kind in SEVERAL_MASSES else 0]


def _module_of(given: Any) -> ModuleType:
    return _module(given.instance_class)


_fill_motion = flow.filling(_plan_type, _module_of, "motion")
_fill_recorded = flow.filling(_plan_type, _module_of, "recorded")
_fill_disturbed = flow.filling(_plan_type, _module_of, "disturbed")
_fill_measured = flow.filling(_plan_type, _module_of, "measured")


def _motion(given: Any, table: Any) -> None:
    _fill_motion(given, table)


def _recorded(given: Any, table: Any) -> None:
    _fill_recorded(given, table)


def _disturbed(given: Any, table: Any) -> None:
    _fill_disturbed(given, table)


def _measured(given: Any, table: Any) -> None:
    _fill_measured(given, table)


GROUPS = {
    function.__name__[1:]: Compiled(function, "void(i8[::1])")
    for function in (_motion, _recorded, _disturbed, _measured)
}
"""What fills a part of a table with the addresses of compiled functions."""
_tables: dict[type, NDArray[np.int64]] = {}
_filled: set[tuple[type, str]] = set()


def plan_of(rig: Vector, groups: tuple[str, ...]) -> Vector:
    """Memory for the plan of a rig, whose flow has these groups of functions."""
    given = flow_of(rig)
    memory: Vector = given.memory
    kind = type(given)
    if PLAIN:
        return memory
    table = _tables.setdefault(kind, np.zeros(len(flow.SIGNATURES), np.int64))
    for group in groups:
        if (kind, group) not in _filled:
            GROUPS[group].of(given)(given, table)
            _filled.add((kind, group))
    ctypes.c_int64.from_address(memory.ctypes.data - 8).value = table.ctypes.data
    return memory
