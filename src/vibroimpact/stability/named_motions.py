"""Steady motions at one frequency by name, each with its spectrum and its section."""

from __future__ import annotations

from typing import Literal

import xarray as xr

from vibroimpact.datasets.description import motion_parameters
from vibroimpact.errors import InputError
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import written_for
from vibroimpact.response.sections import stroboscopic_section
from vibroimpact.response.spectrum import fourier_spectrum
from vibroimpact.response.sweep_starts import arrivals
from vibroimpact.stability.coexisting import find_motions
from vibroimpact.stability.steady import steady
from vibroimpact.tasks.threads import Progress

SECTION_POINTS = 5000
"""Points of the section of a motion that does not settle."""

Motions = dict[str, xr.Dataset]


def named_motions(
    rig: Rig,
    branch: Literal["forward", "backward", "all"] = "all",
    *,
    random: int = 12,
    window: int = 200,
    samples: int = 256,
    progress: Progress | None = None,
) -> Motions:
    """Find the steady motions of a rig at its frequency, by name.

    Parameters
    ----------
    rig
        The rig at one frequency.
    branch
        "forward" or "backward" for the motion that a sweep reaches, "all" for those of
        `coexisting_motions`.
    random, window
        As in `coexisting_motions`.
    samples, progress
        As in `steady`.

    Returns
    -------
    dict of xarray.Dataset
        Datasets of `steady` with the variables of `stroboscopic_section` and `fourier_spectrum`.
        Motions that a sweep reaches are called after it, the others by number.

    Raises
    ------
    InputError
        If a value cannot be used, or the sweep does not reach the frequency.
    """
    if branch == "all":
        motions = find_motions(
            rig, random=random, window=window, samples=samples, progress=progress
        )
        return _named([with_spectrum(data) for data in motions])
    name = f"{branch} branch"
    starts = arrivals(rig)
    if name not in starts:
        with written_for(rig):
            there = forcing(rig.harmonic.frequency)
        raise InputError(
            f"branch: no {branch} sweep reaches {there}; use a frequency within "
            "0.3 to 6 times the natural frequency, or branch='all'"
        )
    data = steady(rig, starts[name], samples, window=window, progress=progress)
    return {name: with_spectrum(data)}


def with_spectrum(data: xr.Dataset) -> xr.Dataset:
    """Return a motion with its spectrum and its section."""
    if not data.sizes["time"]:
        return data
    period = int(data["period"])
    phase = motion_parameters(data)["phase"]
    section = stroboscopic_section(data, phase, period or SECTION_POINTS)
    if float(data["cycle"][-1]) < 1.0:  # it was given up
        lines = xr.Dataset()
    else:
        lines = fourier_spectrum(data)
        data.attrs["spectrum_method"] = lines.attrs["method"]
    return data.assign({str(name): part[name] for part in (section, lines) for name in part})


def _named(motions: list[xr.Dataset]) -> Motions:
    """Name motions after the sweep that leads to them, or by number."""
    named = {}
    for number, data in enumerate(motions, 1):
        starts = data.attrs["starts"] + ", " + data.attrs["mirrored_starts"]
        sweeps = [way for way in ("forward", "backward") if f"{way} branch" in starts]
        name = f"{' and '.join(sweeps)} branch" if sweeps else f"motion {number}"
        named[name] = data
    return named
