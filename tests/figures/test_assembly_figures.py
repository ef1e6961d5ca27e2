"""Figures of several masses show the values of their datasets."""

from __future__ import annotations

import itertools
import json
import re
from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb

import vibroimpact as vi
from earthquakes.rigs import noise
from vibroimpact import figures
from vibroimpact.figures.assembly import PENS
from vibroimpact.figures.assembly_animation import save_animation


def storeys(name: str, stiffness: str) -> dict[str, vi.Link]:
    """Return the links of a building of three storeys."""
    bodies = ("ground", *(f"{name}{i}" for i in (1, 2, 3)))
    spring = vi.Isolator(stiffness, "0.8 MN s/m")
    pairs = itertools.pairwise(bodies)
    return {f"{name}_storey_{i}": vi.Link(*pair, spring) for i, pair in enumerate(pairs, 1)}


POUNDING = vi.Bumper("500 MN/m", "2 MN s/m", "2 cm")
BUILDINGS = vi.Assembly(
    {
        f"{name}{i}": "200 t" if name == "north" else "250 t"
        for name in ("north", "south")
        for i in (1, 2, 3)
    },
    {**storeys("north", "60 MN/m"), **storeys("south", "130 MN/m")},
    {
        "pounding_2": vi.Link("north2", "south2", POUNDING),
        "pounding_3": vi.Link("north3", "south3", POUNDING),
        "wall": vi.Link("south3", "ground", vi.RigidStop(0.6, "3 cm")),
    },
)
"""Two neighbours of three storeys, one beside a wall."""
DAMPER = vi.Assembly(
    {"host": 1, "ball": 0.05},
    {"spring": vi.Link("ground", "host", vi.Isolator(1, 0.02))},
    {
        "right": vi.Link("ball", "host", vi.RigidStop(0.75, 15)),
        "left": vi.Link("host", "ball", vi.RigidStop(0.75, 15)),
    },
    units="none",
)
"""An impact damper without units."""
PAIR = vi.Assembly(
    {"north": "200 t", "south": "250 t"},
    {
        "frame_north": vi.Link("ground", "north", vi.Isolator("30 MN/m", "0.3 MN s/m")),
        "frame_south": vi.Link("ground", "south", vi.Isolator("60 MN/m", "0.4 MN s/m")),
    },
    {"pounding": vi.Link("north", "south", POUNDING)},
)


@cache
def quake() -> xr.Dataset:
    return vi.simulate(vi.Rig(BUILDINGS, noise(8).scaled(peak="0.4 g")), tail=1.0, samples=2)


@cache
def compared() -> dict[str, xr.Dataset]:
    rig = vi.Rig(BUILDINGS.replace(stops={}), noise(8).scaled(peak="0.4 g"))
    return {"pounding": quake(), "without stops": vi.simulate(rig, tail=1.0, samples=2)}


@cache
def motion() -> xr.Dataset:
    return vi.simulate(vi.Rig(BUILDINGS, vi.Harmonic("0.3 g", "1.3 Hz")), 5, samples=128)


@cache
def ball() -> xr.Dataset:
    return vi.simulate(vi.Rig(DAMPER, vi.Harmonic(1.0, 1 / (2 * np.pi), of="force", on="host")), 12)


@cache
def swept() -> xr.Dataset:
    return vi.sweep(vi.Rig(BUILDINGS, "0.15 g"), np.linspace(0.9, 2.7, 13))


@cache
def branch() -> xr.Dataset:
    return vi.branch(vi.Rig(PAIR, vi.Harmonic("0.2 g", "1.5 Hz")), vary={"frequency": (1.5, 3.0)})


@cache
def diagram() -> xr.Dataset:
    rig = vi.Rig(PAIR, vi.Harmonic("0.2 g", "1.5 Hz"))
    return vi.bifurcation_diagram(rig, {"gap": ("1 cm", "4 cm")}, 5, points=30, exponent_cycles=64)


@cache
def plane() -> xr.Dataset:
    rig = vi.Rig(PAIR, vi.Harmonic("0.2 g", "2.8 Hz"))
    window = {"displacement.north": (-0.1, 0.1), "velocity.north": (-1.5, 1.5)}
    return vi.basins(rig, plane=window, nodes=12)


@pytest.mark.parametrize("quantity", ["displacement", "velocity", "acceleration"])
def test_histories_are_the_samples_of_each_mass(quantity) -> None:
    factor = {"displacement": 1e3, "velocity": 1.0, "acceleration": 1 / 9.80665}[quantity]
    axes = figures.mass_histories(motion(), quantity=quantity, cycles=2)
    assert [ax.get_title(loc="left") for ax in axes] == list(BUILDINGS.names)
    assert len({ax.get_ylim() for ax in axes}) == 1
    kept = motion()["cycle"].values >= 3.0
    for ax, name in zip(axes, BUILDINGS.names, strict=True):
        line = max(ax.lines, key=lambda one: len(one.get_xdata()))
        np.testing.assert_array_equal(line.get_xdata(), motion()["cycle"].values[kept])
        expected = factor * motion()[quantity].sel(mass=name).values[kept]
        np.testing.assert_allclose(line.get_ydata(), expected, rtol=1e-13)


def test_closing_displacements_have_panels_below_the_masses() -> None:
    data = quake()
    *_, third, second = axes = figures.mass_histories(data, closing=["pounding_3", "pounding_2"])
    assert len(axes) == len(BUILDINGS.names) + 2
    for ax, i in ((third, 3), (second, 2)):
        line = max(ax.lines, key=lambda one: len(one.get_xdata()))
        moved = [data["displacement"].sel(mass=f"{name}{i}") for name in ("north", "south")]
        np.testing.assert_allclose(line.get_ydata(), 1e3 * (moved[0] - moved[1]), atol=1e-12)
        (gap,) = [one.get_ydata()[0] for one in ax.lines if one.get_linestyle() == "--"]
        assert gap == 20.0
    assert spans(third) == spans(axes[2])
    with pytest.raises(vi.InputError, match=r"^closing: 'pounding' is not a stop"):
        figures.mass_histories(data, closing=["pounding"])


def test_the_end_of_a_record_is_marked_if_the_motion_goes_on() -> None:
    record = json.loads(quake().attrs["parameters"])["record"]
    end = (record["samples"] - 1) * record["step"]
    assert end < quake()["time"].values[-1] - 0.9
    for axes in (figures.mass_histories(quake()), figures.contact_forces(quake())):
        for ax in axes:
            assert [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == ":"] == [
                end
            ]
        names = [text.get_text() for text in axes[0].get_legend().get_texts()]
        assert "end of the record" in names
    for ax in figures.mass_histories(motion()):
        assert not [line for line in ax.lines if line.get_linestyle() == ":"]


def test_an_axis_has_three_ticks_and_a_short_contact_the_colour_of_its_stop() -> None:
    for ax in figures.mass_histories(quake()):
        low, high = ax.get_ylim()
        assert sum(low <= tick <= high for tick in ax.get_yticks()) >= 3
        for band in (one for one in ax.collections if isinstance(one, PolyCollection)):
            red, green, blue = band.get_edgecolor()[0][:3]
            assert max(red, green, blue) - min(red, green, blue) > 0.3  # no grey
            assert band.get_linewidth()[0] >= 0.7


def test_panels_share_one_label() -> None:
    for axes in (figures.mass_resonance(swept()), figures.mass_branches(branch())):
        assert not any(ax.get_ylabel() for ax in axes)
        figure = axes[0].get_figure(root=True)
        assert figure.get_supylabel() == "largest displacement (mm)"


def spans(ax) -> list[tuple[float, float]]:
    """Return the bands in a panel."""
    bands = [one for one in ax.collections if isinstance(one, PolyCollection)]
    boxes = [path.get_extents() for one in bands for path in one.get_paths()]
    return sorted((box.x0, box.x1) for box in boxes)


def test_bands_are_the_contacts_of_the_masses_that_they_join() -> None:
    axes = figures.mass_histories(motion(), cycles=3)
    of = dict(zip(BUILDINGS.names, axes, strict=True))
    data = motion()
    at = data["event_cycle"].values + data["event_cycle_time"].values * 1.3
    for mass, stop in (("north2", "pounding_2"), ("north3", "pounding_3"), ("north1", None)):
        mine = data["event_stop"].values == stop
        begins, ends = (at[mine & (data["event_contact"].values == k)] for k in (1, 0))
        expected = [(max(a, 2.0), b) for a, b in zip(begins, ends, strict=True) if b >= 2.0]
        assert len(spans(of[mass])) == len(expected)
        np.testing.assert_allclose(np.ravel(spans(of[mass])), np.ravel(expected), atol=1e-12)
        assert (len(expected) > 0) == (stop is not None)


def test_a_contact_that_lasts_from_the_start_or_to_the_end_is_drawn() -> None:
    squeezed = PAIR.replace(
        stops={"pounding": vi.Link("north", "south", POUNDING.replace(gap=-0.005))}
    )
    data = vi.simulate(vi.Rig(squeezed, vi.Harmonic("0.3 g", "1.5 Hz")), 2)
    kinds = data["event_contact"].values
    assert kinds[0] == 0
    (north, _) = figures.mass_histories(data)
    (first, *_), at = spans(north), data["event_cycle_time"].values * 1.5
    assert first == pytest.approx((0.0, at[0] + data["event_cycle"].values[0]))
    assert len(spans(north)) == (kinds == 1).sum() + 1


def test_a_contact_without_an_event_is_drawn() -> None:
    squeezed = PAIR.replace(
        stops={"pounding": vi.Link("north", "south", POUNDING.replace(gap=-0.005))}
    )
    data = vi.simulate(vi.Rig(squeezed, vi.Harmonic("1e-6 g", "1.5 Hz")), 2)
    assert data.sizes["event"] == 0
    assert (data["deformation"] > 0.0).all()
    (north, _) = figures.mass_histories(data)
    assert spans(north) == [pytest.approx((0.0, 2.0))]


def test_forces_and_impulses_of_the_stops() -> None:
    data = quake()
    axes = dict(zip(BUILDINGS.stops, figures.contact_forces(data), strict=True))
    assert "MN" in axes["pounding_2"].get_ylabel()
    line, _ = axes["pounding_2"].lines
    np.testing.assert_allclose(
        line.get_ydata(), 1e-6 * data["contact_force"].sel(stop="pounding_2").values
    )
    # The impulse is the change of momentum of the mass, from the samples on both sides of it.
    mine = (data["event_stop"].values == "wall") & (data["event_contact"].values == 2)
    assert mine.sum() >= 2
    points, _ = axes["wall"].lines
    speed = data["event_velocity"].sel(mass="south3").values[mine]
    np.testing.assert_allclose(points.get_ydata(), 1e-3 * 250e3 * 1.6 * speed, rtol=1e-12)
    assert axes["wall"].get_ylabel().replace("\n", " ") == "impulse (kN s)"


def test_the_bands_of_contact_forces_have_a_key() -> None:
    axes = figures.contact_forces(motion(), stops=["pounding_3", "pounding_2"])
    names = [text.get_text() for text in axes[0].get_legend().get_texts()]
    assert names == ["contact, pounding_3", "contact, pounding_2"]
    assert axes[1].get_legend() is None


def test_an_impulse_between_two_masses_is_the_change_of_momentum() -> None:
    data = vi.simulate(vi.Rig(DAMPER), 1, vi.State(velocity={"ball": 5.0}), samples=4096)
    hit = int(np.flatnonzero(data["event_contact"].values == 2)[0])
    v = data["event_velocity"].values[hit]
    (right, _) = figures.contact_forces(data)
    drawn = right.lines[0].get_ydata()[0]
    after = data["velocity"].sel(mass="ball").values
    sample = int(np.searchsorted(data["time"].values, data["event_time"].values[hit])) + 1
    assert drawn == pytest.approx(0.05 * (v[1] - after[sample]), rel=1e-3)


def test_envelopes_are_the_largest_values_and_drifts_those_of_links() -> None:
    moved, drift, shaken = figures.mass_envelopes(quake())
    u = quake()["displacement"]
    assert [label.get_text() for label in moved.get_yticklabels()] == list(BUILDINGS.names)
    # Two buildings are two curves: the first storey of the second stands on the ground.
    assert len(drift.lines) == 2
    south = drift.lines[1]
    np.testing.assert_array_equal(south.get_ydata(), [3, 4, 5])
    first = 1e3 * float(abs(u.sel(mass="south1")).max())
    assert south.get_xdata()[0] == pytest.approx(first, rel=1e-3)
    apart = u.sel(mass="south3") - u.sel(mass="south2")
    assert south.get_xdata()[2] == pytest.approx(1e3 * float(abs(apart).max()), rel=2e-2)
    most = float(abs(quake()["acceleration"].sel(mass="north3")).max()) / 9.80665
    exact = float(vi.totals(quake())["peak_acceleration"].sel(mass="north3")) / 9.80665
    assert most < exact  # between two samples
    assert shaken.lines[0].get_xdata()[2] == pytest.approx(exact, rel=1e-14)
    assert moved.lines[0].get_xdata()[1] >= 1e3 * float(u.sel(mass="north2").max()) - 1e-9


def test_motions_of_other_masses_are_not_compared() -> None:
    with pytest.raises(vi.InputError, match=r"'other' has the masses host, ball, not north1"):
        figures.mass_envelopes({"one": quake(), "other": ball()})


def test_a_portrait_is_shaded_beyond_the_gap() -> None:
    ax = figures.pair_portrait(motion(), "north3", "south3", cycles=2)
    path = ax.lines[0]
    gap = next(line for line in ax.lines if line.get_linestyle() == "--")
    np.testing.assert_allclose(np.subtract(*gap.get_data()), 20.0)
    clear = path.get_xdata() - path.get_ydata() <= 20.0
    kept = motion()["cycle"].values >= 3.0
    pressed = motion()["contact_force"].sel(stop="pounding_3").values[kept] > 0.0
    assert pressed.any()
    assert not (clear & pressed).any()
    # Seen from the other mass, the stop is on the other side.
    ax = figures.pair_portrait(motion(), "south3", "north3", quantity="approach")
    at = next(line for line in ax.lines if line.get_linestyle() == "--").get_xdata()
    np.testing.assert_allclose(at, -20.0)
    with pytest.raises(vi.InputError, match=r"^second: 'north3' is also the first mass"):
        figures.pair_portrait(motion(), "north3", "north3")
    with pytest.raises(vi.InputError, match=r"^first: 'nort3' is not a mass; did you mean north3"):
        figures.pair_portrait(motion(), "nort3", "north3")
    with pytest.raises(vi.InputError, match=r"^second: 'ground' is not a mass"):
        figures.pair_portrait(motion(), "north3", "ground")
    assert figures.pair_portrait(motion(), "north3", "ground", quantity="approach").lines


def test_resonance_curves_are_shaded_where_a_stop_is_touched() -> None:
    data = swept()
    axes = dict(zip(BUILDINGS.names, figures.mass_resonance(data), strict=True))
    ax = axes["north3"]
    np.testing.assert_allclose(
        ax.lines[0].get_ydata(),
        1e3 * data["peak_displacement"].sel(direction="forward", mass="north3"),
    )
    impacts = data["impacts"] > 0.0
    (stop,) = figures.mass_resonance(data, quantity="peak_force", names=["pounding_3"])
    for panel, hit in (
        (stop, impacts.sel(stop="pounding_3")),
        *((one, impacts.any("stop")) for one in axes.values()),
    ):
        edges = np.array([(one.get_x(), one.get_x() + one.get_width()) for one in panel.patches])
        for f, touched in zip(data["frequency"].values, hit.any("direction").values, strict=True):
            assert touched == bool(((edges[:, 0] <= f) & (f <= edges[:, 1])).any()), f
        assert hit.any()
        assert not hit.all()


def test_a_rigid_stop_has_impulses() -> None:
    data = swept()
    axes = figures.mass_resonance(data, quantity="peak_force", names=["wall", "pounding_3"])
    assert "impulse" in axes[0].get_ylabel()
    unit = {"kN s": 1e-3, "MN s": 1e-6, "N s": 1.0}[re.search(r"\((.*)\)", axes[0].get_ylabel())[1]]
    np.testing.assert_allclose(
        axes[0].lines[0].get_ydata(),
        unit * data["peak_impulse"].sel(direction="forward", stop="wall"),
    )
    assert float(data["peak_impulse"].max()) > 0.0
    assert "force" in axes[1].get_ylabel()


def test_an_orbit_that_touches_looks_so_in_the_panels_of_all_masses() -> None:
    wall = {"wall": vi.Link("south3", "ground", vi.Bumper("500 MN/m", "2 MN s/m", "3 cm"))}
    assembly = BUILDINGS.replace(stops=wall)
    shaken = vi.Rig(assembly, vi.Harmonic("0.1 g", "1.4 Hz"))
    data = vi.branch(shaken, vary={"frequency": (1.3, 1.5)})
    swept = vi.sweep(vi.Rig(assembly, "0.1 g"), [1.2, 1.4, 1.6])
    hit = swept["peak_force"].sel(stop="wall").values > 0.0
    assert hit.any()
    shades = [len(ax.patches) for ax in figures.mass_resonance(swept)]
    assert shades[0] > 0
    assert len(set(shades)) == 1
    widths = [{one.get_linewidth() for one in ax.lines} for ax in figures.mass_branches(data)]
    assert max(widths[0]) > 1.5
    assert all(one == widths[0] for one in widths)


@pytest.mark.parametrize("dense", [True, False])
def test_the_spectrum_of_each_mass_has_its_own_panel(dense) -> None:
    highest = 9.0
    long = vi.simulate(vi.Rig(PAIR, vi.Harmonic("0.3 g", "1.6 Hz")), 40, samples=32)
    lines = vi.fourier_spectrum(long if dense else motion())
    axes = figures.mass_spectra(lines, highest=highest)
    assert [ax.get_title(loc="left") for ax in axes] == list(lines["mass"].values)
    assert {ax.get_yscale() for ax in axes} == {"log"}
    assert len({ax.get_ylim() for ax in axes}) == 1
    assert "(g)" in axes[0].figure.get_supylabel()  # as all accelerations of several masses
    kept = lines["order"].values <= highest
    for ax in axes:
        mine = lines["acceleration_amplitude"].sel(mass=ax.get_title(loc="left")).values[kept]
        np.testing.assert_allclose(ax.lines[0].get_ydata(), mine / 9.80665, rtol=1e-12)
        assert mine.max() / 9.80665 < ax.get_ylim()[1]
        assert bool(ax.collections) != dense
    assert [bool(ax.child_axes) for ax in axes] == [True] + [False] * (len(axes) - 1)


def test_branches_of_each_mass_with_their_contacts() -> None:
    data = branch()
    axes = figures.mass_branches(data, sweep=vi.sweep(vi.Rig(PAIR, "0.2 g"), [1.6, 2.0, 2.6]))
    assert [ax.get_title(loc="left") for ax in axes] == ["north", "south"]
    x = np.concatenate([one.get_xdata() for one in axes[0].lines if one.get_marker() == "None"])
    assert set(x) == set(data["frequency"].values)
    thick = [one for one in axes[0].lines if one.get_linewidth() > 1.5]
    hit = data["impacts"].sel(stop="pounding").values > 0.0
    assert hit.any()
    assert not hit.all()
    touched = set(np.concatenate([one.get_xdata() for one in thick]))
    assert touched <= set(data["frequency"].values[hit])
    assert {one.get_marker() for one in axes[0].lines} >= {"o", "s"}


@pytest.mark.parametrize(
    ("draw", "named"),
    [
        (lambda: figures.mass_histories(vi.steady("B2-G1-A3", frequency=2.0)), "motion: "),
        (lambda: figures.mass_histories(swept()), "motion: "),
        (lambda: figures.mass_histories(motion(), masses=["roof"]), "masses: 'roof' is not a mass"),
        (lambda: figures.mass_histories(motion(), quantity="clearance"), "quantity: 'clearance'"),
        (lambda: figures.mass_histories(motion(), cycles=0), "cycles: 0"),
        (lambda: figures.contact_forces(motion(), stops=[]), "stops: empty"),
        (lambda: figures.mass_envelopes({}), "motions: empty"),
        (lambda: figures.mass_resonance(motion()), "data: this is not a sweep"),
        (
            lambda: figures.mass_resonance(swept(), quantity="eta_d"),
            "quantity: 'eta_d' is unknown; use",
        ),
        (lambda: figures.mass_branches(swept()), "data: this is not a branch"),
        (lambda: figures.branch_diagram(branch()), "data: it is of an Assembly of several masses"),
        (lambda: figures.resonance_curves(swept()), "data: it is of an Assembly of several"),
        (
            lambda: figures.resonance_family(vi.sweeps([vi.Rig(PAIR, "0.2 g")], [1.6])),
            "data: it is of an Assembly of several masses; draw it with figures.mass_resonance",
        ),
        (
            lambda: figures.spectrum_lines(vi.fourier_spectrum(motion())),
            "spectra: it is of an Assembly of several masses; draw it with figures.mass_spectra",
        ),
        (lambda: figures.mass_spectra(motion()), "spectrum: this is not a spectrum of several"),
        (lambda: figures.mass_spectra(vi.fourier_spectrum(motion()), quantity="x"), "quantity: "),
        (lambda: figures.mass_spectra(vi.fourier_spectrum(motion()), highest=0), "highest: 0"),
        (lambda: figures.phase_portrait(motion()), "motion: it is of an Assembly of several"),
        (lambda: figures.mass_histories(motion(), axes=[1]), "axes: 1 Axes; pass 6"),
        (lambda: save_animation(motion(), "motion.mp4"), "path: 'motion.mp4' does not end in .gif"),
        (lambda: save_animation(motion(), "a.gif", duration=0), "duration: 0"),
        (lambda: save_animation(motion(), "a.gif", start=3, end=2), "start, end: 3 s and 2 s"),
    ],
)
def test_wrong_input(draw, named) -> None:
    with pytest.raises(vi.InputError) as caught:
        draw()
    assert str(caught.value).startswith(named)


def test_an_animated_gif_moves(tmp_path) -> None:
    from PIL import Image

    path = save_animation(motion(), tmp_path / "motion.gif", duration=0.5, title="Neighbours")
    with Image.open(path) as picture:
        assert picture.n_frames == 10
        assert picture.size[0] >= 1000
        frames = []
        for k in (0, 5):
            picture.seek(k)
            frames.append(np.asarray(picture.convert("RGB"), dtype=int))
        assert picture.info["loop"] == 0
    assert (np.abs(frames[0] - frames[1]).max(axis=2) > 100).mean() > 1e-3
    for pen in PENS.values():
        seen = np.abs(frames[0] - np.rint(255 * np.array(to_rgb(pen.colour)))).max(axis=2) < 40
        assert seen.any(), pen
    assert (frames[0][0, frames[0].shape[1] // 2] == 255).all()  # the paper


def test_an_animated_page_has_the_motion(tmp_path) -> None:
    path = save_animation(motion(), tmp_path / "motion.html", duration=5, title="a </script> b")
    text = path.read_text(encoding="utf-8")
    assert "<h1>a &lt;/script&gt; b</h1>" in text
    assert not re.search(r"(src|href)=", text)  # nothing from elsewhere
    assert re.search(r'<svg width="100%" viewBox="0 0 [\d.]+ [\d.]+"', text)
    assert "max-width" not in text
    data = json.loads(re.search(r"const data = (.*);\n", text)[1].replace("<\\/", "</"))
    assert len(data["values"]) == len(data["times"]) <= 300
    at = motion()["time"].values
    np.testing.assert_allclose(
        np.array(data["values"])[:, 2],
        np.interp(data["times"], at, motion()["displacement"].sel(mass="north3").values),
        rtol=1e-4,
        atol=2e-6,
    )
    # The bodies meet on the screen when the stop is touched: its face is at the stem.
    index = list(BUILDINGS.stops).index("pounding_3")
    clearance = motion()["clearance"].sel(stop="pounding_3").values
    (face,) = (one for one in data["shapes"] if one["stop"] == index and len(one["points"]) == 2)
    stem = [one for one in data["shapes"] if one["above"]][2]
    shift = np.array(data["values"])
    scale = stem["points"][0][2][0][1]

    def places(point) -> np.ndarray:
        return point[0] + sum(by * shift[:, k] for k, by in point[2])

    apart = (places(face["points"][0]) - places(stem["points"][0])) / scale
    np.testing.assert_allclose(apart, np.interp(data["times"], at, clearance), atol=2e-5)
    touched = np.array(data["touched"])[:, index]
    assert 0 < touched.sum() < len(touched)
