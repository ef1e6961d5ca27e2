"""What an assembly accepts, and one clear line for everything else."""

import copy
import pickle
import re

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.errors import InputError
from vibroimpact.model import equilibrium
from vibroimpact.model.assembly import numbers

GROUND = "ground"
MASSES = {"base": "300 t", "roof": "250 t"}
LINKS = {
    "isolator": vi.Link(GROUND, "base", vi.Isolator("5 MN/m", "0.2 MN s/m")),
    "storey": vi.Link("base", "roof", vi.Isolator("200 MN/m", "1 MN s/m")),
}
BUMPER = vi.Bumper("60 MN/m", "0.9 MN s/m", "10 cm")
STOPS = {"moat": vi.Link("base", GROUND, BUMPER)}


def building(**changes):
    return vi.Assembly(**{"masses": MASSES, "links": LINKS, "stops": STOPS, **changes})


def linked(name="storey", **table):
    return {**LINKS, name: {"left": "base", "right": "roof", **table}}


def stopped(**table):
    return {"moat": {"left": "base", "right": GROUND, **table}}


BAD = {
    "no masses": (lambda: vi.Assembly({}), r"^masses: missing; pass a mapping"),
    "a list": (lambda: vi.Assembly([1.0]), r"^masses: \[1\.0\] is not a mapping from names"),
    "zero": (lambda: building(masses={"base": 0, "roof": 1}), r"^masses\.base: 0 is not greater"),
    "unit": (lambda: building(masses={"base": "3 m", "roof": 1}), r"^masses\.base: '3 m' is a len"),
    "blank in a name": (
        lambda: building(masses={"the base": 1.0}),
        r"^masses: 'the base' is not an identifier; use a name such as 'roof'",
    ),
    "point in a name": (lambda: building(masses={"a.b": 1.0}), r"^masses: 'a\.b' is not an ident"),
    "number as a name": (lambda: building(masses={1: 1.0}), r"^masses: 1 is not an identifier"),
    "ground": (lambda: building(masses={GROUND: 1.0}), r"^masses: 'ground' is reserved for the"),
    "ground as a stop": (
        lambda: building(stops={GROUND: STOPS["moat"]}),
        r"^stops: 'ground' is re",
    ),
    "nearest": (
        lambda: building(stops={"moat": vi.Link("bse", GROUND, BUMPER)}),
        r"^stops\.moat\.left: 'bse' is not a mass; did you mean base\? Use base, roof or gr",
    ),
    "nothing near": (
        lambda: building(links={"x": vi.Link(GROUND, "tower", vi.Isolator(1.0, 0.0))}),
        r"^links\.x\.right: 'tower' is not a mass; use base, roof or ground",
    ),
    "loose": (
        lambda: building(masses={**MASSES, "ball": 1.0}),
        r"^masses\.ball: no spring, friction or stop holds this mass; add a link or a stop",
    ),
    "dashpot alone": (
        lambda: vi.Assembly({"a": 1.0}, {"d": vi.Link(GROUND, "a", vi.Isolator(0.0, 1.0))}),
        r"^masses\.a: no spring, friction or stop holds",
    ),
    "same body": (lambda: vi.Link("a", "a", BUMPER), r"^right: 'a' is also the left body"),
    "no law": (lambda: vi.Link("a", "b", 3.0), r"^law: 3\.0 is not a law; pass an isolator"),
    "stop as a link": (
        lambda: building(links={**LINKS, "pad": vi.Link("base", "roof", BUMPER)}),
        r"^links\.pad: Bumper is the law of a stop; move it to stops",
    ),
    "link as a stop": (
        lambda: building(stops=LINKS),
        r"^stops\.isolator: Isolator is the law of a link; move it to links",
    ),
    "law alone": (
        lambda: building(stops={"moat": BUMPER}),
        r"^stops\.moat: Bumper\(.*\) is not a stop; pass a Link, such as Link\(\"ground\"",
    ),
    "no end": (
        lambda: building(links={"x": {"left": GROUND, "stiffness": 1, "damping": 0}}),
        r"^links\.x\.right: missing; add the name of a mass",
    ),
    "misspelt end": (
        lambda: building(links={"x": {"lft": GROUND, "right": "base", "stiffness": 1}}),
        r"^links\.x\.lft: unknown key; did you mean left\?$",
    ),
    "a matrix for masses": (
        lambda: vi.Assembly.model_validate({"mass": [[1.0]], "stiffness": [[1.0]]}),
        r"^mass: unknown key; write masses by name as masses, or matrices as matrices\.mass, "
        r"matrices\.stiffness and matrices\.damping$",
    ),
    "unit in a link": (
        lambda: building(links=linked(stiffness="5 kg", damping=0)),
        r"^links\.storey\.stiffness: '5 kg' is a mass; use a stiffness",
    ),
    "missing in a link": (
        lambda: building(links=linked(stiffness=5)),
        r"^links\.storey\.damping: missing; add a damping",
    ),
    "unknown key": (
        lambda: building(links=linked(stifness=5, damping=0)),
        r"^links\.storey\.stifness: unknown key; did you mean stiffness\? Use stiffness, ",
    ),
    "unknown law": (
        lambda: building(stops=stopped(kind="soft", gap=1)),
        r"^stops\.moat\.kind: 'soft' is unknown; use 'kelvin-voigt', 'rigid'",
    ),
    "period": (
        lambda: building(links=linked(period="2 s", damping_ratio=0.1)),
        r"^links\.storey\.period: needs the mass that this link carries, which is not known "
        r"between two masses; state the mass as carries, or write the fields of the law",
    ),
    "period of no mass": (
        lambda: building(links={"x": {"left": GROUND, "right": "bas", "period": 1}}),
        r"^links\.x\.right: 'bas' is not a mass; did you mean base\?",
    ),
    "share of a mass": (
        lambda: building(
            links={
                **LINKS,
                "x": {
                    "left": GROUND,
                    "right": "roof",
                    "kind": "bilinear",
                    "strength": "5 kN",
                    "yield_displacement": "1 cm",
                    "post_yield_period": 1,
                },
            }
        ),
        r"^links\.x\.post_yield_period: needs the mass that this link carries, of which "
        r"links\.isolator carries an unknown share; state",
    ),
    "carries what nothing needs": (
        lambda: building(links=linked(stiffness=1, damping=0, carries="5 t")),
        r"^links\.storey\.carries: '5 t', but no other key of this link needs the mass; remove it",
    ),
    "carries a length": (
        lambda: building(links=linked(period=1, damping_ratio=0, carries="5 m")),
        r"^links\.storey\.carries: '5 m' is a length",
    ),
    "no damping ratio": (
        lambda: building(links={"x": {"left": GROUND, "right": "base", "period": 1}}),
        r"^links\.x\.damping_ratio: missing, but period requires it",
    ),
    "period and stiffness": (
        lambda: building(
            links={"x": {"left": GROUND, "right": "base", "stiffness": 1, "damping_ratio": 0.1}}
        ),
        r"^links\.x\.damping_ratio: given together with stiffness",
    ),
    "restitution twice": (
        lambda: building(stops=stopped(stiffness=1, damping=1, restitution=0.5, gap=1)),
        r"^stops\.moat\.restitution: this bumper also has a damping",
    ),
    "restitution of no mass": (
        lambda: building(
            stops={
                "a": {"left": "bas", "right": "roof", "stiffness": 1, "restitution": 1, "gap": 0}
            }
        ),
        r"^stops\.a\.restitution: 'bas' is not a mass; did you mean base\?",
    ),
    "force": (
        lambda: building(forces={"rof": 1}),
        r"^forces: 'rof' is not a mass; did you mean r",
    ),
    "unit of a force": (
        lambda: building(forces={"roof": "1 kg"}),
        r"^forces\.roof: '1 kg' is a ma",
    ),
    "no room": (
        lambda: building(
            stops={
                "r": vi.Link("base", GROUND, vi.RigidStop(0.5, "1 cm")),
                "l": vi.Link(GROUND, "base", vi.RigidStop(0.5, "-2 cm")),
            }
        ),
        r"^stops\.r\.gap: 10 mm and stops\.l\.gap: -20 mm leave no room between rigid stops",
    ),
    "no room at all": (
        lambda: building(
            stops={
                "a": vi.Link(GROUND, "base", vi.RigidStop(0.5, 0.0)),
                "b": vi.Link("base", "roof", vi.RigidStop(0.5, 0.0)),
                "c": vi.Link("roof", GROUND, vi.RigidStop(0.5, 0.0)),
                "d": vi.Link("roof", GROUND, BUMPER),
            }
        ),
        r"^stops\.a\.gap: 0 m, stops\.b\.gap: 0 m and stops\.c\.gap: 0 m leave no room",
    ),
    "modal ratios": (
        lambda: building(damping=vi.ModalDamping([0.01, 0.02, 0.03])),
        r"^damping\.ratio: 3 ratios for 2 modes",
    ),
    "negative ratio": (lambda: vi.ModalDamping(-0.1), r"^ratio: -0\.1 is less than 0"),
    "rayleigh": (lambda: vi.RayleighDamping("2 m"), r"^mass_factor: '2 m' is a length"),
    "unknown argument": (lambda: vi.Assembly(MASSES, stop={}), r"^stop: unknown key; .*stops\?"),
    "units": (
        lambda: building(units="none"),
        r"^masses\.base: '300 t' has a unit, but units is \"none\"",
    ),
    "immutable": (lambda: setattr(building(), "masses", {}), r"^masses: Assembly is immutable"),
    "chain": (lambda: vi.chain([1, 2], [1]), r"^stiffnesses: 1 for 2 masses; pass one stiffness"),
    "chain of no spring": (
        lambda: vi.chain([1], [0]),
        r"^stiffnesses\[0\]: 0 is not greater than 0",
    ),
    "chain of no list": (lambda: vi.chain(1, [1]), r"^masses: 1 is not a list"),
    "chain damping": (lambda: vi.chain([1], [1], -1), r"^damping_ratio: -1 is less than 0"),
    "chain rule": (
        lambda: vi.chain([1], [1], damping="x"),
        r"^damping: 'x' is unknown; use modal or rayleigh",
    ),
    "chain modes": (
        lambda: vi.chain([1], [1], damping="rayleigh", rayleigh_modes=(1, 2)),
        r"^rayleigh_modes: 2 is not a mode; use numbers from 1 to 1",
    ),
    "force on nothing": (
        lambda: vi.Rig(building(), vi.Harmonic("5 kN", 2, on="attic")),
        r"^shaking\.on: 'attic' is not a mass; use base or roof",
    ),
    "force on which": (
        lambda: vi.Rig(building(), "5 kN"),
        r"^shaking: 5 kN acts on one of 2 masses; state which, such as on = \"roof\"",
    ),
    "base motion on a mass": (
        lambda: vi.Harmonic("0.05 g", 2, on="roof"),
        r"^on: 'roof', but the acceleration of the base acts on all masses",
    ),
    "on of an oscillator": (
        lambda: vi.Rig(vi.Oscillator(2, vi.Isolator(3, 0)), vi.Harmonic("5 N", 2, on="roof")),
        r"^shaking\.on: 'roof', but an Oscillator has only one mass; remove on",
    ),
    "jankowski of an oscillator": (
        lambda: vi.Oscillator(2, vi.Isolator(3, 0), vi.JankowskiBumper(1, 0.1, 0.6)),
        r"^right\.mass: missing; pass the mass that hits this stop",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_line(case):
    make, message = BAD[case]
    with pytest.raises(InputError, match=message) as caught:
        make()
    text = str(caught.value)
    assert "\n" not in text
    assert len(text) <= 330


def test_a_formula_is_replaced_by_the_built_in_law():
    link = vi.Link("a", "b", vi.Law("k*u + c*v", k=3.0, c=1.0))
    assert link.law == vi.Isolator(3.0, 1.0)
    assert not link.is_stop
    stop = vi.Link("a", "b", vi.Law("max(k*d + c*v, 0)", 0.1, k=3.0, c=1.0))
    assert stop.is_stop


def test_equal_assemblies_are_equal_and_keep_their_order():
    one, two = building(), building()
    _ = one.natural_frequencies  # which is kept
    assert one == two
    assert hash(one) == hash(two)
    assert one == copy.deepcopy(one) == pickle.loads(pickle.dumps(one)) == one.replace()
    assert one != building(masses=dict(reversed(MASSES.items())))
    assert building(masses=dict(reversed(MASSES.items()))).names == ("roof", "base")


def test_repr_makes_an_equal_assembly():
    one = building(forces={"roof": "5 kN"}, damping=vi.RayleighDamping(0.1, 0.002))
    names = {
        name: getattr(vi, name)
        for name in ("Assembly", "Link", "Isolator", "Bumper", "ModalDamping")
    }
    assert eval(repr(one), {**names, "RayleighDamping": vi.RayleighDamping}) == one
    assert vi.Assembly.model_validate(one.model_dump()) == one


def test_a_table_of_a_bumper_may_have_the_restitution_of_the_mass_that_meets():
    stop = {"left": "base", "right": "roof", "stiffness": "1 MN/m", "restitution": 0.6, "gap": 0.1}
    wall = {**stop, "right": GROUND}
    assembly = building(stops={"pad": stop, "moat": wall})
    reduced = 300e3 * 250e3 / 550e3
    expected = vi.Bumper.from_restitution(reduced, "1 MN/m", 0.6, 0.1)
    assert assembly.stops["pad"].law.damping == pytest.approx(expected.damping, rel=1e-14)
    expected = vi.Bumper.from_restitution(300e3, "1 MN/m", 0.6, 0.1)
    assert assembly.stops["moat"].law.damping == pytest.approx(expected.damping, rel=1e-14)


def test_jankowski_has_the_mass_of_the_two_bodies_unless_it_is_passed():
    law = vi.JankowskiBumper("2 GN/m^1.5", "5 cm", 0.6)
    stops = {
        "pad": vi.Link("base", "roof", law),
        "wall": vi.Link(GROUND, "roof", law),
        "own": vi.Link("base", GROUND, law.replace(mass="7 t")),
    }
    masses = {stop.name: stop.law.mass for stop in numbers(building(stops=stops)).stops}
    assert masses == pytest.approx(
        {"pad": 300e3 * 250e3 / 550e3, "wall": 250e3, "own": 7e3}, rel=1e-14
    )
    heavier = building(masses={"base": "300 t", "roof": "500 t"}, stops=stops)
    assert numbers(heavier).stops[1].law.mass == pytest.approx(500e3)


def test_numbers_have_indices_and_signs():
    links = {**LINKS, "brace": vi.Link("roof", "base", vi.PolynomialIsolator(1e6, 0.0, 2e6))}
    system = numbers(building(links=links, forces={"roof": "5 kN"}, damping=vi.ModalDamping(0.02)))
    assert system.names == ("base", "roof")
    np.testing.assert_array_equal(system.stiffness, [[205e6, -200e6], [-200e6, 200e6]])
    np.testing.assert_array_equal(system.force, [0.0, 5e3])
    np.testing.assert_array_equal(system.influence, [1.0, 1.0])
    np.testing.assert_array_equal(system.mass, np.diag([300e3, 250e3]))
    # Modal damping is added to the dashpots.
    assert (np.linalg.eigvalsh(system.damping - [[1.2e6, -1e6], [-1e6, 1e6]]) > 0.0).all()
    (brace,) = system.links
    assert (brace.name, brace.left, brace.right, brace.law.kind) == ("brace", 1, 0, "polynomial")
    assert brace.law.cubic == 2e6
    assert np.isnan(brace.gap)
    (moat,) = system.stops
    assert (moat.left, moat.right, moat.gap, moat.law.kind) == (0, -1, 0.1, "kelvin-voigt")
    assert (moat.law.stiffness, moat.law.damping) == (60e6, 0.9e6)


def test_a_force_on_the_only_mass_needs_no_name():
    one = vi.chain([2.0], [3.0])
    assert vi.Rig(one, "5 N").shaking.on == "floor_1"
    assert vi.Rig(one, vi.Harmonic("5 N", 2.0)).harmonic.on == "floor_1"


def test_a_rig_keeps_its_system():
    rig = vi.Rig(building(), "0.05 g")
    assert rig.system == building()
    assert rig.at("2 Hz").system is rig.system
    assert rig.at("2 Hz").frequency == 2.0
    free = rig.vibrating_freely()
    assert free.frequency == pytest.approx(building().natural_frequencies[0])
    with pytest.raises(InputError, match="an Assembly of several masses is not accepted"):
        _ = rig.oscillator


REFUSED = {
    "classify_scenario": vi.classify_scenario,
    "basin_stability": lambda rig: vi.basin_stability(rig, (-1, 1), (-1, 1)),
    "manifolds": lambda rig: vi.manifolds(rig, None),
    "resonance_diagram": lambda rig: vi.resonance_diagram(rig, vary={"frequency": (1.0, 2.0)}),
    "to_dimensionless": vi.to_dimensionless,
    "explore": vi.explore,
}


@pytest.mark.parametrize("name", REFUSED)
@pytest.mark.parametrize(
    "make", [lambda: vi.Rig(building(), "0.05 g"), building], ids=["rig", "alone"]
)
def test_functions_of_one_mass_refuse_an_assembly(name, make):
    with pytest.raises(
        InputError, match=r"an Assembly of several masses is not accepted"
    ) as caught:
        REFUSED[name](make())
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "ends", [{"left": GROUND, "right": "base"}, {"left": "base", "right": GROUND}]
)
def test_a_link_to_the_ground_has_the_period_of_its_mass(ends):
    made = vi.Assembly(
        {"base": "300 t", "roof": "250 t"},
        {
            "feet": {**ends, "period": "0.4 s", "damping_ratio": 0.05},
            "lead": {
                "left": GROUND,
                "right": "roof",
                "kind": "bilinear",
                "strength": 0.05,
                "yield_displacement": "10 mm",
                "post_yield_period": "2.5 s",
            },
        },
    )
    law = vi.Isolator.from_period("300 t", period="0.4 s", damping_ratio=0.05)
    assert made.links["feet"].law == law
    assert made.links["lead"].law == vi.BilinearIsolator.from_strength(
        "250 t", strength=0.05, yield_displacement="10 mm", post_yield_period="2.5 s"
    )
    assert made.natural_frequencies[-1] == pytest.approx(2.5)


FRAME = {"base": "300 t", "first": "250 t", "second": "250 t", "roof": "200 t"}
STOREYS = {
    f"storey_{i}": vi.Link(*ends, vi.Isolator("150 MN/m", 0.0))
    for i, ends in enumerate((("base", "first"), ("second", "first"), ("second", "roof")))
}
PENDULUM = {"kind": "friction", "radius": "1.5 m", "coefficient": 0.05}
LEAD = {
    "kind": "bilinear",
    "strength": "500 kN",
    "yield_displacement": "1 cm",
    "post_yield_period": "2.5 s",
}


@pytest.mark.parametrize("ends", [(GROUND, "base"), ("base", GROUND)])
@pytest.mark.parametrize("order", [1, -1])
def test_an_isolator_carries_all_that_stands_on_it(ends, order):
    """The isolator of a frame, by a radius or a period, is that of the whole mass."""
    left, right = ends

    def frame(**table):
        links = {**STOREYS, "isolator": {"left": left, "right": right, **table}}
        return vi.Assembly(FRAME, dict(list(links.items())[::order]))

    assumption = (
        "the mass that this link carries is assumed to be 1000 t, that of 'base', 'first', 'sec"
    )
    with pytest.warns(vi.InputWarning, match=rf"^links\.isolator\.radius: {assumption}"):
        made = frame(**PENDULUM)
    law = made.links["isolator"].law
    assert law == vi.FrictionIsolator.from_pendulum("1000 t", "1.5 m", 0.05)
    assert (law.stiffness, law.friction) == pytest.approx((6537.77e3, 490.33e3), rel=1e-5)
    with pytest.warns(vi.InputWarning, match=rf"^links\.isolator\.post_yield_period: {assumption}"):
        made = frame(**LEAD)
    values = {key: value for key, value in LEAD.items() if key != "kind"}
    assert made.links["isolator"].law == vi.BilinearIsolator.from_strength("1000 t", **values)
    with pytest.warns(vi.InputWarning, match=rf"^links\.isolator\.strength: {assumption}"):
        made = frame(**{**LEAD, "strength": 0.05})
    assert made.links["isolator"].law == vi.BilinearIsolator.from_strength(
        "1000 t", **{**values, "strength": 0.05}
    )
    # Dimensionless numbers are written without units.
    with pytest.warns(vi.InputWarning, match=r"assumed to be 3, that of 'a' and 'b'"):
        vi.Assembly(
            {"a": 1.0, "b": 2.0},
            {
                "k": {"left": GROUND, "right": "a", "period": 1.0, "damping_ratio": 0.0},
                "s": vi.Link("b", "a", vi.Isolator(1.0, 0.0)),
            },
            units="none",
        )


def test_an_assumed_mass_is_in_the_notes_of_results():
    """Of all rigs, of results of results, and in other processes; not of a law that replaces it."""
    ends = {"left": GROUND, "right": "base"}
    links = {**STOREYS, "isolator": {**ends, "period": "2 s", "damping_ratio": 0.1}}
    with pytest.warns(vi.InputWarning):
        made = vi.Assembly(FRAME, links)
    assumption = (
        "links.isolator.period: the mass that this link carries is assumed to be 1000 t, that of "
        "'base', 'first', 'second' and 'roof'"
    )
    assert made.assumptions == (assumption,)
    assert pickle.loads(pickle.dumps(made)).assumptions == (assumption,)
    rig = vi.Rig(made, vi.Harmonic("0.5 g", "0.6 Hz"))
    motion = vi.simulate(rig, 2, samples=8)
    record = vi.Record([0.0, 1.0, 0.0], 0.1)
    for data in (
        motion,
        vi.totals(motion),
        vi.modes(made.replace(forces={"roof": 1.0})),
        vi.sweep(rig, [0.5], max_cycles=2, window=1),
        vi.seismic_response(vi.Rig(made, record)),
        vi.demands({"a": made}, {"r": record}),
    ):
        assert data.attrs["notes"].splitlines().count(assumption) == 1, data.attrs["created_by"]
    plain = made.replace(links={**made.links, "isolator": made.links["isolator"].replace()})
    assert plain == made
    assert hash(plain) == hash(made)
    assert plain.assumptions == ()


def test_the_mass_that_a_link_carries_can_be_stated():
    """Where several isolators share a load, between two masses, with matrices, and of one base."""
    half = {"left": GROUND, "right": "base", **PENDULUM, "carries": "500 t"}
    made = vi.Assembly(FRAME, {**STOREYS, "a": half, "b": half})
    assert made.stiffness_matrix[0, 0] == pytest.approx(150e6 + 1e6 * 9.80665 / 1.5)
    storey = linked(period="2 s", damping_ratio=0.1, carries="250 t")
    law = vi.Isolator.from_period("250 t", "2 s", 0.1)
    assert building(links=storey).links["storey"].law == law
    made = vi.Assembly.from_matrices(
        [[2.0]], None, [[1.0]], links={"a": {**half, "right": "dof_1"}}
    )
    assert made.links["a"].law == vi.FrictionIsolator.from_pendulum("500 t", "1.5 m", 0.05)
    assert type(made)(**made.model_dump()) == made
    with pytest.raises(
        InputError, match=r"^links\.a\.radius: .* is not known from matrices; state"
    ):
        vi.Assembly.from_matrices(
            [[2.0]], None, [[1.0]], links={"a": {"left": GROUND, "right": "dof_1", **PENDULUM}}
        )


def test_states_are_by_name():
    state = vi.State({"base": "1 cm"}, {"roof": 0.1}, deformation={"moat": "2 mm"})
    assert state.displacement == {"base": 0.01}
    assert state.velocity == {"roof": 0.1}
    assert state.deformation == {"moat": 0.002}
    state.check_names(building())
    assert eval(repr(state), {"AssemblyState": type(state)}) == state
    assert pickle.loads(pickle.dumps(state)) == state


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: vi.State({"base": 0.1}, isolator=0.1),
            r"^isolator: passed together with displacement by name.*use memory",
        ),
        (lambda: vi.State({"base": "1 kg"}), r"^displacement\.base: '1 kg' is a mass"),
        (lambda: vi.State({"a": 0.1}, 2.0), r"^velocity: 2\.0 is not a mapping from names"),
        (lambda: vi.State(deformation={"moat": -0.1}), r"^deformation\.moat: -0\.1 is less than 0"),
        (
            lambda: vi.State({"basse": 0.1}).check_names(building()),
            r"^start\.displacement: 'basse' is not a mass; did you mean base\?",
        ),
        (
            lambda: vi.State(deformation={"wall": 0.1}).check_names(building()),
            r"^start\.deformation: 'wall' is not a stop; use moat",
        ),
        (
            lambda: vi.State({"base": 0.2}).check_names(
                building(stops={"moat": vi.Link("base", GROUND, vi.RigidStop(0.5, "10 cm"))})
            ),
            r"^start\.displacement: base and ground overlap by 100 mm at the rigid stop 'moat'",
        ),
    ],
)
def test_a_state_that_does_not_fit_is_one_line(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_the_state_of_one_mass_is_as_it_was():
    assert type(vi.State(0.1, 0.2, {"right": 0.001})) is vi.State
    assert vi.State(displacement="1 mm").displacement == 0.001


def test_a_notebook_shows_a_picture():
    shown = vi.Rig(building(), "0.05 g")._repr_html_()
    assert shown.startswith("<svg ")
    assert "moat: gap 100 mm" in shown
    assert shown.count("<svg ") == 1
    assert "<table>" in shown
    html = building(units="none", masses={"base": 1, "roof": 2}, links=LINKS)._repr_html_()
    assert not re.search(r"\d (kg|mm|kN)", html)


def test_the_equilibrium_is_a_state():
    state = equilibrium(building(forces={"roof": "100 kN"}))
    assert state.displacement["base"] == pytest.approx(0.02)
    assert state.velocity == {}
