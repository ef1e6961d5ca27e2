"""Bifurcation diagrams by brute force: against branches, single motions, and symmetry."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample

CASE = vi.laboratory.case("B3-10mm-A3")
RIG = CASE.oscillator


def shaken(frequency: float, phase: float = 0.0) -> vi.Harmonic:
    return vi.Harmonic(CASE.amplitude, frequency, phase)


@cache
def over_frequency() -> xr.Dataset:
    return vi.bifurcation_diagram(vi.Rig(RIG, shaken(1.2, 0.4)), {"frequency": (1.05, 1.2)}, 16)


def changes(data: xr.Dataset, first: int, second: int) -> list[tuple[float, float]]:
    """Neighbouring values between which the period goes from one to the other, either way."""
    (name,) = (data.attrs["parameter"],)
    values, period = data[name].values, data["period"].values
    at = [i for i in range(len(period) - 1) if {*period[i : i + 2]} == {first, second}]
    return [(values[i], values[i + 1]) for i in at]


@pytest.mark.parametrize(
    ("parameter", "low", "high", "frequency"),
    [
        ("frequency", 1.105, 1.115, 1.11),
        ("gap", 4.85e-3, 5.1e-3, 1.12),
    ],
)
def test_period_doublings_lie_where_branches_double(parameter, low, high, frequency):
    """Each change from period 1 to 2 holds a doubling of the branch of period 1."""
    whole = vi.Rig(RIG, shaken(frequency))
    arguments = (whole, {parameter: (low, high)}, sample(201, 41))
    diagram = vi.bifurcation_diagram(*arguments, directions="up").isel(start=0)
    ends = changes(diagram, 1, 2)
    assert ends
    for below, above in ends:
        middle = diagram.sel(
            {parameter: below if int(diagram["period"].sel({parameter: below})) == 1 else above}
        )
        rig, excitation = RIG, shaken(frequency)
        if parameter == "frequency":
            excitation = excitation.replace(frequency=float(middle[parameter]))
        else:
            stop = RIG.right.replace(gap=float(middle[parameter]))
            rig = RIG.replace(right=stop, left=stop)
        branch = vi.branch(
            vi.Rig(rig, excitation), middle["section"], vary={parameter: (low, high)}
        )
        doubling = branch["bifurcation_kind"].values == "period doubling"
        at = branch["bifurcation_value"].values[doubling]
        assert ((below <= at) & (at <= above)).any()


@pytest.mark.parametrize("k", [0, 6, 12, 15])
def test_single_values_are_those_of_steady(k):
    data = over_frequency().isel(frequency=k).sel(start="up")
    motion = vi.steady(vi.Rig(RIG, shaken(float(data["frequency"]), 0.4)), data["section"])
    assert data["motion"].item() == motion["motion"].item()
    assert int(data["period"]) == int(motion["period"])
    known = data["section_displacement"].dropna("section_point")
    if data["motion"].item() == "chaotic":
        assert len(known) == 200
        spread = np.hypot(*(float(one["exponents_uncertainty"][0]) for one in (data, motion)))
        apart = abs(float(data["exponents"][0] - motion["exponents"][0]))
        assert apart < 6.0 * spread
        return
    assert len(known) == int(data["period"])
    section = vi.stroboscopic_section(motion, 0.4)
    for name in ("displacement", "velocity"):
        one, other = (np.sort(d[f"section_{name}"].values) for d in (data, section))
        np.testing.assert_allclose(one[: len(known)], other, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(data["exponents"], motion["exponents"], rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(
        data["displacement_excursion"], motion["displacement_excursion"], rtol=1e-9
    )


def test_impacts_are_those_of_steady():
    data = vi.bifurcation_diagram(
        vi.Rig(RIG, shaken(1.2)), {"amplitude": ("0.045 g", "0.05 g")}, 3, section="impacts"
    ).isel(amplitude=-1, start=0)
    motion = vi.steady(
        vi.Rig(RIG, shaken(1.2).replace(amplitude=float(data["amplitude"]))), data["section"]
    )
    section = vi.impact_section(motion)
    order = np.argsort(section["contact_start_phase"].values)
    known = data.isel(section_point=slice(section.sizes["contact_number"]))
    mine = np.argsort(known["contact_start_phase"].values)
    padded = data.sizes["section_point"] - len(order)
    assert (data["contact_stop"].values == "").sum() == padded
    assert (known["contact_stop"].values[mine] == section["contact_stop"].values[order]).all()
    for name in ("contact_start_phase", "contact_start_velocity"):
        np.testing.assert_allclose(known[name].values[mine], section[name].values[order], rtol=1e-8)


def test_the_mirror_image():
    """Seen from the other side, half a forcing period later, all signs are turned."""
    rig = RIG.replace(left=RIG.left.replace(gap=6e-3))
    turned = rig.replace(right=rig.left, left=rig.right)
    one, other = (
        vi.bifurcation_diagram(vi.Rig(oscillator, shaken(1.3, phase)), {"amplitude": (0.3, 0.6)}, 7)
        for oscillator, phase in ((rig, 0.2), (turned, 0.2 + np.pi))
    )
    settled = one["period"].values > 0
    assert settled.any()
    np.testing.assert_array_equal(one["period"], other["period"])
    for name in ("section_displacement", "section_velocity"):
        a, b = (np.nan_to_num(data[name].values[settled]) for data in (one, other))
        np.testing.assert_allclose(a, -b, rtol=1e-7, atol=1e-10)
    np.testing.assert_allclose(one["displacement_max"], -other["displacement_min"], rtol=1e-9)


def test_up_is_down_where_there_is_one_motion():
    """Free flight, in closed form: |u| of the section, and exponents −C/2M."""
    rig = RIG.replace(right=None, left=None)
    span = ("10 kN/m", "40 kN/m")
    data = vi.bifurcation_diagram(vi.Rig(rig, shaken(2.0)), {"isolator.stiffness": span}, 9)
    np.testing.assert_allclose(
        data["section_displacement"].sel(start="up"), data["section_displacement"].sel(start="down")
    )
    omega, ratio = 2.0 * np.pi * 2.0, rig.isolator.damping / rig.mass
    swing = -CASE.amplitude / (
        data["isolator.stiffness"].values / rig.mass - omega**2 + 1j * omega * ratio
    )
    np.testing.assert_allclose(data["section_displacement"][0, :, 0], swing.imag, rtol=1e-9)
    np.testing.assert_allclose(data["exponents"], -0.5 * ratio, rtol=1e-9)
    assert (data["period"] == 1).all()
    assert data["isolator.stiffness"].attrs["units"] == "N m-1"


def test_threads_and_seeds():
    arguments = (vi.Rig(RIG, shaken(1.1)), {"gap": (4e-3, 5e-3)}, 40)
    seen = []
    one, two = (
        vi.bifurcation_diagram(
            *arguments,
            directions=(),
            random=2,
            seed=3,
            threads=n,
            progress=lambda *p: seen.append(p),
        )
        for n in (1, 2)
    )
    for name in one:
        np.testing.assert_array_equal(one[name], two[name])
    assert seen[-1] == (80, 80)
    assert list(one["start"].values) == ["random 1", "random 2"]


def test_named_starts_find_what_coexists():
    """At 2.2 Hz free flight and a motion with impacts: each from a start near it."""
    case = vi.laboratory.case("B2-G1-A3")
    starts = {"rest": vi.State(), "far": vi.State(0.0, 0.5)}
    data = vi.bifurcation_diagram(
        case, {"gap": ("6 mm", "7.5 mm")}, 3, frequency=2.4, starts=starts, directions=()
    )
    reach = data["displacement_max"].sel(gap=7.5e-3)
    assert float(reach.sel(start="rest")) < 7.5e-3 < float(reach.sel(start="far"))


def test_a_motion_that_is_given_up():
    data = vi.bifurcation_diagram(
        vi.Rig(RIG, shaken(0.5)), {"gap": (4.9e-3, 5e-3)}, 2, max_events=6
    )
    assert (data["status"] == 2).all()
    assert (data["period"] == 0).all()
    assert data["section_displacement"].isnull().all()
    assert data["displacement_max"].isnull().all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"vary": {"colour": (2e-3, 5e-3)}},
        {"vary": {"gap": (2e-3, 1e-3)}},
        {"steps": 1},
        {"directions": "sideways"},
        {"directions": ()},
        {"starts": {"up": vi.State()}},
        {"random": -1},
        {"section": "poincare"},
        {"points": 0},
        {"threads": 0},
        {"vary": {"gap": (0.0, 5e-3)}, "log": True},
    ],
)
def test_refused(wrong):
    arguments = {"vary": {"gap": (2e-3, 5e-3)}}
    with pytest.raises(vi.InputError, match=f"^{next(iter(wrong))}"):
        vi.bifurcation_diagram(vi.Rig(RIG, shaken(1.1)), **{**arguments, **wrong})
