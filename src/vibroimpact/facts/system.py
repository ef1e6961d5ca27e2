"""Modes and static equilibrium of a system, as plain values and as text."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model import equilibrium
from vibroimpact.model.rig import several_masses_only
from vibroimpact.model.system import System
from vibroimpact.model.written_units import unitless
from vibroimpact.response.modes import modes

_SHAPE = "mode_shape"


def facts(system: System) -> dict[str, Any]:
    """Return the static equilibrium and, of several masses, the modes, in SI units."""
    rest = equilibrium(system).displacement
    if not system.by_mass:
        return {"equilibrium": {"displacement": rest}}
    data = modes(several_masses_only(system))
    names = data["mass"].values.tolist()
    by_mode = ("natural_frequency", "modal_damping_ratio", "effective_mass")
    mode_rows = [
        {
            **{name: float(one[name]) for name in by_mode},
            _SHAPE: dict(zip(names, one[_SHAPE].values.tolist(), strict=True)),
        }
        for one in (data.isel(mode=i) for i in range(data.sizes["mode"]))
    ]
    moved = {name: float(rest.get(name, 0.0)) for name in names}  # type: ignore[union-attr]
    return {
        "modes": mode_rows,
        "equilibrium": {"displacement": moved},
        "notes": str(data.attrs.get("notes", "")).splitlines(),
    }


def text(summary: Mapping[str, Any]) -> RenderableType:
    """Return the modes and the displacements of the equilibrium as tables."""
    rest = summary["equilibrium"]["displacement"]
    if "modes" not in summary:
        return Group(Text(), Text(f"Static equilibrium: u = {written('displacement', rest)}"))
    turn = math.tau if unitless() else 1.0
    count = len(summary["modes"])
    rows = [{"mode": i, **one} for i, one in enumerate(summary["modes"], 1)]
    shapes = [
        {
            "mass": name,
            "rest": value,
            **{str(i + 1): one[_SHAPE][name] for i, one in enumerate(summary["modes"])},
        }
        for name, value in rest.items()
    ]
    by_mode = (
        Column("mode", "mode"),
        Column(
            "ω" if unitless() else "frequency (Hz)", lambda one: turn * one["natural_frequency"]
        ),
        Column("damping ratio", lambda one: _unless_nan(one["modal_damping_ratio"])),
        Column("effective mass", "effective_mass"),
    )
    parts: list[RenderableType] = [
        Text(),
        table_of(rows, by_mode, "Modes without stops"),
        Text(),
        table_of(
            shapes,
            (
                Column("mass", "mass", left=True),
                *(Column(f"mode {i + 1}", str(i + 1), 3) for i in range(min(count, _MOST))),
            ),
            f"Mode shapes{f' of the first {_MOST}' if count > _MOST else ''}",
        ),
        Text(),
    ]
    if any(rest.values()):
        moved = Column("mass", "mass", left=True), Column("displacement", "rest", units="m")
        parts.append(table_of(shapes, moved, "Static equilibrium"))
    else:
        parts.append(Text("Static equilibrium: u = 0 of all masses"))
    notes = [Text(f"Note: {note}") for note in summary["notes"]]
    return Group(*parts, *([Text()] if notes else []), *notes)


def _unless_nan(value: float) -> float | None:
    return None if math.isnan(value) else value


_MOST = 8
"""Largest number of modes whose shapes are printed."""
