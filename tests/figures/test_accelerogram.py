"""Records and response spectra, drawn."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import accelerogram, response_spectra, save_figure

RECORD = vi.Record(np.sin(np.arange(60) / 5.0) * np.hanning(60) - 0.01, 0.1)
PERIODS = [0.0, 0.1, 0.5, 1.0, 2.0]


def test_the_record_with_its_peak_above_its_spectrum(tmp_path):
    spectrum = vi.response_spectrum(RECORD, PERIODS, [0.0, 0.05])
    axes = accelerogram(RECORD, spectrum, title="made up")
    assert len(axes) == 2
    line, marked = axes[0].lines[1:3]
    np.testing.assert_array_equal(line.get_ydata(), RECORD.acceleration)
    assert marked.get_xdata() == [RECORD.peak_time]
    assert abs(marked.get_ydata()[0]) == RECORD.peak
    assert f"at {RECORD.peak_time:g} s" in axes[0].texts[0].get_text()
    assert "m/s²" in axes[0].get_ylabel()
    assert axes[1].get_xlabel() == "natural period (s)"
    for i, curve in enumerate(axes[1].lines):
        np.testing.assert_array_equal(curve.get_xdata(), PERIODS[1:])
        expected = spectrum["pseudo_acceleration"].isel(damping_ratio=i).values[1:]
        np.testing.assert_array_equal(curve.get_ydata(), expected)
    words = [text.get_text() for text in axes[1].get_legend().get_texts()]
    assert words == ["$\\zeta$ = 0", "$\\zeta$ = 0.05"]
    assert len({curve.get_linestyle() for curve in axes[1].lines}) == 2
    assert save_figure(axes, tmp_path / "record.png").is_file()
    (alone,) = accelerogram(RECORD)
    assert len(alone.lines) == 3


def test_spectra_of_several_records_by_name():
    first, second = (vi.response_spectrum(RECORD.scaled(k), PERIODS, [0.02, 0.05]) for k in (1, 2))
    ax = response_spectra({"one": first, "two": second})
    assert [line.get_label() for line in ax.lines] == [
        *("one, $\\zeta$ = 0.02", "one, $\\zeta$ = 0.05"),
        *("two, $\\zeta$ = 0.02", "two, $\\zeta$ = 0.05"),
    ]
    assert [line.get_color() for line in ax.lines] == ["black", "black", "#c8102e", "#c8102e"]
    assert len({line.get_linestyle() for line in ax.lines}) == 2
    expected = second["pseudo_acceleration"].isel(damping_ratio=1).values[1:]
    np.testing.assert_array_equal(ax.lines[3].get_ydata(), expected)
    with pytest.raises(vi.InputError, match=r"^spectrum\['one'\]: this is a Record; pass"):
        response_spectra({"one": RECORD})
    with pytest.raises(vi.InputError, match=r"^spectrum: empty; pass"):
        response_spectra({})
    with pytest.raises(vi.InputError, match=r"^record: a mapping of records; call response_spec"):
        vi.response_spectrum({"one": RECORD}, PERIODS)


def test_what_is_refused():
    spectrum = vi.response_spectrum(RECORD, PERIODS)
    with pytest.raises(vi.InputError, match=r"^record: an object of type ndarray; pass a Record"):
        accelerogram(RECORD.acceleration)
    with pytest.raises(vi.InputError, match=r"^axes: 1 Axes; pass 2"):
        accelerogram(RECORD, spectrum, [response_spectra(spectrum)])
    for other in (vi.response_spectrum(RECORD, 1.0), spectrum["pseudo_velocity"], None):
        with pytest.raises(vi.InputError, match=r"^spectrum: this is not a response spectrum"):
            response_spectra(other)
    with pytest.raises(
        vi.InputError, match=r"^quantity: 'x' is unknown; use spectral_displacement, "
    ):
        response_spectra(spectrum, quantity="x")
    many = vi.response_spectrum(RECORD, PERIODS, np.linspace(0.0, 0.5, 26))
    with pytest.raises(vi.InputError, match=r"^spectrum: 26 curves; at most 25"):
        response_spectra(many)
