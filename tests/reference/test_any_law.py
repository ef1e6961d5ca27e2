"""The reference for every law against plain formulae, closed forms, and itself."""

from __future__ import annotations

from pathlib import Path

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from formula_stops import FORMULA_STOPS
from reference import fifty_digits, law_states, shaken_cases, shaken_states, store_law_states
from reference import laws_mpmath as laws
from reference import rig as rig_reference
from reference.any_law import Step, follow
from reference.jets import value
from reference.law_cases import CASES, CYCLES, hertz
from reference.law_series import law_of
from reference.public_motion import reference_shaking
from reference.store_law_states import STORES, States, Store, difference, marks
from samples import sample
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.stops import STOPS, Stop

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


BY_FORMULA = {vi.Law, *FORMULA_STOPS.values()}
BUILT_IN = {kinds: set(kinds.classes.values()) - BY_FORMULA for kinds in (ISOLATORS, STOPS)}
"""A law given as a formula equals one of these to the bit: tests/engine/taylor/test_own_laws.py."""


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
    stops = [type(stop) for one in CASES.values() for stop in one.rig.stops]
    assert all(stops.count(law) >= 3 for law in BUILT_IN[STOPS])


def test_another_stop_changes_no_stored_rig() -> None:
    found = shaken_cases.cases({"one": hertz, "two": hertz})
    assert found.items() >= shaken_cases.CASES.items()
    more = found.keys() - shaken_cases.CASES.keys()
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


@pytest.mark.parametrize(
    "name", sample(["friction, bumpers", "exponential, softening, power"], ["friction, bumpers"])
)
def test_order_and_digits_change_nothing(name: str) -> None:
    rig, shaken = CASES[name]
    one = follow(rig, shaken, 3)
    other = follow(rig, shaken, 3, order=30, digits=42)
    rough = follow(rig, shaken, 3, order=44, digits=25)
    with mp.workdps(60):
        assert difference(one, other, 1) < mpf(10) ** -38
        assert mpf(10) ** -60 < difference(one, rough, 1) < mpf(10) ** -21


@pytest.mark.full
def test_a_linear_rig_moves_as_by_the_reference_of_linear_rigs() -> None:
    rig, shaken = CASES["linear, bumpers"]
    one = follow(rig, shaken, CYCLES)
    right, left = (rig_reference.Stop(s.stiffness, s.damping, s.gap) for s in rig.stops)
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


def free(stop: Stop, v: float) -> mpf:
    """What an impact on a stop returns while nothing else acts, over v."""
    rig = vi.Oscillator(550.0, vi.Isolator(0.0, 0.0), stop)
    motion = follow(rig, vi.Harmonic(0.0, 1.0), 1, (0, v))
    assert [event.kind for event in motion.events] == ["contact_right", "detach_right"]
    with mp.workdps(60):
        return -motion.states[-1][1] / mpf(v)


@pytest.mark.parametrize(
    ("relation", "returned"),
    [
        ("hunt-crossley", (0.581, 0.663, 0.768, 0.909)),
        ("lankarani-nikravesh", (0.684, 0.725, 0.796, 0.913)),
        ("flores", (0.256, 0.470, 0.683, 0.894)),
        ("gonthier", (0.304, 0.488, 0.670, 0.876)),
        ("exact", (0.3, 0.5, 0.7, 0.9)),
    ],
)
def test_a_free_impact_returns_what_its_relation_says(
    relation: str, returned: tuple[float, ...]
) -> None:
    impacts = [*zip((0.3, 0.5, 0.7, 0.9), returned, strict=True)]
    for e, known in sample(impacts, impacts[1:2]):
        found = free(vi.PowerBumper(2e7, 0.05, restitution=e, relation=relation), 0.4)
        assert round(float(found), 3) == known
        with mp.workdps(60):
            d = laws.dissipation(e, relation)
            assert abs(mp.log((1 + d) / (1 - found * d)) - d * (1 + found)) < mpf(10) ** -36
            assert relation != "exact" or abs(found - mpf(e)) < mpf(10) ** -36


@pytest.mark.parametrize(("e", "returned"), [(0.3, 0.292), (0.5, 0.495), (0.7, 0.698), (0.9, 0.9)])
def test_a_free_impact_by_jankowski(e: float, returned: float) -> None:
    assert round(float(free(vi.JankowskiBumper(2e7, 0.05, e, 550.0), 0.4)), 3) == returned


@pytest.mark.parametrize("exponent", [1.0, 1.25, 1.5, 2.5])
def test_an_elastic_power_returns_everything(exponent: float) -> None:
    assert abs(free(vi.PowerBumper(2e7, 0.05, exponent), 0.4) - 1) < mpf(10) ** -38


@pytest.mark.parametrize("cubic", [2e8, -4e7])
def test_duffing_moves_by_an_elliptic_function(cubic: float) -> None:
    u0, mass, k = 0.01, 550.0, 20e3
    rig = vi.Oscillator(mass, vi.PolynomialIsolator(k, 0.0, cubic))
    motion = follow(rig, vi.Harmonic(0.0, 1.0), 5, (u0, 0))
    with mp.workdps(60):
        bent = mpf(cubic) * mpf(u0) ** 2
        rate = mp.sqrt((mpf(k) + bent) / mpf(mass))
        m = bent / (2 * (mpf(k) + bent))
        for n, (u, _) in enumerate(motion.states):
            assert abs(u - u0 * mp.ellipfun("cn", rate * n, m=m)) < mpf(10) ** -38


@pytest.mark.parametrize("frequency", [0.7, 1.5])
def test_sliding_without_a_stop_is_den_hartogs(frequency: float) -> None:
    """His steady motion, and its amplitude (Trans. ASME 53 (1931) 107)."""
    mass, k, friction, size = 550.0, 26e3, 60.0, 0.49
    phase = 1.0 if frequency < 1 else -0.5
    with mp.workdps(60):
        omega, own = 2 * mp.pi * mpf(frequency), mp.sqrt(mpf(k) / mass)
        push, rub = -mpf(size) * mass / mpf(k), mpf(friction) / mpf(k)
        swing = push / (1 - (omega / own) ** 2)
        sine, cosine = mp.sin(mp.pi * own / omega), mp.cos(mp.pi * own / omega)
        # From a turn on the right, at the angle psi of the forcing, to one on the left.
        lag = rub * own / omega * sine / (1 + cosine)
        amplitude = mp.sqrt(swing**2 - lag**2)
        psi = mp.atan2(amplitude / swing, lag / swing)
        late = ((mpf(phase) - psi) / omega) % (1 / mpf(frequency))
        side = 1
        if late > mp.pi / omega:
            late, side = late - mp.pi / omega, -1

        def half(t: mpf) -> mpf:
            # cos and sin of the own frequency have -rub and -rub sin/(1 + cos).
            free = -rub * mp.cos(own * t) - rub * sine / (1 + cosine) * mp.sin(own * t)
            return swing * mp.sin(omega * t + psi) + rub + free

        start = (side * half(late), side * mp.diff(half, late))
        assert abs(half(mpf(0)) - amplitude) < mpf(10) ** -50
    rig = vi.Oscillator(mass, vi.FrictionIsolator(k, 0.0, friction))
    largest = mpf(0)

    def watch(step: Step) -> None:
        nonlocal largest
        assert not step.stuck
        largest = max(largest, abs(value(step.u, step.span)))

    motion = follow(rig, vi.Harmonic(size, frequency, phase), 3, start, watch=watch)
    with mp.workdps(60):
        for state in motion.states:
            assert max(abs(state[0] - start[0]), abs(state[1] - start[1])) < mpf(10) ** -38
        assert abs(largest - amplitude) < mpf(10) ** -38


def test_a_bilinear_law_yields_where_energy_says() -> None:
    """A free motion yields with the energy that is left, and by Masing's rule behind its turn."""
    elastic, post_yield, limit, mass = 80e3, 20e3, 2e-3, 550.0
    law = vi.BilinearIsolator(elastic, post_yield, elastic * limit, 0.0)
    motion = follow(vi.Oscillator(mass, law), vi.Harmonic(0.0, 1.0), 1, (0, 0.1))
    yields = [event for event in motion.events if event.kind == "yield"]
    with mp.workdps(60):
        k, p, y = mpf(elastic), mpf(post_yield), mpf(elastic * limit) / mpf(elastic)
        # To the first turn: m v²/2 = k_p u²/2 + (k - p) (y²/2 + y (u - y)).
        first = yields[0]
        assert abs(first.u - y) < mpf(10) ** -40
        left = mass * mpf(0.1) ** 2 / 2 - k * y**2 / 2
        assert abs(mass * first.v**2 / 2 - left) < mpf(10) ** -36
        # Masing: it yields again 2 y behind the turn.
        plastic = (k - p) * y
        inside = plastic**2 + p * (mass * mpf(0.1) ** 2 + plastic * y)
        most = (mp.sqrt(inside) - plastic) / p
        assert abs(yields[1].u - (most - 2 * y)) < mpf(10) ** -38


@pytest.mark.parametrize("alpha", [0.25, 0.5, 1.5, 2.0])
def test_a_dashpot_alone_brings_the_mass_to_rest(alpha: float) -> None:
    """v^(1 - a) = v0^(1 - a) - (1 - a) c t/m while it lasts."""
    rig = vi.Oscillator(2.0, vi.Isolator(0.0, 1.0, alpha), vi.RigidStop(1.0, 100.0))
    motion = follow(rig, vi.Harmonic(0.0, 4.0), 1, (0, 1))
    with mp.workdps(60):
        rest = 1 - mpf(alpha)
        known = (1 - rest * mpf("0.25") / 2) ** (1 / rest)
        assert abs(motion.states[-1][1] - known) < mpf(10) ** -38


def test_what_is_out_of_reach_is_refused() -> None:
    plain = vi.Isolator(1e4, 10.0)
    shaken = vi.Harmonic(1.0, 1.0)
    with pytest.raises(ValueError, match="small fraction"):
        follow(vi.Oscillator(1.0, plain, vi.PowerBumper(1e4, 0.01, 1.3)), shaken, 1)
    with pytest.raises(ValueError, match="touches"):
        follow(vi.Oscillator(1.0, plain, vi.Bumper(1e4, 1.0, -0.01)), shaken, 1)
    with pytest.raises(ArithmeticError):
        follow(vi.Oscillator(1.0, plain, vi.RigidStop(0.2, 1e-6)), shaken, 2)
