"""A rigid wall with another law of rebound touches three files; the rest follows.

The law: constant restitution up to an impact speed, and beyond it e = e₀ (w₀/w)^p, which with
p = 1/4 is that of fully plastic impacts (K. L. Johnson, Contact Mechanics, 1985, section 11.5), and
with p = 0.234 that of ice (F. G. Bridges, A. Hatzes, D. N. C. Lin, Nature 309 (1984) 333).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from changed_package import answers_of

LAW = '''
def falling(numbers: Vector, at: int, speed: float) -> Rebound:
    """A constant e up to a speed, beyond which it falls by a power."""
    e, limit, power = numbers[at], numbers[at + 1], numbers[at + 2]
    if speed <= limit:
        return Rebound(e, 1.0, e)
    return Rebound(e * (limit / speed) ** power, 1.0 - power, 1.0)


LAWS: dict[str, Callable[[Any, int, float], Rebound]] = {"falling": falling, '''

CLASS = '''
"""A rigid wall whose restitution falls with the impact speed."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.law_numbers import Wall
from vibroimpact.model.quantities import DIMENSIONLESS, LENGTH, VELOCITY
from vibroimpact.model.stops.law import WallLaw
from vibroimpact.model.validation import Accepts, takes_fields


class FallingStop(WallLaw):
    """A rigid wall whose restitution falls with the impact speed."""

    kind: ClassVar[str] = "falling"

    restitution: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0)]
    speed: Annotated[float, Accepts(VELOCITY, above=0.0)]
    exponent: Annotated[float, Accepts(DIMENSIONLESS, minimum=0.0, maximum=0.9)]
    gap: Annotated[float, Accepts(LENGTH)]

    @takes_fields
    def __init__(
        self, restitution: float, speed: float, exponent: float, gap: float
    ) -> None: ...

    def engine_numbers(self) -> Wall:
        """Return the numbers by which the engine follows the law."""
        return Wall("falling", (self.restitution, self.speed, self.exponent), self.gap)
'''

EDITS = {
    "engine/stops/rebound.py": [
        ("\nLAWS: dict[str, Callable[[Any, int, float], Rebound]] = {", LAW),
    ],
    "model/stops/falling.py": [("", CLASS)],
    "model/stops/__init__.py": [
        (
            "from vibroimpact.model.stops.jankowski import",
            "from vibroimpact.model.stops.falling import FallingStop\n"
            "from vibroimpact.model.stops.jankowski import",
        ),
        ("STOPS = Kinds(", "STOPS = Kinds(FallingStop, "),
    ],
}
"""All that the law takes: by file, what is replaced, and by what."""

SCRIPT = """
import json, math
import numpy as np
import vibroimpact as vi
from cycle_derivative import both_derivatives
from vibroimpact.figures.assembly_histories import impulses
from vibroimpact.model.parameters import parameter
from vibroimpact.model.stops.falling import FallingStop
from vibroimpact.response.assembly_state import as_assembly_state, assembly_vector
from vibroimpact.response.engine_input import as_state, engine_state
from vibroimpact.response.motion_phases import parting_velocity

SHAKEN = vi.Harmonic(1.0, 1.0 / (2.0 * math.pi))
WALL = FallingStop(0.8, 0.3, 0.25, 0.16)
TABLE = {"kind": "falling", "restitution": 0.8, "speed": 0.3, "exponent": 0.25, "gap": 0.16}


def chain(link):
    masses = {"a": 1.0, "b": 0.7}
    links = {"a": vi.Link("ground", "a", vi.Isolator(1.0, 0.2)), "ab": vi.Link("a", "b", link)}
    stops = {
        "ab": vi.Link("a", "b", WALL.replace(gap=0.6)),
        "b": vi.Link("b", "ground", WALL.replace(gap=0.9)),
    }
    return vi.Assembly(masses, links, stops)


def carried(rig, data):
    # The derivative of a state after a cycle by the tangent flow and by differences, and the
    # logarithm of its determinant, which the losses make, too.
    one = not isinstance(rig.system, vi.Assembly)
    start = data["final_state"]
    if one:
        vector, n = engine_state(rig.oscillator, as_state(start)), 1
    else:
        state = as_assembly_state(start, rig.system)
        vector, n = assembly_vector(rig.system, state), len(rig.system.masses)
    parts = 5 if one else len(vector) - 5

    exact, rows, damping = both_derivatives(rig, vector, parts, 2 * n, 1e-6)
    return {
        "apart": float(np.abs(exact - rows).max() / np.abs(exact).max()),
        "volume": [math.log(abs(np.linalg.det(exact))), -damping],
    }


made = {}
right, left = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), TABLE).right, WALL.replace(gap=0.5)
assert right == WALL
for name, isolator in {
    "linear": vi.Isolator(1.0, 0.1), "cubic": vi.PolynomialIsolator(1.0, 0.1, 0.3)
}.items():
    rig = vi.Rig(vi.Oscillator(1.0, isolator, right, left), SHAKEN)
    data = vi.simulate(rig, 2, samples=2)
    log, whole = vi.contacts(data), vi.totals(data)
    made[name] = {
        "speed": log["contact_closing_speed"].values.tolist(),
        "restitution": log["contact_restitution"].values.tolist(),
        "lost": float(whole["total_bumpers"].sum()),
        "parting": np.abs(parting_velocity(data, rig.oscillator)).tolist(),
        **carried(rig, data),
    }
for name, link in {
    "masses": vi.Isolator(0.8, 0.1), "curved masses": vi.PolynomialIsolator(0.8, 0.1, 0.3)
}.items():
    rig = vi.Rig(chain(link), SHAKEN)
    data = vi.simulate(rig, 3, samples=2)
    log, whole = vi.contacts(data), vi.totals(data)
    hits = data["event_stop"].values == "ab"
    made[name] = {
        "speed": log["contact_closing_speed"].values.tolist(),
        "restitution": log["contact_restitution"].values.tolist(),
        "stop": log["contact_stop"].values.tolist(),
        "lost": float(whole["total_stops"].sum()),
        "impulse": impulses(data, rig.system, "ab")[hits].tolist(),
        **carried(rig, data),
    }

# A mass that a constant force presses against a wall: it chatters, and comes to rest.
for e in (0.5, 1.0):
    pressed = vi.Oscillator(1.0, vi.Isolator(1e-9, 0.0), WALL.replace(restitution=e, gap=0.0))
    pressed = pressed.replace(force=1.0)
    still = vi.Harmonic(1e-12, 0.01)
    data = vi.simulate(vi.Rig(pressed, still), 1, vi.State(0.0, 2.0), samples=1)
    begins = np.flatnonzero(data["event_contact"].values == 1)
    made[f"chatter {e}"] = {
        "rests": data["event_time"].values[begins].tolist(),
        "impacts": int((data["event_contact"].values == 2).sum()),
    }
made["units"] = parameter("stops.speed", rig).units
print(json.dumps(made))
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    pytest.importorskip("numba")
    return answers_of(tmp_path_factory.mktemp("package"), EDITS, SCRIPT)


def restitution(speed: Any, e: float = 0.8) -> Any:
    return e * np.minimum(1.0, 0.3 / np.asarray(speed)) ** 0.25


ONE_MASS = ("linear", "cubic")
MASSES = ("masses", "curved masses")
PER_STOP = {"ab": 0.7 / 1.7, "b": 0.7}
"""The masses that meet (kg)."""


def test_three_files() -> None:
    assert len(EDITS) == 3


@pytest.mark.parametrize("name", ONE_MASS + MASSES)
def test_each_impact_follows_the_law(made: dict[str, Any], name: str) -> None:
    of = made[name]
    speed = np.array(of["speed"])
    assert len(speed) > 5
    assert speed.max() > 0.6
    np.testing.assert_allclose(of["restitution"], restitution(speed), rtol=1e-11)
    if name in ONE_MASS:
        np.testing.assert_allclose(of["parting"], restitution(speed) * speed, rtol=1e-12)
    else:
        there = speed[np.array(of["stop"]) == "ab"]
        impulse = PER_STOP["ab"] * (1.0 + restitution(there)) * there
        np.testing.assert_allclose(of["impulse"], impulse, rtol=1e-11)


@pytest.mark.parametrize("name", ONE_MASS + MASSES)
def test_stops_lose_what_the_law_takes(made: dict[str, Any], name: str) -> None:
    of = made[name]
    speed = np.array(of["speed"])
    mass = np.array([PER_STOP[stop] for stop in of["stop"]]) if name in MASSES else 1.0
    lost = (mass * (1.0 - restitution(speed) ** 2) * speed**2 / 2.0).sum()
    assert of["lost"] == pytest.approx(lost, rel=1e-11)


@pytest.mark.parametrize("name", ONE_MASS + MASSES)
def test_disturbances_jump_by_its_slope(made: dict[str, Any], name: str) -> None:
    assert made[name]["apart"] < 1e-7
    determinant, losses = made[name]["volume"]
    assert determinant == pytest.approx(losses, rel=1e-11)


def test_a_chatter_ends_where_the_restitution_does_not_grow_to_1(made: dict[str, Any]) -> None:
    """Flights of 2 w under a force of 1 N, whose speeds the law makes, from an impact at 2 m/s."""
    rest, speed = 0.0, 2.0
    while speed > 1e-20:
        speed *= restitution(speed, 0.5)
        rest += 2.0 * speed
    assert made["chatter 0.5"]["rests"] == [pytest.approx(rest, rel=1e-7)]
    assert made["chatter 0.5"]["impacts"] > 10
    assert made["chatter 1.0"]["rests"] == []
    # Up to 0.3 m/s it is elastic: flights of 0.6 s until 100 s.
    assert made["chatter 1.0"]["impacts"] == pytest.approx(100.0 / 0.6, rel=0.1)


def test_its_numbers_are_parameters_with_units(made: dict[str, Any]) -> None:
    assert made["units"] == "m s-1"
