"""The report of a fit holds what was found, and its study file is the fitted rig."""

import numpy as np
import pytest

import vibroimpact as vi
from identification.twins import curves
from vibroimpact.cli.study import read_study
from vibroimpact.figures import fit_history, fit_profiles, fit_residuals
from vibroimpact.identification.comparison import hertzian, softening
from vibroimpact.model.study import study_text
from vibroimpact.reports.identification import measured_of, parameter_rows


@pytest.fixture(scope="module")
def case():
    return vi.laboratory.case("B2-G2-A2", "identified")


@pytest.fixture(scope="module")
def data(case):
    return curves(case.oscillator, case.amplitude, 0.02, seed=3)


@pytest.fixture(scope="module")
def fit(case, data):
    return vi.identify(case.oscillator, data, "stops.stiffness,stops.damping", tried=0, starts=1)


def test_the_report_and_the_rig(fit, tmp_path):
    files = vi.fit_report(fit, tmp_path, "twin")
    text = files["markdown"].read_text()
    for row in parameter_rows(fit):
        assert " | ".join(row) in text
    for line in fit.attrs["findings"].splitlines():
        assert line in text
    html = files["report"].read_text()
    assert html.count("<img") == text.count("![") == 3
    for name in ("curves", "residuals", "profiles"):
        assert (tmp_path / f"twin-{name}.png").stat().st_size > 5000
        assert f'src="twin-{name}.png"' in html
    study = read_study(files["study twin"])
    assert study.oscillator == vi.fitted_rig(fit).oscillator
    assert study.excitation.amplitude == vi.fitted_rig(fit).amplitude


def test_a_study_file_of_any_law(case, tmp_path):
    rig = softening(hertzian(case.oscillator, 3e-3)).replace(left=vi.RigidStop(0.5, "9 mm"))
    path = tmp_path / "any.toml"
    path.write_text(
        study_text(vi.Rig(rig, 0.4, name='a "name"'), "first\nsecond"), encoding="utf-8"
    )
    assert read_study(path).oscillator == rig
    assert read_study(path).name == 'a "name"'


def test_points_become_curves_again(fit, data):
    again = measured_of(fit, "test 1")
    for name in ("displacement_excursion", "acceleration_excursion"):
        assert again[name].values == pytest.approx(data[name].values)


def test_figures_of_a_fit(fit):
    (ax,) = fit_residuals(fit)
    drawn = np.concatenate([line.get_ydata() for line in ax.lines[1:]])
    assert np.sort(drawn) == pytest.approx(np.sort(fit.fit_residual.values / fit.noise.values[0]))
    panels = fit_profiles(fit)
    assert [ax.get_xlabel().split(" (")[0] for ax in panels] == [
        "stops.stiffness",
        "stops.damping",
    ]
    with pytest.raises(vi.InputError, match="has no time history"):
        fit_history(fit)
    with pytest.raises(vi.InputError, match="not a fit"):
        fit_residuals(fit[["fitted_value"]])


def test_the_next_test_reduces_every_error(case, fit):
    advice = vi.next_test(fit, np.arange(0.5, 5.01, 0.1), [case.amplitude])
    assert "next test: a measurement at" in advice.attrs["findings"]
    error = advice.remaining_error.sel(parameter="stops.damping").isel(candidate_amplitude=0)
    best = error.isel(error.argmin(...))
    assert 0.3 < float(best) < 1.0
    assert (advice.remaining_error.values[np.isfinite(advice.remaining_error.values)] <= 1.0).all()
    assert (advice.information.values[np.isfinite(advice.information.values)] >= 0.0).all()


def test_the_next_test_keeps_away_from_a_jump(case, fit):
    near = np.arange(1.0, 3.6, 0.02)
    rig = vi.fitted_rig(fit)
    curves = vi.sweep(vi.Rig(rig.oscillator, rig.amplitude), near)
    swing = np.log(curves.displacement_excursion.values)
    jump = near[np.argmin(np.diff(swing[0]))]
    last = {}
    for margin in (0.0, 0.02, 0.1):
        proposal = vi.next_test(fit, near, [case.amplitude], margin=margin)
        gain = proposal.information.sel(direction="forward").isel(candidate_amplitude=0)
        last[margin] = near[np.isfinite(gain.values) & (near < jump + 0.01)].max()
        assert last[margin] * (1.0 + margin) < jump + 0.021  # the step in which it jumps
    assert last[0.1] < last[0.02] <= last[0.0]
    assert last[0.1] > 0.85 * jump
    with pytest.raises(vi.InputError, match="margin: '2 m'"):
        vi.next_test(fit, margin="2 m")


def test_models_are_compared(case, data, fit):
    asked = {"tried": 0, "starts": 1, "profiles": False}
    again = vi.identify(case.oscillator, data, "stops.stiffness", **asked)
    comparison = vi.compare_fits({"two": fit, "one": again})
    assert float(comparison.akaike_weight.sum()) == pytest.approx(1.0)
    assert abs(float(comparison.akaike[1] - comparison.akaike[0])) < 10.0  # both are right
    with pytest.raises(vi.InputError, match="at least two"):
        vi.compare_fits({"one": fit})
    other = curves(case.oscillator, case.amplitude, 0.02, seed=8)
    wrong = vi.identify(case.oscillator, other, "gap", **asked)
    with pytest.raises(vi.InputError, match="other data"):
        vi.compare_fits({"one": fit, "other": wrong})


@pytest.mark.full
def test_names_of_tests_are_no_markdown_and_no_html(tmp_path):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, frequencies=np.arange(1.0, 2.0, 0.1))
    names = ["<script>alert(1)</script> | x", "<script>alert(1)</script> / x", "[a](b) *c* `d`"]
    joint_fit = vi.identify(
        case, dict.fromkeys(names, data), "isolator.stiffness", tried=0, starts=1, profiles=False
    )
    files = vi.fit_report(joint_fit, tmp_path)
    text = files["markdown"].read_text()
    assert "<script>" not in text.replace("\\<script\\>", "")
    assert "](b)" not in text.replace("\\](b)", "")
    rows = [line for line in text.splitlines() if line.startswith("| \\<script")]
    assert all(line.replace("\\|", "").count("|") == 6 for line in rows)
    assert len(rows) == 2
    assert "<script>" not in files["report"].read_text()
    # Names that differ in what a file name cannot hold have files of their own.
    drawn = [path for key, path in files.items() if key.startswith("figure curves")]
    assert len(set(drawn)) == 3


def test_a_name_that_a_terminal_would_obey_is_refused():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, frequencies=np.array([1.0, 1.1]))
    with pytest.raises(vi.InputError, match=r"^data: .*control character"):
        vi.identify(case, {"a\x1b[2J": data}, "isolator.stiffness")
