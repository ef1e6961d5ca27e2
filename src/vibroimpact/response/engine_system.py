"""The choice of how the engine sees a system: as one mass, or as several."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model import Oscillator, Record
from vibroimpact.model.rig import Rig, several_masses_only
from vibroimpact.model.system import System
from vibroimpact.response.one_mass import OneMass
from vibroimpact.response.several_masses import SeveralMasses

_Array: TypeAlias = NDArray[np.float64]
EngineSystem: TypeAlias = OneMass | SeveralMasses
"""A system as the engine sees it.

Both classes have these members, so that a function asks for them in the place of the kind of the
system:

- its size: ``masses``, ``stops``, ``memories``, ``places``, ``parts``, ``width``, and the
  ``layout`` of phases;
- its numbers: ``numbers`` and ``section_numbers`` under a shaking, ``closing`` (displacements u
  close the stops by W u), ``largest_mass``, ``highest_frequency``, ``has_dashpot``,
  ``is_symmetric``, and ``partners``, the stop that is the mirror image of each;
- what it refuses: ``check_motion``, ``check_size``, ``check_bounded``;
- its states: ``read``, ``near``, ``vector_of``, ``motion_vector``, ``state``, ``point``,
  ``vector``, ``mirror_image``, and ``names`` and ``components`` in datasets;
- what is written down of a motion: ``record_widths``, ``histories``, ``event_doubts``,
  ``cause_of_events``, ``phase_rows``;
- what is measured: ``measured``, ``doubts_of_rows``, ``judged``, ``ended``, ``of_masses``,
  ``section_variables``.
"""


def engine_system(system: System) -> EngineSystem:
    """Return an oscillator or an assembly as the engine sees it."""
    if isinstance(system, Oscillator):
        return OneMass(system)
    return SeveralMasses(several_masses_only(system))


def engine_rig(rig: Rig) -> _Array:
    """Return a rig as the vector that the engine reads."""
    shaking = rig.shaking if isinstance(rig.shaking, Record) else rig.periodic
    return engine_system(rig.system).numbers(shaking)


def system_vector(rig: Rig) -> _Array:
    """Return `engine_rig` with the size and the frequency of the shaking, for the section map."""
    return engine_system(rig.system).section_numbers(rig.periodic)
