"""Output variables of assemblies of several masses."""

from __future__ import annotations

from vibroimpact.datasets.variable import ANY_PEAKS, SHAKEN, STEADY, Variable, along, integer, text

_COUPLED = "if damping couples the modes (see the notes), an approximation"

ASSEMBLIES: dict[str, Variable] = {
    **along("mass", mass=text("name of the mass")),
    **along(
        STEADY,
        simultaneous_impacts=integer(
            "number of impacts whose order was decided by the order of the stops",
            "impacts at the same instant as another impact or rest of the same mass",
        ),
    ),
    **along("link", link=text("name of the link")),
    **along(
        ANY_PEAKS,
        drift_max=Variable("m", "largest drift of the link, u_right − u_left", part="link"),
        drift_min=Variable("m", "smallest drift of the link, u_right − u_left", part="link"),
        drift_excursion=Variable("m", "excursion of the drift of the link", part="link"),
        peak_drift=Variable("m", "largest drift of the link, without sign", part="link"),
    ),
    **along(
        SHAKEN,
        peak_closing=Variable(
            "m",
            "largest closing displacement u_left − u_right of the bodies of the stop, without "
            "stops",
            part="stop",
        ),
    ),
    **along(
        "",
        total_links=Variable("J", "energy lost in the link during the whole motion", part="link"),
        total_stops=Variable("J", "energy lost in the stop during the whole motion", part="stop"),
        total_damping=Variable(
            "J",
            "energy lost in damping that is not of a link during the whole motion",
            "modal or Rayleigh damping, and damping of matrices",
        ),
        total_stored=Variable(
            "J",
            "growth of the kinetic and potential energy during the whole motion",
            "of links, stops and constant forces; relative to the base",
        ),
    ),
    **along(
        "mode",
        mode=integer("number of the mode", "from 1, in the order of the natural frequencies"),
        natural_frequency=Variable(
            "Hz", "undamped natural frequency without stops", "0 for a free motion"
        ),
        mode_shape=Variable("1", "undamped mode", "its largest entry is 1", part="mass"),
        modal_damping_ratio=Variable("1", "damping ratio of the mode", _COUPLED),
        participation_factor=Variable(
            "1", "modal participation factor for a motion of the base", "φᵀ M ι/φᵀ M φ"
        ),
        effective_mass=Variable(
            "kg", "effective modal mass for a motion of the base", "(φᵀ M ι)²/φᵀ M φ"
        ),
    ),
}
