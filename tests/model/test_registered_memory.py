"""A deformable stop with a memory touches three files; the rest of an assembly follows.

The law: a hardening spring beside a dashpot, k d + h d³ + c v, whose face keeps its deformation z
after a contact and returns by c z' = −(k z + h z³).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from changed_package import answers_of

LAW = """
LAWS: dict[str, MemoryLaw] = {
    "hardening": MemoryLaw(
        force=lambda of, d, v, z: d * of[0] + d**3 * of[1] + v * of[2],
        rate=None,
        free_rate=lambda of, z: (z * of[0] + z**3 * of[1]) * (-1.0 / of[2]),
    ),
    """

CLASS = '''
"""A stop with a hardening spring and a dashpot."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.law_numbers import MemoryStop
from vibroimpact.model.quantities import DAMPING, LENGTH, STIFFNESS, quantity
from vibroimpact.model.stops.law import StopWithMemory
from vibroimpact.model.validation import Accepts, takes_fields


class HardeningStop(StopWithMemory):
    """A stop with a hardening spring and a dashpot."""

    kind: ClassVar[str] = "hardening"

    stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    hardening: Annotated[float, Accepts(quantity("N/m^3"), minimum=0.0)]
    damping: Annotated[float, Accepts(DAMPING, above=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @takes_fields
    def __init__(
        self, stiffness: float, hardening: float, damping: float, gap: float
    ) -> None: ...

    def engine_numbers(self) -> MemoryStop:
        """Return the numbers by which the engine follows the law."""
        return MemoryStop("hardening", (self.stiffness, self.hardening, self.damping), self.gap)

    def static_force(self, deformation: float) -> float:
        """Return the force (N) at a slow deformation (m)."""
        return self.stiffness * deformation + self.hardening * deformation**3
'''

EDITS = {
    "engine/stops/memory_laws.py": [("\nLAWS: dict[str, MemoryLaw] = {", LAW)],
    "model/stops/hardening.py": [("", CLASS)],
    "model/stops/__init__.py": [
        (
            "from vibroimpact.model.stops.jankowski import",
            "from vibroimpact.model.stops.hardening import HardeningStop\n"
            "from vibroimpact.model.stops.jankowski import",
        ),
        ("STOPS = Kinds(", "STOPS = Kinds(HardeningStop, "),
    ],
}
"""All that the law takes: by file, what is replaced, and by what."""

NUMBERS = {"face": (1500.0, 8e6, 40.0, 0.01), "between": (900.0, 3e7, 15.0, 0.004)}
CYCLES, DRIVE, FREQUENCY = 5, 6.0, 1.7

SCRIPT = f"""
import json, math
import numpy as np
import vibroimpact as vi
from cycle_derivative import both_derivatives
from vibroimpact.model.parameters import parameter
from vibroimpact.model.stops.hardening import HardeningStop
from vibroimpact.response.assembly_state import as_assembly_state, assembly_vector

numbers = {NUMBERS}
system = vi.Assembly(
    {{"a": 1.0, "b": 0.6}},
    {{
        "a": vi.Link("ground", "a", vi.PolynomialIsolator(150.0, 1.0, 5e3)),
        "ab": vi.Link("a", "b", vi.Isolator(200.0, 0.5)),
    }},
    {{
        "face": vi.Link("a", "ground", HardeningStop(*numbers["face"])),
        "between": vi.Link("a", "b", HardeningStop(*numbers["between"])),
    }},
)
rig = vi.Rig(system, vi.Harmonic({DRIVE}, {FREQUENCY}))
motion = vi.simulate(rig, {CYCLES}, samples=50)
whole = vi.totals(motion)
half = vi.simulate(rig, 2.3, samples=0)
resumed = vi.simulate(rig, {CYCLES} - 2.3, half, samples=0)
state = as_assembly_state(motion["final_state"], system)
start = assembly_vector(system, state)
exact, rows, _ = both_derivatives(rig, start, len(start) - 5, 6, 1e-7)
made = {{
    "state": motion["final_state"].values[:6].tolist(),
    "resumed": resumed["final_state"].values[:6].tolist(),
    "times": motion["event_time"].values.tolist(),
    "force": float(motion["contact_force"].min()),
    "lost": [float(whole["total_stops"].sel(stop=name)) for name in ("face", "between")],
    "apart": float(np.abs(exact - rows).max() / np.abs(exact).max()),
    "units": parameter("stops.face.hardening", rig).units,
}}
print(json.dumps(made))
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    pytest.importorskip("numba")
    return answers_of(tmp_path_factory.mktemp("package"), EDITS, SCRIPT)


@pytest.fixture(scope="module")
def followed() -> tuple[Any, list[float]]:
    """The last state with the work on the stops, and the times of all events, by DOP853."""
    omega = 2.0 * np.pi * FREQUENCY
    stops = [NUMBERS[name] for name in ("face", "between")]
    touched = [False, False]

    def depths(y: Any) -> list[tuple[float, float]]:
        return [(y[0] - stops[0][3], y[2]), (y[0] - y[1] - stops[1][3], y[2] - y[3])]

    def force(j: int, y: Any) -> float:
        k, h, c, _ = stops[j]
        d, v = depths(y)[j]
        return k * d + h * d**3 + c * v

    def rates(t: float, y: Any) -> Any:
        u, v, w = y[:2], y[2:4], y[4:6]
        push = [force(j, y) if touched[j] else 0.0 for j in range(2)]
        on_base = 150.0 * u[0] + 5e3 * u[0] ** 3 + v[0]
        between = 200.0 * (u[1] - u[0]) + 0.5 * (v[1] - v[0])
        shaken = -DRIVE * np.sin(omega * t)
        a = shaken - on_base + between - push[0] - push[1]
        b = shaken + (push[1] - between) / 0.6
        free = [-(k * z + h * z**3) / c for z, (k, h, c, _) in zip(w, stops, strict=True)]
        faces = [depths(y)[j][1] if touched[j] else free[j] for j in range(2)]
        return [*v, a, b, *faces, push[0] * v[0], push[1] * (v[0] - v[1])]

    def watched(j: int) -> Any:
        def event(t: float, y: Any) -> float:
            return force(j, y) if touched[j] else 1e3 * (y[4 + j] - depths(y)[j][0])

        event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
        return event

    t, y, times, end = 0.0, np.zeros(8), [], CYCLES / FREQUENCY
    while t < end:
        done = solve_ivp(
            rates, (t, end), y, "DOP853", rtol=1e-12, atol=1e-15, max_step=2e-3,
            events=[watched(0), watched(1)],
        )  # fmt: skip
        t, y = done.t[-1], done.y[:, -1]
        if done.status == 1:
            j = 0 if len(done.t_events[0]) else 1
            if touched[j]:
                y[4 + j] = depths(y)[j][0]
            touched[j] = not touched[j]
            times.append(t)
    return y, times


def test_three_files() -> None:
    assert len(EDITS) == 3


def test_motion_follows_the_law(made: dict[str, Any], followed: tuple[Any, list[float]]) -> None:
    state, times = followed
    assert len(times) > 20
    np.testing.assert_allclose(made["times"], times, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(made["state"], state[:6], rtol=0.0, atol=1e-10)
    assert made["force"] >= 0.0


def test_a_motion_goes_on_from_its_state(made: dict[str, Any]) -> None:
    np.testing.assert_allclose(made["resumed"], made["state"], rtol=0.0, atol=1e-12)


def test_stops_lose_the_work_on_them(
    made: dict[str, Any], followed: tuple[Any, list[float]]
) -> None:
    faces = followed[0][4:6]
    k, hardening = (np.array([one[i] for one in NUMBERS.values()]) for i in (0, 1))
    stored = k * faces**2 / 2.0 + hardening * faces**4 / 4.0
    np.testing.assert_allclose(made["lost"], followed[0][6:] - stored, rtol=1e-10)


def test_derivative_of_a_cycle(made: dict[str, Any]) -> None:
    assert made["apart"] < 1e-6


def test_its_numbers_are_parameters_with_units(made: dict[str, Any]) -> None:
    assert made["units"] == "N m-3"
