"""A session: messages, pictures in their order, and the newest request only."""

from __future__ import annotations

import base64
import contextlib
import json

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.explorer import share
from vibroimpact.explorer.presets import preset
from vibroimpact.explorer.server import _text
from vibroimpact.explorer.session import Session
from vibroimpact.scenarios.classify import classify
from vibroimpact.tasks.threads import Stopped


@pytest.fixture
def session():
    return Session(preset("B2-G1-A3"))


def pictures(session):
    messages = []
    for stage in session.stages():
        if session.wants(stage):
            messages.append(session.make(stage, session.asked))
            session.sent(stage)
    # As the server sends them.
    return json.loads(json.dumps(messages, allow_nan=False))


def test_pictures_are_those_of_the_public_functions(session):
    messages = pictures(session)
    assert [(one["picture"], one["fine"]) for one in messages] == [
        ("curves", False),
        ("motion", False),
        ("scenario", False),
        ("curves", True),
        ("motion", True),
        ("scenario", True),
    ]
    coarse, fine, motion, scenario = messages[0], messages[3], messages[4], messages[5]
    case = vi.laboratory.case("B2-G1-A3")
    curves = vi.sweep(case, coarse["frequency"])
    for k, name in enumerate(("eta_a", "eta_d")):
        for direction in ("forward", "backward"):
            np.testing.assert_allclose(
                coarse["panels"][k]["curves"][direction],
                curves[name].sel(direction=direction),
                rtol=1e-4,
            )
    assert set(coarse["frequency"]) <= set(fine["frequency"])
    assert fine["hysteresis"][-1]["side"] == "right"
    held = curves.sel(direction="forward").sel(frequency=motion["frequency"], method="nearest")
    assert max(motion["displacement"]) == pytest.approx(
        1e3 * float(held["displacement_max"]), rel=1e-3
    )
    assert "periodic, period 1, stable" in motion["words"]
    assert "one motion found" not in motion["table"]  # the other curve may lead to another
    alone = classify(case)
    assert (scenario["scenario"], "; ".join(scenario["evidence"])) == (
        alone.scenario,
        alone.evidence,
    )


def test_what_has_been_sent_is_not_made_again(session):
    pictures(session)
    assert pictures(session) == []
    answer = session.take({"do": "choose", "direction": "backward", "frequency": 2.2})
    assert answer["state"]["direction"] == "backward"
    assert [one["picture"] for one in pictures(session)] == ["motion", "motion"]


def test_a_turning_knob_makes_quick_pictures_only(session):
    session.take({"do": "change", "path": "stops.gap", "value": 0.01, "dragging": True})
    assert {one["fine"] for one in pictures(session)} == {False}
    session.take({"do": "change", "path": "stops.gap", "value": 0.01})
    assert [one["fine"] for one in pictures(session)] == [True, True, True]


def test_what_is_overtaken_is_not_made(session):
    stages = list(session.stages())
    asked = session.asked
    session.take({"do": "change", "path": "mass", "value": 600})
    with pytest.raises(Stopped):
        session.make(stages[0], asked)


@pytest.mark.parametrize(
    "message",
    [
        None,
        [],
        {"do": 3},
        {"do": "nothing"},
        {"do": "change", "path": "mass"},
        {"do": "change", "path": "mass", "value": True},
        {"do": "change", "path": "mass", "value": "1 m"},
        {"do": "change", "path": "oscillator.__init__", "value": 1},
        {"do": "change", "path": "mass", "value": 1e300},
        {"do": "change", "path": "amplitude", "value": 1e-320},
        {"do": "change", "path": "stops.stiffness", "value": "1e-320"},
        {"do": "change", "path": "isolator.stiffness", "value": 0},
        {"do": "law", "part": "isolator", "kind": "magic"},
        {"do": "law", "part": "state", "kind": "rigid"},
        {"do": "choose", "direction": "up", "frequency": 1},
        {"do": "choose", "direction": "forward", "frequency": 1e9},
        {"do": "look", "what": "everything", "on": True},
        {"do": "place", "x": "1", "y": 2},
        {"do": "place", "x": 1e400, "y": 2},
        {"do": "preset", "name": "../../etc/passwd"},
        {"do": "open", "address": "AAAA"},
        {"do": "look", "what": "state", "on": True},
        {"do": "change", "path": float("nan"), "value": 1},
        {"do": "change", "path": "\ud800", "value": 1},
        {"do": "preset", "name": "\ud800", "path": ["mass"]},
    ],
)
def test_what_is_wrong_is_refused_and_changes_nothing(session, message):
    before = session.history
    answer = session.take(message)
    assert answer["refused"]
    assert session.history == before
    assert json.loads(_text(answer).encode()) == answer  # it can be sent


ODD = [
    None,
    True,
    [],
    {},
    [1],
    {"kind": []},
    "",
    "x",
    "nan",
    "\ud800",
    0,
    -1,
    1e308,
    1e-320,
    10**400,
]


def places(table, path=()):
    yield path
    inner = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in inner:
        yield from places(value, (*path, key)) if isinstance(value, dict | list) else [(*path, key)]


@pytest.mark.parametrize("odd", ODD, ids=repr)
def test_an_address_of_wrong_types_is_answered(session, odd):
    written = json.loads(base64.urlsafe_b64decode(share.address(session.state) + "=="))
    for path in places(written):
        table = {"whole": json.loads(json.dumps(written))}
        part = table
        for key in (keys := ("whole", *path))[:-1]:
            part = part[key]
        part[keys[-1]] = odd
        address = base64.urlsafe_b64encode(json.dumps(table["whole"]).encode()).decode()
        answer = session.take({"do": "open", "address": address})
        assert "state" in json.loads(_text(answer).encode())
        session.take({"do": "open", "address": share.address(preset("B2-G1-A3"))})


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("path", ["isolator.damping", "damping_ratio", "amplitude", "force"])
def test_knobs_beyond_all_bounds_are_told_in_words(session, path):
    session.take({"do": "look", "what": "map", "on": True})
    for value in (1e150, 1e300):
        if "refused" in session.take({"do": "change", "path": path, "value": value}):
            continue
        for stage in session.stages():
            if not stage.long and stage.kind != "map":
                with contextlib.suppress(vi.InputError):
                    session.make(stage, session.asked)


def test_files(session, tmp_path):
    answer = session.file("netcdf")
    path = tmp_path / answer["file"]
    path.write_bytes(base64.b64decode(answer["bytes"]))
    assert vi.load(path).sizes["frequency"] == 181
    table = base64.b64decode(session.file("csv")["bytes"]).decode()
    assert table.count("\n") == 1 + 2 * 181
    with pytest.raises(vi.InputError, match="file"):
        session.file("/etc/passwd")


def test_coarse_pictures_are_waited_for_and_long_ones_are_left(session):
    stages = list(session.stages())
    assert [stage.long for stage in stages] == [False, False, False, True, True, True]
