"""The static equilibrium of an assembly under its constant forces and preloads.

Write s = S u for the relative displacements of the links and d = W u − g for the depths in the
stops. At rest, the masses minimise

    E(u) = ½ uᵀ K u + Σ ∫ F_i ds_i + Σ F_c |s_i| + Σ ∫ P_j dd_j − fᵀ u,   with d ≤ 0 at rigid stops,

where F_i is the force of a first, slow loading of link i from s = 0, F_c its friction, and P_j ≥ 0
the static force of stop j. E is convex as long as each link is within its `reach`, and a stop never
softens. The minimum is sought in steps. A step minimises E with the curved laws replaced by their
tangents, which is a linear complementarity problem in the forces of bumpers, rigid stops and
friction: bumpers and rigid stops push only, friction is within ±F_c. The step is shortened to where
the energy is least along it, unless the residual decreases anyway. The displacements of a step are
computed from the linear equations of the stops that are pressed.

A free motion, which no spring opposes, stays near u = 0, by a term ½ ε |u − u_k|² about the last
iterate u_k. This term vanishes where the iterates converge.

Masses that no force reaches move exactly as the mass or the base on which they hang, and bodies
touch exactly at a rigid stop that they press: the rounding of a step depends on the order of the
masses, and would decide which stops are closed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model.assembly.state import AssemblyState
from vibroimpact.model.isolators import FrictionIsolator
from vibroimpact.model.quantities import FORCE, LENGTH
from vibroimpact.model.units import pretty
from vibroimpact.model.unknown_keys import listed

if TYPE_CHECKING:
    from vibroimpact.model.assembly.assembly import Assembly
    from vibroimpact.model.assembly.link import Link

Vector = NDArray[np.float64]

_MOST_STEPS = 300
_EXACT = 1e-10
"""Largest residual of the forces, relative to the largest force."""
_ROUNDING = 1e-13
"""Relative error of displacements that rounding causes: a stiff bumper turns it into a force."""
_PROXIMAL = 1e-6
"""ε relative to the mean stiffness."""


class _Curve(NamedTuple):
    """A curved law: its force at s = row · u − offset acts along the row."""

    name: str
    row: Vector
    offset: float
    force: Callable[[float], float]
    reach: float
    strongest: float


class _Problem(NamedTuple):
    """An assembly in numbers; W has the rows of the bumpers, the rigid stops and the friction."""

    stiffness: Vector
    force: Vector
    curved: list[_Curve]
    rows: Vector
    gaps: Vector
    compliance: Vector
    low: Vector
    high: Vector


def equilibrium(assembly: Assembly) -> AssemblyState:
    """Return the state of rest that a slow loading from u = 0 reaches.

    Each link is loaded from rest in one direction. If a contact reverses the deformation of a
    hysteretic link, the state of rest depends on the order of the loading, and this is one of them.

    Returns
    -------
    AssemblyState
        The displacements, with zero velocities, and the memories of hysteretic links. A bumper is
        compressed as far as the masses penetrate into it.

    Raises
    ------
    InputError
        If nothing balances the constant forces and the preloads, or if a softening link does not.
    """
    check_balance(assembly)
    u = _minimum(assembly)
    memory = {}
    for name, link in assembly.links.items():
        held = link.isolator.remembered(float(-assembly.closing(link) @ u))
        if held:
            memory[name] = held
    displacements = {name: float(one) for name, one in zip(assembly.names, u, strict=True) if one}
    pressed = {
        name: one.stop.remembered(depth)
        for name, one in assembly.stops.items()
        if one.stop.remembers and (depth := float(assembly.closing(one) @ u) - one.stop.gap) > 0.0
    }
    return AssemblyState(displacements, deformation=pressed, memory=memory)


def check_balance(assembly: Assembly) -> None:
    """Raise an error if there is no equilibrium, without computing it where it must exist.

    There is none if the forces push masses in a direction that nothing opposes. That is a direction
    d without an elastic force, K d = 0, and without a stop that it closes, W d ≤ 0, in which the
    forces do more work than friction and bounded links can take up.
    """
    force = assembly.constant_force
    if not force.any():
        return
    from scipy.optimize import linprog

    bounded: list[Link] = []
    springs: list[Link] = []
    for link in assembly.links.values():
        (springs if math.isinf(link.isolator.strongest) else bounded).append(link)
    own = assembly.matrix_of_links("stiffness", ())
    rows = [assembly.closing(link) for link in springs]
    scale = float(np.abs(own).max()) or 1.0
    equal = np.vstack([own / scale, *rows])
    stops = np.array([assembly.closing(one) for one in assembly.stops.values()])
    count, extra = len(force), len(bounded)
    # Unknowns: d, and the |s_i| of bounded links as upper bounds.
    largest = float(np.abs(force).max())
    cost = np.append(-force, [link.isolator.strongest for link in bounded]) / largest
    limits = [np.column_stack([stops, np.zeros((len(stops), extra))])] if len(stops) else []
    for i, link in enumerate(bounded):
        for sign in (1.0, -1.0):
            row = np.append(sign * assembly.closing(link), np.zeros(extra))
            row[count + i] = -1.0
            limits.append(row[np.newaxis])
    solution = linprog(
        cost,
        A_ub=np.vstack(limits) if limits else None,
        b_ub=np.zeros(sum(len(one) for one in limits)) if limits else None,
        A_eq=np.column_stack([equal, np.zeros((len(equal), extra))]),
        b_eq=np.zeros(len(equal)),
        bounds=[(-1.0, 1.0)] * count + [(0.0, None)] * extra,
    )
    if solution.status == 0 and solution.fun < -1e-9:
        moved = [
            name for name, one in zip(assembly.names, solution.x, strict=False) if abs(one) > 1e-6
        ]
        pushed = [name for name in moved if name in assembly.forces]
        text = listed([f"forces.{one}: {pretty(assembly.forces[one], FORCE)}" for one in pushed])
        raise InputError(
            f"{text}; no link and no stop holds {listed(moved)} against "
            f"{'this force' if len(pushed) == 1 else 'these forces'}, so there is no equilibrium; "
            "reduce the force, or add a link or a stop"
        )


def _problem(assembly: Assembly) -> _Problem:
    count = len(assembly.names)
    linear, curved = [], []
    rows, gaps, compliance, low, high = [], [], [], [], []

    def contact(row: Vector, gap: float, soft: float, least: float, most: float) -> None:
        rows.append(row)
        gaps.append(gap)
        compliance.append(soft)
        low.append(least)
        high.append(most)

    for name, link in assembly.links.items():
        law, row = link.isolator, -assembly.closing(link)
        parts = law.linear_and_bounded
        if isinstance(law, FrictionIsolator):
            linear.append(link)
            contact(row, 0.0, 0.0, -law.friction, law.friction)
        elif parts is not None and parts[1] == 0.0:
            linear.append(link)
        else:
            curved.append(
                _Curve(f"links.{name}", row, 0.0, law.static_force, law.reach, law.strongest)
            )
    for name, stop in assembly.stops.items():
        stopping, row = stop.stop, assembly.closing(stop)
        if stopping.rigid:
            contact(row, stopping.gap, 0.0, 0.0, math.inf)
        elif pair := stopping.spring_and_dashpot:
            contact(row, stopping.gap, 1.0 / pair[0], 0.0, math.inf)
        else:
            curved.append(
                _Curve(
                    f"stops.{name}", row, stopping.gap, stopping.static_force, math.inf, math.inf
                )
            )
    return _Problem(
        assembly.matrix_of_links("stiffness", linear),
        assembly.constant_force,
        curved,
        np.array(rows).reshape(-1, count),
        np.array(gaps),
        np.array(compliance),
        np.array(low),
        np.array(high),
    )


def _minimum(assembly: Assembly) -> Vector:
    """Return the displacements at which the energy is least."""
    problem = _problem(assembly)
    u = np.zeros(len(assembly.names))
    reached = _residual(problem, u)
    # Where free masses only move apart, all forces vanish at the end: those at u = 0 are the scale.
    first = _size(problem, u)
    if reached <= _EXACT * first + _rounding(problem, u):
        return u
    damping = 1.0
    for _ in range(_MOST_STEPS):
        aim = _step(problem, u, damping)
        share = 1.0 if _residual(problem, aim) < reached else _share(problem, u, aim - u)
        damping = max(damping * (10.0 if share < 0.1 else 0.1), 1.0)
        u = u + share * (aim - u)
        reached = _residual(problem, u)
        if reached <= _EXACT * max(first, _size(problem, u)) + _rounding(problem, u):
            _check_reach(problem, u)
            near = _near(problem, u)
            return _alike(assembly, _touching(assembly, _alike(assembly, u), near))
    _check_reach(problem, u)
    raise InputError(
        f"forces: no equilibrium was found in {_MOST_STEPS} steps (residual {reached:.3g} N); "
        "change the constant forces or the preloads, or use links without softening"
    )


def _touching(assembly: Assembly, u: Vector, near: float) -> Vector:
    """Return u with a clearance of 0 at the rigid stops whose clearance is below a length."""
    base = len(u)
    stops = [one for one in assembly.stops.values() if one.stop.rigid]
    left = [_column(assembly, one.left) for one in stops]
    right = [_column(assembly, one.right) for one in stops]
    at, gaps = np.append(u, 0.0), [one.stop.gap for one in stops]
    todo = [f for f in range(len(stops)) if abs(at[left[f]] - at[right[f]] - gaps[f]) <= near]
    exact = {base}
    while todo:
        # A body that touches another one whose displacement is exact follows it.
        f = next((f for f in todo if (left[f] in exact) != (right[f] in exact)), todo[0])
        todo.remove(f)
        if left[f] in exact and right[f] not in exact:
            at[right[f]] = at[left[f]] - gaps[f]
        elif left[f] not in exact:
            at[left[f]] = at[right[f]] + gaps[f]
        exact |= {left[f], right[f]}
    return at[:base]


def _column(assembly: Assembly, end: str) -> int:
    """Return the number of a mass, or for the ground the count of the masses."""
    names = assembly.names
    return names.index(end) if end in names else len(names)


def _alike(assembly: Assembly, u: Vector) -> Vector:
    """Return u with equal displacements where nothing deforms the links between masses."""
    base = len(u)
    beside: list[list[int]] = [[] for _ in range(base + 1)]
    for link in assembly.links.values():
        if link.isolator.linear_and_bounded != (0.0, 0.0):
            left, right = _column(assembly, link.left), _column(assembly, link.right)
            beside[left].append(right)
            beside[right].append(left)
    stops = [
        (_column(assembly, stop.left), _column(assembly, stop.right), stop.stop.gap)
        for stop in assembly.stops.values()
    ]
    forced = {int(i) for i in np.flatnonzero(assembly.constant_force)}

    def linked(starts: set[int], barred: set[int]) -> set[int]:
        reached, todo = set(starts), list(starts)
        while todo:
            new = [i for i in beside[todo.pop()] if i not in reached and i not in barred]
            reached.update(new)
            todo += new
        return reached

    at = np.append(u, 0.0)
    for host in (base, *range(base)):
        moved = linked((forced | {base}) - {host}, {host})
        while True:
            others = set(range(base)) if host == base else linked({host}, moved)
            alike = others - moved - {host}
            aligned = at.copy()
            aligned[list(alike)] = at[host]
            pressed = {
                end
                for left, right, gap in stops
                if aligned[left] - aligned[right] - gap > 0.0
                for end in alike.intersection((left, right))
            }
            if not pressed:
                break
            moved = linked(moved | pressed, {host})
        at = aligned
    return at[:base]


def _share(problem: _Problem, u: Vector, way: Vector) -> float:
    """Return the share of a step at which the energy is least, at most 1.

    The energy is convex, so its derivative along the step changes its sign only once.
    """

    def rise(share: float) -> float:
        at = u + share * way
        curved, _ = _forces_of_curved(problem, at)
        slope = float((problem.stiffness @ at + curved - problem.force) @ way)
        depth, speed = problem.rows @ at - problem.gaps, problem.rows @ way
        bumper = problem.compliance > 0.0
        held = np.isfinite(problem.high) & ~bumper
        slope += float(
            (np.maximum(depth, 0.0) * speed)[bumper] @ (1.0 / problem.compliance[bumper])
        )
        return slope + float((np.sign(depth) * speed)[held] @ problem.high[held])

    low, high = 0.0, 1.0
    if rise(high) <= 0.0:
        return high
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rise(middle) < 0.0 else (low, middle)
    return high


def _forces_of_curved(problem: _Problem, u: Vector) -> tuple[Vector, Vector]:
    """Return the force of the curved laws on the masses' coordinates, and its derivative."""
    force, tangent = np.zeros_like(u), np.zeros((len(u), len(u)))
    for curve in problem.curved:
        s = float(curve.row @ u) - curve.offset
        width = 1e-6 * max(abs(s), 1e-6)
        force += curve.row * curve.force(s)
        slope = (curve.force(s + width) - curve.force(s - width)) / (2.0 * width)
        tangent += max(slope, 0.0) * np.outer(curve.row, curve.row)
    return force, tangent


def _step(problem: _Problem, u: Vector, damping: float) -> Vector:
    """Return the minimum with the curved laws replaced by their tangents at u."""
    curved, tangent = _forces_of_curved(problem, u)
    stiffness = problem.stiffness + tangent
    size = float(np.trace(stiffness)) / len(u) or _stop_size(problem)
    k = stiffness + damping * _PROXIMAL * size * np.eye(len(u))
    rhs = problem.force - curved + tangent @ u + damping * _PROXIMAL * size * u
    forces = _complementary(problem, k, rhs)
    smooth = np.asarray(np.linalg.solve(k, rhs - problem.rows.T @ forces))
    return _polished(problem, stiffness, problem.force - curved + tangent @ u, forces, smooth)


def _stiffness(problem: _Problem) -> float:
    """Return the mean stiffness of the linear links or, if there is none, that of the stops."""
    return float(np.trace(problem.stiffness)) / len(problem.force) or _stop_size(problem)


def _stop_size(problem: _Problem) -> float:
    """Return a stiffness with which free masses are sought at their stops."""
    soft = problem.compliance[problem.compliance > 0.0]
    return float(1.0 / soft.mean()) if len(soft) else 1.0


def _complementary(problem: _Problem, k: Vector, rhs: Vector) -> Vector:
    """Return the forces λ of stops and friction that minimise ½ λᵀ A λ − qᵀ λ within their bounds.

    A = W K⁻¹ Wᵀ + compliance and q = W K⁻¹ rhs − g: the depths are d = q − A λ + compliance λ.
    """
    if not len(problem.rows):
        return np.zeros(0)
    from scipy.optimize import lsq_linear

    flexibility = problem.rows @ np.linalg.solve(k, problem.rows.T)
    a = flexibility + np.diag(problem.compliance)
    q = problem.rows @ np.linalg.solve(k, rhs) - problem.gaps
    # Stops that are pressed by one another have no unique forces: a small compliance chooses. Below
    # 1e-9, the cost of what they cannot satisfy hides from `bvls` that another stop is touched.
    scale = np.sqrt(np.diag(a))
    scaled = a / np.outer(scale, scale) + 1e-9 * np.eye(len(a))
    wanted = q / scale
    pushed = np.where(problem.low < 0.0, np.abs(wanted), np.maximum(wanted, 0.0))
    forces, size = np.zeros(len(a)), math.hypot(*pushed)
    # At the minimum λᵀ A λ ≤ 2 qᵀ λ, so that no depth changes by more than this. `bvls`, which ends
    # at small changes of the cost, and at an absolute slope, sees no stop that is farther away.
    farthest = 2.0 * size / math.sqrt(max(float(np.linalg.eigvalsh(scaled)[0]), 1e-10))
    some = (problem.high > problem.low) & (wanted >= -farthest)
    if not size > 0.0 or not some.any():
        return forces
    factor = np.linalg.cholesky(scaled[np.ix_(some, some)])
    solved = lsq_linear(
        factor.T,
        np.linalg.solve(factor, wanted[some] / size),
        (problem.low[some] * scale[some] / size, problem.high[some] * scale[some] / size),
        method="bvls",
        tol=1e-15,
    )
    forces[some] = solved.x * size
    return np.asarray(forces / scale)


def _polished(
    problem: _Problem, stiffness: Vector, rhs: Vector, forces: Vector, smooth: Vector
) -> Vector:
    """Return the displacements of the equations in which the same stops are pressed."""
    size = max(float(np.abs(forces).max(initial=0.0)), float(np.abs(rhs).max(initial=0.0)))
    inside = (forces > problem.low + 1e-9 * size) & (forces < problem.high - 1e-9 * size)
    w, g, soft = problem.rows[inside], problem.gaps[inside], problem.compliance[inside]
    sliding = np.where(inside | ~np.isfinite(problem.high), 0.0, forces)
    rhs = rhs - problem.rows.T @ sliding
    scale = float(np.abs(stiffness).max()) or 1.0
    matrix = np.block([[stiffness / scale, w.T], [w, -np.diag(soft * scale)]])
    # Free motions keep the place that the forces alone do not determine.
    start = np.concatenate([smooth, np.zeros(len(g))])
    wanted = np.concatenate([rhs / scale, g])
    change, *_ = np.linalg.lstsq(matrix, wanted - matrix @ start, rcond=1e-13)
    return np.asarray((start + change)[: len(smooth)])


def _stop_forces(problem: _Problem, u: Vector) -> tuple[Vector, Vector, Vector]:
    """Return the least and the largest force of each stop and friction at u, and how far u is off.

    The force of a bumper is unique. A rigid stop that is touched has any force that pushes, and
    friction at rest any within ±F_c.
    """
    depth = problem.rows @ u - problem.gaps
    near = _near(problem, u)
    least, most = problem.low.copy(), problem.high.copy()
    bumper = problem.compliance > 0.0
    pressed = np.maximum(depth, 0.0) / np.where(bumper, problem.compliance, 1.0)
    least[bumper] = most[bumper] = pressed[bumper]
    most[~bumper & (depth < -near)] = problem.low[~bumper & (depth < -near)]
    slid = ~bumper & (depth > near) & np.isfinite(problem.high)
    least[slid] = problem.high[slid]
    inside = ~bumper & (depth > near) & ~np.isfinite(problem.high)
    return least, most, np.where(inside, depth, 0.0)


def _near(problem: _Problem, u: Vector) -> float:
    """Return the length (m) below which a depth is rounding."""
    # Gaps may be far below the displacement that the forces would cause without stops.
    free = float(np.abs(problem.force).max(initial=0.0)) / _stiffness(problem)
    lengths = (np.abs(u).max(initial=0.0), np.abs(problem.gaps).max(initial=0.0), free)
    return 1e-12 * float(sum(lengths))


def _residual(problem: _Problem, u: Vector) -> float:
    """Return the largest force that the laws at u do not balance (N)."""
    curved, _ = _forces_of_curved(problem, u)
    push = problem.force - problem.stiffness @ u - curved
    least, most, beyond = _stop_forces(problem, u)
    fixed = most <= least
    push = push - problem.rows[fixed].T @ least[fixed]
    penalty = _stiffness(problem) * float(beyond.max(initial=0.0))
    if fixed.all():
        return float(np.abs(push).max(initial=0.0)) + penalty
    from scipy.optimize import lsq_linear

    solved = lsq_linear(
        problem.rows[~fixed].T, push, (least[~fixed], most[~fixed]), method="bvls", tol=1e-15
    )
    left = push - problem.rows[~fixed].T @ solved.x
    return float(np.abs(left).max(initial=0.0)) + penalty


def _size(problem: _Problem, u: Vector) -> float:
    """Return the largest of the forces that balance each other at u (N)."""
    sizes = [float(np.abs(problem.force).max(initial=0.0))]
    sizes.append(float((np.abs(problem.stiffness) @ np.abs(u)).max(initial=0.0)))
    least, _, _ = _stop_forces(problem, u)
    sizes.append(float(np.abs(least[np.isfinite(least)]).max(initial=0.0)))
    sizes += [abs(curve.force(float(curve.row @ u) - curve.offset)) for curve in problem.curved]
    return max(sizes)


def _rounding(problem: _Problem, u: Vector) -> float:
    """Return the force that the rounding of displacements causes (N)."""
    _, tangent = _forces_of_curved(problem, u)
    soft = problem.compliance[problem.compliance > 0.0]
    stiffest = max(
        float(np.abs(problem.stiffness).max()),
        float(np.abs(tangent).max()),
        float((1.0 / soft).max(initial=0.0)),
    )
    gaps = float(np.abs(problem.gaps).max(initial=0.0))
    return stiffest * (_ROUNDING * float(np.abs(u).max(initial=0.0)) + math.ulp(gaps))


def _check_reach(problem: _Problem, u: Vector) -> None:
    """Raise an error if a link is deformed beyond the displacement where its force falls."""
    for curve in problem.curved:
        if abs(float(curve.row @ u)) > curve.reach:
            raise InputError(
                f"{curve.name}: it softens, and its largest force, "
                f"{pretty(curve.strongest, FORCE)} at {pretty(curve.reach, LENGTH)}, does not "
                "balance the constant forces and the preloads; reduce these"
            )
