"""The walk to the first crossing, through flight and contact, on motions known in closed form."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from vibroimpact.engine import native
from vibroimpact.engine.linear.contact import contact
from vibroimpact.engine.linear.flight import flight, parted
from vibroimpact.engine.linear.layout import PLAN, Row
from vibroimpact.engine.linear.table_search import ABOVE, BELOW, WITHIN, Bounds
from vibroimpact.engine.linear.tables import build
from vibroimpact.engine.motion import RIGHT
from vibroimpact.engine.parameters import SIZE, rig_vector
from vibroimpact.engine.state import FLIGHT

INF = math.inf


def plan(stop: tuple[float, ...] | None = None) -> np.ndarray:
    """Unit mass and stiffness, no damping, no forcing: x = v0 sin t from x = 0."""
    made = np.zeros(PLAN)
    made[:SIZE] = rig_vector(1.0, 1.0, 0.0, stop, None)
    build(made, 0.0, 1.0)
    return made


def fly(v: float, bounds: Bounds, limit: float, launched: int = WITHIN) -> tuple:
    return flight(plan(), FLIGHT, Row(0.0, v, 0.0, 1.0), bounds, launched, False, limit, 0.0)


def levels(upper: float, lower: float, memory: float = 0.0, rate: float = INF) -> Bounds:
    return Bounds(upper, lower, memory, memory, rate, rate)


@pytest.mark.parametrize("gap", [1e-6, 0.5, 0.99, 1.0 - 1e-9])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_first_contact_of_a_free_vibration(gap: float, sign: float) -> None:
    way, t, (x, v, _, _), _, _ = fly(sign, levels(gap, -gap), 100.0)
    assert way == (ABOVE if sign > 0 else BELOW)
    assert t == pytest.approx(math.asin(gap), rel=1e-7 if gap > 0.999 else 1e-14)
    assert x == sign * gap
    assert v == pytest.approx(sign * math.sqrt((1.0 - gap) * (1.0 + gap)), abs=1e-10)


def test_the_other_side_many_windows_later() -> None:
    """At 3π/2, in spite of a level above that is never reached."""
    way, t, (x, _, _, _), _, _ = fly(1.0, levels(1.001, -0.5), 100.0)
    assert (way, x) == (BELOW, -0.5)
    assert t == pytest.approx(math.pi + math.asin(0.5), rel=1e-14)


@pytest.mark.parametrize("gap", [1.0 + 1e-9, 2.0, INF])
def test_no_contact_before_the_limit(gap: float) -> None:
    way, t, (x, v, s, c), _, _ = fly(1.0, levels(gap, -gap), 50.0)
    assert (way, t) == (WITHIN, 50.0)
    assert (x, v) == pytest.approx((math.sin(50.0), math.cos(50.0)), abs=1e-13)
    assert (s, c) == pytest.approx((math.sin(50.0), math.cos(50.0)), abs=1e-13)


def test_a_relaxing_bumper_is_met_where_it_is_by_then() -> None:
    """The clearance is 0.2 + 0.5 exp(−t) − sin t, which falls: any zero is the first."""
    way, t, (x, _, _, _), memory, _ = fly(1.0, levels(0.2, -9.0, 0.5, 1.0), 100.0)
    assert way == ABOVE
    assert 0.2 + 0.5 * math.exp(-t) - math.sin(t) == pytest.approx(0.0, abs=1e-15)
    assert 0.0 < t < 0.5 * math.pi
    assert x == pytest.approx(math.sin(t), abs=1e-15)
    assert memory == pytest.approx(0.5 * math.exp(-t), rel=1e-14)


def test_the_mass_may_leave_the_stop_that_it_has_just_left() -> None:
    """Launched from x = 0 it comes back after half a period, not at once."""
    way, t, (x, _, _, _), _, _ = fly(-1.0, levels(0.0, -INF), 100.0, launched=ABOVE)
    assert (way, x) == (ABOVE, 0.0)
    assert t == pytest.approx(math.pi, rel=1e-14)


def test_a_contact_without_a_dashpot_lasts_half_a_period() -> None:
    """x″ = −(1 + 24) x from the landing: the force is zero again after π/5."""
    made = plan((24.0, 0.0, 0.0))
    left, t, (x, v, _, _) = contact(made, RIGHT, 0, Row(0.0, 2.0, 0.0, 1.0), True, 9.0, 0.0)
    assert left
    assert t == pytest.approx(math.pi / 5.0, rel=1e-14)
    assert (x, v) == (0.0, pytest.approx(-2.0, rel=1e-14))
    left, t, (x, _, _, _) = contact(made, RIGHT, 0, Row(0.0, 2.0, 0.0, 1.0), True, 0.1, 0.0)
    assert (left, t) == (False, 0.1)
    assert x == pytest.approx(0.4 * math.sin(0.5), rel=1e-14)


def test_a_contact_with_a_dashpot_ends_with_its_force() -> None:
    """F = 24 x + 2 x′ of the closed form is zero, with the bumper still deformed."""
    made = plan((24.0, 2.0, 0.0))
    left, t, (x, v, _, _) = contact(made, RIGHT, 0, Row(0.0, 2.0, 0.0, 1.0), True, 9.0, 0.0)
    w = math.sqrt(25.0 - 1.0)
    assert left
    assert x == pytest.approx(2.0 / w * math.exp(-t) * math.sin(w * t), rel=1e-13)
    assert x > 0.0
    assert 24.0 * x + 2.0 * v == pytest.approx(0.0, abs=1e-13)
    assert t < math.pi / w


def printed(script: str) -> list[str]:
    """The lines of a script beside this file, run without the compiler."""
    path = Path(__file__).parent / script
    if native.find_library():  # and so without it here
        with contextlib.redirect_stdout(io.StringIO()) as out:
            runpy.run_path(str(path), run_name="__main__")
        return out.getvalue().splitlines()
    done = subprocess.run(
        [sys.executable, path],
        env={**os.environ, "VIBROIMPACT_KERNELS": "1", "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.splitlines()


def test_a_contact_shortly_before_a_record_s_line_ends() -> None:
    """The node behind it is farther than the line, where the base would go on as steeply."""
    assert printed("line_ends.py") == ["75 75"]


def test_a_motion_is_bent_no_more_than_is_said_of_it() -> None:
    """By one sine, four and the line of a record; and little less, where |x″| itself is 1."""
    results = [json.loads(line) for line in printed("bent.py")]
    assert len(results) == 9
    for beyond, distance in results:
        assert beyond <= 1e-12
        assert distance < 3.0


@pytest.mark.parametrize("rate", [0.05, 1.0, 40.0])
@pytest.mark.parametrize("bend", [1e-3, 0.3, 2.0])
def test_a_stop_just_left_is_not_met_before_it_is_said(rate: float, bend: float) -> None:
    """It parts as fast as the stop relaxes, if that has a memory, and is bent towards it."""
    for memory, speed in ((0.0, 0.0), (0.0, 0.2), *((m, rate * m) for m in (0.01, 1.0, 1e4))):
        t = parted(memory, rate, speed, bend) * np.linspace(0.0, 1.0, 2001)
        clearance = speed * t - 0.5 * bend * t * t + memory * np.expm1(-rate * t)
        assert (clearance >= -1e-12 * (1.0 + speed * t)).all()
