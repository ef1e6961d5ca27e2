"""What the paper reads off its steady motions (Sections 4 to 6, Figs. 8, 16 and 18).

The numbers beside its statements come from an independent integration of the same model.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from reference.zero_one import zero_one
from vibroimpact.response import resonance
from vibroimpact.stability.coexisting import find_motions


@cache
def motions(code: str, frequency: float):
    case = vi.laboratory.case(code)
    return find_motions(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, frequency)))


def reached(several, direction: str):
    (motion,) = (m for m in several if f"{direction} branch" in m.attrs["starts"])
    return motion


class TestSecondaryResonance:
    """B2-G1-A3: secondary resonance, the valley after it, just before the downward jump."""

    def test_one_contact_a_side_longer_and_longer(self):
        shares = []
        for frequency in (0.58, 0.80, 2.60):
            motion = reached(motions("B2-G1-A3", frequency), "forward")
            assert motion["motion"].item() == "periodic"
            assert (
                float(motion["impacts"].sel(stop="right")),
                float(motion["impacts"].sel(stop="left")),
            ) == (1.0, 1.0)
            share = motion["contact_duration_share"].values
            assert share[0] == pytest.approx(share[1], rel=1e-9)
            shares.append(share[0])
        assert shares == sorted(shares)
        assert shares[2] > 3.0 * shares[0]

    def test_two_motions_coexist_before_the_jump(self):
        pair = motions("B2-G1-A3", 2.60)
        forward, backward = (reached(pair, way) for way in ("forward", "backward"))
        assert float(forward["impacts"].sel(stop="right")) == 1.0
        assert (
            float(backward["impacts"].sel(stop="right"))
            == float(backward["impacts"].sel(stop="left"))
            == 0.0
        )
        assert float(forward["displacement_excursion"]) > 5 * float(
            backward["displacement_excursion"]
        )


class TestNonRegular:
    """B3-10mm-A3: Fig. 16 and the text about it."""

    def test_impacts_a_side_near_0_70_hz(self):
        pair = motions("B3-10mm-A3", 0.70)
        for way, count in (("forward", 2.0), ("backward", 1.0)):
            motion = reached(pair, way)
            assert motion["motion"].item() == "periodic"
            assert bool(motion["antisymmetric"])
            assert (
                float(motion["impacts"].sel(stop="right"))
                == float(motion["impacts"].sel(stop="left"))
                == count
            )

    @pytest.mark.parametrize("frequency", [1.02, 1.06, 1.10])
    def test_a_mirrored_pair_that_does_not_settle(self, frequency):
        (motion,) = motions("B3-10mm-A3", frequency)
        assert bool(motion["mirror_pair"])
        assert int(motion["period"]) == 0
        assert abs(float(motion["eccentricity"])) == pytest.approx(0.55e-3, abs=0.05e-3)

    def test_it_wanders(self):
        """At 1.06 Hz within about 0.47 to 0.63 mm, cycle by cycle."""
        (motion,) = motions("B3-10mm-A3", 1.06)
        cycles = motion["displacement"].values[:-1].reshape(-1, 256)
        wander = np.abs(0.5 * (cycles.max(axis=1) + cycles.min(axis=1)))
        assert wander.min() == pytest.approx(0.47e-3, abs=0.02e-3)
        assert wander.max() == pytest.approx(0.63e-3, abs=0.02e-3)

    @pytest.mark.parametrize("frequency", [1.02, 1.06, 1.10])
    def test_it_is_chaotic_not_quasi_periodic(self, frequency):
        """By two ways: a positive exponent, and the 0–1 test on the section.

        The paper calls it quasi-periodic, from its looks. With bumpers that forget within a
        fraction of a cycle the map from section to section is planar and contracts area, so
        that it can have no attracting closed curve (docs/theory.md, section 6).
        """
        (motion,) = motions("B3-10mm-A3", frequency)
        assert motion["motion"].item() == "chaotic"
        assert float(motion["exponents"][0]) > 20 * float(motion["exponents_uncertainty"][0])
        assert float(motion["exponents"].sum()) < -2.0
        section = vi.stroboscopic_section(motion, 0.0, 4000)
        assert zero_one(section["section_displacement"].values) > 0.9

    @pytest.mark.parametrize(("frequency", "eccentricity"), [(1.12, 0.572e-3), (1.20, 0.246e-3)])
    def test_a_mirrored_pair_of_periodic_motions(self, frequency, eccentricity):
        (motion,) = motions("B3-10mm-A3", frequency)
        assert (motion["motion"].item(), int(motion["period"])) == ("periodic", 1)
        assert bool(motion["mirror_pair"])
        assert abs(float(motion["eccentricity"])) == pytest.approx(eccentricity, abs=0.0005e-3)

    @pytest.mark.parametrize("frequency", [1.26, 1.40])
    def test_one_antisymmetric_motion_above(self, frequency):
        (motion,) = motions("B3-10mm-A3", frequency)
        assert (motion["motion"].item(), int(motion["period"])) == ("periodic", 1)
        assert bool(motion["antisymmetric"])


class TestNoGap:
    """B3-0mm-A3: Fig. 18."""

    def test_no_jump(self):
        case = vi.laboratory.case("B3-0mm-A3")
        data = vi.sweep(vi.Rig(case.oscillator, case.amplitude), np.arange(50, 1001) / 100)
        assert not resonance.features(data).jumps
        assert (data["motion"] == "periodic").all()

    def test_a_very_short_flight_in_each_half_cycle(self):
        case = vi.laboratory.case("B3-0mm-A3")
        motion = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 5.7)), samples=4096)
        assert (
            float(motion["impacts"].sel(stop="right")),
            float(motion["impacts"].sel(stop="left")),
        ) == (1.0, 1.0)
        flights = 0.5 - motion["contact_duration_share"].values
        assert ((flights > 0.001) & (flights < 0.02)).all()
        # In flight, and only there, both clearances are open.
        both = (motion["clearance"].sel(stop="right") > 0) & (
            motion["clearance"].sel(stop="left") > 0
        )
        assert float(both[:-1].mean()) == pytest.approx(float(flights.sum()), abs=2 / 4096)
