"""A record of ground motion: what its file holds, and the largest values of its spectrum."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact._version import __version__
from vibroimpact.facts.tables import sheet
from vibroimpact.model import GRAVITY, Record
from vibroimpact.model.quantities import TIME
from vibroimpact.model.units import plain, pretty


def facts(record: Record, spectrum: xr.Dataset) -> dict[str, Any]:
    """Return the record and the largest values of its spectrum, in SI units."""
    largest = []
    for i, ratio in enumerate(spectrum["damping_ratio"].values):
        curve = spectrum["pseudo_acceleration"].isel(damping_ratio=i).values
        at = int(np.argmax(curve))
        period = float(spectrum["natural_period"].values[at])
        largest.append(
            {"damping": float(ratio), "pseudo_acceleration": float(curve[at]), "period": period}
        )
    return {
        "vibroimpact_version": __version__,
        **record.about._asdict(),
        "samples": len(record.acceleration),
        "step": record.step,
        "duration": record.duration,
        "peak": record.peak,
        "peak_time": record.peak_time,
        "largest": largest,
    }


def text(record: Record, spectrum: xr.Dataset) -> RenderableType:
    """Return the same as a table."""
    summary = facts(record, spectrum)
    about = record.about
    peak = f"{plain(record.peak, 6)} m/s² = {plain(record.peak / GRAVITY, 5)} g"
    rows = [
        ("format", f"{about.format}, values in {about.unit}"),
        *((name, getattr(about, name) or "not stated") for name in ("station", "component")),
        (
            "samples",
            f"{summary['samples']} × {pretty(record.step, TIME)}",
            f"{plain(record.duration, 7)} s",
        ),
        ("peak", peak, f"at {plain(record.peak_time, 7)} s"),
        *(
            (
                f"spectrum, ζ = {plain(one['damping'], 4)}",
                f"pseudo-acceleration at most {plain(one['pseudo_acceleration'], 5)} m/s²",
                f"at T = {plain(one['period'], 4)} s",
            )
            for one in summary["largest"]
        ),
        *(("" if i else "note", note) for i, note in enumerate(about.notes)),
    ]
    return Group(Text(about.source, style="bold"), sheet(rows))
