"""Ensembles: against closed forms, the same for one seed, and whatever is responded."""

from __future__ import annotations

import json
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from scipy import stats

import vibroimpact as vi
from vibroimpact.uncertainty.ensemble import CREATED_BY

CASE = vi.laboratory.case("B2-G1-A3")
FREE = vi.Oscillator(550.0, vi.Isolator(26e3, 1.1e3), None, None)
SHAKING = vi.Harmonic(0.5, 2.0)


def swing(stiffness: np.ndarray, frequency: float = 2.0) -> np.ndarray:
    """|u| of free flight: A/|K/M − ω² + iωC/M|."""
    omega = 2.0 * np.pi * frequency
    return 0.5 / np.abs(stiffness / 550.0 - omega**2 + 1j * omega * 1.1e3 / 550.0)


@pytest.mark.parametrize("method", ["sobol", "latin", "random"])
def test_free_flight_on_an_uncertain_spring(method):
    """Above resonance |u| rises with K, so that its fractiles are those of K, mapped."""
    spring = stats.uniform(20e3, 10e3)
    data = vi.ensemble(
        vi.Rig(FREE, SHAKING),
        {"isolator.stiffness": spring},
        partial(vi.sweeps, frequencies=[2.0], directions=["forward"]),
        256,
        method=method,
        seed=4,
    ).isel(direction=0, frequency=0)
    np.testing.assert_allclose(
        data["displacement_max"], swing(data["isolator.stiffness"].values), rtol=1e-9
    )
    # Kolmogorov–Smirnov distance of the amplitudes from their own distribution.
    at = np.sort(data["displacement_max"].values)
    grid = np.linspace(20e3, 30e3, 10_001)
    known = spring.cdf(np.interp(at, swing(grid), grid))
    steps = np.arange(257) / 256
    apart = max(np.abs(steps[1:] - known).max(), np.abs(known - steps[:-1]).max())
    assert apart < {"sobol": 0.01, "latin": 0.01, "random": 0.1}[method]


def test_the_same_seed_gives_the_same_rigs():
    response = partial(vi.sweeps, frequencies=[1.0, 2.0])
    distributions = {"gap": "normal:5%", "stops.stiffness": "lognormal:0.2"}
    one, two, other = (
        vi.ensemble(CASE, distributions, response, 16, seed=seed, block=block)
        for seed, block in ((1, None), (1, 5), (2, 16))
    )
    xr.testing.assert_identical(one, two)
    assert not np.isin(one["gap"], other["gap"]).any()
    assert one["eta_d"].dims == ("sample", "direction", "frequency")
    assert one["gap"].attrs["units"] == "m"
    assert one.attrs["created_by"] == CREATED_BY
    about = json.loads(one.attrs["parameters"])
    assert about["distributions"] == distributions
    assert about["draws"] == 16
    # Each is the sweep of its own rig.
    k = 11
    stop = CASE.oscillator.right.replace(
        gap=float(one["gap"][k]), stiffness=float(one["stops.stiffness"][k])
    )
    rig = CASE.oscillator.replace(right=stop, left=stop)
    alone = vi.sweep(vi.Rig(rig, CASE.amplitude), [1.0, 2.0])
    for name in ("eta_d", "peak_acceleration", "period"):
        np.testing.assert_array_equal(one[name].isel(sample=k), alone[name])


def test_an_uncertain_amplitude_of_what_shakes_it():
    data = vi.ensemble(
        vi.Rig(FREE, SHAKING),
        {"amplitude": "uniform:0.3 m/s^2:0.7 m/s^2"},
        vi.for_each_rig(lambda rig: vi.steady(rig)[["displacement_max", "period"]]),
        4,
    )
    np.testing.assert_allclose(
        data["displacement_max"], swing(26e3) * data["amplitude"] / 0.5, rtol=1e-9
    )
    assert set(data.data_vars) == {"displacement_max", "period"}


def test_of_what_a_record_asks():
    step = 0.01
    quake = vi.Record(np.sin(2.0 * np.pi * 1.0 * step * np.arange(300)), step)
    data = vi.ensemble(
        CASE.oscillator,
        {"gap": stats.uniform(5e-3, 5e-3), "damping_ratio": "lognormal:0.15:0.3"},
        partial(vi.demands, records={"one": quake}, scales=[0.5, 1.0]),
        8,
        method="latin",
    )
    assert data["peak_force"].dims == ("record", "scale", "sample", "stop")
    k = 5
    stop = CASE.oscillator.right.replace(gap=float(data["gap"][k]))
    rig = CASE.oscillator.replace(right=stop, left=stop)
    ratio = float(data["damping_ratio"][k])
    rig = rig.replace(
        isolator=rig.isolator.replace(damping=ratio * CASE.oscillator.critical_damping)
    )
    alone = vi.seismic_response(vi.Rig(rig, quake))
    assert float(data["peak_displacement"][0, 1, k]) == pytest.approx(
        float(alone["peak_displacement"]), rel=1e-12
    )


def test_parameters_that_are_made_of_others_are_set_last():
    data = vi.ensemble(
        vi.Rig(FREE, SHAKING),
        {"damping_ratio": "uniform:0.1:0.2", "isolator.stiffness": "normal:10%"},
        vi.for_each_rig(
            lambda rig: xr.Dataset(
                {"r": rig.oscillator.damping_ratio, "k": rig.oscillator.isolator.stiffness}
            )
        ),
        8,
    )
    np.testing.assert_allclose(data["r"], data["damping_ratio"])
    np.testing.assert_allclose(data["k"], data["isolator.stiffness"])


def test_progress():
    seen = []
    response = partial(vi.sweeps, frequencies=[2.0])
    distributions = {"isolator.stiffness": "normal:1%"}
    vi.ensemble(
        vi.Rig(FREE, SHAKING),
        distributions,
        response,
        8,
        block=3,
        progress=lambda *p: seen.append(p),
    )
    assert seen == [(3, 8), (6, 8), (8, 8)]


def _slowly(seconds, asked):
    """A response that takes so long a rig, by a clock of its own."""
    clock = [0.0]

    def response(rigs):
        asked.append(len(rigs))
        clock[0] += seconds * len(rigs)
        return xr.Dataset({"y": ("rig", np.arange(float(len(rigs))))})

    return response, lambda: clock[0]


@pytest.mark.parametrize(
    ("seconds", "sizes"),
    [(1.0, [64] * 16), (1 / 128, [64, 256, 256, 256, 192]), (1e-5, [64, 512, 448])],
)
def test_rigs_are_asked_for_that_take_a_while(monkeypatch, seconds, sizes):
    asked = []
    response, clock = _slowly(seconds, asked)
    monkeypatch.setattr("vibroimpact.uncertainty.ensemble.time", SimpleNamespace(monotonic=clock))
    data = vi.ensemble(vi.Rig(FREE, SHAKING), {"isolator.stiffness": "normal:1%"}, response, 1024)
    assert asked == sizes
    assert data.sizes["sample"] == 1024


SWEEPS = partial(vi.sweeps, frequencies=[2.0])


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"distributions": {}}, "distributions: "),
        ({"distributions": {"colour": "normal:5%"}}, "distributions: 'colour'"),
        ({"distributions": {"gap": 3.0}}, r"distributions\['gap'\]: 3.0 is not a distribution"),
        ({"distributions": {"cubic": "normal:5%"}}, "distributions: 'cubic' is not a parameter"),
        ({"distributions": {"isolator.damping": "normal:1kN*s/m:1kN*s/m"}}, "gives the value -"),
        (
            {"distributions": {"isolator_period": "normal:5%", "isolator.stiffness": "normal:5%"}},
            "isolator_period and isolator.stiffness set the same quantity; remove one of the two",
        ),
        (
            {"distributions": {"frequency": "normal:5%"}},
            "'frequency' is also the name of a variable",
        ),
        ({"draws": 100}, "draws: 100 is not a power of 2.* such as 128"),
        ({"draws": 0}, "draws"),
        ({"method": "halton"}, "method: 'halton'"),
        ({"seed": -1}, "seed"),
        ({"block": 0}, "block"),
        ({"response": 3}, "response: 3 is not a function"),
        (
            {"response": lambda rigs: vi.sweep(rigs[0], [2.0])},
            "response: the function returns a dataset with the dimensions",
        ),
        (
            {"rig": CASE.oscillator, "distributions": {"amplitude": "normal:5%"}},
            "requires sinusoidal shaking",
        ),
        ({"rig": vi.Rig(FREE, [0.1, 0.2])}, "shaking: a list"),
    ],
)
def test_refused(wrong, message):
    arguments = {"rig": CASE, "distributions": {"gap": "normal:5%"}, "response": SWEEPS, "draws": 4}
    with pytest.raises(vi.InputError, match=message):
        vi.ensemble(**{**arguments, **wrong})


def test_fractiles_over_the_rigs():
    """|u| rises with K: its fractiles are the swing at those of K; NaN is left out, and told."""
    spring = stats.norm(25e3, 1e3)
    response = partial(vi.sweeps, frequencies=[2.0, 2.2], directions=["forward"])
    data = vi.ensemble(vi.Rig(FREE, SHAKING), {"isolator.stiffness": spring}, response, 512)
    fractiles = vi.fractiles(data, "displacement_max", (0.16, 0.5, 0.84))
    assert fractiles["displacement_max"].dims == ("fractile", "direction", "frequency")
    for k, frequency in enumerate((2.0, 2.2)):
        known = swing(spring.ppf([0.16, 0.5, 0.84]), frequency)
        np.testing.assert_allclose(fractiles["displacement_max"][:, 0, k], known, rtol=1e-3)
    # The median of what is left.
    holes = data.assign(
        displacement_max=data["displacement_max"].where(data["isolator.stiffness"] > 25e3)
    )
    with pytest.warns(
        RuntimeWarning,
        match=r"(256 of 512|512 of 1024) values of .* are missing \(NaN\) and were left out",
    ):
        fractiles = vi.fractiles(holes, "displacement_max", [0.5])
    np.testing.assert_allclose(
        fractiles["displacement_max"][0, 0, 0], swing(spring.ppf(0.75)), rtol=1e-3
    )
    # What went beyond all limits is above whatever fractile.
    lost = data.assign(status=data["status"].where(data["isolator.stiffness"] > 25e3, 6))
    fractiles = vi.fractiles(lost, "displacement_max", [0.4, 0.6])["displacement_max"]
    assert np.isfinite(fractiles[0]).all()
    assert np.isinf(fractiles[1]).all()
    with pytest.raises(
        vi.InputError, match=r"quantity: 'colour'; pass one of displacement_excursion, "
    ):
        vi.fractiles(data, "colour")


def test_fractiles_of_a_response_with_a_name_of_its_own():
    response = vi.for_each_rig(lambda rig: xr.Dataset({"k": rig.oscillator.isolator.stiffness}))
    data = vi.ensemble(
        vi.Rig(FREE, SHAKING), {"isolator.stiffness": "uniform:1kN/m:2kN/m"}, response, 256
    )
    assert float(vi.fractiles(data, "k", [0.5])["k"][0]) == pytest.approx(1.5e3, rel=1e-3)
