"""The paths of an assembly's parameters."""

from __future__ import annotations

import pytest

import vibroimpact as vi
from vibroimpact.model.parameters import parameter, parameters, set_values


def rig() -> vi.Rig:
    assembly = vi.Assembly(
        {"base": 300.0, "roof": 250.0},
        {
            "isolator": vi.Link("ground", "base", vi.Isolator(2e4, 900.0)),
            "storey": vi.Link("base", "roof", vi.Isolator(6e4, 400.0)),
        },
        {
            "moat": vi.Link("base", "ground", vi.Bumper(6e5, 9e3, 0.012)),
            "wall": vi.Link("ground", "base", vi.RigidStop(0.6, 0.02)),
        },
        {"roof": 5.0},
    )
    return vi.Rig(assembly, vi.Harmonic("1 m/s2", 0.9))


VALUES = {
    "frequency": 0.9,
    "amplitude": 1.0,
    "masses.base": 300.0,
    "links.storey.stiffness": 6e4,
    "links.isolator.damping": 900.0,
    "stops.moat.gap": 0.012,
    "stops.moat.damping": 9e3,
    "stops.wall.restitution": 0.6,
    "forces.roof": 5.0,
    "forces.base": 0.0,
}


@pytest.mark.parametrize("path", VALUES)
def test_each_is_read_and_varied(path: str) -> None:
    one = parameter(path, rig())
    assert one.read(rig()) == VALUES[path]
    value = one.beside(VALUES[path])
    changed = one.vary(rig(), value)
    assert one.read(changed) == value
    for name, other in parameters(rig()).items():
        if name != path and name in VALUES:
            assert other.read(changed) == VALUES[name]


def test_a_path_of_all_stops() -> None:
    one = parameter("gap", rig())
    changed = one.vary(rig(), 0.03)
    assert {stop.law.gap for stop in changed.system.stops.values()} == {0.03}
    with pytest.raises(vi.InputError, match="the stops have different values of gap"):
        one.read(rig())
    assert parameter("stops.restitution", rig()).read(rig()) == 0.6
    assert parameter("moat.gap", rig()).name == "stops.moat.gap"


def test_values_are_set_at_once() -> None:
    system = set_values(
        rig(),
        {"links.storey.stiffness": "70 kN/m", "masses.base": 310, "forces.base": "2 N"},
    ).system
    assert system.links["storey"].law.stiffness == 7e4
    assert system.masses["base"] == 310.0
    assert dict(system.forces) == {"roof": 5.0, "base": 2.0}


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("links.storey.gap", r"'links.storey.gap' is unknown; did you mean links.storey.damping\?"),
        ("isolator.stiffness", r"is not a parameter of this rig; did you mean links.isolator.st"),
        ("damping_ratio", "'damping_ratio' is not a parameter of this rig"),
        ("masses.nobody", "'masses.nobody' is unknown; use frequency"),
    ],
)
def test_paths_that_there_are_not(path: str, says: str) -> None:
    with pytest.raises(vi.InputError, match=says) as error:
        parameter(path, rig())
    assert "\n" not in str(error.value)


def test_values_that_cannot_be() -> None:
    with pytest.raises(vi.InputError, match=r"^masses.base at -1 kg: masses.base: -1"):
        parameter("masses.base", rig()).vary(rig(), -1.0)
