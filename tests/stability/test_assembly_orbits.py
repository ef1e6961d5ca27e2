"""Orbits, branches and steady motions of assemblies."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.response.engine_system import system_vector
from vibroimpact.stability.parameter_family import family

SHAKING = vi.Harmonic("1 m/s2", 0.9)


def frame(stop: object = None, gap: float = 0.012, damping: float = 1.0) -> vi.Assembly:
    """A building on an isolator between two walls."""
    law = vi.Bumper(6e5, 9e3, gap) if stop is None else stop
    return vi.Assembly(
        masses={"base": 300.0, "roof": 250.0},
        links={
            "isolator": vi.Link("ground", "base", vi.Isolator(2.0e4, 900.0 * damping)),
            "storey": vi.Link("base", "roof", vi.Isolator(6.0e4, 400.0 * damping)),
        },
        stops={
            "right": vi.Link("base", "ground", law),
            "left": vi.Link("ground", "base", law),
        },
    )


def alone(stop: object, *, assembled: bool) -> vi.Rig:
    """One mass between two stops, as an oscillator or as an assembly."""
    isolator = vi.Isolator(1.5e4, 600.0)
    shaking = vi.Harmonic("1 m/s2", 1.3)
    if not assembled:
        return vi.Rig(vi.Oscillator(300.0, isolator, stop, stop), shaking)
    return vi.Rig(
        vi.Assembly(
            masses={"m": 300.0},
            links={"isolator": vi.Link("ground", "m", isolator)},
            stops={"right": vi.Link("m", "ground", stop), "left": vi.Link("ground", "m", stop)},
        ),
        shaking,
    )


STOPS = {"bumpers": vi.Bumper(2e5, 3e3, "8 mm"), "walls": vi.RigidStop(0.6, "8 mm")}


@pytest.mark.parametrize("kind", STOPS)
def test_the_orbit_of_one_mass_is_the_oscillators(kind: str) -> None:
    one = vi.orbit(alone(STOPS[kind], assembled=False))
    several = vi.orbit(alone(STOPS[kind], assembled=True))
    assert several.attrs["contacts"].split() == [
        {"R": "right", "L": "left"}[side] for side in one.attrs["contacts"]
    ]
    assert len(one.attrs["contacts"]) >= 2
    for name in ("displacement_max", "acceleration_max", "transmitted_force_max"):
        mine, theirs = float(np.squeeze(several[name])), float(one[name])
        assert mine == pytest.approx(theirs, rel=1e-12)
    known = one["multiplier_real"] + 1j * one["multiplier_imag"]
    multipliers = several["multiplier_real"] + 1j * several["multiplier_imag"]
    np.testing.assert_allclose(multipliers[:2], known[:2], rtol=0, atol=1e-11)
    size = abs(one["monodromy"].values[:2, :2]).max()
    np.testing.assert_allclose(
        several["monodromy"].values[:2, :2],
        one["monodromy"].values[:2, :2],
        rtol=0,
        atol=1e-11 * size,
    )
    assert float(several["effective_damping"]) == pytest.approx(
        float(one["effective_damping"]), rel=1e-11
    )
    assert bool(several["antisymmetric"]) == bool(one["antisymmetric"])


def section_after(rig: vi.Rig, state: vi.State, cycles: int) -> np.ndarray:
    return vi.simulate(rig, cycles, state, samples=0)["final_state"].values


@pytest.mark.parametrize("stop", [None, vi.RigidStop(0.8, 0.012)])
def test_multipliers_are_those_of_differences(stop: object) -> None:
    rig = vi.Rig(frame(stop), SHAKING)
    orbit = vi.orbit(rig)
    period = int(orbit["period"])
    start = orbit["initial_state"]
    names = ["displacement.base", "displacement.roof", "velocity.base", "velocity.roof"]
    places = [list(start["component"].values).index(name) for name in names]
    assert (start.values[-3:-1] == 0).all()  # it flies at the section
    columns = []
    for place in places:
        step = 1e-7
        ends = []
        for sign in (1.0, -1.0):
            moved = start.copy()
            moved[place] += sign * step
            ends.append(section_after(rig, moved, period))
        columns.append((ends[0] - ends[1])[places] / (2 * step))
    differences = np.array(columns).T
    exact = orbit["monodromy"].values[:4, :4]
    np.testing.assert_allclose(exact, differences, rtol=0, atol=1e-6 * abs(exact).max())
    expected = np.linalg.eigvals(differences)
    multipliers = (orbit["multiplier_real"] + 1j * orbit["multiplier_imag"]).values
    for one in expected:
        assert abs(multipliers - one).min() <= 1e-6 * abs(exact).max()


def test_the_product_of_multipliers_is_that_of_the_damping() -> None:
    """Of rigid stops exp(−∫ tr M⁻¹C) times e² for each impact."""
    e = 0.8
    rig = vi.Rig(frame(vi.RigidStop(e, 0.012)), SHAKING)
    orbit = vi.orbit(rig)
    impacts = len(orbit.attrs["contacts"].split())
    assert impacts >= 2
    assembly = rig.system
    trace = np.trace(np.linalg.solve(assembly.mass_matrix, assembly.damping_matrix))
    lasts = int(orbit["period"]) / SHAKING.frequency
    expected = math.exp(-trace * lasts) * e ** (2 * impacts)
    moving = orbit["monodromy"].values[:4, :4]
    assert np.linalg.det(moving) == pytest.approx(expected, rel=1e-10)
    multipliers = orbit["multiplier_real"].values + 1j * orbit["multiplier_imag"].values
    assert np.prod(multipliers[:4]).real == pytest.approx(expected, rel=1e-9)
    assert orbit["exponents"].values.sum() * lasts == pytest.approx(math.log(expected), rel=1e-9)
    assert float(orbit["effective_damping"]) * lasts == pytest.approx(
        -math.log(expected), rel=1e-10
    )


def test_a_steady_motion_is_its_orbit() -> None:
    rig = vi.Rig(frame(), SHAKING)
    steady, orbit = vi.steady(rig), vi.orbit(rig)
    assert str(steady["motion"].values) == "periodic"
    assert bool(steady["antisymmetric"])
    assert int(steady["stable"]) == 1
    assert steady["exponents"].sizes == {"exponent": 4}
    np.testing.assert_allclose(steady["exponents"], orbit["exponents"], rtol=1e-6)
    for name in ("displacement_max", "peak_acceleration", "peak_force"):
        np.testing.assert_allclose(steady[name], orbit[name], rtol=1e-9)
    # Exact extremes bound the samples, and are close to them.
    sampled = steady["displacement"].max("time")
    assert (sampled <= steady["displacement_max"] * (1 + 1e-12)).all()
    np.testing.assert_allclose(sampled, steady["displacement_max"], rtol=1e-3)
    np.testing.assert_allclose(
        steady["transmitted_force"].max(), steady["transmitted_force_max"], rtol=1e-2
    )
    swept = vi.sweep(rig, [SHAKING.frequency], "forward")
    np.testing.assert_allclose(
        swept["displacement_max"].values[0, 0], orbit["displacement_max"], rtol=1e-11
    )


def test_a_branch_of_one_mass_is_the_oscillators() -> None:
    one, several = (
        vi.branch(alone(STOPS["bumpers"], assembled=assembled), vary={"frequency": (0.7, 3.0)})
        for assembled in (False, True)
    )
    kinds = one["bifurcation_kind"].values.tolist()
    assert kinds.count("fold") >= 3
    assert kinds.count("grazing") >= 2
    assert several["bifurcation_kind"].values.tolist() == kinds
    np.testing.assert_allclose(
        several["bifurcation_value"].values, one["bifurcation_value"].values, rtol=1e-9
    )
    assert several.sizes["point"] == one.sizes["point"]
    np.testing.assert_allclose(
        several["displacement_max"].values[:, 0], one["displacement_max"].values, rtol=1e-9
    )
    names = {"R": " right,", "L": " left"}
    for mine, theirs in zip(
        several["bifurcation_contacts"].values, one["bifurcation_contacts"].values, strict=True
    ):
        assert mine == "".join(names.get(letter, letter) for letter in theirs)


def test_a_branch_without_contacts_is_the_linear_response() -> None:
    assembly = frame(gap=1.0)
    branch = vi.branch(vi.Rig(assembly, SHAKING), vary={"frequency": (0.4, 3.0)})
    m, c, k = assembly.mass_matrix, assembly.damping_matrix, assembly.stiffness_matrix
    assert branch.sizes["bifurcation"] == 0
    for i in range(0, branch.sizes["point"], 7):
        here = branch.isel(point=i)
        w = 2 * np.pi * float(here["frequency"])
        u = np.linalg.solve(k - w**2 * m + 1j * w * c, -m @ np.ones(2))
        np.testing.assert_allclose(here["displacement_max"], abs(u), rtol=1e-11)
        rates = np.linalg.eigvals(
            np.block(
                [[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]
            )
        )
        flown = np.exp(rates / float(here["frequency"]))
        mine = (here["multiplier_real"] + 1j * here["multiplier_imag"]).values
        if bool(here["antisymmetric"]):
            assert float(abs(mine).max()) == pytest.approx(abs(flown).max(), rel=1e-10)


PATHS = {
    "gap": ("gap", (0.004, 0.012)),
    "isolator.stiffness": ("links.isolator.stiffness", (1.2e4, 1.9e4)),
    "stops.stiffness": ("stops.stiffness", (1e5, 4e5)),
    "stops.damping": ("stops.damping", (1500.0, 6000.0)),
    "right.gap": ("stops.right.gap", (0.005, 0.012)),
    "mass": ("masses.m", (250.0, 350.0)),
    "force": ("forces.m", (-60.0, 60.0)),
}


@pytest.mark.parametrize("path", PATHS)
def test_a_branch_over_a_path_of_one_mass_is_the_oscillators(path: str) -> None:
    """Also where the path makes the rig its own mirror image at one value only."""
    of_parts, span = PATHS[path]
    one = vi.branch(alone(STOPS["bumpers"], assembled=False), vary={path: span})
    several = vi.branch(alone(STOPS["bumpers"], assembled=True), vary={of_parts: span})
    assert several.sizes["point"] == one.sizes["point"] > 20
    assert several["bifurcation_kind"].values.tolist() == one["bifurcation_kind"].values.tolist()
    np.testing.assert_allclose(
        several["bifurcation_value"].values, one["bifurcation_value"].values, rtol=1e-9
    )
    if path == "gap":
        assert one.sizes["bifurcation"] == 1
    np.testing.assert_allclose(several[of_parts].values, one[one.attrs["parameter"]].values)
    np.testing.assert_allclose(
        several["displacement_max"].values[:, 0], one["displacement_max"].values, rtol=1e-10
    )
    np.testing.assert_array_equal(several["antisymmetric"], one["antisymmetric"])


def test_a_branch_over_a_storey_passes_its_orbits() -> None:
    """Orbits along the path are those that `orbit` finds at its values."""
    rig = vi.Rig(frame(), SHAKING)
    for path, span in (("links.storey.stiffness", (4e4, 9e4)), ("masses.roof", (200.0, 300.0))):
        branch = vi.branch(rig, vary={path: span})
        assert branch[path].attrs["units"] == ("kg" if "mass" in path else "N m-1")
        for i in (0, branch.sizes["point"] // 2, branch.sizes["point"] - 1):
            here = branch.isel(point=i)
            value = float(here[path])
            assembly = frame()
            if path.startswith("masses"):
                assembly = assembly.replace(masses={"base": 300.0, "roof": value})
            else:
                storey = vi.Link("base", "roof", vi.Isolator(value, 400.0))
                assembly = assembly.replace(links={**assembly.links, "storey": storey})
            single = vi.orbit(vi.Rig(assembly, SHAKING), here["section"], 1)
            np.testing.assert_allclose(
                here["displacement_max"], single["displacement_max"], rtol=1e-9
            )


def test_amplitudes_are_followed_and_other_parameters_refused() -> None:
    rig = vi.Rig(frame(), SHAKING)
    branch = vi.branch(rig, vary={"amplitude": (0.2, 2.0)})
    assert branch["displacement_max"].dims == ("point", "mass")
    assert "grazing" in branch["bifurcation_kind"].values
    with pytest.raises(
        vi.InputError,
        match="'damping_ratio' is not a parameter of this rig; use freq",
    ):
        vi.branch(rig, vary={"damping_ratio": (0.01, 0.02)})


def damper(*, zeta: float, mass: float, e: float, clearance: float) -> vi.Rig:
    """An oscillator with a loose ball between two walls of it, shaken at its resonance."""
    wall = vi.RigidStop(e, 0.5 * clearance)
    assembly = vi.Assembly(
        masses={"host": 1.0, "ball": mass},
        links={"spring": vi.Link("ground", "host", vi.Isolator(1.0, 2.0 * zeta))},
        stops={"right": vi.Link("ball", "host", wall), "left": vi.Link("host", "ball", wall)},
        units="none",
    )
    force = vi.Harmonic(1.0, 1.0 / (2.0 * math.pi), of="force", on="host")
    return vi.Rig(assembly, force)


def test_an_impact_damper_is_that_of_its_formula() -> None:
    """Two impacts a period, each half a period after the other one: in closed form."""
    zeta, mu, e, d = 0.01, 0.05, 0.75, 30.0
    h, omega = math.pi, math.sqrt(1.0 - zeta**2)
    decay, turn = math.exp(-zeta * h), omega * h
    q = 1.0 + 2.0 * decay * math.cos(turn) + decay**2
    g0 = -decay * math.sin(turn) / (omega * q)
    g1 = (1.0 + decay * math.cos(turn) + zeta / omega * decay * math.sin(turn)) / q
    size = 1.0 / (2.0 * zeta)
    a = math.pi / 2.0 - 2.0 * mu * g0
    b = (1.0 - e * (1.0 + 2.0 * mu)) / (1.0 + e) + 2.0 * mu * g1
    # (a V − d/2)² + (b V)² = X²
    p = a * a + b * b
    speed = (a * d / 2 + math.sqrt((a * d / 2) ** 2 - p * (d * d / 4 - size**2))) / p
    assert speed == pytest.approx(14.78340654, rel=1e-9)
    orbit = vi.orbit(damper(zeta=zeta, mass=mu, e=e, clearance=d))
    assert orbit.attrs["contacts"].split() in (["left", "right"], ["right", "left"])
    assert int(orbit["stable"]) == 1
    right = orbit["event_stop"].values == "right"
    at = orbit.isel(event=np.flatnonzero(right)[0])
    host = (a * speed - d / 2) + 2.0 * mu * speed * g0
    assert float(at["event_displacement"].sel(mass="host")) == pytest.approx(host, rel=1e-11)
    assert float(at["event_displacement"].sel(mass="ball")) == pytest.approx(
        host + d / 2, rel=1e-11
    )
    assert float(at["event_velocity"].sel(mass="ball")) == pytest.approx(speed, rel=1e-11)


def test_a_pair_of_multipliers_leaves_the_unit_circle() -> None:
    """Beyond Neimark–Sacker the motion beside the orbit spirals away from it, as told."""
    rig = damper(zeta=0.01, mass=0.05, e=0.75, clearance=30.0)
    branch = vi.branch(rig, vary={"frequency": (0.157, 0.182)})
    kinds = branch["bifurcation_kind"].values
    assert "Neimark-Sacker" in kinds
    place = list(kinds).index("Neimark-Sacker")
    critical = branch.isel(bifurcation=place)
    pair = (
        critical["bifurcation_multiplier_real"] + 1j * critical["bifurcation_multiplier_imag"]
    ).values
    pair = pair[np.abs(np.abs(pair) - 1.0) < 1e-7]
    assert len(pair) == 2
    assert abs(pair[0] - pair[1].conj()) < 1e-9
    assert abs(pair[0].imag) > 1e-3
    value = float(critical["bifurcation_value"])
    start = critical["bifurcation_section"]
    for frequency, stable in ((0.998 * value, 1), (1.002 * value, 0)):
        assert int(vi.orbit(rig, start, 1, frequency=frequency)["stable"]) == stable


def test_a_motion_that_does_not_settle_is_judged_by_its_exponents() -> None:
    """The growth of two motions side by side is that of the first exponent."""
    rig = damper(zeta=0.05, mass=0.1, e=0.6, clearance=8.0)
    motion = vi.steady(rig, samples=4, max_cycles=400, window=20, exponent_cycles=1500)
    assert str(motion["motion"].values) == "chaotic"
    largest, spread = float(motion["exponents"][0]), float(motion["exponents_uncertainty"][0])
    assert largest > 0.0
    start = motion["initial_state"]
    grown, apart = 0.0, 1e-9
    other = start.copy()
    other[list(start["component"].values).index("velocity.host")] += apart
    cycles = 400
    for _ in range(cycles):
        first, second = (
            vi.simulate(rig, 1, one, samples=0)["final_state"] for one in (start, other)
        )
        away = (second - first).values[:4]
        size = float(np.linalg.norm(away))
        grown += math.log(size / apart)
        start, other = first, first.copy()
        other[:4] = first.values[:4] + away * (apart / size)
    rate = grown / cycles * rig.periodic.frequency
    assert rate == pytest.approx(largest, abs=0.25 * largest + 4.0 * spread)


def test_masses_without_stops_have_one_orbit() -> None:
    for masses in (1, 3):
        chain = vi.chain([2.0] * masses, [300.0] * masses, damping_ratio=0.03)
        rig = vi.Rig(chain, vi.Harmonic("0.5 m/s2", 0.9))
        branch = vi.branch(rig, vary={"frequency": (0.5, 2.0)})
        assert branch.sizes["stop"] == 0
        assert branch.sizes["bifurcation"] == 0
        m, c, k = chain.mass_matrix, chain.damping_matrix, chain.stiffness_matrix
        w = 2.0 * np.pi * 0.9
        u = np.linalg.solve(k - w**2 * m + 1j * w * c, -0.5 * m @ np.ones(masses))
        for motion in (vi.orbit(rig), vi.steady(rig), vi.sweep(rig, [0.9], "forward")):
            values = motion["displacement_max"].values.reshape(masses)
            np.testing.assert_allclose(values, abs(u), rtol=1e-12)


def test_a_path_that_breaks_the_symmetry_is_not_symmetric_at_any_value() -> None:
    rig = alone(STOPS["bumpers"], assembled=True)
    even = family(rig, "gap")
    assert even.straight
    assert even.symmetric
    for path in ("stops.right.gap", "forces.m", "stops.left.stiffness"):
        made = family(rig, path)
        assert made.straight, path
        assert not made.symmetric
        assert not made.near(made.value).symmetric
        # The vector of the engine is that of the rig, but for its mirror image.
        vector, known = made.system(made.value), system_vector(rig)
        assert (vector != known).sum() <= 3
