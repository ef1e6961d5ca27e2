"""Checks of an assembly as a whole: what holds it, room between rigid stops, and an equilibrium."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from vibroimpact.errors import InputError
from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.units import pretty
from vibroimpact.model.unknown_keys import listed

if TYPE_CHECKING:
    from vibroimpact.model.assembly.assembly import Assembly

_LEAST, _MOST = 1e-50, 1e50
"""Natural frequencies (rad/s) whose powers are floating-point numbers."""


def check(assembly: Assembly) -> None:
    """Raise an error if an assembly cannot be simulated.

    Raises
    ------
    InputError
        If neither a link nor a stop holds a mass, if a natural frequency is out of range, if rigid
        stops leave no room, or if there is no equilibrium.
    """
    _check_held(assembly)
    _check_frequencies(assembly)
    _check_room(assembly)
    if assembly.forces or any(stop.stop.gap < 0.0 for stop in assembly.stops.values()):
        from vibroimpact.model.assembly.equilibrium import check_balance, equilibrium

        check_balance(assembly)
        # Without softening, balance is enough, because the energy is convex.
        if any(link.isolator.reach < math.inf for link in assembly.links.values()):
            equilibrium(assembly)


def _check_held(assembly: Assembly) -> None:
    held = {end for stop in assembly.stops.values() for end in (stop.left, stop.right)}
    for link in assembly.links.values():
        if link.isolator.strongest > 0.0:
            held |= {link.left, link.right}
    if assembly.matrices is not None:
        rows = np.abs(np.array(assembly.matrices.stiffness)).max(1)
        held |= {name for name, row in zip(assembly.names, rows, strict=True) if row > 0.0}
    if loose := [name for name in assembly.names if name not in held]:
        raise InputError(
            f"masses.{loose[0]}: no spring, friction or stop holds this mass; add a link or a stop "
            f'between {loose[0]!r} and another mass or "{GROUND}"'
        )


def _check_frequencies(assembly: Assembly) -> None:
    stiffness = assembly.stiffness_matrix
    if not stiffness.any():
        return
    omega = assembly._modes.omega
    for one in omega[omega > 0.0]:
        if not _LEAST <= one <= _MOST:
            raise InputError(
                f"masses and links: a natural angular frequency is about {one:.0e} rad/s, but only "
                f"values from {_LEAST:g} to {_MOST:g} rad/s can be computed; correct the masses or "
                "the stiffnesses"
            )


def _check_room(assembly: Assembly) -> None:
    """Check that the masses can be placed so that all rigid stops are open."""
    rigid = {name: stop for name, stop in assembly.stops.items() if stop.stop.rigid}
    gaps = np.array([stop.stop.gap for stop in rigid.values()])
    if not len(rigid) or gaps.min() > 0.0:
        return
    from scipy.optimize import linprog

    # Maximise the least clearance t: w u + t ≤ gap. Without a bound it would be infinite.
    scale = float(np.abs(gaps).max()) or 1.0
    rows = np.array([assembly.closing(stop) for stop in rigid.values()])
    count = len(assembly.names)
    solution = linprog(
        np.append(np.zeros(count), -1.0),
        A_ub=np.column_stack([rows, np.ones(len(rigid))]),
        b_ub=gaps / scale,
        bounds=[(None, None)] * count + [(None, 1.0)],
    )
    if solution.status == 0 and solution.x[-1] > 1e-12:
        return
    marginals = np.zeros(len(rigid)) if solution.status else solution.ineqlin.marginals
    tight = [name for name, one in zip(rigid, marginals, strict=True) if one < 0.0] or list(rigid)
    text = listed([f"stops.{name}.gap: {pretty(rigid[name].stop.gap, LENGTH)}" for name in tight])
    total = math.fsum(rigid[name].stop.gap for name in tight)
    raise InputError(
        f"{text} leave no room between rigid stops, so there is no equilibrium (their sum is "
        f"{pretty(total, LENGTH)}); use gaps with a sum greater than 0"
    )
