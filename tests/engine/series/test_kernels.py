"""Kernels as machine code and as floats, and what becomes of a rig whose laws they do not have."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest

from samples import sample
from vibroimpact.engine import batch
from vibroimpact.engine import parameters as par
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.series import kernels, root_variable, slopes, step
from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series.code_generation import Plain
from vibroimpact.engine.series.root_variable import Rooted
from vibroimpact.engine.series.step import Shape
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import DONE, TOO_MANY_EVENTS
from vibroimpact.law_numbers import SYMBOLS, IsolatorNumbers, PowerLaw


def symbols(*operations: str | int) -> tuple[int, ...]:
    return tuple(one if isinstance(one, int) else SYMBOLS.index(one) for one in operations)


OWN = {
    "softening": symbols("number", 0, "x", "*", "number", 1, "|x|", "number", 2, "/", "+", "/"),
    "power": symbols(
        "x", "number", 1, "x", "power", 2, "+", "real power", 2, "*", "v", "|v|", "*", "+"
    ),
    "turning": symbols(
        "x", "number", 0, "*", "sin", "x", "cos", "*", "v", "tanh", "-", "x", "sinh", "neg", "-"
    ),
    "root": symbols("x", "x", "cosh", "sqrt", "*", "x", "power", 2, "exp", "*"),
}  # fmt: skip
LAWS = {
    "linear": ((), (), (), (), ()),
    "cubic": ((3,), (), (), (), ()),
    "quintic": ((3, 5), (), (), (), ()),
    "exponential": ((), (True,), (1,), (), ()),
    "bilinear": ((), (), (0,), (), ()),
    "Bouc-Wen 5": ((), (), (5,), (), ()),
    "square": ((), (), (), (2,), ()),
    "fluid": ((), (), (), (0,), ()),
    **{name: ((), (), (), (), one) for name, one in OWN.items()},
}
SHAPES = [
    (step.begun, Shape(laws, push, other))
    for laws in LAWS.values()
    for push in (0, 1, 2)
    for other in (0, 1)
]
SHAPES += [
    (root_variable.write_root_series, Rooted(laws, which, power, viscous, single))
    for name, laws in LAWS.items()
    if name != "fluid"
    for which, power, viscous in ((2, 3, False), (4, 6, True))
    for single in (True, False)
]
# Each is compiled for itself.
SHAPES = sample(SHAPES, SHAPES[::12])
NUMBERS = {
    "drag": 0.2,
    "drag_exponent": 0.6,
    "way": 1.0,
    "side": 1.0,
    "apart": 1.7,
    "offset": 0.1,
}


def memory() -> np.ndarray:
    plan = np.zeros(at.END)
    rng = np.random.default_rng(3)
    for i, name in enumerate(at.NAMES):
        plan[at.NUMBERS + i] = NUMBERS.get(name, float(rng.uniform(0.2, 1.0)))
    plan[par.OWN + par.OWN_FIRST : par.OWN + par.OWN_FIRST + 3] = 0.7, 1.3, 0.6
    plan[at.SHAKES : at.SHAKES + at.DEGREE] = 0.3 * 0.5 ** np.arange(at.DEGREE)
    return plan


def _name(one: object) -> str:
    """The same in every process, as the text of a function is not."""
    return getattr(one, "__name__", str(one))


@pytest.mark.parametrize(("formula", "shape"), SHAPES, ids=_name)
def test_machine_code_computes_what_floats_do(formula, shape) -> None:
    arguments = (0.4, 0.5, 0.1, 0.5, 0.3, 0.2, -0.1)
    kernel = ctypes.CFUNCTYPE(None, ctypes.c_void_p, *[ctypes.c_double] * kernels.NUMBERS)(
        kernels.address(formula, shape)
    )
    fast, slow = memory(), memory()
    kernel(fast.ctypes.data, *arguments)
    formula(Plain(slow, arguments), shape)
    assert np.isfinite(slow).all()
    size = np.maximum(np.abs(slow), 1e-3)
    errors = np.abs(fast - slow) / size
    errors[at.FOUND + at.F_EXCESS] = 0.0  # what is below rounding
    errors[at.FOUND + at.F_OWES] *= 1e-3  # a difference of what all but cancels
    assert errors.max() < 1e-10


@pytest.mark.parametrize(
    "shape", [one for formula, one in SHAPES if formula is step.begun], ids=str
)
def test_slopes_are_derivatives_of_the_forces(shape) -> None:
    """Of the step's series, by machine code and floats; against differences of the formulas."""
    plan, h = memory(), 0.3
    step.begun(Plain(plan, (0.4, 0.5, 0.1, 0.5, h, 0.2, -0.1)), shape)
    h = plan[at.FOUND + at.F_H]
    for place in (at.X, at.Z):
        plan[place : place + at.DEGREE + 1] *= h ** np.arange(at.DEGREE + 1)
    fast = plan.copy()
    arguments = (0.0, 0.0, 0.0, 0.0, h, 0.0, 0.0)
    kernel = ctypes.CFUNCTYPE(None, ctypes.c_void_p, *[ctypes.c_double] * kernels.NUMBERS)(
        kernels.address(slopes.slopes, shape)
    )
    kernel(fast.ctypes.data, *arguments)
    slopes.slopes(Plain(plan, arguments), shape)
    np.testing.assert_allclose(fast, plan, rtol=1e-11, atol=1e-13)
    for share in (0.0, 0.4, 1.0):
        state = [np.polyval(plan[at.X : at.X + at.DEGREE + 1][::-1], share)]
        steps = plan[at.X + 1 : at.X + at.DEGREE + 1] * np.arange(1, at.DEGREE + 1)
        state.append(np.polyval(steps[::-1], share) / h)
        state.append(np.polyval(plan[at.Z : at.Z + at.DEGREE + 1][::-1], share))
        for place, i, pulls, unit in (
            (at.BY_X, 0, True, h * h),
            (at.BY_V, 1, True, h),
            (at.BY_Z, 1, False, 1.0),
            (at.BY_Z_OF_Z, 2, False, -h),
        ):
            ends = []
            for way in (1.0, -1.0):
                moved = list(state)
                moved[i] += way * 1e-6
                ends.append(forces(plan, shape, *moved)[0 if pulls else 1])
            slope = unit * (ends[0] - ends[1]) / 2e-6
            value = np.polyval(plan[place : place + at.DEGREE + 1][::-1], share)
            assert value == pytest.approx(slope, abs=1e-6)


def forces(plan: np.ndarray, shape: Shape, x: float, v: float, z: float) -> tuple[float, float]:
    """What all forces pull back with but for that of z alone, and z′."""
    law = step.LawNumbers(Plain(plan, ()))
    u = x + law.offset
    pull = law.stiffness * x + law.damping * v
    pull += sum(step.isolator(law, shape, u, v, z)) + sum(step.pushes(law, shape, x, v))
    return pull, step.memory(law, shape, u, v, z) or 0.0


@pytest.mark.parametrize(
    ("made", "asked"),
    [
        (IsolatorNumbers(cubic=1.0), IsolatorNumbers(cubic=1.0, quintic=1.0)),
        (IsolatorNumbers(cubic=1.0), IsolatorNumbers(sinh=1.0, sinh_rate=1.0)),
        (IsolatorNumbers(cubic=1.0), IsolatorNumbers(hysteretic=1.0, knee=1.0)),
        (
            IsolatorNumbers(hysteretic=1.0, knee=1.0),
            IsolatorNumbers(hysteretic=1.0, knee=1.0, sharpness=3.0),
        ),
        (IsolatorNumbers(cubic=1.0), IsolatorNumbers(cubic=1.0, drag=2.0)),
    ],
)
def test_a_plan_of_other_laws_is_given_up(made: IsolatorNumbers, asked: IsolatorNumbers) -> None:
    """Never followed by kernels that lack one of its laws."""
    one, other = (rig_vector(1.0, 1.0, 0.1, None, None, law=law) for law in (made, asked))
    assert outcome_of(one, one) == DONE
    assert outcome_of(one, other) == TOO_MANY_EVENTS


def test_a_plan_of_another_stop_is_given_up() -> None:
    free = rig_vector(1.0, 1.0, 0.1, None, None, law=IsolatorNumbers(cubic=1.0))
    stopped = rig_vector(
        1.0, 1.0, 0.1, PowerLaw(9.0, 1.5, 0.0, 0.0, 1.0), None, law=IsolatorNumbers(cubic=1.0)
    )
    assert outcome_of(free, stopped) == TOO_MANY_EVENTS


def outcome_of(made: np.ndarray, asked: np.ndarray) -> int:
    """What becomes of a rig in the plan of another, by the entry that is compiled for all."""
    trajectory = batch.trajectory
    plan = plan_of(made, trajectory.groups)
    _, _, outcome = trajectory.of(plan)(
        plan, asked, 0.6, 0.2, 0.0, np.zeros(ONE_MASS.width), 0.0, 1.0, 0, 100,
        np.empty((0, record_layout.SAMPLE)), np.empty((101, record_layout.EVENT)),
    )  # fmt: skip
    return outcome
