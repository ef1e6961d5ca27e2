"""Scenarios whatever is held: an acceleration or a displacement of the base, or a force."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.resonance import Hysteresis
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.borders import jump_border
from vibroimpact.scenarios.classification import scenario
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.scenarios.sweep_frequencies import frequencies, highest

CASE = vi.laboratory.case("B2-G1-A3")
MASS, OMEGA = CASE.oscillator.mass, CASE.oscillator.angular_frequency
FORCE = vi.Harmonic(MASS * CASE.amplitude, 1.0, of="force")
SWING = vi.Harmonic(CASE.amplitude / OMEGA**2, 1.0, of="displacement")
UNBALANCE = vi.Harmonic(MASS * CASE.amplitude / OMEGA**2, 1.0, of="unbalance")
"""Of the same largest free flight."""


def test_a_force_on_the_mass_is_an_acceleration_of_the_base() -> None:
    """Relative to the base, the motion is the same; only the absolute acceleration is not."""
    held = np.arange(0.5, 3.5, 0.02)
    base, force = (classify(vi.Rig(CASE.oscillator, one), held) for one in (CASE.amplitude, FORCE))
    for name in ("contact", "gap_ratio", "penetration", "swept", "within"):
        pair = getattr(base.features, name), getattr(force.features, name)
        assert pair[1] == pytest.approx(pair[0], rel=1e-9)
    np.testing.assert_allclose(force.features.folds, base.features.folds, rtol=1e-8)
    assert highest(one_sine(vi.Rig(CASE.oscillator, FORCE))) == highest(
        one_sine(vi.Rig(CASE.oscillator, CASE.amplitude))
    )


def test_an_unbalance_is_a_displacement_of_the_base() -> None:
    """Relative to the base, the motion is the same; only the absolute acceleration is not."""
    held = np.arange(0.5, 3.5, 0.02)
    base, machine = (classify(vi.Rig(CASE.oscillator, one), held) for one in (SWING, UNBALANCE))
    for name in ("contact", "gap_ratio", "penetration", "swept", "within"):
        pair = getattr(base.features, name), getattr(machine.features, name)
        assert pair[1] == pytest.approx(pair[0], rel=1e-9)
    np.testing.assert_allclose(machine.features.folds, base.features.folds, rtol=1e-8)
    assert highest(one_sine(vi.Rig(CASE.oscillator, UNBALANCE))) == highest(
        one_sine(vi.Rig(CASE.oscillator, SWING))
    )


def _of_unit_frequency(ratio: float, stiffness_ratio: float = 25.9) -> vi.Oscillator:
    """A rig of 1 Hz whose gaps are so many times the free flight over a base that moves by 2 mm."""
    rig = vi.from_dimensionless(
        stiffness_ratio, 1.0, 0.01, 0.15, stiffness=(2.0 * np.pi) ** 2
    ).oscillator
    bumper = rig.right.replace(gap=ratio * 2e-3 / (2.0 * 0.15 * np.sqrt(1.0 - 0.15**2)))
    return rig.replace(right=bumper, left=bumper)


@pytest.mark.parametrize("ratio", [1.2, 0.97, 0.7])
def test_growth_of_the_acceleration_hides_no_scenario_in_silence(ratio: float) -> None:
    """The same motion u as over a base that moves by m e/M, but ü grows as ω² without contact.

    Where the mass hits nothing, that is S0. Otherwise the top of η_a is no resonance.
    """
    rig = _of_unit_frequency(ratio)
    verdict = classify(vi.Rig(rig, vi.Harmonic(2e-3 * rig.mass, 1.0, of="unbalance")))
    moved = classify(vi.Rig(rig, "2 mm"))
    assert moved.scenario == ("S0" if ratio > 1.0 else "S2")
    assert "hides" not in moved.evidence
    assert verdict.features.contact == moved.features.contact
    if ratio > 1.0:
        assert verdict.scenario == "S0"
        return
    assert verdict.scenario == "unclassified"
    assert verdict.confidence == 1.0
    assert "undecided: η_a grows with the frequency without contact" in verdict.evidence
    assert "m e/M" in verdict.evidence
    assert "outside the frequency range" not in verdict.evidence
    assert "\n" not in verdict.evidence


def test_a_left_hysteresis_below_the_hidden_resonance_is_not_s4() -> None:
    """Ranges below the end of the sweep are below the primary resonance only if that is there."""
    rig = _of_unit_frequency(0.7)
    verdict = classify(vi.Rig(rig, vi.Harmonic(2e-3 * rig.mass, 1.0, of="unbalance")))
    assert verdict.features.hidden_by == "unbalance"
    wide = Hysteresis("left", 2.0, 3.0, 1.9, 3.1, True)
    features = verdict.features._replace(left=(wide,))
    assert features.extent(0.02) >= 0.08
    assert scenario(features, vi.Thresholds()) is Scenario.UNCLASSIFIED
    assert scenario(features._replace(hidden_by=None), vi.Thresholds()) is Scenario.S4


def test_a_resonance_that_stands_out_keeps_its_scenario_under_an_unbalance() -> None:
    rig = _of_unit_frequency(0.4, 2.0)
    verdict = classify(vi.Rig(rig, vi.Harmonic(2e-3 * rig.mass, 1.0, of="unbalance")))
    assert verdict.scenario == classify(vi.Rig(rig, "2 mm")).scenario == "S6"


def test_far_above_the_resonance_the_growth_over_a_moving_base_hides_it_too() -> None:
    """There ü + A_t → 2ξ ω₀ ω X, which passes the resonance at some ten times its frequency."""
    rig = _of_unit_frequency(0.97, 2.0)
    verdict = classify(vi.Rig(rig, "2 mm"), np.arange(0.4, 15.0, 0.02))
    assert verdict.scenario == "unclassified"
    assert "undecided: η_a grows with the frequency without contact" in verdict.evidence
    assert "end the frequencies lower" in verdict.evidence


@pytest.mark.parametrize(("ratio", "named"), [(1.2, "S0"), (0.97, "S2"), (0.7, "S2")])
def test_gaps_are_scaled_by_free_flight_under_what_is_held(ratio: float, named: str) -> None:
    """u_max = X/(2ξ√(1 − ξ²)) of a base that moves by X, at 1/√(1 − 2ξ²) times f0.

    What only grazes at one acceleration is carried on by one displacement, which shakes the more
    the higher the frequency.
    """
    verdict = classify(vi.Rig(_of_unit_frequency(ratio), "2 mm"))
    assert verdict.features.gap_ratio == pytest.approx(ratio, rel=1e-12)
    assert verdict.features.within
    assert verdict.scenario == named


def test_a_base_that_moves_far_resonates_above_the_natural_frequency() -> None:
    """Where damping is heavy, the sweep goes on to that resonance."""
    heavy = vi.Oscillator(1.0, vi.Isolator(1.0, 1.2))
    at = 1.0 / np.sqrt(1.0 - 2.0 * 0.6**2)
    held = frequencies(one_sine(vi.Rig(heavy, "1 mm")))
    assert held[-1] / heavy.natural_frequency > 1.4 * at
    assert highest(one_sine(vi.Rig(heavy, "1 N"))) == 1.5


def test_a_constant_force_is_a_pair_of_other_gaps() -> None:
    """What presses the mass towards one stop by F/K, whatever shakes it."""
    rig = CASE.oscillator
    shift = 2e-3
    gaps = {
        "right": rig.right.replace(gap=rig.right.gap - shift),
        "left": rig.left.replace(gap=rig.left.gap + shift),
    }
    held = np.arange(0.5, 3.5, 0.05)
    pushed = rig.replace(force=shift * rig.isolator.stiffness)
    one, other = (
        classify(vi.Rig(pushed, SWING), held),
        classify(vi.Rig(rig.replace(**gaps), SWING), held),
    )
    assert one.scenario == other.scenario
    for name in ("contact", "gap_ratio", "penetration", "onset"):
        pair = getattr(one.features, name), getattr(other.features, name)
        assert pair[1] == pytest.approx(pair[0], rel=1e-6)


@pytest.mark.parametrize("shaken", [FORCE, SWING])
def test_a_map_is_made_of_such_rigs(shaken: vi.Harmonic) -> None:
    sizes = [0.5 * shaken.amplitude, 2.0 * shaken.amplitude]
    data = vi.scenario_map(
        vi.Rig(CASE.oscillator, shaken),
        {"amplitude": sizes, "stiffness_ratio": [1.0, 20.0]},
        step=0.02,
    )
    units, name = {
        "force": ("N", "peak force on the mass"),
        "displacement": ("m", "peak base displacement"),
    }[shaken.of]
    assert data["amplitude"].attrs["units"] == units
    assert data["amplitude"].attrs["long_name"] == name
    ratio = CASE.oscillator.right.damping / CASE.oscillator.right.stiffness
    stiffness = 20.0 * CASE.oscillator.isolator.stiffness
    bumper = CASE.oscillator.right.replace(stiffness=stiffness, damping=ratio * stiffness)
    rig = CASE.oscillator.replace(right=bumper, left=bumper)
    for k, size in enumerate(sizes):
        one = shaken.replace(amplitude=size)
        alone = classify(vi.Rig(rig, one), frequencies(one_sine(vi.Rig(rig, one)), 0.02))
        assert Scenario(int(data["scenario"][1, k])).label == alone.scenario
        wanted = max(p.value for p in alone.features.peaks if p.curve == "eta_d")
        known = data[["peak_eta_d_forward", "peak_eta_d_backward"]].isel(
            stiffness_ratio=1, amplitude=k
        )
        assert max(float(one) for one in known.values()) == pytest.approx(wanted, rel=1e-6)


def test_the_unit_of_an_unbalance_is_that_of_its_axis() -> None:
    data = vi.scenario_map(
        vi.Rig(CASE.oscillator, UNBALANCE),
        {"amplitude": ["1 kg m", "2 kg m"], "stiffness_ratio": [1.0, 20.0]},
        step=0.1,
    )
    assert data["amplitude"].attrs["units"] == "kg m"
    assert data["amplitude"].attrs["long_name"] == "rotating unbalance of the mass"
    np.testing.assert_array_equal(data["amplitude"], [1.0, 2.0])


def test_the_border_of_jumps_is_the_same_under_a_force() -> None:
    """There the orbits are the same: λ = 1.6276962 at this gap, as for the acceleration."""
    delta = vi.to_dimensionless(vi.Rig(CASE.oscillator, CASE.amplitude)).right.gap
    data = vi.scenario_map(
        vi.Rig(CASE.oscillator, FORCE),
        {"stiffness_ratio": np.geomspace(1.4, 2.0, 3), "gap_ratio": [delta, delta + 0.2]},
        step=0.02,
    )
    border = jump_border(data)
    assert float(border["stiffness_ratio"][0]) == pytest.approx(1.6276962, abs=1e-6)


@pytest.mark.parametrize(
    ("oscillator", "amplitude", "message"),
    [
        (
            CASE.oscillator,
            vi.Periodic(1.0, [0.3, 0.1]),
            "shaking: scenarios are not defined for a Periodic",
        ),
        (CASE.oscillator, [0.3, 0.4], "shaking: 2 amplitudes, but a scenario is defined for one"),
        (CASE.oscillator, 0.0, "shaking: missing, and the rig has no shaking"),
        (
            CASE.oscillator.replace(isolator=vi.Isolator(0.0, 1.0)),
            0.3,
            "isolator.stiffness: 0, but a scenario requires a natural frequency",
        ),
    ],
)
def test_what_has_no_scenario_is_refused(oscillator, amplitude, message) -> None:
    with pytest.raises(vi.InputError, match=message):
        classify(vi.Rig(oscillator, amplitude))
    with pytest.raises(vi.InputError, match=message):
        vi.scenario_map(vi.Rig(oscillator, amplitude), {"gap": [1e-3, 2e-3], "amplitude": [1, 2]})
