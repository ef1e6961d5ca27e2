"""Twins that another program made: a general solver with small steps, an uneven rig, noise."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi
from samples import sample

RIGHT, LEFT = (620e3, 1300.0, 8.2e-3), (430e3, 700.0, 6.1e-3)
MASS, STIFFNESS, DAMPING, SIZE = 550.0, 29.3e3, 1300.0, 0.44
TRUE = np.array([STIFFNESS, DAMPING, RIGHT[0], RIGHT[2], LEFT[0], LEFT[2]])


def rate(t, y, omega):
    """The paper's equation 5 written down plainly: u, u', and what either bumper is pressed by."""
    u, v, *pressed = y
    pull, rates = DAMPING * v + STIFFNESS * u, []
    for sign, seat, (k, c, gap) in ((1.0, pressed[0], RIGHT), (-1.0, pressed[1], LEFT)):
        reach = sign * u - gap
        push = k * reach + c * sign * v
        touches = reach >= seat - 1e-12 and push > 0.0
        pull += sign * push if touches else 0.0
        rates.append(sign * v if touches else -seat * k / c)
    return [v, -pull / MASS - SIZE * np.sin(omega * t), *rates]


def made(frequency, cycles, samples):
    omega, period = 2.0 * np.pi * frequency, 1.0 / frequency
    time = np.arange(cycles * samples) * period / samples
    solution = solve_ivp(
        rate, (0.0, time[-1]), np.zeros(4), args=(omega,), t_eval=time, max_step=period / 300,
        rtol=1e-8, atol=1e-11,
    )  # fmt: skip
    base = SIZE * np.sin(omega * time)
    slopes = [rate(t, y, omega)[1] for t, y in zip(time, solution.y.T, strict=True)]
    return time, solution.y[0], np.array(slopes) + base, base


@pytest.mark.full
def test_a_csv_of_a_noisy_history_with_uneven_gaps(tmp_path):
    time, u, acceleration, base = made(1.6, 8, 50)
    draw = np.random.default_rng(2)
    rows = ["time (s),mass rel disp (mm),mass acc (m/s2),table acc (m/s2)"]
    channels = zip(
        time,
        1e3 * (u + 0.01 * u.std() * draw.normal(size=len(u))),
        acceleration + 0.02 * acceleration.std() * draw.normal(size=len(u)),
        base + 0.01 * base.std() * draw.normal(size=len(u)),
        strict=True,
    )
    rows += [",".join(f"{v:.6g}" for v in row) for row in channels]
    path = tmp_path / "history.csv"
    path.write_text("\n".join(rows))
    bumper = vi.Bumper("500 kN/m", "1 kN s/m", "7 mm")
    guess = vi.Oscillator(MASS, vi.Isolator("27 kN/m", "1.1 kN s/m"), bumper, bumper)
    stops = [f"stops.{side}.{name}" for side in ("right", "left") for name in ("stiffness", "gap")]
    dampings = ["stops.right.damping", "stops.left.damping"]
    free = ["isolator.stiffness", "isolator.damping", *stops, *dampings]
    with pytest.warns(vi.InputWarning, match="the displacement of the mass"):
        fit = vi.identify(guess, path, free, profiles=False, tried=0, starts=1)
    values, errors = fit.fitted_value.values, fit.standard_error.values
    assert values[:6] == pytest.approx(TRUE, rel=0.03)
    assert values[6:] == pytest.approx([RIGHT[1], LEFT[1]], rel=0.15)
    true = np.concatenate([TRUE, [RIGHT[1], LEFT[1]]])
    assert (np.abs(values - true) < 3.0 * errors).all()


def test_frequencies_that_were_held_twice_count_twice(tmp_path):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    swept = vi.sweep(case, np.round(np.arange(1.0, 3.6, sample(0.2, 0.5)), 10), "forward")
    draw = np.random.default_rng(1)
    rows = ["f (Hz),sweep,Ed (mm),Ea (m/s2)"]
    for _ in range(2):
        for f in swept.frequency.values[::-1]:
            one = swept.sel(frequency=f, direction="forward")
            d, a = draw.normal(1.0, 0.01, 2) * [
                1e3 * float(one.displacement_excursion), float(one.acceleration_excursion)
            ]  # fmt: skip
            rows.append(f"{f},up,{d:.5f},{'nan' if f == 1.0 else f'{a:.5f}'}")
    path = tmp_path / "twice.csv"
    path.write_text("\n".join(rows))
    fit = vi.identify(
        vi.Rig(case.oscillator, case.amplitude),
        path,
        "isolator.stiffness,gap",
        tried=0,
        starts=1,
        profiles=False,
    )
    assert fit.sizes["point"] == 2 * (2 * swept.sizes["frequency"] - 1)
    assert fit.fitted_value.values == pytest.approx([31.9e3, 0.01], rel=0.01)
