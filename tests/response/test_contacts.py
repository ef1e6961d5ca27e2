"""The contact log against integrals over the phases by a second way, and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from reference.linear_phases import phases

LOG = "contact_"


def force(rig, phase):
    bumper = rig.right if phase.contact == 1 else rig.left
    deformation = phase.motion.right if phase.contact == 1 else phase.motion.left
    return phase.contact * (bumper.stiffness * deformation + bumper.damping * phase.motion.v)


@examples(80)
@given(motions())
def test_contacts_against_the_phases_by_matrix_exponentials(motion: Motion) -> None:
    """Impulse, energy, impulse and momentum: Gauss-Legendre on states that the engine knows not."""
    rig, shaken = motion.oscillator, motion.excitation
    data = simulated(motion, 3.0)
    log = vi.contacts(data)
    walk = list(phases(rig, shaken, data))
    inner = [p for p in walk[1:-1] if p.contact]
    # Displacements are exact to rounding of the motion's size, however short and slight a contact.
    size = float(np.abs(data["displacement"]).max())
    rounding = 1e-15 * size
    assert log.sizes["contact_number"] == len(inner)
    for i, phase in enumerate(inner):
        row = {str(name).removeprefix(LOG): log[name].values[i] for name in log}
        bumper = rig.right if phase.contact == 1 else rig.left
        pressing = force(rig, phase)
        impulse = float(phase.weights @ pressing)
        scale = float(phase.weights @ np.abs(pressing)) + 1e-300
        assert row["stop"] == ("right" if phase.contact == 1 else "left")
        assert row["duration"] == pytest.approx(phase.length, rel=1e-9)
        deepest = float(np.abs(phase.motion.u).max()) - bumper.gap
        if deepest < 1e-9 * size:
            continue
        unknown = bumper.stiffness * rounding
        assert abs(row["impulse"] - impulse) < 1e-10 * scale + unknown * phase.length
        lost = bumper.damping * float(phase.weights @ phase.motion.v**2)
        assert row["dissipated"] == pytest.approx(lost, rel=1e-10, abs=1e-300)
        # Momentum: M Δu̇ + C Δu + K ∫u + M ∫A_t = −(contact impulse towards the mass).
        other = (
            rig.mass * (phase.end.v - phase.begin.v)
            + rig.isolator.damping * (phase.end.u - phase.begin.u)
            + rig.isolator.stiffness * float(phase.weights @ phase.motion.u)
            + rig.mass * float(phase.weights @ phase.base)
        )
        turnover = rig.mass * (abs(phase.end.v) + abs(phase.begin.v)) + scale
        assert abs(other + phase.contact * row["impulse"]) < 1e-10 * turnover
        # Peaks are at least what is seen at the nodes, and hardly more.
        assert row["penetration"] >= deepest - 1e-12 * (bumper.gap + abs(deepest)) - rounding
        assert row["peak_force"] >= float(pressing.max()) * (1 - 1e-12) - unknown
        accelerations = -(
            rig.isolator.stiffness * phase.motion.u
            + rig.isolator.damping * phase.motion.v
            + phase.contact * pressing
        )
        sizes = np.abs(accelerations) / rig.mass
        assert row["peak_acceleration"] >= float(sizes.max()) * (1 - 1e-12)
        pieces = len(phase.weights) // 16
        nodes = (
            np.arange(pieces)[:, None] + (np.polynomial.legendre.leggauss(16)[0] + 1) / 2
        ).ravel()
        near = np.abs(row["start"] + phase.length / pieces * nodes - row["peak_time"]).argmin()
        assert sizes[near] >= row["peak_acceleration"] - 0.2 * np.ptp(accelerations / rig.mass)
        assert row["peak_force"] <= 1.05 * max(
            float(pressing.max()), phase.contact * bumper.damping * phase.begin.v
        ) + 1e-9 * scale / max(phase.length, 1e-300)


def test_rebound_of_an_elastic_stop():
    """Against a stiff elastic stop the contact is half a sine: π/ω, F = √(k m) v, e = 1."""
    stiff = 1e10
    rig = vi.Oscillator(2.0, vi.Isolator(1.0, 0.0), vi.Bumper(stiff, 0.0, 0.0), None)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(1e-12, 0.5)), 1.0, vi.State(-1e-6, 3.0))
    (row,) = vi.contacts(data).to_dataframe().itertuples()
    omega = math.sqrt(stiff / 2.0)
    assert row.contact_duration == pytest.approx(math.pi / omega, rel=1e-9)
    assert row.contact_peak_force == pytest.approx(math.sqrt(stiff * 2.0) * 3.0, rel=1e-9)
    assert row.contact_impulse == pytest.approx(2.0 * 2.0 * 3.0, rel=1e-9)
    assert row.contact_penetration == pytest.approx(3.0 / omega, rel=1e-9)
    assert row.contact_restitution == pytest.approx(1.0, rel=1e-12)
    assert row.contact_peak_time == pytest.approx(
        row.contact_start + 0.5 * math.pi / omega, rel=1e-9
    )
    assert row.contact_dissipated == row.contact_dissipated_relaxing == 0.0


def test_rebound_of_a_damped_stop():
    """Release by force: e = exp(−ζ α / √(1 − ζ²)) with tan(α…) from F = 0 (theory.md)."""
    stiff, zeta = 1e10, 0.2
    damping = 2.0 * zeta * math.sqrt(stiff)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), vi.Bumper(stiff, damping, 0.0), None)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(1e-12, 0.5)), 1.0, vi.State(-1e-6, 1.0))
    (row,) = vi.contacts(data).to_dataframe().itertuples()
    # x = e^(−ζτ) sin(wτ)/w, F ∝ x + 2ζ x′ = 0 first at wτ = π − atan2(2ζw, 1 − 2ζ²) + …
    w = math.sqrt(1.0 - zeta**2)
    tau = (math.pi - math.atan2(2.0 * zeta * w, 1.0 - 2.0 * zeta**2)) / w
    assert row.contact_duration == pytest.approx(tau / math.sqrt(stiff), rel=1e-6)
    end = math.exp(-zeta * tau) * (math.cos(w * tau) - zeta / w * math.sin(w * tau))
    assert row.contact_restitution == pytest.approx(-end, rel=1e-6)
    # Peak force: of a Kelvin-Voigt bumper at once C v where 2ζ > …, else within.
    times = np.linspace(0.0, tau, 200_001)
    x = np.exp(-zeta * times) * np.sin(w * times) / w
    v = np.exp(-zeta * times) * (np.cos(w * times) - zeta / w * np.sin(w * times))
    assert row.contact_peak_force == pytest.approx(
        math.sqrt(stiff) * (x + 2 * zeta * v).max(), rel=1e-6
    )
    # What is not given back is lost: in contact, and afterwards in the bumper's relaxation.
    lost = row.contact_dissipated + row.contact_dissipated_relaxing
    assert lost == pytest.approx(0.5 * (1.0 - row.contact_restitution**2), rel=1e-6)
    assert row.contact_dissipated_relaxing > 0.0


def test_the_impulse_of_a_rest_that_friction_shares():
    """Friction holds first: the wall is pressed by what is more than that, ∫ max(F − R, 0) dt."""
    isolator = vi.FrictionIsolator(5.0, 0.3, 0.5)
    rig = vi.Oscillator(
        2.0, isolator, vi.RigidStop(0.4, 0.1), vi.Bumper(40.0, 0.5, 0.02), force=3.0
    )
    shaken = vi.Harmonic(2.0, 0.3)
    log = vi.contacts(vi.simulate(vi.Rig(rig, shaken), 9, vi.State(0.05, 0.3), samples=8))
    rests = (log["contact_stop"] == "right") & (log["contact_duration"] > 1.0)
    assert rests.sum() > 3
    level = 3.0 - 5.0 * 0.1 - 0.5
    for i in np.flatnonzero(rests.values):
        begin = float(log["contact_start_phase"][i])
        end = 2.0 * math.pi + math.asin(level / 4.0)  # behind it friction alone holds the mass
        assert begin > math.pi
        assert float(log["contact_end_phase"][i]) + 2.0 * math.pi > end
        turned = level * (end - begin) + 4.0 * (math.cos(end) - math.cos(begin))
        expected = turned / shaken.angular_frequency
        assert float(log["contact_impulse"][i]) == pytest.approx(expected, rel=1e-12)


def test_contacts_at_the_ends_of_the_record_are_left_out():
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    data = vi.simulate(vi.Rig(case.oscillator, shaken), 4, vi.State(9e-3, 0.0))
    assert bool(data["touching"].sel(stop="right")[0])
    log = vi.contacts(data)
    begins = data["event_time"].values[data["event_contact"].values == 1]
    assert float(log["contact_start"][0]) == begins[0]
    assert (log["contact_end"].values <= data["time"].values[-1]).all()


def test_grazing_is_flagged():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)), 20)
    log = vi.contacts(data)
    fastest = max(np.abs(data["velocity"]).max(), np.abs(data["event_velocity"]).max())
    speeds = np.abs(log["contact_start_velocity"].values)
    for share in (1e-3, 0.5, 1.0):
        flags = vi.contacts(data, grazing=share)["contact_grazing"].values
        np.testing.assert_array_equal(flags, speeds < share * float(fastest))
    assert vi.contacts(data, grazing=1.0)["contact_grazing"].any()


def test_samples_change_nothing():
    case = vi.laboratory.case("B3-10mm-A3")
    shaken = vi.Harmonic(case.amplitude, 1.06)
    few, many = (
        vi.contacts(vi.simulate(vi.Rig(case.oscillator, shaken), 30, samples=n)) for n in (1, 99)
    )
    assert few["contact_stop"].equals(many["contact_stop"])
    for name in few:
        if name not in ("contact_grazing", "contact_stop"):
            np.testing.assert_allclose(few[name], many[name], rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("wrong", [None, 3, "motion"])
def test_no_motion(wrong):
    case = vi.laboratory.case("B2-G1-A3")
    if wrong == 3:
        wrong = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(1.0, 2.0)), 3, samples=0)
    with pytest.raises(
        vi.InputError, match=r"motion: .* pass the result of steady, or the result of simulate"
    ):
        vi.contacts(wrong)
    with pytest.raises(vi.InputError, match="grazing"):
        vi.contacts(vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(1.0, 2.0)), 3), grazing=-1.0)


def test_relaxation_ends_at_a_contact_that_the_record_cuts():
    """What the spring holds after a contact less what it holds when it is pressed again."""
    bumper = vi.Bumper(1.0, 20.0, 0.1)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), bumper, None)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.15)), 20.75)
    assert bool(data["touching"].sel(stop="right")[-1])
    log = vi.contacts(data)
    begins = data["event_contact"].values == 1
    ends = data["event_deformation"].sel(stop="right").values[~begins][-1]
    again = data["event_deformation"].sel(stop="right").values[begins][-1]
    expected = 0.5 * (ends**2 - again**2)
    assert float(log["contact_dissipated_relaxing"][-1]) == pytest.approx(expected, rel=1e-12)


def test_a_bumper_that_catches_up_with_a_receding_mass():
    bumper = vi.Bumper(1.0695, 8.9267, 0.3)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.01335), bumper, None)
    log = vi.contacts(vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.0911)), 200))
    receding = log["contact_start_velocity"].values < 0.0
    assert receding.any()
    assert (log["contact_closing_speed"].values > 0.0).all()
    assert np.isnan(log["contact_restitution"].values[receding]).all()
    assert np.isfinite(log["contact_restitution"].values[~receding]).all()


class TestThroughARecord:
    """Contacts of a motion that has no period."""

    RIG = vi.Oscillator(
        2.0, vi.Isolator(5.0, 0.3), vi.Bumper(60.0, 0.9, 0.1), vi.RigidStop(0.4, 0.15), force=0.2
    )
    ROUGH = vi.Record(np.random.default_rng(5).uniform(-4.0, 4.0, 65), 0.125)

    def test_they_are_those_that_the_motion_tells(self):
        data = vi.simulate(vi.Rig(self.RIG, self.ROUGH), tail=1.0, samples=2000)
        log = vi.contacts(data)
        kind, side = (
            data["event_contact"].values,
            np.where(data["event_stop"].values == "right", 1, -1),
        )
        begins = data["event_time"].values[(kind == 1) & (side == 1)]
        ends = data["event_time"].values[(kind == 0) & (side == 1)]
        right = log.isel(contact_number=log["contact_stop"].values == "right")
        assert right.sizes["contact_number"] >= 4
        np.testing.assert_array_equal(right["contact_start"], begins[: len(right["contact_start"])])
        np.testing.assert_allclose(right["contact_end"], ends[: len(begins)], rtol=1e-13)
        assert int((log["contact_stop"] == "left").sum()) == int((kind[side == -1] == 2).sum())
        assert not {"contact_start_phase", "contact_duration_share"} & set(log)
        time, u, v, a = (
            data[name].values for name in ("time", "displacement", "velocity", "acceleration")
        )
        push = -(2.0 * a + 0.3 * v + 5.0 * u - 0.2)
        for row in right.to_dataframe().itertuples():
            inside = (time > row.contact_start) & (time < row.contact_end)
            assert row.contact_peak_force == pytest.approx(push[inside].max(), rel=1e-3)
            assert row.contact_peak_force >= push[inside].max() * (1.0 - 1e-12)
            summed = np.trapezoid(push[inside], time[inside])
            assert row.contact_impulse == pytest.approx(summed, rel=1e-2)
            deepest = data["deformation"].sel(stop="right").values[inside].max()
            assert row.contact_penetration == pytest.approx(deepest, rel=1e-6)
            sharpest = np.abs(a[inside]).max()
            assert row.contact_peak_acceleration == pytest.approx(sharpest, rel=1e-3)
            peak = row.contact_peak_time
            assert row.contact_start <= peak <= row.contact_end

    @pytest.mark.parametrize("parts", [2, 5])
    def test_the_same_lines_in_parts_have_the_same_contacts(self, parts):
        time = np.arange(64 * parts + 1) * (self.ROUGH.step / parts)
        finer = vi.Record(self.ROUGH.at(time), self.ROUGH.step / parts)
        one, other = (
            vi.contacts(vi.simulate(vi.Rig(self.RIG, r), tail=1.0)) for r in (self.ROUGH, finer)
        )
        assert one["contact_stop"].equals(other["contact_stop"])
        for name in set(one) - {"contact_grazing", "contact_stop"}:
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-11)

    def test_samples_change_nothing(self):
        few, many = (
            vi.contacts(vi.simulate(vi.Rig(self.RIG, self.ROUGH), tail=1.03, samples=n))
            for n in (1, 30)
        )
        assert few["contact_stop"].equals(many["contact_stop"])
        for name in set(few) - {"contact_grazing", "contact_stop"}:
            np.testing.assert_allclose(few[name], many[name], rtol=1e-9, atol=1e-13)

    def test_sections_and_spectra_have_no_meaning(self):
        data = vi.simulate(vi.Rig(self.RIG, self.ROUGH))
        for look in (vi.fourier_spectrum, vi.stroboscopic_section, vi.impact_section):
            with pytest.raises(vi.InputError, match=r"^motion: this is the response to a Record"):
                look(data)
