"""A machine under an unbalance on the page: its pictures and its knob."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.explorer.change import chosen, moved
from vibroimpact.explorer.controls import controls
from vibroimpact.explorer.pictures.branch import branches
from vibroimpact.explorer.pictures.curves import curves, swept
from vibroimpact.explorer.pictures.motion import quick
from vibroimpact.explorer.share import address, from_address, study
from vibroimpact.explorer.state import begin

OMEGA = 2.0 * math.pi * 4.0
STOP = vi.Bumper("3 MN/m", "10 kN s/m", "3 mm")
MACHINE = vi.Oscillator("800 kg", vi.Isolator(800.0 * OMEGA**2, 0.12 * 800.0 * OMEGA), STOP, STOP)


@pytest.fixture(scope="module")
def state():
    return chosen(begin(vi.Rig(MACHINE, "0.4 kg m"), "machine", (3.0, 6.0)), "forward", 4.2)


def test_the_force_of_the_motion_is_that_of_isolator_and_stops(state) -> None:
    picture = quick(state, swept(state, fine=False))
    u, v = (1e-3 * np.array(picture[name]) for name in ("displacement", "velocity"))
    force = MACHINE.isolator.stiffness * u + MACHINE.isolator.damping * v
    touching = {stop: np.array(one) > 0 for stop, one in picture["touching"].items()}
    for stop, side in (("right", 1), ("left", -1)):
        pressed = STOP.stiffness * (u - side * STOP.gap) + STOP.damping * v
        force += np.where(touching[stop], pressed, 0.0)
    assert any(one.any() for one in touching.values())
    assert picture["axes"]["force"] == "force (kN)"
    drawn = 1e3 * np.array(picture["force"])
    np.testing.assert_allclose(drawn, force, atol=2e-3 * np.abs(force).max())


@pytest.mark.parametrize("physical", [False, True])
def test_the_branch_lies_on_the_curves_of_each_panel(state, physical: bool) -> None:
    shown = state._replace(physical=physical)
    data = swept(shown, fine=False)
    panels = curves(shown, data, fine=False)["panels"]
    assert panels[2]["name"] == ("transmitted force" if physical else "transmissibility")
    along = branches(shown, data, lambda *_: None)["panels"]
    assert len(along) == 3
    frequency = data["frequency"].values
    for panel, pieces in zip(panels, along, strict=False):
        first = pieces[0]  # from the lowest frequency on
        expected = np.interp(first["frequency"][:3], frequency, panel["curves"]["forward"])
        np.testing.assert_allclose(first["value"][:3], expected, rtol=2e-2)


def test_its_knob_and_its_texts_have_the_unit_of_the_unbalance(state) -> None:
    knob = next(one for one in controls(state, state) if one.path == "amplitude")
    assert knob.text == "0.4 kg m"
    assert moved(state, "amplitude", "0.5 kg m").shaking.amplitude == 0.5
    assert "amplitude = 0.4\n" in study(state)
    assert 'of = "unbalance"' in study(state)
    assert from_address(address(state)).shaking == state.shaking
