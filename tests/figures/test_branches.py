"""Figures of branches and of curves: what is drawn is what the datasets hold."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import same_color

import vibroimpact as vi
from vibroimpact.figures import bifurcation_curves, branch_diagram
from vibroimpact.figures.branches import axis_unit
from vibroimpact.figures.style import SWEEPS
from vibroimpact.model import GRAVITY

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.0)
FREQUENCY = "excitation frequency (Hz)"


@cache
def diagram() -> xr.Dataset:
    return vi.resonance_diagram(CASE, {"frequency": (1.0, 4.0)})


@cache
def several() -> xr.Dataset:
    """Symmetry breaking, period doubling, and the branches that are born there."""
    return vi.resonance_diagram("B3-10mm-A3", {"frequency": (0.9, 1.4)}, longest=2)


@cache
def gaps() -> xr.Dataset:
    return vi.branch(CASE, frequency=2.0, vary={"gap": (1e-3, 20e-3)})


@cache
def swept() -> xr.Dataset:
    return vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), np.arange(1.0, 4.0, 0.05))


@cache
def curve(kind: str, other: str = "stiffness_ratio") -> xr.Dataset:
    row = int(np.flatnonzero(diagram()["bifurcation_kind"].values == kind)[0])
    low, high = {"stiffness_ratio": (0.5, 100.0), "gap": (4e-3, 20e-3)}[other]
    return vi.bifurcation_curve(
        vi.Rig(CASE.oscillator, SHAKEN),
        diagram().isel(bifurcation=row),
        vary={"frequency": (1.0, 4.0), other: (low, high)},
    )


def points(line) -> np.ndarray:
    return np.column_stack([line.get_xdata(), line.get_ydata()])


def curves(ax) -> list:
    return [line for line in ax.lines if line.get_linestyle() != "None"]


def marks(ax) -> dict:
    return {line.get_label(): line for line in ax.lines if line.get_linestyle() == "None"}


def named(ax) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


@pytest.mark.parametrize(
    ("units", "largest", "factor", "symbol"),
    [
        ("m", 0.02, 1e3, "mm"),
        ("m", 3.0, 1e3, "mm"),
        ("N m-3", 4e7, 1e-6, "MN/m³"),
        ("N m-7", 4e7, 1e-6, "MN/m^7"),
        ("N/m^1.5", 4e6, 1e-3, "kN/m^1.5"),
        ("N (s/m)^0.5", 4e3, 1e-3, "kN (s/m)^0.5"),
        ("m s-2", 0.4, 1.0 / GRAVITY, "g"),
        ("Hz", 2.0, 1.0, "Hz"),
        ("1", 0.4, 1.0, "–"),
        ("N^2", 4e6, 1.0, "N^2"),
    ],
)
def test_the_unit_of_a_parameter_has_a_fitting_size(units, largest, factor, symbol):
    values = xr.DataArray([0.0, largest], attrs={"units": units})
    assert axis_unit(values) == (pytest.approx(factor, rel=1e-15), symbol)


# Branches


@pytest.mark.parametrize("made", [diagram, several, gaps])
def test_solid_where_stable_and_dashed_where_not(made):
    """From one bifurcation to the next, which belongs to both."""
    data = made()
    along = data[data.attrs["parameter"]]
    x, y = (1e3 if along.attrs["units"] == "m" else 1.0) * along.values, data["eta_d"].values
    branch, stable = data["branch"].values, data["stable"].values
    drawn = {}
    for line in curves(branch_diagram(data)):
        assert line.get_linestyle() in ("-", "--")
        solid = line.get_linestyle() == "-"
        assert same_color(line.get_color(), "black")
        for begin, end in zip(points(line)[:-1], points(line)[1:], strict=True):
            drawn[(*begin, *end)] = solid
    wanted = {}
    for i in range(len(x) - 1):
        if branch[i] != branch[i + 1]:
            continue
        ends = {int(stable[i]), int(stable[i + 1])} - {-1}
        assert len(ends) <= 1  # it changes at bifurcations only
        if ends:
            wanted[(x[i], y[i], x[i + 1], y[i + 1])] = ends == {1}
    assert {key: drawn[key] for key in wanted} == wanted
    assert len(drawn) <= np.sum(branch[:-1] == branch[1:])  # and none from branch to branch


def test_the_line_changes_at_the_folds():
    data = diagram()
    upper, lower = data["bifurcation_value"].values[:2]
    first, between, last = curves(branch_diagram(data))
    looks = [line.get_linestyle() for line in (first, between, last)]
    assert looks == ["-", "--", "-"]
    assert points(first)[-1, 0] == points(between)[0, 0] == upper
    assert points(between)[-1, 0] == points(last)[0, 0] == lower
    assert first.get_linewidth() > between.get_linewidth()


def test_free_flight_ends_where_it_swings_from_gap_to_gap():
    ax = branch_diagram(diagram(), quantity="displacement_excursion")
    ((frequency, excursion),) = points(marks(ax)["grazing"])
    assert excursion == pytest.approx(15.0, rel=1e-9)  # mm
    rig, omega = CASE.oscillator, 2.0 * np.pi * frequency
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    swing = CASE.amplitude / abs(k - omega**2 + 1j * c * omega)
    assert swing == pytest.approx(7.5e-3, rel=1e-9)


@pytest.mark.parametrize(
    ("quantity", "factor", "label"),
    [
        ("eta_d", 1.0, "$\\eta_d$ (–)"),
        ("eta_a", 1.0, "$\\eta_a$ (–)"),
        pytest.param("displacement_excursion", 1e3, "excursion of displacement (mm)"),
        ("eccentricity", 1e3, "eccentricity (mm)"),
    ],
)
def test_quantities_and_labels(quantity, factor, label):
    data = several()
    ax = branch_diagram(data, quantity=quantity, title="a title")
    assert ax.get_xlabel() == FREQUENCY
    assert ax.get_ylabel() == label
    assert ax.figure.get_suptitle() == "a title"
    assert ax.get_xlim() == (0.9, 1.4)
    drawn = np.concatenate([points(line) for line in curves(ax)])
    held = np.column_stack([data["frequency"].values, factor * data[quantity].values])
    assert {tuple(row) for row in drawn} == {tuple(row) for row in held}
    for kind in ("symmetry breaking", "period doubling", "grazing"):
        mine = data["bifurcation_kind"].values == kind
        there = points(marks(ax)[kind])
        np.testing.assert_array_equal(there[:, 0], data["bifurcation_value"].values[mine])
        # On the branch: at the point that is the bifurcation.
        assert mine.sum() == len(there) > 0
        for row in there:
            assert np.isclose(drawn, row, rtol=1e-9, atol=1e-9).all(axis=1).any()


def test_marks_differ_and_are_named():
    ax = branch_diagram(several())
    assert named(ax)[:2] == ["stable orbits", "unstable orbits"]
    assert named(ax)[2:] == list(marks(ax))
    looks = [
        (line.get_marker(), line.get_markeredgecolor(), line.get_markerfacecolor())
        for line in marks(ax).values()
    ]
    assert len(set(looks)) == len(looks) >= 3
    assert named(branch_diagram(gaps()))[2:] == ["fold", "symmetry breaking", "grazing"]
    # What is not there is not named.
    assert named(branch_diagram(diagram())) == [
        "stable orbits",
        "unstable orbits",
        "fold",
        "grazing",
    ]


def test_a_fold_is_seen_inside_the_grazing_beside_it():
    ax = branch_diagram(diagram())
    fold, grazing = marks(ax)["fold"], marks(ax)["grazing"]
    assert grazing.get_markerfacecolor() == "none"
    buffer = grazing.get_markersize() - 2.0 * grazing.get_markeredgewidth()
    assert fold.get_markersize() < buffer


def test_unstable_mirror_images_are_dashed_where_they_coincide():
    lines = curves(branch_diagram(several()))
    dashed = [line for line in lines if line.get_linestyle() == "--"]
    solid = [line for line in lines if line.get_linestyle() == "-"]
    assert all(same_color(line.get_gapcolor(), "white") for line in dashed)
    assert max(d.get_zorder() for d in dashed) < min(s.get_zorder() for s in solid)


def test_branches_are_named_by_their_impacts():
    texts = [text.get_text() for text in branch_diagram(diagram()).texts]
    assert sorted(texts) == ["1R 1L", "no contact"]
    several_texts = {text.get_text() for text in branch_diagram(several()).texts}
    assert {"1R 1L", "3R 2L, period 2"} <= several_texts


@pytest.mark.parametrize("side", ["right", "left"])
def test_names_leave_out_a_side_without_a_stop(side):
    stops = {side: vi.RigidStop(0.6, "10 mm")}
    rig = vi.Rig(vi.Oscillator("550 kg", CASE.oscillator.isolator, **stops), "0.03 g")
    data = vi.branch(rig, vary={"frequency": (1.2, 1.8)})
    letter = side[0].upper()
    assert "grazing" in data["bifurcation_kind"].values
    grazing = data["bifurcation_contacts"].values[data["bifurcation_kind"].values == "grazing"]
    assert set(grazing) == {f"0{letter} | 1{letter}"}
    texts = {text.get_text() for text in branch_diagram(data).texts}
    assert f"1{letter}" in texts
    assert not any(f"0{other}" in text for text in texts for other in "RL")


@pytest.mark.parametrize(
    ("quantity", "factor"),
    [
        pytest.param("displacement_excursion", 1e3),
        ("eccentricity", 1e3),
        ("eta_a", 1.0),
    ],
)
def test_a_sweep_is_laid_over_in_its_colours(quantity, factor):
    ax = branch_diagram(diagram(), quantity=quantity, sweep=swept())
    for direction, look in SWEEPS.items():
        line = marks(ax)[look.label]
        assert line.get_color() == look.colour
        assert line.get_marker() == look.marker
        x, y = points(line).T
        np.testing.assert_array_equal(x, swept()["frequency"].values)
        held = factor * swept()[quantity].sel(direction=direction).values
        scale = held.max() or 1.0  # of η within what a grid misses of the largest free flight
        np.testing.assert_allclose(y, held, atol=0.01 * scale if factor == 1.0 else 0.0)
    assert named(ax)[-2:] == ["forward sweep", "backward sweep"]
    one = branch_diagram(diagram(), sweep=swept().sel(direction=["backward"]))
    assert named(one)[-1] == "backward sweep"
    assert "forward sweep" not in named(one)


def test_a_sweep_falls_on_the_solid_lines():
    ax = branch_diagram(diagram(), quantity="displacement_excursion", sweep=swept())
    upper, _, lower = (points(line) for line in curves(ax))
    below = lower[np.argsort(lower[:, 0])]
    for look in SWEEPS.values():
        for x, y in points(marks(ax)[look.label]):
            near = [np.interp(x, part[:, 0], part[:, 1]) for part in (upper, below)]
            # Between two points of a line its chord is a bit off.
            assert np.abs(np.array(near) - y).min() < 0.15


@pytest.mark.parametrize("quantity", ["eta_d", "eta_a"])
@pytest.mark.parametrize(
    "low",
    [
        1.0,
        pytest.param(2.0),
    ],
)
def test_a_sweep_is_at_the_scale_of_the_branches(quantity, low):
    """Over the largest free flight at any frequency, though the sweep has not been there."""
    data = vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), np.arange(low, 4.0, 0.05), "backward")
    ax = branch_diagram(diagram(), quantity=quantity, sweep=data)
    x, y = points(marks(ax)["backward sweep"]).T
    free = np.flatnonzero(x > 2.9)
    lower = points(curves(ax)[-1])
    lower = lower[np.argsort(lower[:, 0])]
    np.testing.assert_allclose(y[free], np.interp(x[free], *lower.T), rtol=0.02)


# Curves


def test_a_curve_and_its_cusp():
    data = curve("fold")
    ax = bifurcation_curves(data, title="a title")
    (line,) = curves(ax)
    np.testing.assert_array_equal(line.get_xdata(), data["frequency"].values)
    np.testing.assert_array_equal(line.get_ydata(), data["stiffness_ratio"].values)
    (cusp,) = points(marks(ax)["cusp"])
    assert cusp == pytest.approx([1.61545, 1.62770], abs=1e-5)
    # Both folds of the rig end there: the line turns back beside it.
    assert points(line)[:, 1].min() == pytest.approx(cusp[1], rel=0.05)
    assert named(ax) == ["fold", "cusp"]
    assert ax.get_xlabel() == FREQUENCY
    assert ax.get_ylabel().startswith("stiffness ratio")
    assert ax.get_ylabel().endswith(" (–)")
    assert ax.figure.get_suptitle() == "a title"


def test_curves_of_several_kinds():
    both = {"fold": curve("fold", "gap"), "grazing": curve("grazing", "gap")}
    ax = bifurcation_curves(both)
    first, second = curves(ax)
    for line, data in zip((first, second), both.values(), strict=True):
        np.testing.assert_array_equal(line.get_xdata(), data["frequency"].values)
    assert first.get_linestyle() != second.get_linestyle()
    assert not same_color(first.get_color(), second.get_color())
    assert [name for name in named(ax) if name != "cusp"] == ["fold", "grazing"]
    # The same kind twice has one name.
    twice = bifurcation_curves({"a": curve("grazing", "gap"), "b": curve("grazing", "gap")})
    assert len(curves(twice)) == 2
    assert named(twice) == ["grazing"]


def test_curves_are_called_by_their_names():
    named_curves = {"tongue": curve("fold", "gap"), "grazing": curve("grazing", "gap")}
    (text,) = bifurcation_curves(named_curves).texts  # the legend tells the kind
    assert text.get_text() == "tongue"
    assert same_color(text.get_color(), curves(bifurcation_curves(named_curves))[0].get_color())
    # Both, although the one lies on the other.
    twice = bifurcation_curves({"a": curve("grazing", "gap"), "b": curve("grazing", "gap")})
    assert {text.get_text() for text in twice.texts} == {"a", "b"}


# Files, axes, and what is left alone


# Refused


def refused(call, begins: str, *holds: str) -> None:
    with pytest.raises(vi.InputError) as caught:
        call()
    message = str(caught.value)
    assert message.startswith(begins)
    assert "pass " in message.partition("; ")[2]
    assert "\n" not in message
    for part in holds:
        assert part in message


def test_what_is_no_branch_is_refused():
    for wrong in (xr.Dataset(), swept(), curve("fold")):
        refused(lambda wrong=wrong: branch_diagram(wrong), "data: ", "resonance_diagram")


def test_sections_are_sent_to_their_own_figure():
    data = vi.bifurcation_diagram(
        "B3-10mm-A3", {"gap": (4.9e-3, 5e-3)}, 2, frequency=1.12, directions="up"
    )
    refused(lambda: branch_diagram(data), "data: ", "figures.section_diagram", "resonance_diagram")


def test_other_quantities_are_refused():
    refused(
        lambda: branch_diagram(diagram(), quantity="jerk"),
        "quantity: 'jerk'; ",
        "eta_d, eta_a",
    )


def test_a_sweep_over_another_parameter_or_none_is_refused():
    refused(lambda: branch_diagram(gaps(), sweep=swept()), "sweep: ", "'gap'", "'frequency'")


@pytest.mark.parametrize("wrong", [diagram, xr.Dataset])
def test_what_is_no_sweep_is_refused(wrong):
    refused(lambda: branch_diagram(diagram(), sweep=wrong()), "sweep: ")


def test_what_is_no_curve_is_refused():
    for wrong in (xr.Dataset(), diagram(), {}, {"a": curve("fold"), "b": swept()}):
        refused(lambda wrong=wrong: bifurcation_curves(wrong), "curves: ", "bifurcation_curve")


def test_curves_in_other_parameters_are_not_mixed():
    mixed = {"a": curve("fold"), "b": curve("fold", "gap")}
    refused(lambda: bifurcation_curves(mixed), "curves: ", "'gap'", "'stiffness_ratio'", "one pair")
