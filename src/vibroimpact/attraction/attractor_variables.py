"""The motions of a search as variables of a dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.attraction.attractors import Attractor
from vibroimpact.attraction.basin_fractions import interval
from vibroimpact.attraction.basin_metrics import entropies, uncertainty_exponent
from vibroimpact.attraction.node_labels import NodeLabels
from vibroimpact.grids.refinement import Nodes
from vibroimpact.model import Oscillator
from vibroimpact.response.engine_system import engine_system
from vibroimpact.stability.equivalence import mirrors

_KEPT = (
    "displacement_excursion",
    "acceleration_excursion",
    "eccentricity",
)
POINTS = 1000
"""Points that are kept of a motion that does not repeat itself."""


def ranked(motions: Sequence[xr.Dataset]) -> list[int]:
    """Return the numbers of motions, the largest first."""

    def size(number: int) -> tuple[float, float]:
        excursion = float(motions[number]["displacement_excursion"].max())
        # To nine digits, for of a mirrored pair rounding decides; then by the side.
        return -float(f"{excursion:.9g}"), -float(motions[number]["eccentricity"].values.flat[0])

    return sorted(range(len(motions)), key=size)


def renamed(labels: NDArray[np.int16], order: Sequence[int]) -> NDArray[np.int16]:
    """Return labels in which a motion has its place in an order as its number."""
    new_labels = labels.copy()
    for new, old in enumerate(order):
        new_labels[labels == old] = new
    return new_labels


def basin_variables(
    nodes: NodeLabels,
    plan: Nodes,
    dims: tuple[str, str],
    motions: Sequence[xr.Dataset],
) -> dict[str, Any]:
    """Return what a dataset says of basins, and the types and shares of their motions.

    `dims` are the names of the rows and of the columns, and `motions` stand in the order of their
    numbers.
    """
    labels, cycles, levels = nodes
    step = plan.spacing(0)
    drawn = max(int((labels[::step, ::step] >= -1).sum()), 1)
    mixed, exponent = entropies(labels), uncertainty_exponent(labels)
    return {
        "basin": (dims, labels),
        "capture_cycles": (dims, cycles),
        "level": (dims, levels),
        **kinds(motions),
        **shares(labels, len(motions), drawn),
        "basin_entropy": mixed.basin,
        "border_entropy": mixed.border,
        "uncertainty_exponent": exponent.value,
        "uncertainty_exponent_error": exponent.uncertainty,
    }


def lattice_words(plan: Nodes) -> str:
    """Describe the nodes of basins."""
    step = plan.spacing(0)
    rows, columns = (len(range(0, n, step)) for n in plan.shape)
    return f"each of {columns} × {rows} states was computed" + (
        f"; refined {plan.refine} times near borders, to {plan.shape[1]} × {plan.shape[0]}: "
        "regions narrower than the spacing of the first grid may be missed"
        if plan.refine
        else ""
    )


def kinds(motions: Sequence[xr.Dataset]) -> dict[str, Any]:
    """Return the types and periods of motions."""
    return {
        "motion": ("attractor", np.array([str(one["motion"].values) for one in motions], str)),
        "period": ("attractor", np.array([int(one["period"]) for one in motions], np.int64)),
    }


def variables(oscillator: Oscillator, known: Sequence[Attractor]) -> dict[str, Any]:
    """What a dataset says of motions, in this order."""
    along = ("attractor",)
    shown = [one.points[: one.settled_motion.period or POINTS] for one in known]
    states = engine_system(oscillator)
    points = np.vstack([*shown, np.empty((0, states.parts))])
    return {
        **kinds([one.motion for one in known]),
        **{name: (along, np.array([float(a.motion[name]) for a in known])) for name in _KEPT},
        "impacts": (
            (*along, "stop"),
            np.array([one.motion["impacts"].values for one in known]).reshape(len(known), -1),
        ),
        **oscillator.part_names,
        "exponents": (
            (*along, "exponent"),
            np.array([one.motion["exponents"].values for one in known]).reshape(-1, 2),
        ),
        "mirror_image": (along, _mirror_images(known)),
        "section_attractor": (
            "point",
            np.repeat(np.arange(len(known)), [len(one) for one in shown]),
        ),
        **states.section_variables(points * states.signs, ("point",)),
    }


def shares(labels: NDArray[np.integer[Any]], motions: int, drawn: int) -> dict[str, Any]:
    """Shares of states, with the intervals of as many that are drawn at random."""
    known = labels[labels >= -1]
    counts = np.array([(known == one).sum() for one in range(motions)], dtype=np.int64)
    share = counts / max(known.size, 1)
    low, high = interval(share * drawn, drawn)
    return {
        "states": ("attractor", counts),
        "share": ("attractor", share),
        "share_low": ("attractor", low),
        "share_high": ("attractor", high),
    }


def _mirror_images(known: Sequence[Attractor]) -> NDArray[np.int64]:
    """Which motion is each one's mirror image; -1 where that is not among them."""
    partners = np.full(len(known), -1, dtype=np.int64)
    for i, one in enumerate(known):
        if not one.settled_motion.symmetric:
            continue
        for j, other in enumerate(known):
            alike = one.settled_motion.period == other.settled_motion.period
            if alike and mirrors(one.settled_motion, other.settled_motion, 10_000):
                partners[i] = j
                break
    return partners
