"""A rig over two parameters."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.engine_system import system_vector
from vibroimpact.stability.parameter_family import RATES
from vibroimpact.stability.two_parameters import plane

CASE = vi.laboratory.case("B2-G1-A3")


@pytest.mark.parametrize(
    ("pair", "independent"),
    [
        (("frequency", "gap"), True),
        (("stiffness_ratio", "gap_ratio"), True),
        (("amplitude", "isolator.damping"), True),
        (("gap", "gap_ratio"), False),
        (("amplitude", "gap_ratio"), False),
        (("isolator.stiffness", "stiffness_ratio"), False),
        (("stops.damping", "stiffness_ratio"), False),
        (("gap", "stops.right.gap"), False),
    ],
)
def test_pairs_of_parameters(pair, independent):
    """Each writes its own numbers of the rig, and its line does not bend with the other."""
    for names in (pair, pair[::-1]):
        if not independent:
            with pytest.raises(vi.InputError, match="not independent"):
                plane(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)), names)
            continue
        made = plane(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)), names)
        p, q = 1.3 * made.family.value, 0.8 * made.value
        rig = vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0))
        there = made.other.vary(made.family.parameter.vary(rig, p), q)
        vector, expected = made.at_vectors(q).system(p), system_vector(there)
        kept = [i for i in range(len(vector)) if i not in RATES]
        np.testing.assert_allclose(vector[kept], expected[kept], rtol=1e-12)
