"""Curves of bifurcations: round once, no jumps, and an end that is told."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from reference.paper_signs import mode_of, signed_parts
from samples import sample
from vibroimpact.engine.section_map import RESIDUAL
from vibroimpact.stability.fixed_points import Section, evaluated, seen_at
from vibroimpact.stability.parameter_family import family
from vibroimpact.stability.two_parameters import plane

CASE = vi.laboratory.case("B2-G1-A3")
TURN = 2.0 * math.pi
LOW, HIGH = (0.2 / TURN, 0.05), (6.0 / TURN, 3.0)


def beside_the_cusp(other: str, low: float, high: float):
    """The fold of B2-G1-A3 near 0.56 Hz over the frequency and another parameter."""
    data = vi.resonance_diagram(vi.Rig(CASE.oscillator, CASE.amplitude), {"frequency": (0.4, 1.0)})
    folds = np.flatnonzero(data["bifurcation_kind"].values == "fold")
    row = folds[np.argmin(np.abs(data["bifurcation_value"].values[folds] - 0.56038578))]
    return vi.bifurcation_curve(
        vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)),
        data.isel(bifurcation=int(row)),
        vary={"frequency": (0.3, 6.0), other: (low, high)},
    )


@pytest.mark.full
def test_a_closed_curve_is_gone_round_once():
    """Its section moves on the way, and it begins beside a cusp."""
    curve = beside_the_cusp("gap", 1e-4, 3e-2)
    assert curve.attrs["ended_low"] == curve.attrs["ended_high"] == "it is closed"
    assert curve.sizes["point"] < 300
    assert curve.sizes["cusp_number"] == 2


@pytest.mark.full
def test_a_curve_that_creeps_ends_with_a_reason():
    """The fold comes so close to a grazing that no step leads on."""
    curve = beside_the_cusp("stiffness_ratio", 0.1, 500.0)
    ends = [curve.attrs["ended_low"], curve.attrs["ended_high"]]
    assert "the range of stiffness_ratio ends at 500" in ends
    assert any("no fold could be found beyond" in end and "grazes" in end for end in ends)
    assert curve.sizes["point"] < 800


def rig(cubic: float, damping: float, stops: int) -> vi.Oscillator:
    stop = vi.Bumper(40.0, damping, 1.0)
    law = vi.PolynomialIsolator(1.0, 0.1, cubic=cubic) if cubic else vi.Isolator(1.0, 0.1)
    return vi.Oscillator(1.0, law, stop, stop if stops == 2 else None)


@cache
def highest_fold(cubic: float, damping: float, stops: int):
    """The fold of the highest frequency, over frequency and amplitude."""
    branch = vi.branch(
        vi.Rig(rig(cubic, damping, stops), vi.Harmonic(0.5, 3.9 / TURN)),
        vary={"frequency": (1.0 / TURN, 4.0 / TURN)},
    )
    folds = np.flatnonzero(branch["bifurcation_kind"].values == "fold")
    row = folds[np.argmax(branch["bifurcation_value"].values[folds])]
    return vi.bifurcation_curve(
        vi.Rig(rig(cubic, damping, stops), vi.Harmonic(0.5, 1.8 / TURN)),
        branch.isel(bifurcation=int(row)),
        vary=dict(zip(("frequency", "amplitude"), zip(LOW, HIGH, strict=True), strict=True)),
    )


def seen_by(oscillator: vi.Oscillator, shaken: vi.Harmonic, section, period: int = 1):
    """What the rig itself makes of a listed section."""
    state = section.values
    shaken = shaken.replace(phase=float(state[4]))
    scale = np.array([1.0, shaken.angular_frequency, 1.0, 1.0, 1.0, 1.0])
    point = np.array([*signed_parts(state), state[-1], shaken.frequency])
    one = Section(family(vi.Rig(oscillator, shaken), "frequency"), period, False, scale)
    status, orbit, _ = evaluated(one, point, mode_of(state))
    assert int(status) == 0
    return orbit


def looked_at(data, oscillator: vi.Oscillator) -> tuple[np.ndarray, ...]:
    """Of each point, by the rig itself: residual, distance of a multiplier from 1, extremes."""
    rows = []
    for k in range(data.sizes["point"]):
        section = data["section"].isel(point=k)
        shaken = vi.Harmonic(float(data["amplitude"][k]), float(data["frequency"][k]))
        orbit = seen_by(oscillator, shaken, section)
        miss = np.abs(orbit.map_multipliers - 1.0).min()
        shaken = shaken.replace(phase=float(section.sel(component="phase")))
        seen = vi.simulate(vi.Rig(oscillator, shaken), 1, section, samples=128)[
            "displacement"
        ].values
        rows.append((orbit.facts[RESIDUAL], miss, seen.min(), seen.max()))
    residual, miss, least, most = np.array(rows).T
    return residual, miss, np.column_stack([least, most])


def reversals(data) -> int:
    """How often the curve of the two parameters turns back."""
    steps = np.diff(parameters_of(data), axis=0)
    steps = steps[np.hypot(*steps.T) > 1e-10]
    return int(((steps[1:] * steps[:-1]).sum(axis=1) < 0.0).sum())


def parameters_of(data) -> np.ndarray:
    """Both parameters over their ranges."""
    width = np.subtract(HIGH, LOW)
    return np.column_stack([data["frequency"], data["amplitude"]]) / width


CURVES = [
    (cubic, damping, stops)
    for cubic in (0.0, 0.1, 0.3, 1.0)
    for damping in (0.0, 0.4, 2.0)
    for stops in (1, 2)
]


@pytest.mark.parametrize(
    ("cubic", "damping", "stops"),
    sample(CURVES, [(0.3, 0.4, 1)]),
)
def test_no_point_is_another_curve_s(cubic, damping, stops):
    """Folds of the rig itself, each near the one before, wherever the section moves."""
    data = highest_fold(cubic, damping, stops)
    residual, miss, extremes = looked_at(data, rig(cubic, damping, stops))
    assert residual.max() < 1e-9
    assert miss.max() < 1e-5
    steps = np.abs(np.diff(parameters_of(data), axis=0)).max(axis=1)
    grown = np.abs(np.diff(extremes, axis=0)).max(axis=1) / extremes[1:].max(axis=1)
    assert steps.max() < 0.05
    assert grown.max() < 0.3
    moved = np.diff(data["section"].sel(component="phase").values) != 0.0
    assert steps[moved].max(initial=0.0) < 1e-9
    assert grown[moved].max(initial=0.0) < 1e-3  # between two samples
    assert reversals(data) == data.sizes["cusp_number"]
    for end in (data.attrs["ended_low"], data.attrs["ended_high"]):
        lost = (
            end.startswith("no fold could be found beyond")
            and "the orbit nearly grazes a stop" in end
        )
        assert lost or end.startswith("the range of") or end == "it is closed"


def test_it_ends_where_the_fold_grazes():
    """At 1.11561 rad/s; it went on as another fold, and back to where it came from."""
    data = highest_fold(0.3, 0.4, 1)
    assert data.attrs["ended_low"].startswith("no fold could be found beyond")
    assert "the orbit nearly grazes a stop" in data.attrs["ended_low"]
    assert "range of amplitude ends at 3" in data.attrs["ended_high"]
    upper, lower = sides(data)
    for size in (0.112, 0.1127):
        folds = folds_of_branch(0.3, 0.4, size)
        for side in (upper, lower):
            assert np.abs(folds - at(side, size)).min() < 5e-5  # between two points of the curve
    assert lower[-1, 1] < 0.114
    folds = folds_of_branch(0.3, 0.4, 0.114)
    assert np.abs(folds - at(upper, 0.114)).min() < 5e-5
    assert np.abs(folds - lower[-1, 0]).min() > 2e-3


@pytest.mark.full
def test_a_linear_isolator_s_fold_ends_in_a_grazing_too():
    """A section that moves on the way over the amplitude leads on to where it grazes."""
    data = highest_fold(0.0, 2.0, 1)
    assert "the orbit nearly grazes a stop" in data.attrs["ended_low"]
    upper, lower = sides(data)
    for size in (0.1013, 0.1015):
        folds = folds_of_branch(0.0, 2.0, size)
        for side in (upper, lower):
            assert np.abs(folds - at(side, size)).min() < 5e-5
    assert 0.1015 < lower[-1, 1] < 0.1017
    folds = folds_of_branch(0.0, 2.0, 0.1017)
    assert np.abs(folds - at(upper, 0.1017)).min() < 5e-5
    assert np.abs(folds - lower[-1, 0]).min() > 5e-4


def sides(data) -> tuple[np.ndarray, np.ndarray]:
    """(Ω, A) on either side of the cusp that is nearest to the lower end."""
    points = np.column_stack([TURN * data["frequency"], data["amplitude"]])
    cusp = np.abs(points[:, 1] - float(data["cusp_second"].min())).argmin()
    return points[cusp : cusp + 60], points[cusp::-1]


def at(side: np.ndarray, size: float) -> float:
    """Ω of a fold at an amplitude."""
    order = np.argsort(side[:, 1])
    return float(np.interp(size, side[order, 1], side[order, 0]))


def folds_of_branch(cubic: float, damping: float, size: float) -> np.ndarray:
    """Ω of the folds on the branch at one amplitude, which knows nothing of the curve."""
    shaken = vi.Harmonic(size, 3.0 / TURN)
    branch = vi.branch(
        vi.Rig(rig(cubic, damping, 1), shaken), vary={"frequency": (0.9 / TURN, 3.0 / TURN)}
    )
    return TURN * branch["bifurcation_value"].values[branch["bifurcation_kind"].values == "fold"]


@pytest.mark.parametrize("pair", [("frequency", "amplitude"), ("gap", "frequency")])
def test_an_orbit_elsewhere_on_the_plane_is_seen_as_it_moves(pair):
    """The family's own forcing is still that with which the plane was made."""
    oscillator, shaken = rig(0.0, 0.4, 1), vi.Harmonic(0.5, 0.3)
    there = {"amplitude": 0.7, "frequency": 0.25, "gap": 0.9}
    over = plane(vi.Rig(oscillator, shaken), pair)
    p, q = (there[name] for name in pair)
    there = over.other.vary(over.family.parameter.vary(vi.Rig(oscillator, shaken), p), q)
    start = vi.steady(there)["final_state"].values
    section = Section(over.at_vectors(q), 1, False, np.ones(6))
    point = np.array([*signed_parts(start), start[-1], p])
    status, orbit, _ = evaluated(section, point, mode_of(start))
    assert int(status) == 0
    seen, _ = seen_at(orbit, 1.3)
    expected = vi.simulate(there, 1.3 / TURN, vi.State(start[0], start[1]), samples=0)
    np.testing.assert_allclose(seen[:2], expected["final_state"].values[:2], rtol=1e-9)


def test_a_parameter_of_one_side_takes_the_symmetry():
    """The fold begins as that of a motion that is its own mirror image."""
    oscillator = CASE.oscillator
    shaken = vi.Harmonic(CASE.amplitude, 2.0)
    branch = vi.branch(vi.Rig(oscillator, shaken), vary={"frequency": (1.0, 4.0)})
    row = list(branch["bifurcation_kind"].values).index("fold")
    assert branch["bifurcation_antisymmetric"][row]
    gap = oscillator.right.gap
    data = vi.bifurcation_curve(
        vi.Rig(oscillator, shaken),
        branch.isel(bifurcation=row),
        vary={"frequency": (0.3, 6.0), "stops.right.gap": (0.5 * gap, 1.5 * gap)},
    )
    for wide in (0.6 * gap, 1.3 * gap):
        other = oscillator.replace(right=oscillator.right.replace(gap=wide))
        beside = vi.branch(
            vi.Rig(other, vi.Harmonic(CASE.amplitude, 4.0)), vary={"frequency": (1.0, 4.0)}
        )
        folds = beside["bifurcation_value"].values[beside["bifurcation_kind"].values == "fold"]
        order = np.argsort(data["stops.right.gap"].values)
        here = np.interp(
            wide, data["stops.right.gap"].values[order], data["frequency"].values[order]
        )
        assert np.abs(folds - here).min() < 2e-3  # between two points of the curve


@pytest.mark.full
def test_no_step_lands_on_the_curve_beside_it():
    """1e-5 from a grazing on its way, behind which motions with one contact more fold as well."""
    case = vi.laboratory.case("B3-10mm-A3")
    diagram = vi.resonance_diagram(
        vi.Rig(case.oscillator, case.amplitude), {"frequency": (0.9, 1.4)}
    )
    value, contacts = diagram["bifurcation_value"].values, diagram["bifurcation_contacts"].values
    folds = (diagram["bifurcation_kind"].values == "fold") & (contacts == "7R 4L")
    row = np.flatnonzero(folds & (np.abs(value - 1.0082179) < 1e-6))[0]
    data = vi.bifurcation_curve(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.2)),
        diagram.isel(bifurcation=int(row)),
        vary={"frequency": (0.3, 3.0), "amplitude": (0.1, 2.0)},
    )
    for k in range(data.sizes["point"]):
        shaken = vi.Harmonic(float(data["amplitude"][k]), float(data["frequency"][k]))
        one = seen_by(case.oscillator, shaken, data["section"].isel(point=k), 4)
        assert one.contacts == (7, 4)
    for end in (data.attrs["ended_low"], data.attrs["ended_high"]):
        assert end.startswith("no fold could be found beyond")
