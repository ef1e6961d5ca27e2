"""Force loops of single laws."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import force_loop

TURN = np.linspace(0.0, 2.25, 9001) * 2.0 * np.pi
CYCLE = slice(5000, None)
"""The last turn: from crest to crest."""


def loop(law, size, speed=0.0):
    u = size * np.sin(TURN)
    return u, law.force(u, np.cos(TURN), speed * np.cos(TURN))


def area(u, force):
    return abs(np.trapezoid(force[CYCLE], u[CYCLE]))


def test_areas_of_closed_forms():
    u, force = loop(vi.FrictionIsolator(10.0, 0.0, 2.0), 3.0)
    assert area(u, force) == pytest.approx(4 * 2.0 * 3.0, rel=1e-3)
    u, force = loop(vi.BilinearIsolator(10.0, 2.0, 5.0, 0.0), 3.0)
    assert area(u, force) == pytest.approx(4 * (10 - 2) * 0.5 * (3.0 - 0.5), rel=1e-3)
    u, force = loop(vi.Isolator(10.0, 2.0), 3.0, speed=0.7)
    assert area(u, force) == pytest.approx(np.pi * 2.0 * 0.7 * 3.0, rel=1e-3)
    large = vi.ExponentialIsolator(10.0, 2.0, 5.0, 0.0)
    u, force = loop(large, 30.0)
    assert area(u, force) == pytest.approx(4 * 30.0 * large.hysteretic_force, rel=0.02)
    u, force = loop(vi.PolynomialIsolator(1.0, 0.0, 1.0, 1.0), 1.3)
    assert area(u, force) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    "law",
    [
        vi.BilinearIsolator(10.0, 2.0, 5.0, 0.0),
        vi.BoucWenIsolator(10.0, 2.0, 5.0, 0.0, 3, 0.7, 0.2),
        vi.ExponentialIsolator(10.0, 2.0, 5.0, 0.0, 1.0, 0.2),
        vi.PolynomialIsolator(1.0, 0.0, 1.0, 1.0),
    ],
    ids=lambda law: law.kind,
)
def test_the_first_quarter_is_the_static_force(law):
    u, force = loop(law, 1.5)
    for i in range(0, 1001, 100):
        assert force[i] == pytest.approx(law.static_force(u[i]), rel=1e-9, abs=1e-12)


def test_bouc_wen_and_exponential_agree_where_they_are_one():
    u, force = loop(vi.ExponentialIsolator(5.0, 1.0, 8.0, 0.0), 0.7)
    _, twin = loop(vi.BoucWenIsolator(3.0, 1.0, 3.0 / 8.0, 0.0, 1, 1.0, 0.0), 0.7)
    assert force == pytest.approx(twin, abs=1e-9)
    assert len(u) == len(force)


def test_contacts():
    turn = np.linspace(0.0, 0.5, 101) * 2.0 * np.pi
    d, v = 0.01 * np.sin(turn), 0.5 * np.cos(turn)
    hertz = vi.PowerBumper(2e6, 0.0).force(d, v)
    assert hertz == pytest.approx(2e6 * np.maximum(d, 0.0) ** 1.5)
    damped = vi.PowerBumper(2e6, 0.0, dissipation=1.0).force(d, v)
    assert damped == pytest.approx(hertz * (1.0 + v))
    relation = vi.PowerBumper(2e6, 0.0, restitution=0.5, relation="hunt-crossley")
    assert relation.force(d, v) == pytest.approx(hertz * (1.0 + 0.75 / 0.5 * v))
    pounding = vi.JankowskiBumper(2e6, 0.0, 0.5, 100.0).force(d, v)
    assert np.all(pounding[:50] >= hertz[:50])
    assert pounding[51:] == pytest.approx(hertz[51:])
    assert vi.Bumper(1e4, 1e3, 0.0).force(d, v).min() == 0.0


def test_a_figure():
    ax = force_loop(vi.BilinearIsolator(5e5, 3e4, 1e3, 0), "20 mm", title="bilinear")
    x, y = ax.lines[0].get_data()
    assert np.max(x) == pytest.approx(20.0)
    assert np.max(y) == pytest.approx(1e-3 * (3e4 * 0.02 + 4.7e5 * 0.002))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("displacement $u$ (mm)", "force (kN)")
    ax = force_loop(vi.PowerBumper(2e9, 0, restitution=0.5), "2 mm", "5 Hz")
    assert ax.get_xlabel() == "deformation (mm)"
    with pytest.raises(vi.InputError, match=r"^amplitude: 0 is not greater"):
        force_loop(vi.Isolator(1, 1), 0)


def test_a_formula_with_a_gap_is_a_stop():
    assert force_loop(vi.Law("k*d", k=1e4, gap=0.01), "2 mm").get_xlabel() == "deformation (mm)"
    assert force_loop(vi.Law("k*u", k=1e4), "2 mm").get_xlabel() == "displacement $u$ (mm)"


@pytest.mark.parametrize(
    ("law", "line"),
    [
        (3, "law: 3 is not a law; pass an isolator or a stop"),
        (vi.RigidStop(0.5, 0.01), "law: a rigid stop has no displacement"),
    ],
)
def test_what_has_no_loop(law, line):
    with pytest.raises(vi.InputError, match=f"^{line}"):
        force_loop(law, "2 mm")
