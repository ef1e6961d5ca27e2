"""An assembly in plain numbers and arrays, for code that computes its motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model.assembly.link import AnyLaw, Link
from vibroimpact.model.assembly.names import GROUND

if TYPE_CHECKING:
    from vibroimpact.model.assembly.assembly import Assembly

GROUND_INDEX = -1
"""Index of the ground."""


class PartNumbers(NamedTuple):
    """A link or a stop in numbers."""

    name: str
    left: int
    """Index of the left body; -1 for the ground."""
    right: int
    gap: float
    """Gap of a stop (m); NaN for a link."""
    law: AnyLaw
    """The law; a Jankowski bumper has a mass."""


class AssemblyNumbers(NamedTuple):
    """M ü + C u̇ + K u + (curved links) + (stops) = −M ι A_t + f in numbers, in SI units."""

    names: tuple[str, ...]
    mass: NDArray[np.float64]
    """M, shape (masses, masses)."""
    damping: NDArray[np.float64]
    """C of linear links, of matrices and of modal or Rayleigh damping."""
    stiffness: NDArray[np.float64]
    """K of linear links and of matrices."""
    influence: NDArray[np.float64]
    """ι, shape (masses,)."""
    force: NDArray[np.float64]
    """f, shape (masses,)."""
    links: tuple[PartNumbers, ...]
    """All links that are not in K and C, in the order of the assembly."""
    stops: tuple[PartNumbers, ...]
    """All stops, in the order of the assembly."""


def numbers(assembly: Assembly) -> AssemblyNumbers:
    """Return an assembly as numbers and arrays, which are made once and not to be changed."""
    return assembly._numbers


def made_of(assembly: Assembly) -> AssemblyNumbers:
    """Make the numbers of an assembly, whose arrays are read-only."""
    linear = [link for link in assembly.links.values() if link.law.linear]
    all_numbers = AssemblyNumbers(
        assembly.names,
        assembly.mass_matrix,
        assembly.matrix_of_links("damping", linear) + assembly.rule_damping,
        assembly.matrix_of_links("stiffness", linear),
        assembly.influence,
        assembly.constant_force,
        tuple(
            _part(assembly, name, link)
            for name, link in assembly.links.items()
            if not link.law.linear
        ),
        tuple(_part(assembly, name, stop) for name, stop in assembly.stops.items()),
    )
    for one in all_numbers:
        if isinstance(one, np.ndarray):
            one.setflags(write=False)
    return all_numbers


def _part(assembly: Assembly, name: str, link: Link) -> PartNumbers:
    return PartNumbers(
        name,
        _index(assembly, link.left),
        _index(assembly, link.right),
        link.stop.gap if link.is_stop else float("nan"),
        link.law.between(assembly.meeting_mass(link)),
    )


def _index(assembly: Assembly, end: str) -> int:
    return GROUND_INDEX if end == GROUND else assembly.names.index(end)
