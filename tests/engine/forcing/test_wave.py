"""One part of a forcing."""

from __future__ import annotations

from vibroimpact.engine.forcing.wave import Wave, without_amplitude


def test_a_wave_that_cannot_move_the_mass_goes_on_turning() -> None:
    assert without_amplitude(Wave(3.0, 2.0, 1.0, 0.6, -0.8)) == Wave(0.0, 2.0, 1.0, 0.6, -0.8)
