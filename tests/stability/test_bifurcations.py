"""Bifurcations: located to rounding, and only where one can be."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from stability.followed import diagram, remembering, values


@pytest.mark.parametrize("phase", sample([0.0, 2.0], [2.0]))
def test_neimark_sacker_with_a_long_memory(phase):
    """There a pair can cross the unit circle, and beyond it the motion is quasi-periodic."""
    turn = 2 * np.pi
    data = vi.resonance_diagram(
        vi.Rig(remembering(), 1.0), {"frequency": (1.0 / turn, 1.8 / turn)}, phase=phase
    )
    (value,) = values(data, "Neimark-Sacker")
    row = int(np.flatnonzero(data["bifurcation_kind"].values == "Neimark-Sacker")[0])
    pair = data.isel(bifurcation=row)
    modulus = np.hypot(*(pair[f"bifurcation_multiplier_{part}"][0] for part in ("real", "imag")))
    assert float(modulus) == pytest.approx(1.0, abs=1e-9)
    assert abs(float(pair["bifurcation_multiplier_imag"][0])) > 0.1
    beside = [vi.steady(vi.Rig(remembering(), vi.Harmonic(1.0, value * f))) for f in (0.98, 1.02)]
    assert [m["motion"].item() for m in beside] == ["periodic", "quasi-periodic"]


@pytest.mark.parametrize("left", [True, False])
def test_no_pair_passes_the_circle_at_no_damping(left):
    """There all multipliers of elastic bumpers lie on it, to rounding."""
    stop = vi.Bumper(10.0, 0.0, 1.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop if left else None)
    shaken = vi.Harmonic(0.3, 1.3 / (2 * np.pi))
    data = vi.branch(vi.Rig(rig, shaken), vary={"isolator.damping": (0.0, 0.5)})
    assert float(data["isolator.damping"].min()) == 0.0
    assert len(values(data, "Neimark-Sacker")) == 0


def test_grazings_tell_the_contacts_on_both_sides():
    data = diagram("B2-G1-A3", 0.8, 4.0)
    (row,) = np.flatnonzero(data["bifurcation_kind"].values == "grazing")
    contacts = data["bifurcation_contacts"].values[row]
    assert sorted(contacts.split(" | ")) == ["0R 0L", "1R 1L"]


def test_a_fold_beside_a_period_doubling_is_a_fold():
    data = diagram("B3-10mm-A3")
    kinds, periods = data["bifurcation_kind"].values, data["bifurcation_period"].values
    folds = data["bifurcation_value"].values[(kinds == "fold") & (periods == 4)]
    assert np.abs(folds - 1.1050054621).min() < 1e-8
    assert np.abs(folds - 1.0082179154).min() < 1e-8


def test_steps_are_small_and_stability_changes_at_bifurcations_only():
    data = diagram("B3-10mm-A3")
    stable, piece, branch = (data[name].values for name in ("stable", "piece", "branch"))
    within = (branch[:-1] == branch[1:]) & (piece[:-1] == piece[1:])
    both = within & (stable[:-1] >= 0) & (stable[1:] >= 0)
    assert (stable[:-1][both] == stable[1:][both]).all()
    jump = np.abs(np.diff(data["displacement_excursion"].values))[within]
    assert jump.max() < 0.1 * float(data["displacement_excursion"].max())


@pytest.mark.parametrize("mirrored", [False, True])
def test_two_folds_within_a_step(mirrored):
    """Beside a cusp, 2e-5 of a frequency apart; the mirror image is followed by other steps."""
    made = vi.from_dimensionless((60.0, 1.0), (0.15375, 1.0), 0.01, 0.1574)
    rig, amplitude = made.oscillator, made.amplitude
    natural = rig.natural_frequency
    data = vi.branch(
        vi.Rig(rig.mirrored() if mirrored else rig, vi.Harmonic(amplitude, 1.5 * natural)),
        vary={"frequency": (0.4 * natural, 4.0 * natural)},
    )
    low, high = values(data, "fold")[-2:]
    assert high - low < 1e-4 * natural
    np.testing.assert_allclose([low, high], [0.27274430771, 0.27274926534], rtol=1e-9)
