"""The protocol that oscillators and assemblies fulfil."""

import re
from pathlib import Path

import numpy as np
import pytest

import vibroimpact
import vibroimpact as vi
from vibroimpact.datasets.stops import shared_part_names
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_system

ONE = vi.Oscillator(2.0, vi.Isolator(50.0, 0.4), left=vi.RigidStop(0.8, 0.01))
TWO = vi.Assembly(
    {"low": 2.0, "high": 1.0},
    links={
        "spring": vi.Link("ground", "low", vi.Isolator(50.0, 0.4)),
        "storey": vi.Link("low", "high", vi.Isolator(80.0, 0.2)),
    },
    stops={"wall": vi.Link("ground", "low", vi.RigidStop(0.8, 0.01))},
)


def test_no_module_outside_the_model_asks_for_the_kind_of_a_system():
    root = Path(vibroimpact.__file__).parent
    asks = {
        path.relative_to(root).as_posix()
        for path in root.rglob("*.py")
        if "model" not in path.relative_to(root).parts
        and re.search(r"isinstance\([^)]*\b(Oscillator|Assembly)\b", path.read_text("utf-8"))
    }
    # The choice of the engine's view, and a drawing of assemblies alone.
    assert asks == {"response/engine_system.py", "figures/assembly.py"}


def test_a_system_of_neither_kind_is_abstract():
    with pytest.raises(TypeError, match="abstract"):
        System()


@pytest.mark.parametrize(
    ("system", "stops", "counted", "dims"),
    [
        (ONE, ["left"], ("right", "left"), {"stop"}),
        (TWO, ["wall"], ("wall",), {"mass", "link", "stop"}),
    ],
)
def test_both_kinds_name_their_stops_and_parts(system, stops, counted, dims):
    assert list(system.stops) == list(system.stop_laws) == stops
    assert system.counted_stops == counted
    assert system.stop_laws[stops[0]].rigid
    assert system.part_names.keys() == dims
    assert system.part_names["stop"].tolist() == stops
    assert system.assumptions == ()


def test_oscillators_in_one_dataset_have_the_stops_that_one_of_them_has():
    names = shared_part_names([ONE, ONE.mirrored()])
    assert names["stop"].tolist() == ["right", "left"]


@pytest.mark.parametrize("system", [ONE, TWO])
def test_the_engine_sees_both_kinds_by_the_same_members(system):
    seen = engine_system(system)
    vector = seen.vector_of(seen.read(None))
    assert len(vector) == seen.places.width == seen.width
    np.testing.assert_array_equal(seen.vector(seen.point(vector), vector[0]), vector)
    assert seen.closing.shape == (seen.stops, seen.masses)
    assert seen.velocities().sum() == seen.masses
    assert len(seen.components(vector, 0.0)) == len(seen.names)


def test_a_rig_of_the_other_kind_is_refused_in_one_line():
    with pytest.raises(vi.InputError, match=r"^rig: an Assembly of several masses .*pass a Rig"):
        _ = vi.Rig(TWO).oscillator
    with pytest.raises(vi.InputError, match=r"^rig: an Oscillator has one mass; pass an Assembly$"):
        _ = vi.Rig(ONE).assembly
