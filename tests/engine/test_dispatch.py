"""Both flows answer every question, with a kernel of their own."""

from __future__ import annotations

import inspect

import pytest

from vibroimpact.engine import dispatch, flow_dispatch
from vibroimpact.engine import parameters as par
from vibroimpact.engine.parameters import free_rig, rig_vector
from vibroimpact.law_numbers import IsolatorNumbers

NAMES = [
    name
    for name, value in vars(dispatch).items()
    if inspect.isfunction(value) and value.__qualname__.startswith("_by_flow.")
]


def test_the_questions() -> None:
    assert set(dispatch._MODULES) == set(range(3)), flow_dispatch  # which says who answers
    assert {"build", "carry", "sample_stretch", "acceleration"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_both_answer_alike(name: str) -> None:
    linear, taylor = (dispatch._found(laws, name) for laws in (par.LINEAR, par.BENT))
    assert ".linear." in linear.__module__
    assert ".taylor." in taylor.__module__
    # What yields has tables of its own, and is asked as what is curved for all else.
    yielding = dispatch._found(par.YIELDING, name)
    assert yielding is taylor or (".yielding." in yielding.__module__ and name == "build")
    assert len(inspect.signature(linear).parameters) == len(inspect.signature(taylor).parameters)


def test_what_is_not_there_is_said() -> None:
    with pytest.raises(AttributeError, match="the flow of curved laws has no nonsense"):
        dispatch._found(par.BENT, "nonsense")
    with pytest.raises(AttributeError, match="the flow of linear laws has no nonsense"):
        dispatch._found(par.LINEAR, "nonsense")


def test_without_a_compiler_the_rig_decides() -> None:
    curved = rig_vector(1.0, 4.0, 0.1, None, None, law=IsolatorNumbers(hysteretic=5.0))
    assert curved[par.CURVED] == 1.0
    assert dispatch.stiff_rate(curved) == 3.0
    linear = free_rig()
    assert linear[par.CURVED] == 0.0
    assert dispatch._found(par.LINEAR, "stiff_rate").__module__.startswith(
        "vibroimpact.engine.linear"
    )
