"""Options say what the arguments of the library say, and have their defaults."""

from __future__ import annotations

import importlib
import inspect
import re
from dataclasses import fields
from typing import Any, get_type_hints

import pytest
from cyclopts import Parameter
from docstring_parser import parse_from_object

import vibroimpact as vi
from vibroimpact import cli
from vibroimpact.cli import _COMMANDS
from vibroimpact.cli.function_options import (
    describe,
    is_group,
    read_arguments,
    with_default,
)
from vibroimpact.cli.options import OutputOptions, RigOptions, ThresholdOptions
from vibroimpact.cli.records import RecordOptions
from vibroimpact.cli.states import StateOptions
from vibroimpact.model.parameters import PARAMETERS, canonical
from vibroimpact.scenarios.axes import NAMES

OWN_DEFAULTS = {
    ("bifurcation", "direction"): "both, as the function, by its name",
    ("basins", "nodes"): "a figure has about so many pixels",
    ("branch", "basins"): "a number of basins; the function takes the basins",
    ("scenario_map", "refine"): "a map with smooth borders",
    ("record", "damping"): "a text that may hold several; the same value",
    ("record", "periods"): "a number of periods; the function takes the periods",
}
"""Options whose default is not that of an argument of the same name, and why."""


def _command(name: str):
    module = name.replace("-", "_")
    function = "scenario_map" if name == "map" else module
    return getattr(importlib.import_module(f"vibroimpact.cli.{module}"), function)


COMMANDS = {name: _command(name) for name in _COMMANDS}
CALLING = [name for name, command in COMMANDS.items() if command.called_function]


def _options(command) -> dict[str, inspect.Parameter]:
    parameters = inspect.signature(command).parameters
    hints = get_type_hints(command, include_extras=True)
    return {name: one for name, one in parameters.items() if not is_group(hints[name])}


def _help(command, name: str) -> str:
    hint = get_type_hints(command, include_extras=True)[name]
    texts = [one.help for one in hint.__metadata__ if isinstance(one, Parameter) and one.help]
    return texts[-1] if texts else ""


def _counterparts(name: str) -> dict[str, tuple[Any, Any]]:
    """Return the defaults of options and of the arguments that they set."""
    command = COMMANDS[name]
    library = inspect.signature(getattr(vi, command.called_function)).parameters
    defaults = {}
    for option, one in _options(command).items():
        argument = library.get(command.called_arguments.get(option, option))
        if argument is None or one.kind is not inspect.Parameter.KEYWORD_ONLY:
            continue
        if one.default in (None, (), inspect.Parameter.empty):
            continue  # the study or the function states it, or the option is a list
        defaults[option] = (one.default, argument.default)
    return defaults


@pytest.mark.parametrize("name", CALLING)
def test_defaults_are_those_of_the_function(name):
    for option, (own, argument) in _counterparts(name).items():
        differs = (COMMANDS[name].__name__, option) in OWN_DEFAULTS
        assert (own != argument) == differs, option


def test_enough_defaults_are_compared():
    compared = {
        (COMMANDS[name].__name__, option) for name in CALLING for option in _counterparts(name)
    }
    assert len(compared) > 25
    assert OWN_DEFAULTS.keys() <= compared


@pytest.mark.parametrize("name", CALLING)
def test_the_source_is_read_as_the_function_is(name):
    function = COMMANDS[name].called_function
    real = inspect.signature(getattr(vi, function)).parameters
    read = read_arguments(function)
    assert list(read) == list(real)
    for argument, one in read.items():
        if one.default is not inspect.Parameter.empty:
            assert one.default == real[argument].default, argument


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_has_a_help_and_says_its_default(name):
    command = COMMANDS[name]
    for option, one in _options(command).items():
        text = _help(command, option)
        assert text[:1].isupper(), f"{option}: {text!r}"
        assert text.endswith("."), f"{option}: {text!r}"
        if one.kind is not inspect.Parameter.KEYWORD_ONLY or one.default in ((), False):
            continue
        if one.default is True:
            assert "This is the default." in text, option
        elif one.default is not inspect.Parameter.empty:
            assert re.search(r"[Dd]efault\b|Replaces", text), f"{option}: {text!r}"


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_a_command_ends_with_its_examples(name):
    text = COMMANDS[name].__doc__
    assert text.splitlines()[-1].startswith(f"    vibroimpact {name}")
    assert "Parameters" not in text


def test_parameters_in_the_examples_of_the_help_are_paths():
    texts = [cli._HELP, *(one.__doc__ for one in COMMANDS.values())]
    examples = [
        path
        for text in texts
        for paths in re.findall(r"--(?:free|set|vary|uncertain|each) ([\w.,]+)", text)
        for path in paths.split(",")
    ]
    assert len(examples) > 15
    parts = ("isolator", "left", "right")
    strange = {one for one in examples if canonical(one, PARAMETERS) not in PARAMETERS}
    assert not strange.difference(parts, NAMES)


@pytest.mark.parametrize("name", COMMANDS)
def test_defaults_in_help_are_those_of_the_signature(name):
    command = COMMANDS[name]
    for option, one in _options(command).items():
        if isinstance(one.default, int | float) and not isinstance(one.default, bool):
            text = _help(command, option)
            stated = re.search(r"[Dd]efault: ([\d.e+-]*\d)", text)
            assert stated, f"{option}: {text!r}"
            assert float(stated[1]) == one.default, option


@pytest.mark.parametrize(
    "group", [RigOptions, ThresholdOptions, RecordOptions, StateOptions, OutputOptions]
)
def test_options_in_groups_have_a_help(group):
    described = {one.arg_name: one.description for one in parse_from_object(group).params}
    for field in fields(group):
        if field.name != "json":  # its type has the help
            assert described[field.name].endswith("."), field.name


def test_thresholds_in_the_help_are_those_of_the_library():
    source = inspect.getsource(ThresholdOptions)
    for name in vi.Thresholds.names():
        text = source.split(f"    {name}: ")[1]
        stated = re.search(r"[Dd]efault:\s+([\d.]*\d)", text)
        assert float(stated[1]) == getattr(vi.Thresholds(), name)


def test_a_description_elsewhere_is_found():
    assert read_arguments("sweep")["max_cycles"].help == "As in sweeps."
    assert describe("sweep", "max_cycles") == read_arguments("sweeps")["max_cycles"].help


@pytest.mark.parametrize(
    ("text", "default", "expected"),
    [
        ("Random seed.", 0, "Random seed (default: 0)."),
        ("Random seed. The same seed.", 0, "Random seed. The same seed. Default: 0."),
        ("Tolerance.", 1e-12, "Tolerance (default: 1e-12)."),
        ("Threads. Default: one.", None, "Threads. Default: one."),
        ("Flag.", False, "Flag."),
    ],
)
def test_defaults_in_sentences(text, default, expected):
    assert with_default(text, default) == expected
