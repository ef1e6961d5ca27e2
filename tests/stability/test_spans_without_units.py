"""Functions of a rig without units refuse values with a unit, in one line."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import vibroimpact as vi

STATED = vi.Rig(
    vi.Oscillator(3, vi.Isolator(2, 0.3), vi.Bumper(40, 1, 2), units="none"),
    vi.Harmonic(0.5, 0.2),
)
ONES = vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1), vi.Bumper(20, 0.5, 2)), vi.Harmonic(0.5, 0.2))
SI = vi.Rig(STATED.oscillator.replace(units="SI"), STATED.shaking)
BOX = {"velocity": (-1, 1)}

CALLS = {
    "branch": lambda rig, five: vi.branch(rig, vary={"gap": (0, five)}),
    "branch of a damping": lambda rig, five: vi.branch(
        rig, vary={"isolator.damping": (0.2, five.replace("m", "N s/m"))}
    ),
    "bifurcation_diagram": lambda rig, five: vi.bifurcation_diagram(rig, {"gap": (five, 6)}, 2),
    "bifurcation_curve": lambda rig, five: vi.bifurcation_curve(
        rig,
        vi.branch(rig, vary={"frequency": (0.05, 0.2)}).isel(bifurcation=0),
        vary={"frequency": (0.05, 0.2), "gap": (0, five)},
    ),
    "basins": lambda rig, five: vi.basins(rig, (0, five), nodes=2, **BOX),
    "basin_stability": lambda rig, five: vi.basin_stability(rig, (-5, five), states=2, **BOX),
    "scenario_map": lambda rig, five: vi.scenario_map(
        rig, {"gap": [1, five], "gap_ratio": [0.5, 1.0]}
    ),
    "ensemble": lambda rig, five: vi.ensemble(
        rig, {"gap": f"uniform:0:{five}"}, partial(vi.sweeps, frequencies=[0.1]), draws=2
    ),
    "simulate": lambda rig, five: vi.simulate(
        vi.Rig(rig.oscillator, vi.Record(np.ones(9), 0.1)), tail=five.replace("m", "s")
    ),
}


@pytest.mark.parametrize("rig", [STATED, ONES], ids=["stated", "ones"])
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_a_value_with_a_unit_is_refused(call, rig):
    with pytest.raises(vi.InputError, match="has a unit, but the rig has none") as refused:
        call(rig, "5 m")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("call", [CALLS["branch"], CALLS["basins"], CALLS["ensemble"]])
def test_the_same_rig_in_si_units_accepts_it(call):
    call(SI, "5 m")


def test_frequencies_have_units_of_any_rig(tmp_path):
    assert (
        vi.resonance_diagram(STATED, {"frequency": ("0.6 rad/s", "0.11 Hz")}).unit_system == "none"
    )


def test_a_study_file_without_units_counts_too(tmp_path):
    path = tmp_path / "bare.toml"
    path.write_text(
        '[oscillator]\nmass = 3\nunits = "none"\nisolator = { stiffness = 2, damping = 0.3 }\n'
        "right = { stiffness = 40, damping = 1, gap = 2 }\n[excitation]\namplitude = 0.5\n"
    )
    for source in (path, str(path)):
        with pytest.raises(vi.InputError, match="has a unit, but the rig has none"):
            vi.branch(source, frequency=0.2, vary={"gap": ("5 mm", 3)})
        with pytest.raises(vi.InputError, match="has a unit, but the rig has none"):
            vi.branch(rig=source, frequency=0.2, vary={"gap": ("5 mm", 3)})
