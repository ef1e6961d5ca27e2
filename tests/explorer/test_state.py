"""The state of a page: knobs, laws, presets, undo, addresses, and the files made from it."""

from __future__ import annotations

import base64
import json
import tomllib
import tracemalloc

import pytest

import vibroimpact as vi
from vibroimpact.cli.study import read_study
from vibroimpact.explorer import change, laws, presets, share
from vibroimpact.explorer.controls import controls
from vibroimpact.explorer.state import MOST_STEPS, UndoHistory, begin

CASE = presets.preset("B2-G1-A3")


def knobs(state):
    return {knob.path: knob for knob in controls(state, state)}


def test_every_number_of_the_rig_has_a_knob():
    by_path = knobs(CASE)
    rig = CASE.oscillator
    assert by_path["mass"].value == rig.mass
    assert by_path["isolator.stiffness"].text == "26.29 kN/m"
    assert by_path["stops.gap"].value == rig.right.gap
    assert by_path["amplitude"].text == "0.05 g"
    assert by_path["stops.stiffness_ratio"].value == pytest.approx(510e3 / 26290.0)
    assert by_path["damping_ratio"].value == pytest.approx(0.15)
    assert all(knob.low <= knob.value <= knob.high for knob in by_path.values())


@pytest.mark.parametrize("kind", laws.isolator_laws())
@pytest.mark.parametrize("stop", laws.stop_laws())
def test_every_law_has_its_knobs_and_can_be_left_again(kind, stop):
    state = change.with_law(change.with_law(CASE, "isolator", kind), "stops", stop)
    rig = state.oscillator
    assert rig.isolator.kind == kind
    assert (rig.right.kind if rig.right else "none") == stop
    for path, knob in knobs(state).items():
        assert knob.low <= knob.value <= knob.high, path
        assert knob.low < knob.high, path
    back = change.with_law(change.with_law(state, "isolator", "linear"), "stops", "kelvin-voigt")
    assert back.oscillator.isolator.stiffness == pytest.approx(26290.0, rel=0.6)


def test_a_knob_moves_its_other_form():
    moved = change.moved(CASE, "stops.gap_ratio", 0.5)
    assert knobs(moved)["stops.gap"].value == pytest.approx(0.5 / 0.216859 * 7.5e-3, rel=1e-5)
    moved = change.moved(CASE, "stops.gap", "12 mm")
    assert knobs(moved)["stops.gap_ratio"].value == pytest.approx(0.216859 * 12 / 7.5, rel=1e-5)
    heavier = change.moved(CASE, "mass", "1.1 t")
    assert heavier.oscillator.mass == 1100.0
    stiffer = change.moved(CASE, "stops.stiffness_ratio", 40.0)
    time = stiffer.oscillator.right.damping / stiffer.oscillator.right.stiffness
    assert time == pytest.approx(CASE.oscillator.right.damping / CASE.oscillator.right.stiffness)


def test_one_side_alone():
    apart = change.joined(CASE, False)
    moved = change.moved(apart, "left.gap_ratio", 0.4)
    assert moved.oscillator.right == CASE.oscillator.right
    assert knobs(moved)["left.gap_ratio"].value == pytest.approx(0.4)
    assert "stops.gap" not in knobs(moved)
    again = change.joined(moved, True)
    assert again.oscillator.left == again.oscillator.right == CASE.oscillator.right
    assert change.with_law(apart, "left", "none").oscillator.left is None


@pytest.mark.parametrize(
    ("text", "of", "size"),
    [
        ("120 N", "force", 120.0),
        ("5 mm", "displacement", 0.005),
        ("0.4 kg m", "unbalance", 0.4),
        ("0.5", "acceleration", 0.5),
    ],
)
def test_the_unit_of_an_amplitude_selects_the_excitation(text, of, size):
    turned = CASE._replace(shaking=CASE.shaking.replace(phase=0.3))
    moved = change.moved(turned, "amplitude", text)
    assert (moved.shaking.of, moved.shaking.amplitude) == (of, pytest.approx(size))
    assert (moved.shaking.frequency, moved.shaking.phase) == (CASE.shaking.frequency, 0.3)
    assert change.moved(moved, "amplitude", 2.0).shaking.of == of
    assert change.moved(moved, "amplitude", "0.02 g").shaking.of == "acceleration"
    assert knobs(moved)["amplitude"].low < size < knobs(moved)["amplitude"].high


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        ("amplitude", "2 kg", "is a mass"),
        ("stops.gap", "12 kg", "mass"),
        ("mass", "-3", "greater than 0"),
        ("amplitude", "0", "greater than 0"),
        ("stops.nonsense", "1", "nonsense"),
        ("__class__", "1", "is unknown; use"),
        ("right.gap.real", "1", "is unknown; use"),
        ("isolator.kind", "friction", "the law is Isolator; to change it"),
        ("stops.stiffness_ratio", "soft", "does not start with a number"),
    ],
)
def test_wrong_values_are_refused_in_words(path, value, words):
    with pytest.raises(vi.InputError, match=words):
        change.moved(CASE, path, value)


def test_undo_redo_and_one_step_a_drag():
    history = UndoHistory(CASE, CASE)
    for value in (8e-3, 9e-3, 10e-3):
        history = history.to(change.moved(history.now, "stops.gap", value), "drag 1")
    dragged = history.now
    history = history.to(change.moved(dragged, "mass", 600.0))
    assert len(history.past) == 2
    history = history.undo()
    assert history.now == dragged
    assert history.undo().now == CASE
    assert history.undo().undo().now == CASE
    assert history.redo().now.oscillator.mass == 600.0
    assert history.redo().redo().future == ()


def test_a_history_does_not_grow():
    history = UndoHistory(CASE, CASE)
    for k in range(3 * MOST_STEPS):
        history = history.to(change.moved(history.now, "mass", 500.0 + k))
    assert len(history.past) == MOST_STEPS
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for k in range(2000):
        history = history.to(change.moved(history.now, "mass", 500.0 + k))
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert grown < 1_000_000


@pytest.mark.parametrize(
    "name", ["S4: motions that are not regular (B3, 10 mm, A3)", presets.BUILDING, "B1-G4-A1"]
)
def test_an_address_gives_the_state_back(name):
    state = change.looked(presets.preset(name), {"physical": True})
    state = change.chosen(state, "backward", sum(state.span) / 3)
    for law in ("rigid", "power"):
        state = change.with_law(state, "stops", law)
        again = share.from_address(share.address(state))
        assert again == state


def made(**changes):
    table = json.loads(base64.urlsafe_b64decode(share.address(CASE) + "=="))
    return base64.urlsafe_b64encode(json.dumps({**table, **changes}).encode()).decode()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "§",
        "A" * 100_000,
        base64.urlsafe_b64encode(b"[" * 3000).decode(),
        base64.urlsafe_b64encode(b"[]").decode(),
        made(name="x" * 1000),
        made(extra=1),
        made(span=[2.0, 1.0]),
        made(span=[1e-9, "inf"]),
        made(frequency=99.0),
        made(direction="sideways"),
        made(of="velocity"),
        made(amplitude="nan"),
        made(shown=["__import__"]),
        made(oscillator={"mass": "../../etc/passwd"}),
        made(oscillator={"mass": 1.0, "isolator": {"kind": "os.system"}}),
        None,
        7,
    ],
)
def test_another_address_is_refused(text):
    with pytest.raises(vi.InputError):
        share.from_address(text)


def test_the_study_file_and_the_program_give_the_same(tmp_path):
    state = change.with_law(change.joined(CASE, False), "left", "rigid")
    path = tmp_path / "study.toml"
    path.write_text(share.study(state), encoding="utf-8")
    read = read_study(path)
    assert read.oscillator == state.oscillator
    assert read.excitation.amplitude == state.shaking.amplitude
    assert read.sweep.start == state.span[0]
    names: dict[str, object] = {}
    program = share.program(state).split("frequencies =")[0]
    exec(program, names)
    assert names["oscillator"] == state.oscillator
    assert names["shaking"] == state.shaking


def test_a_name_runs_nothing():
    name = '"""; raise SystemExit #'
    state = share.from_address(made(name=name))
    names: dict[str, object] = {}
    exec(share.program(state).split("frequencies =")[0], names)
    assert names["oscillator"] == CASE.oscillator
    for forged in ("a\nraise SystemExit", "a\u2028b", "a\rb"):
        with pytest.raises(vi.InputError, match="name"):
            share.from_address(made(name=forged))
    many = share.program(state._replace(name="a\nraise SystemExit"))
    exec(many.split("frequencies =")[0], names)


@pytest.mark.parametrize(
    "name", ["a\x7fb", "a\0b", 'a"\\b', "防撞 🏗", "a\x85b", "\x1b[31m", "half \ud800"]
)
def test_files_of_odd_names_can_be_read(tmp_path, name):
    state = CASE._replace(name=name)
    path = tmp_path / "study.toml"
    path.write_bytes(share.study(state).encode())
    assert tomllib.loads(path.read_text("utf-8"))["name"] == name.replace("\ud800", "?")
    names: dict[str, object] = {}
    exec(share.program(state).encode().split(b"frequencies =")[0], names)
    assert names["oscillator"] == CASE.oscillator


def test_what_a_page_can_begin_with():
    for _, names in presets.names():
        for name in names:
            assert presets.preset(name).name == name
    with pytest.raises(vi.InputError, match="preset"):
        presets.preset("/etc/passwd")
    state = begin("B2-G1-A3")
    assert state.span == (0.5, 5.0)
    with pytest.raises(vi.InputError):
        begin(vi.Rig(vi.Oscillator(1.0, vi.Isolator(0.0, 1.0), vi.RigidStop(0.5, 0.1)), 1.0))
