"""The boundary of public functions: arguments are checked by their annotations."""

from __future__ import annotations

import inspect
from typing import Annotated, Literal

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.model.argument_types import PositiveInt, Share
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig
from vibroimpact.model.written_units import unitless

UNCHECKED = {"threads", "where", "nodes"}
"""Read with another argument, or of two forms."""


def _tenfold(value: object, field: str) -> int:
    if not isinstance(value, int):
        raise vi.InputError(f"{field}: {value!r}; pass a whole number")
    return 10 * value


@public
def _asked(
    size: Annotated[int, _tenfold],
    share: Share | None = None,
    *,
    log: bool = False,
    kind: Literal["a", "b"] | None = None,
    free: object = None,
) -> tuple[object, ...]:
    """Return the arguments."""
    return size, share, log, kind, free


@public
def _read(rig: AnyRig, count: PositiveInt = 1) -> tuple[AnyRig, int, bool]:
    """Return the arguments, and whether values have no units."""
    return rig, count, unitless()


def test_an_argument_is_what_its_check_returns():
    assert _asked(2, "0.5", log=np.bool_(True), kind="b", free="x") == (20, 0.5, True, "b", "x")
    assert _asked(size=2) == (20, None, False, None, None)
    assert _asked(2, None) == (20, None, False, None, None)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"size": "x"}, "size: 'x'; pass a whole number"),
        ({"size": 1, "share": 2}, "share: 2; pass a number between 0 and 1"),
        ({"size": 1, "log": 1}, "log: 1; pass True or False"),
        ({"size": 1, "kind": "c"}, "kind: 'c' is unknown; use a or b"),
    ],
)
def test_an_error_names_the_argument(wrong, message):
    with pytest.raises(vi.InputError, match=message):
        _asked(**wrong)


def test_a_call_that_python_refuses_names_the_function():
    with pytest.raises(TypeError, match=r"_asked\(\) got an unexpected keyword argument 'sizes'"):
        _asked(sizes=3)
    with pytest.raises(TypeError, match=r"_asked\(\) missing 1 required positional argument"):
        _asked()


def test_a_rig_is_read_and_chooses_the_units():
    rig, count, plain = _read("B2-G1-A3", 2)
    assert (rig, count, plain) == (vi.laboratory.case("B2-G1-A3").rig, 2, False)
    oscillator = vi.Oscillator(mass=1.0, isolator=vi.Isolator(1.0, 0.1), units="none")
    assert _read(vi.Rig(oscillator, 1.0))[2]


def test_signatures_and_help_are_those_of_the_function():
    assert list(inspect.signature(vi.basins).parameters)[:2] == ["rig", "displacement"]
    assert vi.basins.__doc__.startswith("Compute the basins of attraction")
    assert vi.basins.__module__ == "vibroimpact.attraction.basins"


def test_public_functions_check_their_numbers():
    """No argument of a public function is only an `int` or a `bool`: each has a check."""
    checks = 0
    for name in vi.__all__:
        function = getattr(vi, name)
        if not inspect.isfunction(function) or not function.__module__.startswith("vibroimpact."):
            continue
        for one in inspect.signature(function).parameters.values():
            plain = str(one.annotation).replace(" | None", "")
            if plain == "int":
                assert one.name in UNCHECKED, f"{name}({one.name}=)"
            if plain in {"bool", "PositiveInt", "NonNegativeInt", "MaxEvents", "Progress", "Share"}:
                assert hasattr(function, "__wrapped__"), f"{name} is not @public"
                checks += 1
    assert checks > 60


def test_every_public_function_of_the_package_is_checked():
    unchecked = {
        name
        for name in vi.__all__
        if inspect.isfunction(getattr(vi, name)) and not hasattr(getattr(vi, name), "__wrapped__")
    }
    assert unchecked == set()


def test_a_function_without_arguments_may_be_public():
    assert public(lambda: 3)() == 3


def test_every_figure_is_checked_or_finished():
    unchecked = {
        name
        for name in figures.__all__
        if inspect.isfunction(getattr(figures, name))
        and not hasattr(getattr(figures, name), "__wrapped__")
    }
    assert unchecked == set()


CASE = "B2-G1-A3"


@pytest.mark.parametrize(
    ("call", "line"),
    [
        (lambda: vi.required_gap(CASE, fractile="x"), "fractile: 'x'"),
        (lambda: vi.required_gap(CASE, fractile=7), "fractile: 7"),
        (lambda: vi.required_gap(CASE, tail="x"), "tail: 'x'"),
        (lambda: vi.required_gap(CASE, tail=-1.0), "tail: -1"),
        (lambda: vi.progress_bar(3), "what: 3; pass a string"),
        (lambda: vi.progress_bar("done", every="x"), "every: 'x'"),
        (lambda: vi.for_each_rig(3), "function: 3; pass a function of one rig"),
        (lambda: vi.for_each_rig(len, threads="a"), "threads: 'a'; pass a whole number"),
        (lambda: vi.explore(CASE, height=0), "height: 0; pass a whole number"),
        (lambda: vi.modes(3), "rig: 3 is not a rig"),
        (lambda: vi.to_dimensionless(3), "rig: 3 is not a rig"),
        (lambda: vi.compare_fits(3), "fits: 3; pass a dict of results of identify"),
        (lambda: vi.save(3, 4), "path: 4 is not a path"),
        (lambda: figures.family_legend(3), "ax: 3; pass Axes of matplotlib"),
        (lambda: figures.frequency_marks(3, {}), "axes: 3; pass Axes of matplotlib"),
        (lambda: figures.feature_map(3, "extent"), "data: 3; pass the result of scenario_map"),
        (lambda: figures.save_figure(3, 4), "path: 4 is not a path"),
        (lambda: figures.save_animation(3, 4), "path: 4 is not a path"),
        (lambda: figures.assembly_drawing(3), "assembly: 3 is not an Assembly"),
    ],
)
def test_nonsense_is_refused_where_it_is_passed(call, line):
    with pytest.raises(vi.InputError, match=f"^{line}"):
        call()
