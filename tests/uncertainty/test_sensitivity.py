"""Sobol's indices against closed forms."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
import xarray as xr
from scipy import stats

import vibroimpact as vi
from samples import sample

RIG = vi.Oscillator(1.0, vi.Isolator(2.0, 1.0), vi.Bumper(1.0, 0.1, 1.0), None)
TURN = stats.uniform(-np.pi, 2.0 * np.pi)


def ishigami(rigs: list[vi.Rig]) -> xr.Dataset:
    """sin x1 + 7 sin² x2 + 0.1 x3⁴ sin x1 of three numbers of a rig, and twice that."""
    drawn = [rig.oscillator for rig in rigs]
    x = np.array([(r.force, r.right.gap, r.isolator.damping - np.pi) for r in drawn]).T
    y = np.sin(x[0]) + 7.0 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])
    return xr.Dataset({"y": (("rig", "multiple"), np.outer(y, [1.0, 2.0]))})


def test_ishigami():
    """Closed form of Ishigami and Homma (1990): a = 7, b = 0.1."""
    seen = []
    indices = vi.sensitivity(
        vi.Rig(RIG, 1.0),
        {"force": TURN, "gap": TURN, "isolator.damping": stats.uniform(0.0, 2.0 * np.pi)},
        ishigami,
        "y",
        sample(4096, 1024),
        resamples=50,
        block=4096,
        progress=lambda *p: seen.append(p),
    )
    a, b, pi = 7.0, 0.1, np.pi
    parts = np.array([0.5 * (1.0 + b * pi**4 / 5.0) ** 2, a**2 / 8.0, 0.0])
    both = 8.0 * b**2 * pi**8 / 225.0
    whole = parts.sum() + both
    first, total = parts / whole, (parts + np.array([both, 0.0, both])) / whole
    assert list(indices["uncertain_parameter"].values) == ["force", "gap", "isolator.damping"]
    for name, known in (("first_order", first), ("total_order", total)):
        assert indices[name].dims == ("multiple", "uncertain_parameter")
        for k in range(2):
            np.testing.assert_allclose(indices[name][k], known, atol=0.06)
        interval = indices[f"{name}_interval"]
        assert (interval[..., 0] <= indices[name] + 1e-12).all()
        assert (indices[name] <= interval[..., 1] + 1e-12).all()
        assert ((interval[..., 1] - interval[..., 0]) < 0.3).all()
    np.testing.assert_allclose(indices["variance"], whole * np.array([1.0, 4.0]), rtol=0.03)
    np.testing.assert_allclose(indices["mean"], 3.5 * np.array([1.0, 2.0]), rtol=0.03)
    count = sample(4096, 1024)
    assert seen[-1] == (5 * count, 5 * count)


def test_near_the_static_limit():
    """|u| → M A/K far below resonance: of ln |u| K makes all, and the damping nothing."""
    rig = RIG.replace(right=None)

    def response(rigs):
        data = vi.sweeps(rigs, [1e-3], ["forward"])
        return np.log(data[["peak_displacement"]].isel(direction=0, frequency=0))

    spread = {
        "isolator.stiffness": "lognormal:0.1",
        "amplitude": "lognormal:0.2",
        "isolator.damping": "normal:5%",
    }
    indices = vi.sensitivity(vi.Rig(rig, 1.0), spread, response, "peak_displacement", 256)
    np.testing.assert_allclose(indices["first_order"], [0.2, 0.8, 0.0], atol=0.02)
    np.testing.assert_allclose(indices["total_order"], [0.2, 0.8, 0.0], atol=0.02)
    np.testing.assert_allclose(indices["variance"], 0.05, rtol=0.05)
    again = vi.sensitivity(vi.Rig(rig, 1.0), spread, response, "peak_displacement", 256)
    xr.testing.assert_identical(indices, again)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"quantity": "colour"}, "quantity: 'colour' is unknown; use displacement_excursion, "),
        ({"draws": 100}, "draws: 100"),
        ({"resamples": -1}, "resamples"),
        ({"seed": 0.5}, "seed"),
    ],
)
def test_refused(wrong, message):
    arguments = {
        "rig": vi.Rig(RIG, 1.0),
        "distributions": {"gap": "normal:5%"},
        "response": partial(vi.sweeps, frequencies=[0.3]),
        "quantity": "eta_d",
        "draws": 2,
    }
    with pytest.raises(vi.InputError, match=message):
        vi.sensitivity(**{**arguments, **wrong})
