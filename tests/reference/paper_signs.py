"""A motion with the signs of the paper, in which the reference computations are written."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import vibroimpact as vi

SIGNS = {"right": 1, "left": -1}


def in_paper_signs(data: xr.Dataset) -> xr.Dataset:
    """Add both sides' deformations with the sign of the displacement, and numbers of sides.

    Side 1 is the right one and -1 the left one; a contact is with a side, with none (0) or with
    both (2). A side without a stop is undeformed.
    """
    return data.assign(
        {
            f"{event}{side}_bumper": (dim, faces(data, f"{event}deformation", side))
            for event, dim in (("", "time"), ("event_", "event"))
            for side in SIGNS
        }
    ).assign(contact=("time", contact(data)), event_side=("event", sides(data)))


def faces(data: xr.Dataset, name: str, side: str) -> NDArray[np.float64]:
    """Deformations of one side with the sign of the displacement."""
    values = data[name]
    if side not in values["stop"].values:
        return np.zeros(values.isel(stop=[]).sum("stop").shape)
    return SIGNS[side] * values.sel(stop=side).values + 0.0


def contact(data: xr.Dataset) -> NDArray[np.int64]:
    """Number of the side that is touched at each sample."""
    touched = [
        data["touching"].sel(stop=side).values
        if side in data["stop"].values
        else np.zeros(data.sizes["time"], dtype=bool)
        for side in SIGNS
    ]
    return np.where(touched[0] & touched[1], 2, touched[0].astype(int) - touched[1])


def sides(data: xr.Dataset) -> NDArray[np.int64]:
    """Number of the side of each event."""
    return np.where(data["event_stop"].values == "right", 1, -1)


def signed_parts(components: NDArray[np.float64]) -> NDArray[np.float64]:
    """Displacement, velocity and both deformations, of a dataset's components (last axis)."""
    return components[..., :4] * [1.0, 1.0, 1.0, -1.0]


def mode_of(components: NDArray[np.float64]) -> float:
    """The phase of a dataset's state, as the engine counts."""
    return float(components[5] + 2.0 * components[6])


def start(components: NDArray[np.float64], **changes: float) -> vi.State:
    """The state of the first components of a dataset, which may be fewer, with other values."""
    u, v, right, left, *others = (float(one) for one in components[:7])
    values: dict[str, float] = dict(zip(("phase",), others[:1], strict=False))
    if len(others) == 3:
        touches = {(1.0, 0.0): 1, (0.0, 1.0): -1, (1.0, 1.0): 2, (0.0, 0.0): 0}
        values["contact"] = touches[others[1], others[2]]
    return vi.State(u, v, {"right": right, "left": left}, **(values | changes))
