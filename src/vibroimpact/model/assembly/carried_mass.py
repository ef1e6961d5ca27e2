"""The mass that a link carries, from which periods and other design values make its law."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from vibroimpact.errors import InputError, warn_of_input
from vibroimpact.model.assembly.link import Link
from vibroimpact.model.assembly.names import GROUND, check_body
from vibroimpact.model.quantities import MASS
from vibroimpact.model.units import pretty
from vibroimpact.model.unknown_keys import listed
from vibroimpact.model.written_units import written_for

_INSTEAD = (
    "state the mass as carries, or write the fields of the law, such as stiffness and damping"
)


class CarriedMasses:
    """The masses that links between the ground and a mass carry, and what was assumed of them.

    Such a link carries the mass at its upper end, and those that links join to it, unless one of
    them has a further link to the ground, which carries an unknown share.

    Parameters
    ----------
    masses
        Masses (kg) by name. Empty for an assembly of matrices.
    names
        Names of the bodies other than the ground.
    links
        Links and tables by name. Those without two valid ends are left out.
    units
        As in `Assembly`, for the text of warnings.
    """

    def __init__(
        self,
        masses: Mapping[str, float],
        names: Iterable[str],
        links: Mapping[str, Any],
        units: Any,
    ) -> None:
        self.units = units
        self._masses, self._names = masses, tuple(names)
        self._ends = {}
        for name, link in links.items():
            ends = _ends(link)
            if all(end == GROUND or end in self._names for end in ends):
                self._ends[name] = ends
        self._assumed: dict[str, tuple[str, float, list[str]]] = {}

    def of(self, name: str, left: str, right: str, keys: Sequence[str]) -> float:
        """Return the mass (kg) that a link carries.

        Parameters
        ----------
        keys
            Keys of its table that use the mass.

        Raises
        ------
        InputError
            If the mass is not determined, or if there is no such body.
        """
        for end, body in (("left", left), ("right", right)):
            check_body(body, self._names, end)
        needs = f"{keys[0]}: needs the mass that this link carries"
        if GROUND not in (left, right):
            raise InputError(f"{needs}, which is not known between two masses; {_INSTEAD}")
        if not self._masses:
            raise InputError(f"{needs}, which is not known from matrices; {_INSTEAD}")
        carried, joined = [right if left == GROUND else left], {name}
        for body in carried:
            for other, ends in self._ends.items():
                if body not in ends or other in joined:
                    continue
                joined.add(other)
                (further,) = set(ends) - {body}
                if further == GROUND:
                    raise InputError(
                        f"{needs}, of which links.{other} carries an unknown share; {_INSTEAD}"
                    )
                if further not in carried:
                    carried.append(further)
        mass = sum(self._masses[one] for one in carried)
        if len(carried) > 1:
            own = [one for one in self._masses if one in carried]  # in the order of the user
            self._assumed[name] = (f"links.{name}.{keys[0]}", mass, own)
        return mass

    def warn(self, links: Mapping[str, Link]) -> None:
        """Warn of each link whose mass was assumed to be that of several bodies; it states this."""
        for name, (where, mass, carried) in self._assumed.items():
            with written_for(self):
                what = pretty(mass, MASS)
            names = listed([repr(one) for one in carried])
            assumed = f"the mass that this link carries is assumed to be {what}, that of {names}"
            links[name]._assumes(f"{where}: {assumed}")
            warn_of_input(where, [f"{assumed}; to state it, add carries"])


def _ends(link: Any) -> tuple[Any, Any]:
    if isinstance(link, Link):
        return link.left, link.right
    if isinstance(link, Mapping) and link.get("left") != link.get("right"):
        return link.get("left"), link.get("right")
    return None, None
