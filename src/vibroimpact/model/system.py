"""What vibrates: the protocol that an oscillator and an assembly fulfil."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model.validation import Model

if TYPE_CHECKING:
    from vibroimpact.model.assembly.link import Link
    from vibroimpact.model.excitation import Repeated
    from vibroimpact.model.stops import Stop

Units: TypeAlias = Literal["SI", "none"]
"""Units of the numbers of a rig."""
PartNames: TypeAlias = dict[str, NDArray[np.str_]]
"""Names of the parts of a system, by the dims of datasets: ``mass``, ``link`` and ``stop``."""


class System(Model):
    """A mass, or several masses, on a base: what a rig shakes.

    `Oscillator` and `Assembly` derive from it. Each states what follows; in return, all other
    modules ask for these members, and never which of the two a system is. What the engine and the
    datasets need in addition is `EngineSystem` of `response/engine_system.py`.

    - ``table_name``: name of its table in study files and in the parameters of datasets.
    - ``by_mass``: whether results have a value for each mass, along the dim ``mass``. Otherwise
      they are those of one mass, without this dim.
    - ``units``, ``may_have_units``: the units of its numbers.
    - ``names``: the names of the masses.
    - ``stops``, ``stop_laws``, ``counted_stops``: the stops that exist, by name, with their laws;
      and the names of those for which the engine has numbers.
    - ``part_names``: the names of its parts as coordinates of datasets.
    - ``assumptions``: what was assumed to read it, which parameters and notes of results state.
    - ``angular_frequency``, ``linear``: the lowest natural frequency, and the kind of its motion.
    - ``_acted_on_by``: an excitation, checked, with the mass on which it acts.
    - ``rows``, ``_picture``: its values as text, and a picture.
    """

    table_name: ClassVar[str]
    by_mass: ClassVar[bool]

    if TYPE_CHECKING:  # a field of the one class is a property of the other

        @property
        def units(self) -> Units:
            """``"SI"``, or ``"none"`` if the numbers are dimensionless."""

        @property
        def names(self) -> tuple[str, ...]:
            """Names of the masses."""

        @property
        def stops(self) -> Mapping[str, Stop] | Mapping[str, Link]:
            """The stops that exist, by name."""

    @property
    @abstractmethod
    def stop_laws(self) -> Mapping[str, Stop]:
        """The laws of the stops, by the names of the stops."""

    @property
    @abstractmethod
    def counted_stops(self) -> tuple[str, ...]:
        """Names of the stops for which the engine has numbers, whether they exist or not."""

    @property
    @abstractmethod
    def part_names(self) -> PartNames:
        """Names of the parts by the dims of datasets."""

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What was assumed to read the system, one line each."""
        return ()

    @property
    @abstractmethod
    def angular_frequency(self) -> float:
        """Lowest undamped natural angular frequency above 0 (rad/s), or 0 if there is none."""

    @property
    @abstractmethod
    def linear(self) -> bool:
        """Whether all forces are linear in flight and during contact."""

    @property
    @abstractmethod
    def may_have_units(self) -> bool:
        """Whether a unit that is stated elsewhere makes a rig without units one in SI units."""

    @abstractmethod
    def _acted_on_by(self, shaking: Repeated) -> Repeated:
        """Return a periodic excitation with the mass on which a force acts.

        A force on one of several masses must state which.
        """

    def _picture(self) -> str:
        """Return a picture as SVG; "" if there is none."""
        return ""
