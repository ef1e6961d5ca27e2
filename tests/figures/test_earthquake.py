"""What the page of a motion through a record shows."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise
from vibroimpact.figures import earthquake_page

RECORD = noise(8)


def test_what_is_drawn() -> None:
    rig = RIGS["bumpers"]
    motion = vi.simulate(vi.Rig(rig, RECORD), tail=1.0, samples=4)
    periods = np.geomspace(0.05, 2.0, 20)
    spectra = {
        "ground": vi.response_spectrum(RECORD, periods),
        "mass": vi.response_spectrum(vi.floor_record(motion), periods),
    }
    base, moved, shaken, force, floor = earthquake_page(motion, spectra, title="a quake")
    np.testing.assert_array_equal(base.lines[1].get_ydata(), motion["base_acceleration"])
    gaps = [line.get_ydata()[0] for line in moved.lines if line.get_linestyle() == "--"]
    assert gaps == [30.0, -50.0]
    # Every contact is marked where it begins, with the acceleration behind its beginning.
    begun = motion["event_contact"].values >= 1
    for mark, side in (("^", "right"), ("v", "left")):
        (marked,) = [line for line in shaken.lines if line.get_marker() == mark]
        here = begun & (motion["event_stop"].values == side)
        assert here.sum() > 2
        np.testing.assert_array_equal(marked.get_xdata(), motion["event_time"].values[here])
    # The force that is drawn is that of spring, dashpot and stops at the samples.
    u, drawn = force.lines[2].get_data()
    expected = rig.force - rig.mass * motion["acceleration"].values
    near = np.isin(u, 1e3 * motion["displacement"].values)
    assert near.sum() >= motion.sizes["time"]
    assert np.abs(drawn).max() >= np.abs(expected).max()
    flight = ~motion["touching"].any("stop").values
    spring = 50.0 * motion["displacement"].values + 0.8 * motion["velocity"].values
    np.testing.assert_allclose(expected[flight], spring[flight], atol=1e-9)
    assert [line.get_label() for line in floor.lines] == [
        "ground, $\\zeta$ = 0.05",
        "mass, $\\zeta$ = 0.05",
    ]
    assert base.figure.get_suptitle() == "a quake"


def test_without_spectra_and_stops() -> None:
    rig = RIGS["bumpers"].without_bumpers()
    page = earthquake_page(vi.simulate(vi.Rig(rig, RECORD)))
    assert len(page) == 4
    assert page[1].get_legend() is None


def test_wrong_input() -> None:
    rig = RIGS["bumpers"]
    with pytest.raises(vi.InputError, match=r"^motion: this is not the response to a record; "):
        earthquake_page(vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 1.0)), 3))
    several = vi.response_spectrum(RECORD, [0.1, 0.2], [0.02, 0.05])
    with pytest.raises(
        vi.InputError, match=r"^spectra\['ground'\]: this is not a response spectrum"
    ):
        earthquake_page(vi.simulate(vi.Rig(rig, RECORD)), {"ground": several})


def test_the_largest_values_are_written() -> None:
    motion = vi.simulate(vi.Rig(RIGS["bumpers"], RECORD), tail=1.0, samples=4)
    base, moved, shaken, force = earthquake_page(motion)
    gravity = 9.80665
    for ax, name, unit in ((base, "base_acceleration", 1.0), (moved, "displacement", 1e3)):
        ((words,),) = ([text.get_text() for text in ax.texts],)
        number = float(words.split()[0].replace("−", "-"))
        assert abs(number) == pytest.approx(unit * np.abs(motion[name].values).max(), rel=2e-3)
    # The acceleration is largest just after a contact begins, between two samples.
    (words,) = [text.get_text() for text in shaken.texts]
    largest = max(
        np.abs(motion[name].values).max()
        for name in ("acceleration", "event_acceleration_before", "event_acceleration_after")
    )
    size, in_g = (float(part.split()[0].replace("−", "-")) for part in words.split(" = "))
    assert abs(size) == pytest.approx(largest, rel=1e-3)
    assert in_g == pytest.approx(size / gravity, rel=5e-3)
    (words,) = [text.get_text() for text in force.texts]
    assert words.endswith(" N")
    assert abs(float(words.split()[0].replace("−", "-"))) == pytest.approx(
        max(np.abs(line.get_ydata()).max() for line in force.lines[2:3]), rel=1e-3
    )
