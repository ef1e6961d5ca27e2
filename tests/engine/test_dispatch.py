"""Flows of one mass answer the same questions, each with a kernel of its own."""

from __future__ import annotations

import inspect
from operator import attrgetter
from types import ModuleType
from typing import Any

import pytest

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import by_laws
from vibroimpact.engine.forcing import dispatch as forcing
from vibroimpact.engine.forcing import harmonic, ramp, several
from vibroimpact.engine.jit import kernel
from vibroimpact.engine.one_mass import forces, motions
from vibroimpact.engine.parameters import free_rig, rig_vector
from vibroimpact.law_numbers import IsolatorNumbers


@kernel
def linear(plan, t):
    return 1.0


@kernel
def curved(plan, t):
    return 2.0


@kernel
def yielding(plan, t):
    return 3.0


@kernel
def longer(plan, t, x):
    return 4.0


@by_laws(linear, curved, yielding)
def asked(plan, t):
    """A question."""


@by_laws(linear, curved)
def asked_of_two(plan, t):
    """A question that Taylor series answer for what yields, too."""


RIGS = [IsolatorNumbers(), IsolatorNumbers(cubic=1.0), IsolatorNumbers(friction=0.1)]


@pytest.mark.parametrize(("law", "answers"), list(zip(RIGS, [(1, 1), (2, 2), (3, 2)], strict=True)))
def test_a_rig_is_answered_by_the_kernel_of_its_laws(law, answers) -> None:
    plan = rig_vector(1.0, 4.0, 0.1, None, None, law=law)
    assert (asked(plan, 0.0), asked_of_two(plan, 0.0)) == answers


def test_a_kernel_with_other_arguments_is_refused() -> None:
    with pytest.raises(TypeError, match=r"\.longer: its arguments are not plan, t$"):

        @by_laws(linear, longer)
        def asked_again(plan, t):
            """A question."""


def _questions(module: ModuleType) -> list:
    return [
        one
        for one in vars(module).values()
        if inspect.isfunction(one) and hasattr(one, "__wrapped__")
    ]


def _kernels(question) -> Any:
    return inspect.getclosurevars(question).nonlocals["kernels"]


@pytest.mark.parametrize(
    "question", [*_questions(forces), *_questions(motions)], ids=attrgetter("__name__")
)
def test_a_question_of_laws_is_answered_by_its_namesakes(question) -> None:
    kernels = _kernels(question)
    assert {one.__name__ for one in kernels} == {question.__name__}
    folders = [one.__module__.split(".")[2] for one in kernels]
    third = "yielding" if question is motions.build else "taylor"
    assert folders == ["linear", "taylor", third]


def test_a_question_of_forcings_is_answered_by_its_namesakes() -> None:
    modules = {par.HARMONIC: harmonic, par.SEVERAL: several, par.RAMP: ramp}
    questions = _questions(forcing)
    assert len(questions) == 17
    for one in questions:
        # By its name in the module: one may be another there, too.
        assert _kernels(one) == {
            code: getattr(module, one.__name__) for code, module in modules.items()
        }


def test_without_a_compiler_the_rig_decides() -> None:
    curved_rig = rig_vector(1.0, 4.0, 0.1, None, None, law=IsolatorNumbers(hysteretic=5.0))
    assert curved_rig[par.CURVED] == 1.0
    assert forces.stiff_rate(curved_rig) == 3.0
    assert free_rig()[par.CURVED] == 0.0
    assert forces.stiff_rate(free_rig()) == 1.0
