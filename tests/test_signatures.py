"""Parameters of public functions have the names and defaults that docs/reference/words.md lists."""

from __future__ import annotations

import ast
import inspect
import re
from pathlib import Path
from typing import Any

import pytest

import vibroimpact as vi
from contributing import rows
from vibroimpact import figures

REQUIRED = inspect.Parameter.empty
FORBIDDEN = {"oscillator", "excitation", "amplitude", "shaking", "base", "guess", "low", "high"}
"""Parts of a rig, and names of the interface before rigs; `Rig` and ranges took their place."""
BUILDERS = {"from_dimensionless"}
"""Functions that make a rig of numbers, as constructors do."""
RIG_TYPE = re.compile(r"\b(AnyRig|Rig|Oscillator)\b")


def _functions() -> dict[str, inspect.Signature]:
    found: dict[str, Any] = {name: getattr(vi, name) for name in vi.__all__}
    found |= {f"figures.{name}": getattr(figures, name) for name in figures.__all__}
    found |= {f"laboratory.{name}": getattr(vi.laboratory, name) for name in ("case", "campaign")}
    return {
        name: inspect.signature(thing) for name, thing in found.items() if inspect.isfunction(thing)
    }


FUNCTIONS = _functions()


def _default(cell: str) -> object:
    """Read a default: "required", or a Python literal in backticks."""
    return REQUIRED if cell == "required" else ast.literal_eval(cell.strip("`"))


WORDS = {row[0].strip("`"): _default(row[3]) for row in rows("Words of signatures")}
EXCEPTIONS = {
    (row[0].strip("`"), row[1].strip("`")): _default(row[2])
    for row in rows("Exceptions in signatures")
}


def _named(function: str) -> dict[str, object]:
    return {name: one.default for name, one in FUNCTIONS[function].parameters.items()}


def test_the_tables_are_read():
    assert len(FUNCTIONS) > 70
    assert {"rig", "frequency", "vary", "seed", "tolerance", "frequency_span"} <= set(WORDS)
    assert WORDS["seed"] == 0
    assert WORDS["vary"] is REQUIRED
    assert all(row[3] for row in rows("Exceptions in signatures")), "an exception has a reason"


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


def test_long_computations_take_what_is_listed():
    words = {"where", "threads", "progress"}
    listed = {}
    for parameters, functions, reason in rows("Long computations"):
        assert reason
        for name in re.findall(r"`(\w+)`", functions):
            listed[name] = set(re.findall(r"`(\w+)`", parameters))
    taking = {name: words & set(_named(name)) for name in FUNCTIONS if "progress" in _named(name)}
    assert listed == {name: found for name, found in taking.items() if "." not in name}


def test_every_word_is_used():
    used = {name for function in FUNCTIONS for name in _named(function)}
    assert set(WORDS) <= used


def test_every_exception_is_one():
    for (function, name), default in EXCEPTIONS.items():
        assert _named(function)[name] == default, f"{function}({name}=)"
        assert name in FORBIDDEN or WORDS[name] != default, f"{function}({name}=) is as usual"


def test_names_lists_parameters_as_they_are():
    page = (Path(__file__).parents[1] / "docs/names.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\| `([\w.]+)\((.*?)\)` \|", page, re.M)
    assert {name for name, _ in shown} >= {name for name in FUNCTIONS if "figures" not in name}
    for name, text in shown:
        thing = vi
        for part in name.split("."):
            thing = getattr(thing, part)
        parameters = inspect.signature(thing).parameters
        words = [word.strip() for word in text.split(",") if word.strip()]
        listed = [word for word in words if word not in {"*", "…"}]
        order = [parameter for parameter in parameters if parameter in listed]
        assert listed == order, name
        if "…" not in words:
            assert listed == list(parameters), name
        if "*" in words:
            first = words[words.index("*") + 1]
            after = words[: words.index("*")]
            assert parameters[first].kind is inspect.Parameter.KEYWORD_ONLY, (name, first)
            assert all(parameters[one].kind is not inspect.Parameter.KEYWORD_ONLY for one in after)


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
