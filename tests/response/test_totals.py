"""A whole motion measured: its exact extremes and its energies, through a record, too."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import simpson

import vibroimpact as vi
from reference.paper_signs import in_paper_signs
from samples import sample

BUMPERS = vi.Oscillator(
    2.0, vi.Isolator(5.0, 0.3), vi.Bumper(60.0, 0.9, 0.1), vi.Bumper(40.0, 0.5, 0.15), force=0.3
)
WALLS = BUMPERS.replace(right=vi.RigidStop(0.5, 0.2), left=vi.RigidStop(0.3, 0.1))
PRESSED = BUMPERS.replace(right=vi.Bumper(60.0, 0.9, -0.05), left=vi.Bumper(40.0, 0.5, 0.02))
LOOSE = BUMPERS.replace(isolator=vi.Isolator(0.0, 0.3), left=vi.RigidStop(0.4, 0.1))
HELD = BUMPERS.replace(
    isolator=vi.FrictionIsolator(5.0, 0.3, 0.5), right=vi.RigidStop(0.4, 0.1), force=3.0
)
"""It chatters on the wall, where friction holds it as well."""
RIGS = {
    "bumpers": BUMPERS,
    "walls": WALLS,
    "pressed": PRESSED,
    "no spring": LOOSE,
    "held by friction": HELD,
}
ROUGH = vi.Record(np.random.default_rng(7).uniform(-4.0, 4.0, 81), 0.125)
MOTIONS = ("displacement", "acceleration")


def stored(rig: vi.Oscillator, data: xr.Dataset, at: int) -> float:
    """Energy (J) relative to the base, the constant force's included."""
    signed = in_paper_signs(data)
    u, v, right, left = (
        float(signed[name][at])
        for name in ("displacement", "velocity", "right_bumper", "left_bumper")
    )
    held = rig.mass * v**2 + rig.isolator.stiffness * u**2
    for stop, x in ((rig.right, right), (rig.left, left)):
        held += getattr(stop, "stiffness", 0.0) * x**2
    return 0.5 * held - rig.force * u


@pytest.mark.parametrize("name", RIGS)
def test_the_extremes_are_those_of_ever_more_samples(name: str) -> None:
    exact = vi.totals(vi.simulate(vi.Rig(RIGS[name], ROUGH), tail=2.0))
    for samples, near in ((40, 3e-2), (4000, 3e-6)):
        data = vi.simulate(vi.Rig(RIGS[name], ROUGH), tail=2.0, samples=samples)
        for one in MOTIONS:
            # Both sides of an event count: the samples lie on one of them.
            high, low = (float(exact[f"{one}_{end}"]) for end in ("max", "min"))
            values = [data[one].values]
            if one == "acceleration":
                values += [
                    data[f"event_acceleration_{side}"].values for side in ("before", "after")
                ]
            seen = np.concatenate(values)
            slack = near * (high - low)
            assert high - slack <= seen.max() <= high + 1e-12 * (high - low)
            assert low - 1e-12 * (high - low) <= seen.min() <= low + slack
    assert float(exact["displacement_excursion"]) == high_less_low(exact, "displacement")


def high_less_low(data: xr.Dataset, one: str) -> float:
    return float(data[f"{one}_max"] - data[f"{one}_min"])


@pytest.mark.parametrize(
    "shaken", [ROUGH, vi.Harmonic(2.0, 0.4), vi.Harmonic(1.5, 0.3, of="force")]
)
@pytest.mark.parametrize("name", ["bumpers", "walls", "pressed", "held by friction"])
def test_no_energy_is_lost_count_of(name: str, shaken: vi.Harmonic | vi.Record) -> None:
    rig = RIGS[name]
    how = {"tail": 1.3} if isinstance(shaken, vi.Record) else {"cycles": 6}
    data = vi.simulate(vi.Rig(rig, shaken), start=vi.State(0.0, 0.4), **how)
    totals = vi.totals(data)
    change = stored(rig, data, -1) - stored(rig, data, 0)
    balance = totals["total_supplied"] - totals["total_isolator"] - totals["total_bumpers"]
    scale = float(totals["total_isolator"] + totals["total_bumpers"])
    assert scale > 0.01
    assert float(balance) == pytest.approx(change, abs=1e-11 * scale)


CURVED = {
    "power": vi.Oscillator(
        550.0, vi.Isolator(26800.0, 1100.0), left=vi.PowerBumper(5e6, 0.002, 1.5)
    ),
    "friction": vi.Oscillator(
        550.0, vi.FrictionIsolator(26800.0, 1100.0, 50.0), left=vi.Bumper(2e5, 900.0, 0.0003)
    ),
    "polynomial": vi.Oscillator(
        550.0,
        vi.PolynomialIsolator(26800.0, 1100.0, 1e6, 0.0),
        vi.Bumper(1e5, 500.0, 0.0003),
        vi.Bumper(2e5, 900.0, 0.0003),
    ),
    "bilinear": vi.Oscillator(
        550.0,
        vi.BilinearIsolator(40000.0, 20000.0, 100.0, 500.0),
        left=vi.Bumper(2e5, 900.0, 0.0003),
    ),
    "rest on a wall": vi.Oscillator(
        550.0,
        vi.PolynomialIsolator(26800.0, 1100.0, 1e6, 0.0),
        left=vi.RigidStop(0.5, 0.0003),
        force=-900.0,
    ),
}
SHAKINGS = {
    "even": vi.Periodic(2.0, [0.0, 1.0]),
    "odd and even": vi.Periodic(2.0, [0.7, 1.0, 0.3, 0.4], [0.3, 1.0, -0.4, 2.0]),
    "force": vi.Periodic(2.0, [300.0, 500.0], [0.3, 1.0], of="force"),
    "record": vi.Record(np.random.default_rng(7).uniform(-2.0, 2.0, 200), 0.05),
}


@pytest.mark.parametrize("shaken", sample([*SHAKINGS], [*SHAKINGS][::2]))
@pytest.mark.parametrize("law", CURVED)
def test_the_supplied_energy_is_the_integral_of_the_power(law: str, shaken: str) -> None:
    """On either side: a balance among totals passes if two of them are wrong alike."""
    for rig in (CURVED[law], CURVED[law].mirrored()):
        excitation = SHAKINGS[shaken]
        how = {} if isinstance(excitation, vi.Record) else {"cycles": 20}
        data = vi.simulate(vi.Rig(rig, excitation), samples=2000, **how)
        totals = vi.totals(data)
        if shaken == "force":
            push = data["applied_force"].values
        else:
            push = -rig.mass * data["base_acceleration"].values
        # Over the displacement, which has no jumps where a wall is hit.
        work = 0.5 * (push[1:] + push[:-1]) * np.diff(data["displacement"].values)
        turnover, supplied = float(np.sum(np.abs(work))), float(np.sum(work))
        assert data["touching"].any()
        if law == "rest on a wall":
            assert (data["velocity"].values[1000:] == 0.0).any()
        assert float(totals["total_supplied"]) == pytest.approx(supplied, abs=1e-4 * turnover)


def test_the_energy_supplied_to_a_steady_motion_is_what_is_lost() -> None:
    data = vi.steady(vi.Rig(CURVED["power"], SHAKINGS["even"]))
    lost = float(data["energy_isolator"] + data["energy_bumpers"])
    assert lost > 0.1
    assert float(data["energy_supplied"]) == pytest.approx(lost, rel=1e-9)


def test_those_of_a_steady_motion() -> None:
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)))
    totals = vi.totals(data)
    for name in ("displacement_max", "acceleration_min", "eccentricity"):
        assert float(totals[name]) == float(data[name])
    cycles = int(data["period"])
    for name in ("supplied", "isolator", "bumpers"):
        assert float(totals[f"total_{name}"]) == cycles * float(data[f"energy_{name}"])


def test_no_motion() -> None:
    for wrong in (None, vi.simulate(vi.Rig(BUMPERS, ROUGH), samples=0)):
        with pytest.raises(
            vi.InputError,
            match=r"motion: .* pass the result of steady, or the result of simulate with samples",
        ):
            vi.totals(wrong)


def test_a_start_into_a_rigid_stop_is_noted():
    """The impact counts: with it the energies balance from the initial state on."""
    rig = vi.Oscillator(2.0, vi.Isolator(5.0, 0.3), vi.RigidStop(0.6, 0.1))
    start = vi.State(0.1, 0.5)
    motion = vi.simulate(vi.Rig(rig, vi.Harmonic(0.2, 0.3)), cycles=3, start=start)
    totals = vi.totals(motion)
    assert "starts with an impact, from 0.5 to -0.3 m/s" in totals.attrs["notes"]
    kinetic = 0.5 * 2.0 * (float(motion["velocity"][-1]) ** 2 - 0.5**2)
    spring = 0.5 * 5.0 * (float(motion["displacement"][-1]) ** 2 - 0.1**2)
    lost = float(totals["total_isolator"] + totals["total_bumpers"])
    assert float(totals["total_supplied"]) == pytest.approx(kinetic + spring + lost, abs=1e-12)
    behind = vi.simulate(vi.Rig(rig, vi.Harmonic(0.2, 0.3)), cycles=3, start=vi.State(0.1, -0.3))
    assert "notes" not in vi.totals(behind).attrs


def test_the_totals_of_a_chaotic_flight_are_those_of_the_motion_recorded():
    """Twenty cycles without an event: followed again in one piece, it goes another way."""
    law = vi.PolynomialIsolator(1.0, 0.0658715, 0.4051877, 7.0153961)
    shaken = vi.Periodic(
        0.05027304756588626,
        [9.0839, 9.7366, 0.2548, 3.1057, 3.925],
        phases=[2.1422, 4.8818, 5.99, 3.7407, 3.9813],
        phase=5.6024,
        of="displacement",
    )
    motion = vi.simulate(vi.Rig(vi.Oscillator(1.0, law), shaken), cycles=20.3, samples=4096)
    totals = vi.totals(motion)
    time, v = motion["time"].values, motion["velocity"].values
    pull = motion["base_acceleration"].values
    assert float(totals["total_supplied"]) == pytest.approx(simpson(-pull * v, x=time), abs=1e-6)
    assert float(totals["total_isolator"]) == pytest.approx(
        simpson(law.damping * v**2, x=time), abs=1e-6
    )


@pytest.mark.parametrize("shaken", [vi.Harmonic(3.0, 0.4, of="force"), ROUGH])
@pytest.mark.parametrize("end", [0.3, 0.77])
def test_those_of_a_motion_that_is_cut_at_its_end(shaken: vi.Harmonic | vi.Record, end: float):
    """A record goes on behind the last sample, which may lie on none of its own."""
    how = {} if isinstance(shaken, vi.Record) else {"cycles": 5}
    motion = vi.simulate(vi.Rig(BUMPERS, shaken), samples=48, **how)
    count = int(end * motion.sizes["time"])
    part = motion.isel(time=slice(count))
    totals = vi.totals(part)
    for one in MOTIONS:
        high, low = (float(totals[f"{one}_{name}"]) for name in ("max", "min"))
        assert high == pytest.approx(float(part[one].max()), abs=3e-2 * (high - low))
        assert low == pytest.approx(float(part[one].min()), abs=3e-2 * (high - low))
    balance = totals["total_supplied"] - totals["total_isolator"] - totals["total_bumpers"]
    change = stored(BUMPERS, part, -1) - stored(BUMPERS, part, 0)
    assert float(balance) == pytest.approx(change, abs=1e-11)
    log = vi.contacts(part)
    assert (log["contact_end"] <= part["time"][-1]).all()
    assert "notes" not in log.attrs


@pytest.mark.parametrize("first", [3 * 48, 2 * 48 + 17])
def test_those_of_what_is_left_without_the_first_samples(first: int):
    shaken = vi.Harmonic(3.0, 0.4, 1.1)
    motion = vi.simulate(vi.Rig(BUMPERS, shaken), 6, samples=48)
    part = motion.isel(time=slice(first, None))
    totals = vi.totals(part)
    balance = totals["total_supplied"] - totals["total_isolator"] - totals["total_bumpers"]
    change = stored(BUMPERS, part, -1) - stored(BUMPERS, part, 0)
    assert float(balance) == pytest.approx(change, abs=1e-11)
    every, log = vi.contacts(motion), vi.contacts(part)
    later = every.isel(contact_number=every["contact_start"].values >= float(part["time"][0]))
    assert 2 < log.sizes["contact_number"] < every.sizes["contact_number"]
    assert log["contact_stop"].equals(later["contact_stop"])
    for name in set(log) - {"contact_grazing", "contact_stop"}:
        np.testing.assert_allclose(log[name], later[name], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("kept", [slice(10, None), slice(None, None, 3)])
def test_samples_without_the_whole_record_are_refused(kept: slice):
    motion = vi.simulate(vi.Rig(BUMPERS, ROUGH), samples=2)
    with pytest.raises(vi.InputError, match=r"^motion: its samples .* may be cut at its end only$"):
        vi.totals(motion.isel(time=kept))


@pytest.mark.parametrize("function", [vi.totals, vi.contacts])
def test_a_motion_that_goes_another_way_is_reported(function):
    """As one that is sensitive to rounding and was computed elsewhere: its end is another one."""
    motion = vi.simulate(vi.Rig(BUMPERS, vi.Harmonic(2.0, 0.4)), 3.0, samples=16)
    motion["displacement"][-1] += 1e-3
    with pytest.warns(RuntimeWarning, match=r"the motion ends 0\.001 m away from the recorded one"):
        data = function(motion)
    assert "the motion ends 0.001 m away" in data.attrs["notes"]
