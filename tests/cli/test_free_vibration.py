"""Free vibrations, falls, and masses without an isolator, on the command line."""

from __future__ import annotations

import json
import math

import pytest

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.errors import InputError

SPRING = """
[oscillator]
mass = "2 kg"
isolator = { stiffness = "1 kN/m", damping = 0 }
right = { stiffness = "10 kN/m", damping = 0, gap = "1 m" }
"""
FALL = """
[oscillator]
mass = "2 kg"
force = "-19.6 N"
left = { kind = "rigid", restitution = 0.8, gap = 0 }
"""


@pytest.fixture
def run(tmp_path, capsys):
    def run(command, text, *words):
        path = tmp_path / "one.toml"
        path.write_text(text)
        code = main([command, str(path), *words, "-o", str(tmp_path / "out")])
        out, errors = capsys.readouterr()
        return code, out, errors

    return run


@pytest.mark.parametrize("excitation", ["", "[excitation]\namplitude = 0\n"])
def test_a_spring_without_shaking_swings_at_its_natural_frequency(run, excitation):
    words = ("--displacement", "20 mm", "--cycles", "10.25", "--json")
    code, out, _ = run("simulate", SPRING + excitation, *words)
    facts = json.loads(out)
    assert code == 0
    assert facts["frequency"] == pytest.approx(math.sqrt(500.0) / math.tau, rel=1e-12)
    assert facts["final_state"]["displacement"] == pytest.approx(0.0, abs=1e-12)
    assert facts["final_state"]["velocity"] == pytest.approx(-0.02 * math.sqrt(500.0), rel=1e-9)


def test_a_dropped_mass_bounces(run):
    words = ("--displacement", "0.5 m", "--cycles", "2")
    code, out, _ = run("simulate", FALL, *words)
    assert code == 0
    assert "isolator          none" in out
    assert "at rest: free vibration" in out
    assert "State after 2 cycles (2 s)" in out  # without a spring a cycle is 1 s
    # It falls for √(2 h / g), then flies for 2 v / g with 0.8 times the speed v, and so on.
    g = 9.8
    speed, t = 0.8 * math.sqrt(2.0 * g * 0.5), 2.0 - math.sqrt(2.0 * 0.5 / g)
    while t > 2.0 * speed / g:
        t -= 2.0 * speed / g
        speed *= 0.8
    u = speed * t - 0.5 * g * t * t
    state = vi.simulate(
        vi.Rig(vi.Oscillator(2, left=vi.RigidStop(0.8, 0), force=-19.6)), 2, vi.State(0.5, 0.0)
    )
    assert float(state["displacement"][-1]) == pytest.approx(u, rel=1e-9)
    assert f"{1e3 * u:.6g} mm" in out


@pytest.mark.full
def test_options_take_away_the_shaking_and_the_isolator(run, tmp_path, capsys):
    words = ("--amplitude", "0", "--displacement", "5mm", "--cycles", "3", "-o", str(tmp_path))
    assert main(["simulate", "B2-G1-A3", *words]) == 0
    assert "at rest: free vibration" in capsys.readouterr().out
    words = ("--set", "isolator=none", "--frequency", "2Hz", "--cycles", "3", "-o", str(tmp_path))
    assert main(["simulate", "B2-G1-A3", *words]) == 0
    out = capsys.readouterr().out
    assert "B2-G1-A3, no isolator" in out
    assert "isolator        none" in out
    both = ("--set", "isolator=none", "--set", "isolator.stiffness=2kN/m")
    assert main(["simulate", "B2-G1-A3", *both]) == 2
    assert (
        "--set: isolator.stiffness: the part is removed by isolator=none" in capsys.readouterr().err
    )
    assert main(["simulate", "B2-Ginf-A3", "--set", "isolator=none"]) == 2
    assert "nothing holds the mass" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["sweep", "branch", "motion", "classify", "basins"])
def test_other_commands_need_a_shaking(run, command):
    words = ("--frequency", "2") if command in ("motion", "basins") else ()
    code, _, errors = run(command, SPRING, *words)
    assert code == 2
    assert "excitation.amplitude: missing; set it in the study" in errors
    assert "use vibroimpact simulate" in errors
    code, _, errors = run(command, SPRING, "--amplitude", "0 mm", *words)
    assert code == 2
    assert "--amplitude: 0; set it in the study, or pass --amplitude" in errors


def test_a_rig_of_python_that_nothing_shakes():
    oscillator = vi.Oscillator(2, vi.Isolator(1000, 3), vi.Bumper(1e4, 1, 0.005))
    start = vi.State(-0.02, 0.0)
    ends = [
        vi.simulate(vi.Rig(oscillator, *shaking), 3, start)["final_state"].values
        for shaking in ((), (0,), ("0 mm",), (vi.Harmonic(0, oscillator.natural_frequency),))
    ]
    assert all((end == ends[0]).all() for end in ends)
    shaken = vi.simulate(vi.Rig(oscillator), 3, start, frequency="2 Hz")
    assert float(shaken["time"][-1]) == pytest.approx(1.5)
    with pytest.raises(InputError, match=r"^shaking: missing, and the rig has no shaking"):
        vi.sweep(vi.Rig(oscillator, 0), [1, 2])
    for call in (vi.orbit, lambda rig: vi.bifurcation_diagram(rig, {"gap": (0.001, 0.01)}, 3)):
        with pytest.raises(InputError, match=r"^shaking: 0; pass an amplitude greater than 0"):
            call(vi.Rig(oscillator, vi.Harmonic(0, 2)))


def test_an_oscillator_without_isolator_is_held_by_stops():
    stop = vi.Bumper(1e4, 1, 0.005)
    free = vi.Oscillator(2, right=stop, left=stop)
    assert free == vi.Oscillator(2, vi.Isolator(0, 0), stop, stop)
    assert free == vi.Oscillator(2, None, stop, stop)
    with pytest.raises(InputError, match="nothing holds the mass"):
        vi.Oscillator(2)
