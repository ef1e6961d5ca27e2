"""The figure of exponents: what is drawn is what the dataset holds."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import exponent_curves


def test_over_a_parameter_of_two_rigs():
    rigs = ["B3-10mm-A3", "B2-G1-A3"]
    data = vi.lyapunov_exponents(rigs, [1.1], 64, vary={"gap": [3e-3, 4e-3, 5e-3]})
    ax = exponent_curves(data)
    curves = [line for line in ax.lines if len(line.get_xdata()) == 3]
    known = data["exponents"].squeeze("frequency").transpose("rig", "exponent", "gap").values
    np.testing.assert_array_equal([line.get_ydata() for line in curves], known.reshape(4, 3))
    np.testing.assert_allclose(curves[0].get_xdata(), [3.0, 4.0, 5.0])
    assert ax.get_xlabel() == "gap of each side (mm)"
    assert ax.get_ylabel().endswith("(1/s)")
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels[:2] == ["B3-10mm-A3, largest", "B3-10mm-A3, second"]


def test_of_a_bifurcation_diagram_and_over_the_frequency():
    diagram = vi.bifurcation_diagram("B3-10mm-A3", {"gap": (4.8e-3, 5e-3)}, 3, frequency=1.12)
    ax = exponent_curves(diagram.sel(start="up"))
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), diagram["exponents"][0, :, 0])
    ax = exponent_curves(vi.lyapunov_exponents("B2-G1-A3", [1.0, 2.0], 64), title="two")
    assert ax.get_xlabel() == "excitation frequency (Hz)"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (lambda: vi.sweep("B2-G1-A3", [1.0]), "data: it has no exponents"),
        (lambda: vi.lyapunov_exponents("B2-G1-A3", [1.0], 32), "there is one set of exponents"),
        (
            lambda: vi.lyapunov_exponents("B2-G1-A3", [1.0, 2.0], 32, vary={"gap": [1e-3, 2e-3]}),
            "depend on frequency, gap",
        ),
    ],
)
def test_refused(data, message):
    with pytest.raises(vi.InputError, match=message):
        exponent_curves(data())
