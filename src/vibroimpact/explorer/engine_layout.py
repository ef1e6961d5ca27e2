"""What the page without a server has to know of the engine: its entries, positions and sizes.

The page calls a module of WebAssembly, which has the entries and the flows that are named here.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import batch, flow, flow_tables, lyapunov, state, steady_response
from vibroimpact.engine import parameters as par
from vibroimpact.engine.flow_dispatch import AnyStops, Bumpers
from vibroimpact.engine.linear.layout import PLAN
from vibroimpact.engine.observers import record
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import Status

WASM = "page.wasm"
"""Name of the module in the folder of the libraries (`engine.native.FOLDER`)."""

_ENTRIES = {
    "batch_sweep": batch.sweep,
    "batch_trajectory": batch.trajectory,
    "lyapunov_monodromy": lyapunov.monodromy,
}
_FLOWS = (Bumpers, AnyStops)
_GROUPS = ("motion", *sorted({group for one in _ENTRIES.values() for group in one.groups[1:]}))

SYMBOLS = frozenset(
    [f"ndarray_{name}" for name in _ENTRIES]
    + [flow_tables.GROUPS[group].symbol(kind) for kind in _FLOWS for group in _GROUPS]
)
"""Names of the module's functions."""


def layout_of_engine() -> dict[str, Any]:
    """Return signatures, positions and sizes, by the names that the page knows them by."""
    return {
        "entries": {name: one.signature for name, one in _ENTRIES.items()},
        "flows": [one.__name__ for one in _FLOWS],
        "groups": _GROUPS,
        "functions": len(flow.SIGNATURES),
        "plan": PLAN,
        "state": ONE_MASS.width,
        "results": steady_response.RESULTS,
        "parts": ONE_MASS.total,
        "record": {
            "sample": record_layout.SAMPLE,
            "event": record_layout.EVENT,
            **_positions(
                record_layout,
                "DISPLACEMENT VELOCITY ACCELERATION DEFORMATION TOUCHED "
                "E_CYCLE E_TIME E_KIND E_STOP E_V",
            ),
            **_positions(record, "DETACHMENT"),
        },
        "rig": {
            "size": par.SIZE,
            "infinite": [par.INTERVAL, par.YIELD],
            **_positions(
                par,
                "STIFFNESS DAMPING BUMPER WIDTH KIND BUMPER_STIFFNESS BUMPER_DAMPING GAP RATE "
                "RESTITUTION LOAD BASE SCALE POWER HARMONICS DRAG KELVIN_VOIGT RIGID",
            ),
        },
        "hold": _positions(
            steady_response,
            "PERIOD CYCLES OUTCOME U_LEAST U_MOST A_LEAST A_MOST HITS FORCE IMPULSE T_LEAST T_MOST",
        ),
        "motion": {
            **_positions(state, "MODE FRESH FLIGHT"),
            "U": ONE_MASS.displacement(),
            "V": ONE_MASS.velocity(),
            "DEFORMATION": ONE_MASS.deformation(0),
        },
        "advice": {int(one): one.advice for one in Status},
    }


def _positions(module: Any, names: str) -> dict[str, float]:
    return {name: getattr(module, name) for name in names.split()}
