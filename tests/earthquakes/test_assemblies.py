"""Records on assemblies: one mass, modal superposition, floors, demands and required gaps."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize_scalar

import vibroimpact as vi
from response.test_assembly_motion import BUMPER, QUAKE, neighbours, one_mass

LIVELY = vi.RigidStop(0.9, 5e-3)
SIDES = ("right", "left")


@pytest.mark.parametrize("stops", [(BUMPER, BUMPER), (BUMPER, LIVELY)], ids=["bumpers", "wall"])
def test_the_response_of_one_mass_is_the_oscillators(stops: tuple[object, object]) -> None:
    single, assembly = one_mass(*stops, force=40.0)
    one, several = (vi.seismic_response(vi.Rig(x, QUAKE), tail=1.0) for x in (single, assembly))
    for name in ("peak_displacement", "peak_acceleration", "total_supplied"):
        assert several[name].item() == pytest.approx(one[name].item(), rel=1e-11)
    for side in SIDES:
        for name in ("peak_force", "impulse", "impact_count"):
            mine = several[name].sel(stop=side).item()
            assert mine == pytest.approx(one[name].sel(stop=side).item(), rel=1e-11)
    assert several["drift_max"].item() == pytest.approx(one["displacement_max"].item())
    assert several["total_links"].item() == pytest.approx(one["total_isolator"].item(), rel=1e-11)
    lost = several["total_stops"].sum().item()
    assert lost == pytest.approx(one["total_bumpers"].item(), rel=1e-11)
    balance = several["total_supplied"] - several["total_stored"] - several["total_damping"]
    assert balance.item() == pytest.approx(several["total_links"].sum().item() + lost, rel=1e-11)
    # The default tail is the same, too.
    ends = [vi.seismic_response(vi.Rig(x, QUAKE)) for x in (single, assembly)]
    assert ends[1]["peak_acceleration"].item() == pytest.approx(
        ends[0]["peak_acceleration"].item(), rel=1e-11
    )


def oscillation(omega: float, ratio: float, record: vi.Record) -> np.ndarray:
    """Displacement and velocity of a mode at each sample: exact for straight lines."""
    decay, turning = ratio * omega, omega * math.sqrt(1.0 - ratio**2)
    state, states = np.zeros(2), [np.zeros(2)]
    for a, b in zip(record.acceleration[:-1], record.acceleration[1:], strict=True):
        states.append(
            state := along(state, a, (b - a) / record.step, omega, decay, turning, record.step)
        )
    return np.array(states)


def along(
    state: np.ndarray, a: float, slope: float, omega: float, decay: float, turning: float, t: float
) -> np.ndarray:
    """q″ + 2 δ q′ + ω² q = −(a + slope t), in closed form."""
    particular = slope / omega**2
    still = a / omega**2 - 2.0 * decay * slope / omega**4
    x, v = state[0] + still, state[1] + particular
    e, c, s = math.exp(-decay * t), math.cos(turning * t), math.sin(turning * t)
    p = (v + decay * x) / turning
    u = e * (x * c + p * s)
    rate = e * ((p * turning - decay * x) * c - (x * turning + decay * p) * s)
    return np.array([u - still - particular * t, rate - particular])


def test_peaks_without_contact_are_those_of_modal_superposition() -> None:
    tower = vi.chain([3.0, 2.0, 1.5], [900.0, 700.0, 400.0], damping_ratio=0.03)
    response = vi.seismic_response(vi.Rig(tower, QUAKE), tail=0.0)
    modes = vi.modes(tower)
    shapes = modes["mode_shape"].values * modes["participation_factor"].values[:, np.newaxis]
    omegas = 2.0 * math.pi * modes["natural_frequency"].values
    states = np.array([oscillation(w, 0.03, QUAKE) for w in omegas])
    displacement = np.einsum("jt,ji->it", states[..., 0], shapes)
    drift = np.diff(displacement, axis=0, prepend=0.0)

    def at(weights: np.ndarray, line: int, t: float) -> float:
        a, b = QUAKE.acceleration[line : line + 2]
        parts = [
            along(
                states[j, line], a, (b - a) / QUAKE.step, w, 0.03 * w, w * math.sqrt(1 - 9e-4), t
            )[0]
            for j, w in enumerate(omegas)
        ]
        return abs(float(np.array(parts) @ weights))

    for name, values, of in (
        ("peak_displacement", displacement, shapes),
        ("peak_drift", drift, np.diff(shapes, axis=1, prepend=0.0)),
    ):
        for i, sampled in enumerate(values):
            top = int(abs(sampled).argmax())
            peak = max(
                -minimize_scalar(
                    lambda t, i=i, line=line, of=of: -at(of[:, i], line, t),
                    bounds=(0.0, QUAKE.step),
                    method="bounded",
                    options={"xatol": 1e-12},
                ).fun
                for line in (top - 1, top)
            )
            assert response[name].values[i] == pytest.approx(peak, rel=1e-12)


def test_peaks_by_tables_are_those_of_whole_phases() -> None:
    """`demands` leaves out what widens no range, `seismic_response` measures every stretch."""
    for system in (neighbours(), vi.chain([3.0] * 4, [900.0] * 4, 0.02)):
        peaks = vi.seismic_response(vi.Rig(system, QUAKE), tail=1.0)
        demands = vi.demands(system, QUAKE, tail=1.0, threads=1).isel(record=0, scale=0)
        for name in ("peak_displacement", "peak_acceleration", "peak_drift", "displacement_min",
                     "drift_max", "impulse", "peak_force", "peak_transmitted_force"):  # fmt: skip
            np.testing.assert_allclose(demands[name], peaks[name], rtol=1e-12)
        assert (demands["impact_count"] == peaks["impact_count"]).all()


def test_demands_are_those_of_the_oscillator() -> None:
    single, assembly = one_mass(BUMPER, LIVELY)
    records = {"quake": QUAKE, "half": QUAKE.scaled(0.5)}
    gaps = {"right.gap": [5e-3, 9e-3]}
    one = vi.demands(single, records, ["1 m/s2", "3 m/s2"], intensity="PGA", vary=gaps, tail=1.0)
    several = vi.demands(
        assembly,
        records,
        ["1 m/s2", "3 m/s2"],
        intensity="PGA",
        vary={"stops.right.gap": [5e-3, 9e-3]},
        tail=1.0,
    )
    assert several["peak_force"].dims == ("record", "scale", "stops.right.gap", "stop")
    assert several["stops.right.gap"].attrs["units"] == "m"
    assert (several["status"] == 0).all()
    for side in SIDES:
        for name in ("peak_force", "impulse", "impact_count"):
            np.testing.assert_allclose(
                several[name].sel(stop=side).values, one[name].sel(stop=side).values, rtol=1e-9
            )
    np.testing.assert_allclose(
        several["peak_acceleration"].values[..., 0], one["peak_acceleration"].values, rtol=1e-9
    )
    mine, theirs = (vi.fractiles(x, "peak_acceleration") for x in (several, one))
    np.testing.assert_allclose(
        mine["peak_acceleration"].values[..., 0], theirs["peak_acceleration"].values, rtol=1e-9
    )


def test_demands_of_neighbours_have_fragilities_by_stop() -> None:
    records = [QUAKE.scaled(factor) for factor in (0.5, 0.8, 1.0, 1.3, 1.7)]
    demands = vi.demands(neighbours(), records, np.geomspace(0.05, 1.5, 6))
    assert demands["impact_count"].sizes == {"record": 5, "scale": 6, "stop": 2}
    alone = vi.seismic_response(vi.Rig(neighbours(), records[2].scaled(1.5)))
    for name in ("peak_drift", "peak_displacement", "impulse"):
        np.testing.assert_allclose(demands[name].values[2, -1], alone[name].values, rtol=1e-11)
    share = vi.exceedance(demands, "impact_count.between")["probability"]
    assert share.dims == ("scale",)
    one_link = vi.fragility(demands, "peak_drift.low", "12 mm")
    fitted = vi.fragility(demands, "peak_drift", "12 mm")
    assert fitted["median_capacity"].dims == ("link",)
    assert one_link["median_capacity"].item() == fitted["median_capacity"].sel(link="low").item()
    assert np.isfinite(fitted["median_capacity"]).any()


def test_floor_records_of_each_mass() -> None:
    single, assembly = one_mass(BUMPER, LIVELY)
    one, several = (vi.simulate(vi.Rig(x, QUAKE), samples=4) for x in (single, assembly))
    np.testing.assert_allclose(
        vi.floor_record(several, "m").acceleration,
        vi.floor_record(one).acceleration,
        rtol=0,
        atol=1e-8,
    )
    # Of smooth motions, the weighted mean is the acceleration to second order.
    tower = vi.chain([3.0, 2.0], [900.0, 700.0], damping_ratio=0.03)
    motion = vi.simulate(vi.Rig(tower, QUAKE), samples=64)
    for mass in ("floor_1", "floor_2"):
        floor = vi.floor_record(motion, mass)
        exact = motion["acceleration"].sel(mass=mass).values
        np.testing.assert_allclose(
            floor.acceleration[1:], exact[1:-1], atol=1e-3 * abs(exact).max()
        )
    with pytest.raises(vi.InputError, match=r"^mass: missing; pass one of floor_1, floor_2"):
        vi.floor_record(motion)
    with pytest.raises(vi.InputError, match=r"^mass: 'm', but an Oscillator has only one"):
        vi.floor_record(one, "m")


SINES = [
    vi.Harmonic("1 m/s2", 1.0),
    vi.Harmonic("3 mm", 1.0),
    vi.Harmonic("200 N", 1.0),
    vi.Harmonic("2 kg m", 1.0),
]


@pytest.mark.parametrize("sine", SINES, ids=lambda one: one.of)
@pytest.mark.parametrize("span", [None, (0.2, 0.9), (1.5, 4.0)])
def test_required_gaps_of_one_mass(sine: vi.Harmonic, span: tuple[float, float] | None) -> None:
    single, assembly = one_mass(BUMPER, BUMPER, force=300.0)
    one = vi.required_gap(vi.Rig(single, sine), span and {"frequency": span})
    several = vi.required_gap(vi.Rig(assembly, sine), span and {"frequency": span})
    for side in SIDES:
        assert float(several["required_gap"].sel(stop=side)) == pytest.approx(
            float(one["required_gap"].sel(stop=side)), rel=1e-9
        )


def test_required_gaps_for_records() -> None:
    single, assembly = one_mass(BUMPER, LIVELY)
    records = {str(i): QUAKE.scaled(0.5 + 0.3 * i) for i in range(4)}
    one, several = (vi.required_gap(x, records=records, fractile=0.7) for x in (single, assembly))
    for side in SIDES:
        assert float(several["required_gap"].sel(stop=side)) == pytest.approx(
            float(one["required_gap"].sel(stop=side)), rel=1e-11
        )
    # With this gap nothing meets, and with a smaller one something does.
    gap = vi.required_gap(neighbours(), records=QUAKE)["required_gap"]
    for factor, met in ((1.0 + 1e-9, False), (1.0 - 1e-6, True)):
        for stop in gap["stop"].values:
            law = neighbours().stops[stop].law.replace(gap=factor * float(gap.sel(stop=stop)))
            link = neighbours().stops[stop]
            alone = neighbours().replace(stops={stop: vi.Link(link.left, link.right, law)})
            response = vi.seismic_response(vi.Rig(alone, QUAKE))
            assert (response["impact_count"].item() > 0) == met


def test_neighbours_of_equal_modes_never_meet() -> None:
    """Their distance obeys an equation without forcing."""
    k, c, ratio = 300.0, 2.0, 1.7
    pair = vi.Assembly(
        {"a": 2.0, "b": 2.0 * ratio},
        {
            "a": vi.Link("ground", "a", vi.Isolator(k, c)),
            "b": vi.Link("ground", "b", vi.Isolator(k * ratio, c * ratio)),
        },
        {"between": vi.Link("a", "b", vi.Bumper(1e4, 10.0, 0.01))},
    )
    for keywords in ({"records": QUAKE}, {}):
        rig = pair if keywords else vi.Rig(pair, vi.Harmonic("1 m/s2", 1.0))
        gap = float(vi.required_gap(rig, **keywords)["required_gap"][0])
        assert abs(gap) < 1e-14


class _KilledError(Exception):
    pass


def test_stored_demands_are_resumed(tmp_path: Path) -> None:
    rigs = {"soft": neighbours(), "hard": neighbours().replace(forces={})}
    records = [vi.Record(QUAKE.acceleration[:n], QUAKE.step) for n in (60, 80, 100)]
    arguments, how = (rigs, records, [0.5, 1.0]), {"vary": {"gap": [0.01, 0.02, 0.03]}, "block": 2}
    whole = vi.demands(*arguments, **how)
    assert whole["peak_drift"].dims == ("record", "scale", "rig", "gap", "link")
    alone = vi.demands(rigs["hard"], records[1], [0.5, 1.0], vary={"gap": [0.02]})
    for name in ("peak_displacement", "peak_force", "peak_transmitted_force"):
        one = whole[name].isel(record=1, rig=1, gap=1)
        np.testing.assert_array_equal(one, alone[name].isel(record=0, gap=0))

    def kill(done: int, total: int) -> None:
        if done > total // 2:
            raise _KilledError

    with pytest.raises(_KilledError):
        vi.demands(*arguments, **how, store=tmp_path / "demands", progress=kill)
    held = xr.open_zarr(tmp_path / "demands", consolidated=False)
    assert 0 < int((held["status"] == 0).sum()) < held["status"].size
    again = vi.demands(*arguments, **how, store=tmp_path / "demands")
    for name in whole.data_vars:
        np.testing.assert_array_equal(whole[name], again[name])
    third = vi.demands(*arguments, **how, store=tmp_path / "demands", progress=lambda *_: 1 / 0)
    assert third.identical(again)


def test_wrong_arguments() -> None:
    rig = neighbours()
    single, _ = one_mass(BUMPER, None)
    with pytest.raises(vi.InputError, match=r"^rig\['one'\]: an Oscillator beside an Assembly"):
        vi.demands({"two": rig, "one": single}, QUAKE)
    other = vi.chain([1.0], [30.0])
    with pytest.raises(vi.InputError, match=r"^rig\['b'\]: its mass names are floor_1, not those"):
        vi.demands({"a": rig, "b": other}, QUAKE)
    with pytest.raises(vi.InputError, match=r"^rig: the assembly has no stops, so no gap"):
        vi.required_gap(other, records=QUAKE)
    undamped = vi.chain([1.0], [30.0], stops={"x": vi.Link("floor_1", "ground", BUMPER)})
    undamped = undamped.replace(damping=None)
    with pytest.raises(vi.InputError, match="grows without bound, so no gap is wide enough"):
        vi.required_gap(vi.Rig(undamped, vi.Harmonic("1 m/s2", 1.0)))
