"""What curves made for the purpose show, and the scenario that follows."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.scenario.evidence import evidence
from vibroimpact.scenario.kinds import Scenario
from vibroimpact.scenario.thresholds import Thresholds
from vibroimpact.scenario.verdict import confidence, primary_jumps, scenario

GRID = np.round(np.arange(0.40, 3.01, 0.01), 10)
RIG = vi.from_dimensionless(20.0, 0.3, 0.01, 0.15, mass=1.0, stiffness=(2.0 * math.pi) ** 2)
GAP = RIG.oscillator.right.gap


def bump(centre: float, width: float, height: float) -> np.ndarray:
    return height * np.exp(-(((GRID - centre) / width) ** 2))


def slope(jump_at: float) -> np.ndarray:
    """A primary resonance that rises to a jump and is small beyond it."""
    return np.where(jump_at + 1e-9 >= GRID, 0.3 + GRID, 0.2)


def inside(low: float, high: float) -> np.ndarray:
    return (low - 1e-9 <= GRID) & (high + 1e-9 >= GRID)


def made(forward, backward=None, *, touching=None, period=1, uneven=False, depth=0.3):
    """A sweep's dataset with given η_a; η_d is in proportion, regular unless told otherwise."""
    backward = forward if backward is None else backward
    eta = np.array([forward, backward])
    shape, dims = eta.shape, ("direction", "frequency")
    touching = np.broadcast_to(eta > 0.25 if touching is None else touching, shape)
    period = np.broadcast_to(period, shape)
    reach = np.where(touching, (1.0 + depth) * GAP, 0.5 * GAP)
    free = np.abs(1.0 / (1.0 - GRID**2 + 0.3j * GRID))
    return xr.Dataset(
        {
            "eta_a": (dims, eta),
            "eta_d": (dims, 0.3 * eta),
            "motion": (dims, np.where(period > 0, "periodic", "undecided")),
            "period": (dims, period),
            "impacts_right": (dims, touching.astype(float)),
            "impacts_left": (dims, touching.astype(float)),
            "displacement_max": (dims, reach),
            "displacement_min": (dims, -reach),
            "displacement_excursion": (dims, 2.0 * reach),
            "eccentricity": (dims, np.where(uneven, 0.1 * GAP, 0.0) * np.ones(shape)),
            "free_displacement_excursion": ("frequency", 2.0 * GAP / 0.3 * free / free.max()),
        },
        coords={"direction": ["forward", "backward"], "frequency": GRID},
    )


def named(data: xr.Dataset, oscillator=RIG.oscillator, **thresholds: float) -> str:
    used = Thresholds(**thresholds)
    return scenario(evidence(oscillator, RIG.amplitude, data, 0.5 * used.prominence), used).label


def primary() -> tuple[np.ndarray, np.ndarray]:
    return slope(2.2), slope(1.6)


def test_primary_resonance_alone():
    data = made(*primary())
    found = evidence(*RIG, data, 0.01)
    assert [(h.side, h.low, h.high) for h in found.hysteresis] == [("right", 1.61, 2.2)]
    assert found.contact == (0.4, 2.2)
    assert found.gap_ratio == pytest.approx(0.3)
    assert found.penetration == pytest.approx(0.3)
    assert found.extent(0.02) == 0.0
    assert named(data) == "S2"


def test_regular_secondary_resonance():
    forward, backward = primary()
    peak = bump(0.7, 0.05, 0.5)
    data = made(forward + peak, backward + peak)
    found = evidence(*RIG, data, 0.01)
    ((frequency, share),) = found.secondary_resonances(0.02)
    assert frequency == pytest.approx(0.7, abs=0.02)
    # Above the higher one of its valleys, which is the one beyond it.
    beyond = (forward + peak)[GRID > 0.7].tolist()
    at = float((forward + peak)[np.isclose(GRID, frequency)][0])
    assert share == pytest.approx((at - min(beyond[:60])) / at, rel=1e-9)
    assert named(data) == "S3"
    # Without the right hysteresis it is none of the scenarios.
    assert named(made(0.3 + peak + bump(1.6, 0.4, 1.0))) == "unclassified"


def test_left_hysteresis_counts_by_its_width():
    """0.1 Hz wide, half-way to the frequencies beside it, at a natural frequency of 1 Hz."""
    forward, backward = primary()
    low = np.where(inside(0.66, 0.75), 0.5, 0.0)
    data = made(forward, backward + low)
    found = evidence(*RIG, data, 0.01)
    assert [(h.side, h.low, h.high) for h in found.left] == [("left", 0.66, 0.75)]
    assert found.extent(0.02) == pytest.approx(0.1)
    assert named(data) == "S4"
    assert named(data, extent=0.11) != "S4"
    # Twice the threshold is too much, half of it is not.
    assert confidence(found, Thresholds()) == pytest.approx(7 / 8)


@pytest.mark.parametrize(
    ("period", "uneven", "kind"),
    [(0, False, "not periodic"), (3, False, "subharmonic"), (1, True, "mirrored pair")],
)
def test_irregular_resonance(period, uneven, kind):
    """One that is raised above its valleys, while the mass hits the bumpers there."""
    forward, backward = primary()
    here = inside(1.0, 1.2)
    valley = bump(0.85, 0.06, -0.4)
    peak = valley + np.where(here, 0.3, 0.0)
    data = made(
        forward + peak,
        backward + peak,
        period=np.where(here, period, 1),
        uneven=here & uneven,
    )
    found = evidence(*RIG, data, 0.01)
    assert [(i.low, i.high, i.kinds) for i in found.irregular] == [(1.0, 1.2, (kind,))] * 2
    assert found.irregular[0].prominence > 0.1
    assert found.extent(0.02) == pytest.approx(0.2)
    assert named(data) == "S4"
    # With no peak of the excursion in it, it is not a resonance.
    flat = made(
        forward + valley, backward + valley, period=np.where(here, period, 1), uneven=here & uneven
    )
    assert len(evidence(*RIG, flat, 0.01).irregular) == 2
    assert evidence(*RIG, flat, 0.01).extent(0.02) == 0.0
    assert named(flat) == "S3"  # the valley leaves a regular peak before it


def test_a_pair_of_a_rig_that_is_not_symmetric_is_none():
    """There eccentricity tells nothing."""
    oscillator = RIG.oscillator.replace(left=RIG.oscillator.left.replace(gap=1.01 * GAP))
    data = made(*primary(), uneven=inside(1.0, 1.2))
    assert evidence(oscillator, RIG.amplitude, data, 0.01).irregular == ()
    assert len(evidence(*RIG, data, 0.01).irregular) == 2


def test_where_contact_begins_is_no_secondary_resonance():
    """The same range, raised as much, but free flight is at its foot."""
    forward, backward = primary()
    here = inside(1.0, 1.2)
    peak = np.where(here, 0.3, 0.0)
    touching = np.array([(GRID > 0.985) & (forward > 0.25), (GRID > 0.985) & (backward > 0.25)])
    data = made(forward + peak, backward + peak, touching=touching, period=np.where(here, 0, 1))
    found = evidence(*RIG, data, 0.01)
    assert found.onset == ((1.0, 1.2),)
    assert found.irregular == ()
    assert found.secondary == ()
    assert named(data) == "S2"
    # The same with contact all along: a resonance of its own if the curve falls towards it.
    valley = bump(0.85, 0.06, -0.4)
    alone = made(forward + peak + valley, backward + peak + valley, period=np.where(here, 0, 1))
    assert evidence(*RIG, alone, 0.01).onset == ()
    assert named(alone) == "S4"


def test_smooth_curves_with_contact():
    smooth = 0.3 + bump(1.3, 0.4, 1.0)
    assert named(made(smooth, touching=smooth > 0.5)) == "S6"


def test_no_contact():
    assert named(made(0.1 + bump(1.0, 0.3, 0.1))) == "S0"


def test_attached_bumpers():
    side = RIG.oscillator.right.replace(gap=0.0)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    smooth = 0.3 + bump(2.0, 0.8, 1.0)
    assert named(made(smooth), oscillator) == "S5"
    assert named(made(*primary()), oscillator) == "S2"  # attached, but it jumps


@pytest.mark.parametrize(
    ("thresholds", "expected"),
    [({}, "S1"), ({"touch": 0.04}, "S2"), ({"deformation": 0.01}, "S2")],
)
def test_grazing(thresholds, expected):
    """The gap is 0.95 of free flight's amplitude, and the mass presses in by 0.02 of it."""
    gap = 0.95 / 0.3 * GAP
    side = RIG.oscillator.right.replace(gap=gap)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    data = made(*primary())
    for name, sign in (("displacement_max", 1), ("displacement_min", -1)):
        data[name] = data[name] * 0.0 + sign * 1.02 * gap
    assert named(data, oscillator, **thresholds) == expected


def test_a_primary_resonance_that_is_not_regular_is_unclassified():
    forward, backward = primary()
    data = made(forward, backward, period=np.where(GRID > 1.3, 0, 1))
    assert named(data) == "unclassified"


def test_one_direction_is_not_enough():
    data = made(*primary())
    with pytest.raises(vi.InputError, match="one forward and backward is accepted"):
        evidence(*RIG, data.isel(direction=[0]), 0.01)
    with pytest.raises(vi.InputError, match="is not the sweep of one rig"):
        evidence(*RIG, data.isel(direction=0), 0.01)


def test_every_scenario_has_a_meaning_and_a_label():
    assert [s.label for s in Scenario] == [*(f"S{k}" for k in range(7)), "unclassified"]
    assert len({s.meaning for s in Scenario}) == 8


@pytest.mark.parametrize("value", [0.0, -0.1, 1.5, math.nan, "a", True])
def test_thresholds_are_shares(value):
    with pytest.raises(vi.InputError, match=r"extent: .*greater than 0 and at most 1 is accepted"):
        Thresholds(extent=value)


def test_a_hysteresis_of_motions_that_did_not_settle_is_none():
    """Two windows of wandering motions differ, too."""
    forward, backward = primary()
    wandering = made(forward, backward, period=np.where(inside(1.55, 2.25), 0, 1))
    found = evidence(*RIG, wandering, 0.01)
    assert [item.settled for item in found.hysteresis] == [False]
    assert found.right == ()
    low = np.where(inside(0.66, 0.75), 0.5, 0.0)
    data = made(forward, backward + low, period=np.where(inside(0.6, 0.8), 0, 1))
    assert evidence(*RIG, data, 0.01).left == ()


def test_left_hysteresis_where_contact_begins():
    """It joins the range that is not regular, which has free flight at its foot."""
    forward, backward = primary()
    touching = np.array([GRID > 0.985] * 2) & (np.array([forward, backward]) > 0.25)
    lift = np.where(inside(1.0, 1.2), 0.3, 0.0)
    more = lift + np.where(inside(1.13, 1.2), 0.3, 0.0)
    period = np.where(inside(1.0, 1.12), 3, 1)
    data = made(forward + lift, backward + more, touching=touching, period=period)
    found = evidence(*RIG, data, 0.01)
    assert found.onset == ((1.0, 1.2),)
    assert found.left == ()
    assert named(data) == "S2"


def test_a_regular_peak_where_contact_begins_is_no_secondary_resonance():
    forward, backward = primary()
    touching = np.array([GRID > 0.985] * 2) & (np.array([forward, backward]) > 0.25)
    peak = bump(1.05, 0.04, 0.4)
    data = made(forward + peak, backward + peak, touching=touching)
    assert evidence(*RIG, data, 0.01).secondary == ()
    assert named(data) == "S2"


@pytest.mark.parametrize(("share", "pressed"), [(0.999, False), (0.98, True)])
def test_a_range_that_begins_the_sweep(share, pressed):
    """Whether contact begins there or below: A/ω0² is 0.2966 of free flight's amplitude."""
    gap = share / 0.3 * 0.29665 * GAP
    gap = gap / 0.98 if not pressed else gap
    side = RIG.oscillator.right.replace(gap=gap)
    oscillator = RIG.oscillator.replace(right=side, left=side)
    forward, backward = primary()
    peak = bump(0.5, 0.05, 0.4)
    data = made(forward + peak, backward + peak, period=np.where(inside(0.4, 0.6), 3, 1))
    found = evidence(oscillator, RIG.amplitude, data, 0.01)
    assert bool(found.irregular) == pressed
    assert (found.onset == ()) == pressed


def test_what_lies_above_the_primary_resonance_does_not_count():
    forward = np.where(inside(2.5, 2.8), 0.28, slope(2.2))
    backward = np.where(inside(2.5, 2.8), 0.28, slope(1.6))
    period = np.where(inside(2.5, 2.8), 0, 1)
    data = made(forward, backward, touching=True, period=period)
    found = evidence(*RIG, data, 0.01)
    assert [item.low for item in found.irregular] == [2.5, 2.5]
    assert found.extent(0.01) == 0.0
    assert named(data) == "S2"


def test_a_jump_of_one_direction_alone_is_none():
    """A hysteresis between two frequencies makes both directions jump there."""
    hidden = evidence(*RIG, made(slope(1.6)), 0.01)
    assert hidden.hysteresis == ()
    assert [jump.direction for jump in hidden.jumps] == ["forward", "backward"]
    assert primary_jumps(hidden)
    assert not primary_jumps(hidden._replace(jumps=hidden.jumps[:1]))


def test_a_resonance_that_has_moved_down_is_not_s6():
    smooth = 0.3 + bump(0.8, 0.2, 1.0)
    assert named(made(smooth, touching=smooth > 0.5)) == "unclassified"


def test_free_flight_is_that_at_any_frequency():
    """Of a sweep that does not reach the resonance, too."""
    data = made(*primary()).sel(frequency=slice(1.4, 3.0))
    found = evidence(*RIG, data, 0.01)
    assert found.gap_ratio == pytest.approx(0.3)
    assert not found.within
    assert named(data) == "unclassified"
    assert named(made(*primary()).sel(frequency=slice(0.4, 1.3))) == "unclassified"


def test_holds_without_values():
    data = made(*primary())
    for name in ("eta_a", "eta_d"):
        data[name] = data[name].where(data["direction"] == "forward")
    assert named(data) == "unclassified"
    for name in ("eta_a", "eta_d", "impacts_right", "impacts_left"):
        data[name] = data[name] * np.nan
    assert named(data) == "unclassified"  # not free flight
    nothing = made(*primary(), period=0)
    assert named(nothing) == "unclassified"
