"""Natural frequencies and modes of an assembly."""

from __future__ import annotations

import xarray as xr

from vibroimpact.datasets.description import describe, system_parameters
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyAssembly, as_assembly

_COUPLED = (
    "damping: the undamped modes do not decouple it, so that each damping ratio is the diagonal "
    "entry of the modal damping matrix, an approximation"
)
_CURVED = "links: curved links have their initial stiffness; the modes are those of small motions"


@public
def modes(rig: AnyAssembly) -> xr.Dataset:
    """Compute the natural frequencies, modes and damping ratios of an assembly without stops.

    Parameters
    ----------
    rig
        An `Assembly`, a `Rig` with one, or the path of a study file. Its stops are ignored. Curved
        links have their initial stiffness, and friction does not act.

    Returns
    -------
    xarray.Dataset
        Dimensions ``mode``, counted from 1 in the order of the frequencies, and ``mass``. Variables
        ``natural_frequency`` (Hz; 0 for a free motion), ``mode_shape``, whose largest entry is 1 in
        each mode, ``modal_damping_ratio`` (NaN for a frequency of 0), ``participation_factor`` and
        ``effective_mass`` (kg). The attribute ``notes`` says if damping couples the modes.

    Raises
    ------
    InputError
        If the value is not an assembly or a rig with one.

    Examples
    --------
    >>> shapes = modes(chain(["250 t", "250 t"], ["200 MN/m", "200 MN/m"], 0.02))
    >>> print(shapes["natural_frequency"].values.round(3))
    [2.782 7.284]
    >>> print(shapes["mode_shape"].sel(mass="floor_1").values.round(3))
    [0.618 1.   ]
    """
    system = as_assembly(rig)
    by_mode = {
        "natural_frequency": system.natural_frequencies,
        "modal_damping_ratio": system.damping_ratios,
        "participation_factor": system.participation_factors,
        "effective_mass": system.effective_masses,
    }
    data = xr.Dataset(
        {
            "mode_shape": (("mode", "mass"), system.mode_shapes),
            **{name: ("mode", values) for name, values in by_mode.items()},
        },
        {"mode": range(1, len(system.names) + 1), "mass": list(system.names)},
    )
    notes = [] if system.is_classically_damped else [_COUPLED]
    if not all(link.isolator.linear for link in system.links.values()):
        notes.append(_CURVED)
    return describe(data, "vibroimpact.modes", system_parameters(system), notes)
