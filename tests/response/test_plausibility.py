"""Gaps that a motion shows to be absurd, and damping ratios that were meant in percent."""

import numpy as np
import pytest

import vibroimpact as vi

RIG = vi.Oscillator("5000 t", vi.Isolator.from_period("5000 t", "2.5 s", 0.15))
SLIDING = vi.Oscillator("5000 t", vi.FrictionIsolator("30 MN/m", "4 MN s/m", "100 kN"))
WALL = vi.Bumper("500 MN/m", "5 MN s/m", 250.0)
RECORD = vi.Record(0.3 * np.sin(2.5 * np.arange(0.0, 8.0, 0.02)), 0.02)
FREE, FOUND = "displacement of free flight, 523.4 mm", r"displacement that was found, \d.* mm"


@pytest.mark.parametrize(
    ("of", "rig", "whose"),
    [
        (lambda rig: vi.sweep(vi.Rig(rig, "0.1 g"), [0.3, 0.4]), RIG, FREE),
        (lambda rig: vi.sweep(vi.Rig(rig, "0.1 g"), [0.3, 0.4]), SLIDING, FOUND),
        (lambda rig: vi.steady(vi.Rig(rig, vi.Harmonic("0.1 g", 0.4))), RIG, FREE),
        (lambda rig: vi.steady(vi.Rig(rig, vi.Harmonic("0.1 g", 0.4))), SLIDING, FOUND),
        (lambda rig: vi.seismic_response(vi.Rig(rig, RECORD)), RIG, FOUND),
    ],
    ids=["sweep", "sweep sliding", "steady", "steady sliding", "seismic_response"],
)
def test_a_gap_of_metres_that_were_millimetres_is_doubted(of, rig, whose):
    told = rf"^gap: 250 m is \d+.* times the largest {whose}; is 250 mm meant\?$"
    with pytest.warns(vi.InputWarning, match=told) as warned:
        data = of(rig.replace(right=WALL))
    assert f"gap: {data.attrs['notes']}" == str(warned[0].message)
    # Neither a gap of the motion's size nor one far beyond it whatever its unit.
    for gap in (0.25, 5.0, 1e5):
        assert "notes" not in of(rig.replace(right=WALL.replace(gap=gap))).attrs


def test_a_damping_ratio_of_percent_is_doubted():
    told = r"damping_ratio: 15 is 15 times the critical damping; was 15 % meant\?"
    with pytest.warns(vi.InputWarning, match=f"^{told}$"):
        made = vi.Isolator.from_period("5000 t", "2.5 s", 15)
    assert vi.Oscillator("5000 t", made).damping_ratio == pytest.approx(15.0)
    with pytest.warns(vi.InputWarning, match=r"^vary\['damping_ratio'\]: 10 is 10 times"):
        vi.design_chart(
            RIG.replace(right=WALL.replace(gap=0.05)),
            {"damping_ratio": [0.1, 10.0]},
            records=RECORD,
        )
    vi.Isolator.from_period("5000 t", "2.5 s", 1.5)
    vi.Isolator.from_period("5000 t", "2.5 s", "15 %")
