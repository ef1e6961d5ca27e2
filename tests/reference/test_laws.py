"""The reference's laws against the package's, and against themselves."""

from __future__ import annotations

import math

import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from reference import laws_mpmath as laws

U = (1e-6, 0.003, 0.05)


def virgin(law, u, steps=200):
    """Force after a slow loading from rest, by small steps of the classical Runge-Kutta method."""
    z, step = mpf(0), mpf(u) / steps
    for i in range(steps):
        at = i * step
        k1 = laws_rate(law, at, z)
        k2 = laws_rate(law, at + step / 2, z + step / 2 * k1)
        k3 = laws_rate(law, at + step / 2, z + step / 2 * k2)
        k4 = laws_rate(law, at + step, z + step * k3)
        z += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return law.force(u, 1, z)


def laws_rate(law, u, z):
    return law.rate(u, 1, z)


PAIRS = [
    (vi.Isolator(3e4, 0), laws.Linear(3e4)),
    (vi.FrictionIsolator(3e4, 0, 120), laws.Friction(3e4, 120)),
    (vi.PolynomialIsolator(3e4, 0, 4e6, 2e9), laws.Polynomial(3e4, 4e6, 2e9)),
    (vi.BoucWenIsolator(5e5, 3e4, 1e4, 0), laws.BoucWen(5e5, 3e4, 1e4, 1, 0.5, 0.5)),
    (vi.BoucWenIsolator(5e5, 3e4, 1e4, 0, 3, 0.9, 0.4), laws.BoucWen(5e5, 3e4, 1e4, 3, 0.9, 0.4)),
    (vi.ExponentialIsolator(5e5, 3e4, 50, 0, 20, 50), laws.Exponential(5e5, 3e4, 50, 20, 50)),
]


@pytest.mark.parametrize(("ours", "theirs"), PAIRS, ids=lambda law: repr(law)[:24])
@pytest.mark.parametrize("u", U)
def test_static_forces_agree(ours, theirs, u):
    assert ours.static_force(u) == pytest.approx(float(virgin(theirs, u)), rel=1e-8)


@pytest.mark.parametrize("u", U)
def test_a_bilinear_law_follows_its_memory(u):
    ours, theirs = vi.BilinearIsolator(5e5, 3e4, 1e3, 0), laws.Bilinear(5e5, 3e4, 1e3)
    z = min(mpf(u), theirs.limit)
    assert ours.static_force(u) == pytest.approx(float(theirs.force(u, 1, z)), rel=1e-14)
    assert theirs.branch(u, 1, theirs.limit) == 1
    assert theirs.branch(u, -1, theirs.limit) == theirs.branch(u, 1, theirs.limit / 2) == 0


def test_the_exponential_law_in_its_two_forms():
    """The source's u_j and the rate of the hysteretic part describe one motion."""
    law = laws.Exponential(5, 0.5, 5, 1, 1)
    with mp.workdps(30):
        u, force = mpf(0), mpf(0)  # as the source starts
        for turn in (mpf("0.7"), mpf("-0.4"), mpf("0.1"), mpf("-2")):
            s = laws.sign(turn - u)
            u_j = law.after_reversal(s, u, force)
            assert mp.almosteq(law.on_branch(s, u, u_j), force, 0, mpf(10) ** -28)
            # z' = a (fbar v - z |v|) along a straight way, in closed form
            z, way = force - law.elastic_force(u), abs(turn - u)
            z = s * law.bound + (z - s * law.bound) * mp.exp(-mpf(law.decay) * way)
            u, force = turn, law.on_branch(s, turn, u_j)
            assert mp.almosteq(force, law.force(u, s, z), mpf(10) ** -27)


def test_without_hardening_it_is_a_bouc_wen():
    exponential = laws.Exponential(5, 1, 8, 0, 0)
    twin = laws.BoucWen(3, 1, mpf(3) / 8, 1, 1, 0)
    for z in (-0.1, 0.0, 0.05):
        for v in (-2, 3):
            assert mp.almosteq(exponential.rate(0, v, 2 * mpf(z)), 2 * twin.rate(0, v, z))


@pytest.mark.parametrize(
    "relation", ["exact", "hunt-crossley", "lankarani-nikravesh", "flores", "gonthier"]
)
@pytest.mark.parametrize("e", [0.01, 0.3, 0.7, 0.999])
def test_contacts_agree(relation, e):
    bumper = vi.PowerBumper(2e9, 0, restitution=e, relation=relation)
    assert bumper.dissipation_number == pytest.approx(float(laws.dissipation(e, relation)), 1e-14)
    elastic = laws.power_contact(2e9, 1.5, 0, 0.01, -1)
    assert bumper.static_force(0.01) == pytest.approx(float(elastic), rel=1e-14)
    pounding = vi.JankowskiBumper(2e9, 0, e, 550)
    xi = laws.jankowski_ratio(e)
    assert pounding.damping_ratio == pytest.approx(float(xi), rel=1e-13)
    closing = laws.jankowski_contact(2e9, xi, 550, 0.01, 0.5)
    parting = laws.jankowski_contact(2e9, xi, 550, 0.01, -0.5)
    assert parting == elastic
    damping = 2 * pounding.damping_ratio * math.sqrt(550 * 2e9 * math.sqrt(0.01))
    assert float(closing - parting) == pytest.approx(0.5 * damping, rel=1e-12)


def test_forces_never_pull():
    assert laws.power_contact(2.0, 1.5, 3.0, 0.1, -1.0) == 0
    assert laws.power_contact(2.0, 1.5, 3.0, -0.1, 1.0) == 0
    assert laws.jankowski_contact(2.0, 1.0, 1.0, -0.1, 1.0) == 0
    assert laws.kelvin_voigt(2.0, 3.0, 0.5, -1.0) == -2
    assert laws.viscous(2.0, 0.5, -4.0) == -4
    assert laws.Friction(1, 2).held(-2)
    assert not laws.Friction(1, 2).held(2.1)
