"""Output variables of assemblies of several masses."""

from __future__ import annotations

from vibroimpact.datasets.variable import Variable

_COUPLED = "if damping couples the modes (see the notes), an approximation"

ASSEMBLIES: dict[str, Variable] = {
    "mass": Variable("1", "name of the mass"),
    "simultaneous_impacts": Variable(
        "1",
        "number of impacts whose order was decided by the order of the stops",
        "impacts at the same instant as another impact or rest of the same mass",
    ),
    "mode": Variable("1", "number of the mode", "from 1, in the order of the natural frequencies"),
    "natural_frequency": Variable(
        "Hz", "undamped natural frequency without stops", "0 for a free motion"
    ),
    "mode_shape": Variable("1", "undamped mode", "its largest entry is 1"),
    "modal_damping_ratio": Variable("1", "damping ratio of the mode", _COUPLED),
    "participation_factor": Variable(
        "1", "modal participation factor for a motion of the base", "φᵀ M ι/φᵀ M φ"
    ),
    "effective_mass": Variable(
        "kg", "effective modal mass for a motion of the base", "(φᵀ M ι)²/φᵀ M φ"
    ),
}
