"""The reference for assemblies against that for one mass, and its own limits."""

from __future__ import annotations

from typing import Any

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from reference import any_assembly, any_law
from reference import assembly_cases as laws
from samples import sample

SHAKEN = vi.Harmonic(3.0, 1.7, 0.3)
ONE_MASS: dict[str, tuple[Any, Any, Any]] = {
    "bouc-wen, jankowski": (
        laws.SHARP,
        vi.JankowskiBumper(2e5, 0.012, 0.6, 1.1),
        vi.Bumper(1.5e4, 15.0, 0.01),
    ),
    "bilinear, powers": (laws.BILINEAR, laws.HUNT, laws.RESTITUTION),
    "cubic, rigid": (laws.CUBIC, vi.RigidStop(0.6, 0.012), laws.SQUARE),
    "friction, bumpers": (vi.FrictionIsolator(120.0, 1.0, 0.9), laws.BUMPER, laws.HUNT),
    "exponential, elastic": (laws.EXPONENTIAL, laws.ELASTIC, laws.BUMPER),
}


@pytest.mark.parametrize("name", sample([*ONE_MASS], [*ONE_MASS][:1]))
def test_one_mass_moves_as_by_the_reference_of_one_mass(name: str) -> None:
    isolator, right, left = ONE_MASS[name]
    assembly = vi.Assembly(
        {"m": 1.1},
        links={"i": vi.Link("ground", "m", isolator)},
        stops={"r": vi.Link("m", "ground", right), "l": vi.Link("ground", "m", left)},
    )
    start = vi.State(velocity={"m": 0.1})
    run = any_assembly.follow(vi.Rig(assembly, SHAKEN), 2, start, extremes=False)
    alone = vi.Oscillator(1.1, isolator, right, left)
    expected = any_law.follow(alone, SHAKEN, 2, (0, 0.1))
    with mp.workdps(60):
        for one, other in zip(run.states, expected.states, strict=True):
            assert max(abs(a - b) for a, b in zip(one, other, strict=True)) < mpf("1e-28")
        kinds = [
            event for event in expected.events if event.kind[:5] in ("conta", "detac", "impac")
        ]
        assert len(run.events) == len(kinds) > 3
        for one, other in zip(run.events, kinds, strict=True):
            assert abs(one.time - other.time) < mpf("1e-28")


def test_momentum_is_kept_between_free_masses() -> None:
    """Two free bodies that hit each other, a rigid stop and a curved one between them."""
    assembly = vi.Assembly(
        {"a": 1.0, "b": 0.6},
        links={"x": vi.Link("a", "b", laws.SHARP)},
        stops={
            "r": vi.Link("a", "b", vi.RigidStop(0.7, 0.02)),
            "l": vi.Link("b", "a", laws.JANKOWSKI),
        },
    )
    rig = vi.Rig(assembly, vi.Harmonic(0.0, 1.0))
    start = vi.State(velocity={"a": 1.0, "b": -0.4})
    motion = any_assembly.follow(rig, 1, start, extremes=False)
    assert {event.kind for event in motion.events} == {"impact", "contact", "detach"}
    with mp.workdps(60):
        masses = [mpf(1.0), mpf(0.6)]
        first, *_, last = (
            sum(m * v for m, v in zip(masses, s[2:], strict=True)) for s in motion.states
        )
        assert abs(first - last) < mpf("1e-35")


def test_a_link_whose_way_is_not_known_is_refused() -> None:
    rig = laws.CASES["two, bouc-wen and jankowski"].rig
    with pytest.raises(ValueError, match="must move at the start"):
        any_assembly.follow(rig, 1)
