"""The state of an assembly by the names of its masses, links and stops."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
from pydantic import model_validator

from vibroimpact.arguments import check_list
from vibroimpact.errors import InputError, shown
from vibroimpact.model.assembly.names import check_known
from vibroimpact.model.frozen_mapping import FrozenMapping
from vibroimpact.model.quantities import ANGLE, LENGTH, VELOCITY
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts, Model, takes_fields

if TYPE_CHECKING:
    from vibroimpact.model.assembly.assembly import Assembly

NEAR_ZERO = 1e-12
"""A distance (m) and a speed (m/s) that are rounding, even of bodies that are held at zero."""

_ACCEPTS = {
    "displacement": Accepts(LENGTH),
    "velocity": Accepts(VELOCITY),
    "deformation": Accepts(LENGTH, minimum=0.0),
    "memory": Accepts(LENGTH),
}


class AssemblyState(Model):
    """The state of an `Assembly` at one instant, by names. `State` returns it for mappings.

    Parameters
    ----------
    displacement
        Mapping from masses to displacements relative to the base, in m. A mass that is not named is
        at u = 0.
    velocity
        Mapping from masses to velocities relative to the base, in m/s. A mass that is not named is
        at rest.
    deformation
        Mapping from stops to deformations in m, at least 0. A stop that is not named is undeformed,
        or compressed as far as its two bodies overlap. Of a stop with a memory (`ZenerBumper`) it
        is the memory, the deformation at which a free face stands; default: 0.
    memory
        Mapping from hysteretic links to their internal variables z in m, as `State` explains for
        the isolator. A link that is not named has z = 0.
    phase
        Phase of the excitation at this instant, in rad. Default: the initial phase of the
        excitation.
    touching
        Names of the stops whose bodies touch. Default: deduced from the displacements and the
        deformations.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or is out of bounds.
    """

    _quiet: ClassVar[Mapping[str, Any]] = {
        "velocity": {},
        "deformation": {},
        "memory": {},
        "phase": None,
        "touching": None,
    }

    displacement: FrozenMapping[float] = FrozenMapping()
    velocity: FrozenMapping[float] = FrozenMapping()
    deformation: FrozenMapping[float] = FrozenMapping()
    memory: FrozenMapping[float] = FrozenMapping()
    phase: Annotated[float | None, Accepts(ANGLE, optional=True)] = None
    touching: tuple[str, ...] | None = None

    @takes_fields
    def __init__(
        self,
        displacement: Mapping[str, float | str] | None = None,
        velocity: Mapping[str, float | str] | None = None,
        deformation: Mapping[str, float | str] | None = None,
        memory: Mapping[str, float | str] | None = None,
        phase: float | str | None = None,
        touching: Iterable[str] | None = None,
    ) -> None: ...

    @model_validator(mode="before")
    @classmethod
    def _by_name(cls, data: Any) -> Any:
        if not isinstance(data, Mapping):
            return data
        read = dict(data)
        for field, accepts in _ACCEPTS.items():
            table = data.get(field)
            table = {} if table is None else table
            if not isinstance(table, Mapping):
                raise InputError(
                    f"{field}: {shown(table)} is not a mapping from names, as the other values are"
                )
            read[field] = FrozenMapping(
                {str(name): accepts.at(one, f"{field}.{name}") for name, one in table.items()}
            )
        touching = data.get("touching")
        if touching is not None:
            read["touching"] = tuple(str(one) for one in check_list(touching, "touching"))
        return read

    def check_names(self, assembly: Assembly, where: str = "start") -> None:
        """Raise an error if the state names what an assembly has not, or penetrates a rigid stop.

        Raises
        ------
        InputError
            If a mass, a link or a stop does not exist, or if a displacement is beyond a rigid stop.
        """
        parts = {
            "displacement": ("mass", assembly.names),
            "velocity": ("mass", assembly.names),
            "deformation": ("stop", tuple(assembly.stops)),
            "memory": ("link", tuple(assembly.links)),
        }
        for field, (what, names) in parts.items():
            for name in getattr(self, field):
                check_known(name, names, what, f"{where}.{field}")
        for name in self.touching or ():
            check_known(name, tuple(assembly.stops), "stop", f"{where}.touching")
        u = np.array([self.displacement.get(name, 0.0) for name in assembly.names])
        for name, stop in assembly.stops.items():
            depth = float(assembly.closing(stop) @ u) - stop.stop.gap
            size = float(np.abs(u).max()) + abs(stop.stop.gap)
            if stop.stop.rigid and depth > max(1e-12 * size, NEAR_ZERO):
                raise InputError(
                    f"{where}.displacement: {stop.left} and {stop.right} overlap by "
                    f"{pretty(depth, LENGTH)} at the rigid stop {name!r}; pass displacements that "
                    "leave a clearance of at least 0"
                )
