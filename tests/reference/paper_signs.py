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
        return np.zeros(values.shape[:-1])
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


def start(components: NDArray[np.float64], **changes: float) -> vi.State:
    """The state of the first components (u, v, u_R, u_L, phase, contact), which may be fewer."""
    u, v, right, left, *others = (float(one) for one in components[:6])
    values = dict(zip(("phase", "contact"), others, strict=False)) | changes
    return vi.State(u, v, {"right": right, "left": 0.0 - left}, **values)
