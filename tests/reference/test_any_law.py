"""The reference for every law against plain formulae, closed forms, and itself."""

from __future__ import annotations

from pathlib import Path

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from reference import fifty_digits, law_states, shaken_cases, shaken_states, store_law_states
from reference import laws_mpmath as laws
from reference import rig as rig_reference
from reference.any_law import Step, follow
from reference.jets import value
from reference.law_cases import CASES, CYCLES, hertz
from reference.law_series import law_of
from reference.public_motion import reference_shaking
from reference.store_law_states import STORES, States, Store, marks
from samples import sample
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.stops import STOPS, FormulaStop, StopWithMemory

TINY = mpf(10) ** -36
ONE_EACH = (
    "linear, power by restitution",
    "linear, power 2 that lets go",
    "linear, jankowski and a bumper",
    "friction, sticking",
    "friction, several harmonics",
    "bilinear, power",
    "polynomial, power",
    "bouc-wen, n = 3, walls",
    "exponential, hardening, bumpers",
    "drag 0.5, bumpers",
    "drag 0.5, power",
    "drag 0.5 and friction",
)
ALL = {**CASES, **shaken_cases.CASES}
STATES_OF = {"law_states.py": law_states.STATES, "shaken_states.py": shaken_states.STATES}
STATES: dict[str, States] = {**law_states.STATES, **shaken_states.STATES}
SHAKEN_EACH = tuple(shaken_cases.CASES)[1::19]
"""One of each kind of shaking but two."""


def slope(series: list[int], x: mpf) -> mpf:
    return value([n * one for n, one in enumerate(series)][1:], x)


def stop_force(rig: vi.Oscillator, step: Step, u: mpf, v: mpf) -> mpf:
    """By the plain formulae."""
    if step.contact is None:
        return mpf(0)
    sign, stop = (1, rig.right) if step.contact == "right" else (-1, rig.left)
    assert stop is not None
    d, w = sign * u - mpf(stop.gap), sign * v
    if isinstance(stop, vi.PowerBumper):
        return sign * laws.power_contact(stop.stiffness, stop.exponent, step.chi, d, w)
    if isinstance(stop, vi.JankowskiBumper):
        xi = laws.jankowski_ratio(stop.restitution)
        return sign * laws.jankowski_contact(stop.stiffness, xi, stop.mass, d, w)
    assert isinstance(stop, vi.Bumper)
    return sign * laws.kelvin_voigt(stop.stiffness, stop.damping, d, w)


@pytest.mark.parametrize("name", sample(tuple(ALL), (*ONE_EACH[::6], SHAKEN_EACH[0])))
def test_every_step_obeys_the_plain_formulae(name: str) -> None:
    """du/dt = v, M dv/dt = forces and dz/dt = rate, all along each step."""
    rig, shaken = ALL[name]
    law, shaking = law_of(rig.isolator), reference_shaking(rig, shaken)
    mass = mpf(rig.mass)
    seen, length = 0, shaking.span(0)

    def watch(step: Step) -> None:
        nonlocal seen
        seen += 1
        for part in (3, 9):
            x = step.span * part / 10
            t, u, v, z = (value(one, x) for one in step[:4])
            dt, du, dv, dz = (slope(one, x) for one in step[:4])
            assert abs(du - v * dt) < TINY
            if step.stuck:
                assert v == dv == dz == 0
                continue
            drag = laws.viscous(rig.isolator.damping, rig.isolator.damping_exponent, v)
            force = law.force(u, v, z) + drag + stop_force(rig, step, u, v)
            line = int(mp.floor(t / length)) if isinstance(shaken, vi.Record) else 0
            a = (mpf(rig.force) - force) / mass - shaking.value(line, t - line * length)
            assert abs(dv - a * dt) < TINY
            if isinstance(law, laws.Bilinear):
                assert not dz or abs(dz - v * dt) < TINY
                assert dz or abs(abs(z) - law.limit) < TINY
            else:
                assert abs(dz - law.rate(u, v, z) * dt) < mpf(10) ** 4 * TINY

    follow(rig, shaken, 20 if isinstance(shaken, vi.Record) else 2, watch=watch)
    assert seen > (20 if isinstance(shaken, vi.Record) else 10)


@pytest.mark.parametrize("name", sample(tuple(ALL), (*ONE_EACH[1::6], SHAKEN_EACH[2])))
def test_stored_states_are_those_of_a_fresh_run(name: str) -> None:
    """With another order than they were stored with."""
    rig, shaken = ALL[name]
    at = marks(ALL[name])
    cycles = sample(at[-1], at[1])
    motion = follow(rig, shaken, cycles, order=40, digits=30)
    with mp.workdps(40):
        for n, stored in zip(at, STATES[name], strict=True):
            if n <= cycles:
                for one, digits in zip(motion.states[n], map(mpf, stored), strict=True):
                    assert abs(one - digits) <= mpf("1e-23") * abs(digits)


NOT_STORED = {
    law
    for law in STOPS.classes.values()
    if law is vi.Law or issubclass(law, FormulaStop | StopWithMemory)
}
BUILT_IN = {kinds: set(kinds.classes.values()) - NOT_STORED for kinds in (ISOLATORS, STOPS)}
"""A law given as a formula equals one of these to the bit: tests/engine/taylor/test_own_laws.py.

Assemblies alone have stops with a memory: tests/analytic/test_stop_with_memory.py.
"""


@pytest.mark.parametrize("store", STORES, ids=lambda one: one.name)
def test_storing_one_rig_keeps_the_others(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = Path(store_law_states.__file__).with_name(store.name).read_text()
    monkeypatch.setattr(store_law_states, "__file__", str(tmp_path / "store.py"))
    (tmp_path / store.name).write_text(text)
    (first, state), (second, other) = [*STATES_OF[store.name].items()][3:5]
    for name in (second, first):
        store_law_states.put(store, name, None)
    assert f'"{first}"' not in (tmp_path / store.name).read_text()
    for name, known in ((first, state), (second, other)):
        store_law_states.put(store, name, known)
    assert (tmp_path / store.name).read_text() == text


def test_every_law_has_three_stored_rigs_and_more() -> None:
    assert set(law_states.STATES) == set(CASES)
    laws_seen = [type(one.rig.isolator) for one in CASES.values()]
    assert all(laws_seen.count(law) >= 3 for law in BUILT_IN[ISOLATORS])
    stops = [type(stop) for one in CASES.values() for stop in one.rig.stops.values()]
    assert all(stops.count(law) >= 3 for law in BUILT_IN[STOPS])


def test_another_stop_changes_no_stored_rig() -> None:
    cases = shaken_cases.cases({"one": hertz, "two": hertz})
    assert cases.items() >= shaken_cases.CASES.items()
    more = cases.keys() - shaken_cases.CASES.keys()
    assert len(more) == 4 * len(shaken_cases.SHAKEN)
    assert more >= shaken_cases.cases({"one": hertz}).keys() - shaken_cases.CASES.keys()


def test_every_law_is_under_every_shaking_on_either_side() -> None:
    assert set(shaken_states.STATES) == set(shaken_cases.CASES)
    seen = set()
    for one in shaken_cases.CASES.values():
        kind = type(one.shaken), getattr(one.shaken, "of", None)
        even = isinstance(one.shaken, vi.Periodic) and any(one.shaken.amplitudes[1::2])
        seen |= {
            (kind, even, type(one.rig.isolator), one.rig.isolator.damping_exponent),
            *(
                (kind, even, i, type(stop), getattr(stop, "relation", None))
                for i, stop in enumerate((one.rig.right, one.rig.left))
            ),
        }
    kinds = {one[:2] for one in seen}
    assert len(kinds) == 6
    isolators = {(type(one), one.damping_exponent) for one in shaken_cases.ISOLATORS.values()}
    stops = {
        (type(stop), getattr(stop, "relation", None))
        for stop in (made(0.01) for made in (shaken_cases.STOPS | shaken_cases.LATER).values())
    }
    assert {law for law, _ in isolators} == BUILT_IN[ISOLATORS]
    assert {law for law, _ in stops} == BUILT_IN[STOPS]
    for kind in kinds:
        assert {one[2:] for one in seen if one[:2] == kind and len(one) == 4} == isolators
        for side in range(2):
            assert {one[3:] for one in seen if one[:3] == (*kind, side)} == stops


@pytest.mark.full
def test_a_linear_rig_moves_as_by_the_reference_of_linear_rigs() -> None:
    rig, shaken = CASES["linear, bumpers"]
    one = follow(rig, shaken, CYCLES)
    right, left = (rig_reference.Stop(s.stiffness, s.damping, s.gap) for s in rig.stops.values())
    k, c = rig.isolator.stiffness, rig.isolator.damping
    known = rig_reference.Rig(rig.mass, k, c, right, left)
    rest = (0.0, 0.0, 0.0, 0.0)
    other = fifty_digits.integrate(
        known, shaken.amplitude, shaken.frequency, shaken.phase, rest, CYCLES
    )
    assert [e.kind for e in one.events] == [e.kind for e in other.events]
    with mp.workdps(60):
        for a, b in zip(one.states, other.states, strict=True):
            assert max(abs(a[0] - b[0]), abs(a[1] - b[1])) < mpf(10) ** -40


def test_what_is_out_of_reach_is_refused() -> None:
    plain = vi.Isolator(1e4, 10.0)
    shaken = vi.Harmonic(1.0, 1.0)
    with pytest.raises(ValueError, match="small fraction"):
        follow(vi.Oscillator(1.0, plain, vi.PowerBumper(1e4, 0.01, 1.3)), shaken, 1)
    with pytest.raises(ValueError, match="touches"):
        follow(vi.Oscillator(1.0, plain, vi.Bumper(1e4, 1.0, -0.01)), shaken, 1)
    with pytest.raises(ArithmeticError):
        follow(vi.Oscillator(1.0, plain, vi.RigidStop(0.2, 1e-6)), shaken, 2)
