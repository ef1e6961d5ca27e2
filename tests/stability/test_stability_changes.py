"""No change of stability along a branch without a bifurcation, and none where there is none."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from stability.followed import values
from vibroimpact.model.parameter_ranges import read_ranges
from vibroimpact.stability.bifurcations import unexplained
from vibroimpact.stability.branch import _both_ways, _first_orbit


@pytest.mark.parametrize("gap", sample([None, 0.006331861949463645], [0.006331861949463645]))
def test_a_symmetry_breaking_of_an_orbit_that_does_not_reach_the_only_stop(gap):
    """Symmetry is a property of the motion: the bifurcation is the same with a stop or without."""
    left = None if gap is None else vi.Bumper(5074.3966275400335, 0.0, gap)
    isolator = vi.PolynomialIsolator(
        damping=15.644468520541908,
        stiffness=162.2412809793537,
        cubic=3906050.5514135016,
        quintic=212157551060.25104,
    )
    rig = vi.Oscillator(453.0518198083075, isolator, left=left)
    shaken = vi.Harmonic("1.436060444936944 N", 0.045)
    start = vi.steady(vi.Rig(rig, shaken))["final_state"]
    data = vi.branch(vi.Rig(rig, shaken), start, vary={"frequency": (0.0434, 0.046)})
    assert np.abs(values(data, "symmetry breaking") - 0.04373158).min() < 1e-8
    assert "unexplained_changes" not in data.attrs


def test_a_branch_ends_where_orbits_are_not_isolated():
    """A bilinear rig that no longer yields swings about any offset."""
    bumper = vi.Bumper(28.071718336261494, 0.0, 0.02690309417168668)
    isolator = vi.BilinearIsolator(
        damping=0.420965764683605,
        elastic_stiffness=8.565865055631514,
        post_yield_stiffness=3.536918093526268,
        yield_force=0.5138491291330257,
    )
    rig = vi.Oscillator(1.7149120760510639, isolator, right=bumper, left=bumper)
    shaken = vi.Periodic(
        1.1356545349333251,
        [0.15316268495910734, 0.0, 0.02529428169786426, 0.05313511587543692],
        [0.32482235353280076, 4.930546887254801, 0.546722119591505, 3.8428435448530753],
    )
    f, reach = shaken.frequency, sample(0.1, 0.01)
    with pytest.warns(RuntimeWarning, match="not isolated"):
        start = vi.steady(vi.Rig(rig, shaken))["final_state"]
    data = vi.branch(
        vi.Rig(rig, shaken), start, vary={"frequency": ((1.0 - reach) * f, (1.0 + reach) * f)}
    )
    assert data.sizes["point"] < 100
    assert data.sizes["bifurcation"] == 0
    for end in ("low", "high"):
        assert "not isolated" in data.attrs[f"ended_{end}"]


def test_a_change_that_no_bifurcation_explains_is_told():
    """If those that explain it are left out."""
    case = vi.laboratory.case("B2-G1-A3")
    (along,) = read_ranges({"frequency": (0.8, 4.0)}, case.rig)
    _, first = _first_orbit(case.rig.at(2.0), None, along, None)
    stations, _, _ = _both_ways(first, along.ends, 5000)
    (change,) = unexplained(stations, [])[:1]
    assert 0.8 < change[0] < 4.0


def test_a_branch_that_grows_until_its_points_are_used_up_says_so():
    """Below Den Hartog's bound dry friction does not limit a resonance."""
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(1.0, 0.0, 0.3))
    shaken = vi.Harmonic(1.0, 0.11)
    data = vi.branch(vi.Rig(rig, shaken), vary={"frequency": (0.1, 0.2)}, most_points=300)
    assert "points were reached" in data.attrs["ended_high"]
    assert "times as large as the first orbit and still grows" in data.attrs["ended_high"]


def test_a_branch_ends_where_its_motion_grows_without_bound():
    """Long before its points are used up: at the resonance, from either side of it."""
    rig = vi.Oscillator(1.0, vi.FrictionIsolator(1.0, 0.0, 0.3))
    for frequency, end in ((0.11, "high"), (0.19, "low")):
        data = vi.branch(vi.Rig(rig, vi.Harmonic(1.0, frequency)), vary={"frequency": (0.1, 0.2)})
        assert "without bound near ω = 1 (" in data.attrs[f"ended_{end}"]
        assert data.sizes["point"] < 2500
        ratio = data["displacement_max"].max() / data["displacement_max"].min()
        assert ratio > 1e3


@pytest.mark.parametrize("damping_ratio", [1e-2, 1e-3])
def test_a_slightly_damped_resonance_is_passed(damping_ratio):
    """However large it is: its peak is that of the closed form."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2.0 * damping_ratio))
    data = vi.branch(vi.Rig(rig, vi.Harmonic(1.0, 0.11)), vary={"frequency": (0.1, 0.2)})
    assert data.attrs["ended_high"] == "the range ends at ω = 1.25663706"
    peak = 0.5 / damping_ratio
    assert float(data["displacement_max"].max()) == pytest.approx(peak, rel=1e-3)


def test_a_dashpot_limits_a_resonance_that_is_not_followed_to_its_peak():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2e-5))
    data = vi.branch(vi.Rig(rig, vi.Harmonic(1.0, 0.11)), vary={"frequency": (0.1, 0.2)})
    assert "without bound" not in data.attrs["ended_high"]
    reason = "the motion grows beyond 1e+04 times the first orbit"
    assert data.attrs["ended_high"].startswith(reason)


def test_a_motion_that_grows_with_the_amplitude_is_no_resonance():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.2))
    shaken = vi.Harmonic(1e-3, 0.11)
    data = vi.branch(vi.Rig(rig, shaken), vary={"amplitude": (1e-3, 100.0)})
    assert data.attrs["ended_high"] == "the range ends at 100"


def test_a_pair_passes_the_circle_where_the_section_lies_in_a_contact():
    """The left bumper remembers for longer than a period, which the third multiplier hides."""
    right = vi.Bumper(1.0, 0.028284271247461905, 0.0)
    left = vi.Bumper(0.01, 2.009975124224178, 10.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), right, left)
    shaken = vi.Harmonic(1.0, 0.5 / np.pi)
    data = vi.branch(vi.Rig(rig, shaken), vary={"frequency": (0.11, 0.21)})
    assert "unexplained_changes" not in data.attrs
    (value,) = values(data, "Neimark-Sacker")
    assert value == pytest.approx(0.191607879, abs=1e-8)
