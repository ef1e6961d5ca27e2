"""``vibroimpact show`` prints modes and the equilibrium of a rig, and draws it."""

from __future__ import annotations

import json
import re

import pytest

from vibroimpact.cli import main
from vibroimpact.figures.assembly import oscillator_drawing
from vibroimpact.model import FrictionIsolator, Oscillator, RigidStop

COMMAND = "show"


def test_one_mass(run, tmp_path) -> None:
    code, out, errors = run("B2-G1-A3", "--figure", "svg")
    assert (code, errors) == (0, "")
    assert "natural frequency 1.1 Hz" in out
    assert "Static equilibrium: u = 0 m" in out
    assert (tmp_path / "out/B2-G1-A3-system.svg").stat().st_size > 1000


@pytest.mark.parametrize("kind", ["neighbours", "frame", "record", "mass"])
def test_every_kind_of_study(kind, run, tmp_path) -> None:
    assert main(["init", str(tmp_path / "own.toml"), "--kind", kind]) == 0
    code, out, errors = run("own.toml")
    assert (code, errors) == (0, "")
    assert out.splitlines()[-1] == "  out/own-system.png"
    assert "Static equilibrium" in out


def test_modes_and_the_equilibrium_are_those_of_the_library(run, tmp_path) -> None:
    assert main(["init", str(tmp_path / "own.toml"), "--kind", "frame"]) == 0
    pushed = (tmp_path / "own.toml").read_text() + "\n[assembly.forces]\nroof = '70 kN'\n"
    (tmp_path / "pushed.toml").write_text(pushed)
    code, out, errors = run("pushed.toml", "--json")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    first = facts["modes"][0]
    assert first["natural_frequency"] == pytest.approx(facts["natural_frequencies"][0])
    assert max(first["mode_shape"].values()) == pytest.approx(1.0)
    moved = facts["equilibrium"]["displacement"]
    assert moved["base"] == pytest.approx(0.01)  # 70 kN on 7 MN/m
    assert moved["roof"] == pytest.approx(0.01 + 3 * 70e3 / 150e6)
    _, out, _ = run("pushed.toml")
    assert re.search(r"roof +11\.4$", out, re.M)
    assert out.count("Note: ") == 1
    assert "Note: damping: the undamped modes do not decouple it" in out


def test_paths_with_present_values(run, tmp_path) -> None:
    (tmp_path / "own.toml").write_text(
        "[oscillator]\nmass = '550 kg'\n[oscillator.isolator]\nkind = 'bouc-wen'\n"
        "elastic_stiffness = '100 kN/m'\npost_yield_stiffness = '30 kN/m'\n"
        "yield_force = '800 N'\ndamping = 0\nexponent = 2\n"
        "[oscillator.right]\nkind = 'power'\nstiffness = '2 MN/m^1.5'\ngap = '5 mm'\n"
        "[oscillator.left]\nkind = 'rigid'\nrestitution = 0.5\ngap = '7 mm'\n"
        "[excitation]\namplitude = '0.05 g'\n"
    )
    code, out, errors = run("own.toml")
    assert (code, errors) == (0, "")
    listed = out[out.index("Parameters by path") :]
    for path, text in (
        ("frequency", "open"),
        ("amplitude", "0.05 g"),
        ("isolator.yield_force", "800 N"),
        ("isolator.exponent", "2 +a whole number, which cannot be varied"),
        ("gap", "differs between the stops"),
        ("stops.left.gap", "7 mm"),
        ("stops.right.stiffness", r"2000 kN/m\^1.5"),
        ("restitution", None),
        ("damping_ratio", None),
    ):
        assert bool(re.search(rf"^{re.escape(path)} +{text}$", listed, re.M)) == (text is not None)
    values = json.loads(run("own.toml", "--json")[1])["parameters"]
    assert values["isolator.yield_force"] == 800.0
    assert (values["isolator.exponent"], values["gap"], values["stops.left.gap"]) == (2, None, 7e-3)
    for path in [
        path for path, value in values.items() if value is not None and path != "amplitude"
    ]:
        assert run("own.toml", "--set", f"{path}={values[path]!r}")[0] == 0, path


def test_without_units(run, tmp_path) -> None:
    (tmp_path / "pair.toml").write_text(
        "[assembly]\nunits = 'none'\nmasses = {a = 1, b = 2}\n"
        "[assembly.links.s]\nleft = 'ground'\nright = 'a'\n"
        "stiffness = 1\ndamping = 0.1\n"
        "[assembly.stops.p]\nleft = 'a'\nright = 'b'\n"
        "kind = 'rigid'\nrestitution = 0.5\ngap = 0.1\n"
        "[excitation]\namplitude = 1\n"
    )
    code, out, errors = run("pair.toml")
    assert code == 0, errors
    assert "Hz" not in out
    assert "mode    ω" in out


def test_the_drawing_of_one_mass_has_what_it_has() -> None:
    wall = RigidStop(0.5, "2 cm")
    ax = oscillator_drawing(
        Oscillator("3 t", FrictionIsolator(1e4, 0, friction="1 kN"), right=wall)
    )
    words = {text.get_text() for text in ax.texts}
    assert words >= {"mass\n3000 kg", "isolator", "right: gap 20 mm"}
    assert not any("left" in one for one in words)
