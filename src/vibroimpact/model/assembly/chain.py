"""Masses in a row, such as the storeys of a building."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal

from vibroimpact.arguments import check_list, is_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model.assembly.assembly import Assembly
from vibroimpact.model.assembly.damping import AnyDamping, ModalDamping, RayleighDamping
from vibroimpact.model.assembly.link import Link
from vibroimpact.model.assembly.names import GROUND, check_part_name
from vibroimpact.model.isolators import Isolator
from vibroimpact.model.public import public
from vibroimpact.model.quantities import STIFFNESS
from vibroimpact.model.size_checks import doubt_damping_ratio
from vibroimpact.model.system import Units
from vibroimpact.model.validation import Accepts

_STIFFNESS = Accepts(STIFFNESS, above=0.0)


@public
def chain(
    masses: Sequence[float | str] | Mapping[str, float | str],
    stiffnesses: Sequence[float | str],
    damping_ratio: float | str | Sequence[float | str] = 0.05,
    damping: Literal["modal", "rayleigh"] = "modal",
    stops: Mapping[str, Link | Mapping[str, Any]] | None = None,
    forces: Mapping[str, float | str] | None = None,
    *,
    rayleigh_modes: tuple[int, int] | None = None,
    units: Units = "SI",
) -> Assembly:
    """Return masses in a row: the first on the ground, each next one on the one before.

    Parameters
    ----------
    masses
        Masses in kg from the lowest to the highest, or strings such as ``"250 t"``. A mapping also
        names them. Default names: "floor_1", "floor_2" and so on.
    stiffnesses
        Stiffness of the link below each mass in N/m, greater than 0, or strings such as
        ``"200 MN/m"``. The links are named "storey_1", "storey_2" and so on.
    damping_ratio
        Damping ratio of the modes, at least 0, or a string such as ``"5 %"``. For modal damping, a
        list with one ratio per mode is also accepted. Default: 0.05.
    damping
        ``"modal"`` (the default): all modes have the damping ratio. ``"rayleigh"``: two modes have
        it, see ``rayleigh_modes``.
    stops, forces, units
        As in `Assembly`.
    rayleigh_modes
        Numbers of the two modes with the damping ratio, counted from 1. Default: the first two
        modes.

    Returns
    -------
    Assembly

    Raises
    ------
    InputError
        If the numbers of masses and stiffnesses differ. Also as in `Assembly`.

    Examples
    --------
    >>> building = chain(["250 t"] * 3, ["200 MN/m"] * 3, 0.02)
    >>> print(building.natural_frequencies.round(3), building.damping_ratios.round(6))
    [2.004 5.614 8.113] [0.02 0.02 0.02]
    """
    if isinstance(masses, Mapping):
        named = dict(masses)
    else:
        listed = check_list(masses, "masses", what='a list, such as ["300 t", "250 t"]')
        named = {f"floor_{i + 1}": one for i, one in enumerate(listed)}
    springs = check_list(stiffnesses, "stiffnesses", what='a list, such as ["200 MN/m"]')
    if len(springs) != len(named):
        raise InputError(
            f"stiffnesses: {len(springs)} for {len(named)} masses; pass one stiffness per mass, "
            "that of the link below it"
        )
    if damping == "modal" and rayleigh_modes is not None:
        raise InputError(
            "rayleigh_modes: passed without damping='rayleigh'; remove it, or set the damping"
        )
    links = {}
    for i, ((below, above), value) in enumerate(
        zip(pairwise((GROUND, *named)), springs, strict=True)
    ):
        check_part_name(above, "masses")
        stiffness = _STIFFNESS.at(value, f"stiffnesses[{i}]")
        links[f"storey_{i + 1}"] = Link(below, above, Isolator(stiffness, 0.0))
    try:
        modal = ModalDamping(damping_ratio)
    except InputError as error:
        raise InputError(str(error).replace("ratio", "damping_ratio", 1)) from None
    for ratio in modal.ratio if isinstance(modal.ratio, tuple) else (modal.ratio,):
        doubt_damping_ratio(ratio, "damping_ratio")
    bare = Assembly(named, links, stops, forces, units=units)
    rule: AnyDamping = modal
    if damping == "rayleigh":
        if is_list(damping_ratio) or isinstance(modal.ratio, tuple):
            raise InputError("damping_ratio: a list; Rayleigh damping has one ratio; pass a number")
        rule = RayleighDamping.from_ratio(modal.ratio, *_frequencies(bare, rayleigh_modes))
    return bare.replace(damping=rule) if modal.ratio else bare


def _frequencies(bare: Assembly, modes: Any) -> tuple[float, float]:
    """Return the angular frequencies (rad/s) of the two modes of Rayleigh damping."""
    omega = bare._modes.omega
    numbers = (1, min(2, len(omega))) if modes is None else check_list(modes, "rayleigh_modes")
    for one in numbers:
        if isinstance(one, bool) or not isinstance(one, int) or not 1 <= one <= len(omega):
            raise InputError(
                f"rayleigh_modes: {shown(one)} is not a mode; use numbers from 1 to {len(omega)}"
            )
    if len(numbers) != 2:
        raise InputError(f"rayleigh_modes: {len(numbers)} numbers; pass two")
    first, second = numbers
    return float(omega[first - 1]), float(omega[second - 1])
