"""The page of a rig without units: no unit anywhere, ω instead of f, and plain numbers."""

from __future__ import annotations

import base64
import json
import math
import re

import numpy as np
import pytest

import vibroimpact as vi
from explorer.test_session import pictures
from vibroimpact.explorer import share
from vibroimpact.explorer.session import Session, shown_as
from vibroimpact.explorer.state import begin
from vibroimpact.model.study import read_rig_study
from vibroimpact.model.written_units import unitless

RIG = vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1), vi.Bumper(20, 0.5, 2), vi.Bumper(20, 0.5, 2)), 1)
STATED = vi.Rig(vi.Oscillator(3, vi.Isolator(2, 0.3), vi.Bumper(40, 1, 2), units="none"), 1)
UNIT = re.compile(
    r"(?:\d\s*|\()(?:mm|m|µm|kg|g|mg|t|[kM]?N|[kM]?N/m|k?N s/m|m/s|mm/s|m/s²|[mk]?Hz|m?s|[mk]?J|"
    r"1/s|N s|rad/s)(?![\w/])"
)
"""A unit after a number, or in parentheses."""


def texts(value):
    """All strings in nested lists and dicts, but for names that only the program reads."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, one in value.items():
            if key not in ("address", "path"):
                yield from texts(one)
    elif isinstance(value, list):
        for one in value:
            yield from texts(one)


@pytest.fixture(scope="module", params=[RIG, STATED], ids=["ones", "stated"])
def session(request):
    return Session(begin(request.param, "bare"))


def test_the_state_keeps_the_units_of_its_rig(session):
    state = session.state
    assert state.oscillator.units == "none"
    natural = math.tau * state.oscillator.natural_frequency
    low, high = (math.tau * end for end in state.span)
    assert low == pytest.approx(0.45 * natural, rel=0.05)
    assert float(f"{low:.2g}") == pytest.approx(low, rel=1e-12)  # rounded as ω, which is shown
    assert high == pytest.approx(4.5 * natural, rel=0.05)
    assert share.from_address(share.address(state)) == state


def test_no_text_that_is_sent_has_a_unit(session):
    session.take({"do": "look", "what": "branch", "on": True})
    session.take({"do": "look", "what": "basins", "on": True})
    for physical in (False, True):
        answer = session.take({"do": "look", "what": "physical", "on": physical})
        sent = [answer, *pictures(session)]
        odd = [text for text in texts(sent) if UNIT.search(text) or "Hz" in text or " µ" in text]
        assert odd == []
        assert answer["state"]["without_units"]
    assert not unitless()  # any more


def test_pictures_are_in_the_numbers_of_the_rig():
    session = Session(begin(RIG))
    session.take({"do": "look", "what": "physical", "on": True})
    messages = {(one["picture"], one["fine"]): one for one in pictures(session)}
    coarse, motion = messages["curves", False], messages["motion", True]
    swept = vi.sweep(RIG, np.array(coarse["frequency"]) / math.tau)
    regular = (swept["period"] > 0).sel(direction="forward").values
    assert regular.mean() > 0.5
    for k, name in enumerate(("peak_acceleration", "peak_displacement")):
        drawn = np.array(coarse["panels"][k]["curves"]["forward"], dtype=float)
        expected = swept[name].sel(direction="forward").values
        np.testing.assert_allclose(drawn[regular], expected[regular], rtol=1e-3)
    assert motion["frequency"] == pytest.approx(
        math.tau * session.state.shaking.frequency, rel=0.05
    )
    assert motion["gaps"] == {"right": 2.0, "left": -2.0}
    f = motion["frequency"] / math.tau
    begun = swept["section"].sel(direction="forward").sel(frequency=f, method="nearest")
    held = vi.steady(RIG, begun, frequency=f)
    for name in ("displacement", "velocity", "transmitted_force"):
        reached = max(map(abs, motion[name.removeprefix("transmitted_")]))
        assert reached == pytest.approx(float(abs(held[name]).max()), rel=0.01)
    assert motion["axes"]["time"] == "time"
    assert motion["axes"]["spectrum"] == "frequency ω"
    assert motion["axes"]["force"] == "force"
    assert motion["spectrum"]["frequency"][0] == pytest.approx(motion["frequency"], rel=1e-3)


def test_numbers_of_the_frequency_are_omega():
    session = Session(begin(RIG))
    for value in (1.5, "1.5", "1.5 rad/s"):
        answer = session.take({"do": "choose", "direction": "forward", "frequency": value})
        assert answer["state"]["frequency_text"] == "1.5"
        assert session.state.shaking.frequency == pytest.approx(1.5 / math.tau)
    refused = session.take({"do": "choose", "direction": "forward", "frequency": 99})["refused"]
    assert "ω = 99" in refused
    assert "ω = 0.45 to 4.5" in refused
    assert "Hz" not in refused


@pytest.mark.parametrize("span", [None, (1 / 3, 10 / 3), (0.123456789, 1.23456789)])
@pytest.mark.parametrize("rig", [RIG, vi.laboratory.case("B2-G1-A3")], ids=["none", "SI"])
def test_both_ends_of_the_curves_can_be_chosen(rig, span):
    session = Session(begin(rig, "x", span))
    coarse = session.make(next(session.stages()), session.asked)
    for end in (0, -1):
        answer = session.take(
            {"do": "choose", "direction": "forward", "frequency": coarse["frequency"][end]}
        )
        assert "refused" not in answer
        assert session.state.shaking.frequency == session.state.span[end]


@pytest.mark.parametrize("path", ["amplitude", "mass", "stops.gap", "isolator.damping"])
def test_a_value_with_a_unit_is_refused(path):
    session = Session(begin(RIG))
    unit = {"amplitude": "0.05 g", "mass": "2 kg", "stops.gap": "5 mm"}.get(path, "1 N s/m")
    answer = session.take({"do": "change", "path": path, "value": unit})
    assert answer["refused"].count("\n") == 0
    assert "has a unit, but" in answer["refused"]
    answer = session.take({"do": "change", "path": path, "value": "few"})
    assert not UNIT.search(answer["refused"])
    answer = session.take({"do": "change", "path": path, "value": "0.3"})
    assert "refused" not in answer
    knob = next(one for one in answer["state"]["controls"] if one["path"] == path)
    assert (knob["value"], knob["text"]) == (0.3, "0.3")


def test_files_keep_the_rig_without_units(tmp_path):
    state = begin(STATED, "bare")
    path = tmp_path / "bare.toml"
    path.write_text(share.study(state), encoding="utf-8")
    read = read_rig_study(path)
    assert read.oscillator == STATED.oscillator
    assert read.amplitude == 1.0
    names: dict[str, object] = {}
    program = share.program(state)
    exec(program.split("frequencies =")[0], names)
    assert names["rig"].oscillator == STATED.oscillator
    assert not UNIT.search(program)
    session = Session(state)
    kept = tmp_path / "bare.nc"
    kept.write_bytes(base64.b64decode(session.file("netcdf")["bytes"]))
    assert vi.load(kept).unit_system == "none"


def test_a_study_file_states_that_a_number_is_a_force(tmp_path):
    pushed = vi.Rig(STATED.oscillator, vi.Harmonic(0.5, 0.2, of="force"))
    session = Session(begin(pushed))
    assert "force amplitude" in json.dumps(shown_as(session.history))
    path = tmp_path / "pushed.toml"
    path.write_bytes(base64.b64decode(session.file("study")["bytes"]))
    again = begin(path)
    assert again.shaking == begin(pushed).shaking
    assert again.oscillator.units == "none"
    assert "of='force'" in base64.b64decode(session.file("python")["bytes"]).decode()
