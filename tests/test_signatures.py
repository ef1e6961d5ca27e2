"""A parameter of public functions has one name and one default, but for exceptions with reasons."""

from __future__ import annotations

import ast
import inspect
import re
from pathlib import Path
from typing import Any

import pytest

import vibroimpact as vi
from vibroimpact import figures

REQUIRED = inspect.Parameter.empty
FORBIDDEN = {"oscillator", "excitation", "amplitude", "shaking", "base", "guess", "low", "high"}
"""Parts of a rig, and names of the interface before rigs; `Rig` and ranges took their place."""
BUILDERS = {"from_dimensionless"}
"""Functions that make a rig of numbers, as constructors do."""
RIG_TYPE = re.compile(r"\b(AnyRig|Rig|Oscillator)\b")


def _functions() -> dict[str, inspect.Signature]:
    public: dict[str, Any] = {name: getattr(vi, name) for name in vi.__all__}
    public |= {f"figures.{name}": getattr(figures, name) for name in figures.__all__}
    public |= {f"laboratory.{name}": getattr(vi.laboratory, name) for name in ("case", "campaign")}
    return {
        name: inspect.signature(thing)
        for name, thing in public.items()
        if inspect.isfunction(thing)
    }


FUNCTIONS = _functions()


WORDS: dict[str, Any] = {
    "rig": REQUIRED,
    "rigs": REQUIRED,
    "frequency": None,
    "frequencies": REQUIRED,
    "vary": REQUIRED,
    "start": None,
    "starts": None,
    "period": None,
    "samples": 256,
    "draws": 128,
    "seed": 0,
    "tolerance": 1e-12,
    "max_cycles": 2000,
    "max_events": 10000,
    "window": 500,
    "outputs": None,
    "records": None,
    "where": "threads",
    "threads": None,
    "progress": None,
    "store": None,
}
"""Parameters that have one meaning, and one default, in all public functions."""
EXCEPTIONS: dict[tuple[str, str], Any] = {
    # The explorer opens with a published rig.
    ("explore", "rig"): "B2-G1-A3",
    # Computed: the range that determines the scenario, or one around the natural frequency.
    ("classify_scenario", "frequencies"): None,
    ("coexisting_motions", "frequencies"): None,
    ("next_test", "frequencies"): None,
    # Without a parameter, the rigs that are passed are computed.
    ("basin_stability", "vary"): None,
    ("demands", "vary"): None,
    ("lyapunov_exponents", "vary"): None,
    # Stiffness and damping of the bumpers, in ranges that depend on the isolator.
    ("least_acceleration", "vary"): None,
    # Only the frequency, over all of its values.
    ("required_gap", "vary"): None,
    # The function cannot choose a bifurcation for the caller.
    ("bifurcation_curve", "start"): REQUIRED,
    # A count: of the parameter values at which simulations are started, or of local fits.
    ("resonance_diagram", "starts"): 40,
    ("identify", "starts"): 6,
    # The period of saddles that are passed as states, which the motion from rest does not give.
    ("manifolds", "period"): 1,
    # 256 per forcing cycle for a periodic shaking, and 1 per step for a record.
    ("simulate", "samples"): None,
    # Points in each of two random sets, of which draws × (parameters + 2) rigs are made.
    ("sensitivity", "draws"): 256,
    # Bootstrap samples, each of which requires a fit.
    ("identify", "draws"): 0,
    # 2000, or 300 for a map, which needs fewer details; more if the damping is light.
    ("classify_scenario", "max_cycles"): None,
    ("scenario_map", "max_cycles"): None,
    # A manifold is a curve with many points; one that needs more events is given up.
    ("manifolds", "max_events"): 1000,
    # The window is recorded as a time history, which takes memory.
    ("steady", "window"): 200,
    ("coexisting_motions", "window"): 200,
    # Cycles of a time history that are simulated from one fitted initial state; 5.
    ("identify", "window"): None,
    # A demand is the peak response to a record.
    ("demands", "records"): REQUIRED,
    # Threads for fewer than 500 nodes, and processes, which are then faster, for more.
    ("scenario_map", "where"): None,
    # No argument `rig` could contain the acceleration of the table, or a prescribed displacement.
    ("read_measurement", "amplitude"): None,
    ("figures.force_loop", "amplitude"): REQUIRED,
    # The motion is so slow that the dashpots exert no force.
    ("figures.force_loop", "frequency"): 0.0,
}

MANY_TASKS = {
    *("basin_stability", "basins", "bifurcation_diagram", "demands", "design_chart"),
    *("least_acceleration", "lyapunov_exponents", "required_gap", "scenario_map", "sweeps"),
}
"""Functions of many independent tasks: these have `where`, `threads` and `progress`."""
FEW_TASKS = {"classify_scenario", "identify", "manifolds", "sweep"}
"""Functions of a few tasks that share their results: these have `threads` and `progress`."""
ONE_TASK = {
    *("bifurcation_curve", "branch", "coexisting_motions", "resonance_diagram"),
    *("response_spectrum", "seismic_response", "simulate", "steady"),
    *("ensemble", "sensitivity"),  # their argument `response` decides where rigs are computed
}
"""Functions that compute one motion, or a curve from point to point: these have `progress`."""


def _named(function: str) -> dict[str, object]:
    return {name: one.default for name, one in FUNCTIONS[function].parameters.items()}


def test_functions_are_read():
    assert len(FUNCTIONS) > 70


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_word_has_one_default(function):
    for name, default in _named(function).items():
        if name in WORDS:
            assert default == EXCEPTIONS.get((function, name), WORDS[name]), name


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_rig_comes_first(function):
    parameters = list(FUNCTIONS[function].parameters.values())
    for place, one in enumerate(parameters):
        annotation = re.sub(r"Callable\[.*\]", "", str(one.annotation))
        if one.name in {"rig", "rigs"} or (
            RIG_TYPE.search(annotation) and function not in BUILDERS
        ):
            assert one.name in {"rig", "rigs"}, f"{one.name} takes a rig"
            assert place == 0, f"{one.name} is not the first parameter"


@pytest.mark.parametrize("function", FUNCTIONS)
def test_no_function_takes_a_rig_in_parts(function):
    for name in FORBIDDEN & set(_named(function)):
        assert function in BUILDERS or (function, name) in EXCEPTIONS, name


def test_long_computations_take_what_their_tasks_allow():
    words = {"where", "threads", "progress"}
    taking = {name: words & set(_named(name)) for name in FUNCTIONS if "progress" in _named(name)}
    assert {name: options for name, options in taking.items() if "." not in name} == {
        **dict.fromkeys(MANY_TASKS, words),
        **dict.fromkeys(FEW_TASKS, words - {"where"}),
        **dict.fromkeys(ONE_TASK, words & {"progress"}),
    }


def test_every_word_is_used():
    used = {name for function in FUNCTIONS for name in _named(function)}
    assert set(WORDS) <= used


def test_every_exception_is_one():
    for (function, name), default in EXCEPTIONS.items():
        assert _named(function)[name] == default, f"{function}({name}=)"
        assert name in FORBIDDEN or WORDS[name] != default, f"{function}({name}=) is as usual"


def test_calls_of_the_changes_are_possible():
    """The new calls in the table that moves a script over bind to the signatures."""
    page = (Path(__file__).parents[1] / "CHANGELOG.md").read_text(encoding="utf-8")
    table = page.split("| Before | Now |\n")[1].split("\n\n")[0]
    checked = set()
    for row in table.splitlines()[1:]:
        for text in re.findall(r"`([^`]*\(.*?\))`", row.strip("|").split("|")[1]):
            for call in ast.walk(ast.parse(text)):
                if isinstance(call, ast.Call) and isinstance(call.func, ast.Name):
                    words = {word.arg: None for word in call.keywords if word.arg}
                    inspect.signature(getattr(vi, call.func.id)).bind(*call.args, **words)
                    checked.add(call.func.id)
    assert len(checked) > 25
