"""The commands for assemblies of several masses: their figures, files and summaries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from vibroimpact import figures

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.results import Results
    from vibroimpact.cli.rig import Subject

Animation = Literal["gif", "html"]


def write_motion(
    written: Results,
    motion: xr.Dataset,
    ending: str,
    title: str,
    cycles: float | None,
    animation: Animation | None = None,
) -> None:
    """Save a motion with its histories, and draw the figures of `draw_motion`.

    `cycles` is the number of forcing cycles in the histories, or None for all of them.
    """
    pairs = between_masses(written.what)
    written.write(motion, ending, figures.mass_histories, title, cycles=cycles, closing=pairs)
    draw_motion(written, motion, ending.removesuffix("-history"), title, cycles, animation)


def between_masses(what: Subject) -> list[str]:
    """Return the names of the stops that join two masses."""
    from vibroimpact.model.assembly.names import GROUND

    stops = what.assembly.stops
    return [name for name, stop in stops.items() if GROUND not in (stop.left, stop.right)]


def draw_motion(
    written: Results,
    motion: xr.Dataset,
    stem: str,
    title: str,
    cycles: float | None,
    animation: Animation | None = None,
    of: str = "",
) -> None:
    """Draw the accelerations, the contact forces and, of a frame, the envelopes of a motion."""
    from vibroimpact.figures.assembly_motion import chains

    drawn = {
        "accelerations": figures.mass_histories(
            motion, quantity="acceleration", cycles=cycles, title=title
        )
    }
    if motion.sizes["stop"]:
        drawn["forces"] = figures.contact_forces(motion, cycles=cycles, title=title)
    if any(len(row) > 1 for row in chains(written.what.assembly)):
        drawn["envelopes"] = figures.mass_envelopes(motion, title=title)
    for name, figure in drawn.items():
        written.draw(f"{name}{of}", f"{stem}-{name}", figure)
    if animation is not None:
        path = written.path(stem, animation)
        written.files[f"animation{of}"] = figures.save_animation(motion, path, title=title)


def draw_sweep(written: Results, data: xr.Dataset) -> None:
    """Draw the accelerations and the contact forces of a sweep, after the displacements."""
    title = written.what.title
    for name, quantity in (("accelerations", "peak_acceleration"), ("forces", "peak_force")):
        if quantity == "peak_force" and not data.sizes["stop"]:
            continue
        figure = figures.mass_resonance(data, quantity=quantity, title=title)
        written.draw(name, f"sweep-{name}", figure)


def draw_bands(written: Results, data: xr.Dataset, nominal: xr.Dataset) -> None:
    """Draw the accelerations and the contact forces of an ensemble, after the displacements."""
    forces = [
        f"peak_force.{stop}"
        if np.isfinite(data["peak_force"].sel(stop=stop)).all()
        else f"peak_impulse.{stop}"  # of a rigid stop
        for stop in data["stop"].values
    ]
    for name, drawn in (("accelerations", ["peak_acceleration"]), ("forces", forces)):
        if drawn:
            figure = figures.resonance_bands(
                data, quantities=drawn, nominal=nominal, title=written.what.title
            )
            written.draw(name, f"ensemble-{name}", figure)


def response_table(responses: dict[str, xr.Dataset]) -> xr.Dataset:
    """Return the extremes of several records as one dataset with the dim ``record``."""
    import xarray as xr

    joined = xr.concat(list(responses.values()), "record", combine_attrs="drop")
    joined = joined.assign_coords(record=("record", list(responses)))
    flat: dict[str, Any] = {"record": joined["record"]}
    for name, one in joined.data_vars.items():
        dims = [dim for dim in one.dims if dim != "record"]
        if not dims:
            flat[str(name)] = one
            continue
        for part in joined[dims[0]].values:
            flat[f"{name}_{part}"] = one.sel({dims[0]: part}, drop=True)
    flat.pop("record")
    table = xr.Dataset(flat, coords={"record": list(responses)})
    table.attrs = dict(next(iter(responses.values())).attrs)
    return table
