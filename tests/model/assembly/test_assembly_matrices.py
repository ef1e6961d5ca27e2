"""Matrices from elsewhere: arrays and files, and what is refused."""

import math

import numpy as np
import pytest
from scipy import sparse

import vibroimpact as vi
from vibroimpact.errors import InputError
from vibroimpact.model.assembly import numbers

M = [[2.0, 0.0], [0.0, 1.0]]
C = [[0.4, -0.1], [-0.1, 0.1]]
K = [[3.0, -1.0], [-1.0, 1.0]]


def make(mass=M, damping=C, stiffness=K, **others):
    return vi.Assembly.from_matrices(mass, damping, stiffness, **others)


def test_matrices_of_a_chain_are_that_chain():
    chain = vi.chain([3.0, 2.0], [50.0, 20.0], 0.03)
    stops = {"pad": vi.Link("lower", "upper", vi.Bumper(100.0, 1.0, 0.1))}
    same = make(
        chain.mass_matrix,
        chain.damping_matrix,
        chain.stiffness_matrix,
        names=["lower", "upper"],
        stops=stops,
        forces={"upper": 3.0},
    )
    np.testing.assert_allclose(same.natural_frequencies, chain.natural_frequencies, rtol=1e-14)
    np.testing.assert_allclose(same.damping_ratios, 0.03, rtol=1e-12)
    system = numbers(same)
    np.testing.assert_allclose(system.damping, chain.damping_matrix, rtol=1e-15)
    assert system.stops[0].left == 0
    # 1/(w M⁻¹ wᵀ) is the reduced mass.
    assert same.meeting_mass(stops["pad"]) == pytest.approx(6.0 / 5.0, rel=1e-15)
    assert vi.Assembly.model_validate(same.model_dump()) == same
    assert same.replace() == same


def test_names_and_influence_have_defaults():
    assembly = make()
    assert assembly.names == ("dof_1", "dof_2")
    np.testing.assert_array_equal(assembly.influence, [1.0, 1.0])
    np.testing.assert_array_equal(make(influence=[1.0, 0.0]).influence, [1.0, 0.0])
    np.testing.assert_array_equal(make(damping=None).damping_matrix, np.zeros((2, 2)))


def test_a_consistent_mass_matrix_of_a_rod():
    # Fixed-free rod of finite elements: ω = √(E/ρ) (2j−1) π/(2L), from above, with an error of h².
    count, h = 20, 1.0 / 20
    mass, stiffness = np.zeros((count + 1,) * 2), np.zeros((count + 1,) * 2)
    for i in range(count):
        both = np.ix_([i, i + 1], [i, i + 1])
        mass[both] += h / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiffness[both] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / h
    rod = make(sparse.csr_matrix(mass[1:, 1:]), None, sparse.csr_matrix(stiffness[1:, 1:]))
    omega = math.tau * rod.natural_frequencies[:3]
    exact = (2 * np.arange(1, 4) - 1) * math.pi / 2
    np.testing.assert_allclose(omega, exact * (1.0 + (exact * h) ** 2 / 24.0), rtol=1e-4)
    assert rod.effective_masses.sum() == pytest.approx(mass[1:, 1:].sum())


def test_a_rule_may_damp_matrices():
    assembly = make(damping=vi.ModalDamping(0.02))
    np.testing.assert_allclose(assembly.damping_ratios, 0.02, rtol=1e-13)


def test_links_are_added_to_matrices():
    links = {"brace": vi.Link("ground", "dof_2", vi.Isolator(5.0, 0.5))}
    assembly = make(links=links)
    np.testing.assert_array_equal(assembly.stiffness_matrix, [[3.0, -1.0], [-1.0, 6.0]])
    np.testing.assert_allclose(assembly.damping_matrix, [[0.4, -0.1], [-0.1, 0.6]])


@pytest.mark.parametrize("ending", ["npz", "npy", "csv", "txt"])
def test_files_give_the_same_assembly(tmp_path, ending):
    for name, matrix in {"m": M, "c": C, "k": K}.items():
        path = tmp_path / f"{name}.{ending}"
        if ending == "npz":
            np.savez(path, whatever=matrix)
        elif ending == "npy":
            np.save(path, matrix)
        else:
            separator = "," if ending == "csv" else " "
            np.savetxt(path, matrix, delimiter=separator, header="in SI units")
    files = [str(tmp_path / f"{name}.{ending}") for name in "mck"]
    assert make(*files) == make()


def test_one_npz_file_may_hold_all(tmp_path):
    path = tmp_path / "model.npz"
    names, iota = np.array(["lower", "upper"]), np.array([1.0, 0.5])
    np.savez(path, mass=M, damping=C, stiffness=K, names=names, influence=iota)
    expected = make(names=["lower", "upper"], influence=iota)
    assert vi.Assembly.from_matrices(path) == expected
    assert vi.Assembly.from_matrices("model.npz", folder=tmp_path) == expected
    assert make(path, None, None, names=["a", "b"]).names == ("a", "b")


def test_asymmetry_of_rounding_is_accepted():
    stiffness = make(stiffness=[[3.0, -1.0], [-1.0 + 1e-9, 1.0]]).stiffness_matrix
    np.testing.assert_array_equal(stiffness, stiffness.T)


BAD = {
    "not symmetric": (
        {"stiffness": [[3.0, -1.0], [-0.9, 1.0]]},
        r"^stiffness: not symmetric; row 1, column 2 is -1, but row 2, column 1 is -0\.9",
    ),
    "negative": (
        {"stiffness": [[3.0, 0.0], [0.0, -1.0]]},
        r"^stiffness: not positive semi-definite; row 2, column 2 is -1; pass the matrix of",
    ),
    "indefinite": (
        {"damping": [[1.0, 2.0], [2.0, 1.0]]},
        r"^damping: not positive semi-definite; an eigenvalue, scaled to a unit diagonal, is -1",
    ),
    "no mass": (
        {"mass": [[1.0, 0.0], [0.0, 0.0]]},
        r"^mass: not positive definite; .*row 2.*static condensation",
    ),
    "negative mass": ({"mass": [[1.0, 0.0], [0.0, -1.0]]}, r"^mass: not positive definite"),
    "another size": (
        {"stiffness": [[1.0]]},
        r"^stiffness: 1 rows, but the mass matrix has 2; pass matrices of one size",
    ),
    "not square": ({"mass": [[1.0, 0.0]]}, r"^mass: an array of the shape \(1, 2\); pass a square"),
    "no array": ({"mass": [[1.0], [1.0, 2.0]]}, r"^mass: .*is not an array of real numbers"),
    "complex": ({"stiffness": np.eye(2) * 1j}, r"^stiffness: .*is not an array of real numbers"),
    "texts": ({"mass": [["1 kg", "0"], ["0", "1"]]}, r"^mass: .*is not an array of real numbers"),
    "nan": ({"damping": [[np.nan, 0], [0, 1]]}, r"^damping: an entry is not finite"),
    "missing": ({"stiffness": None}, r"^stiffness: missing; pass the stiffness matrix"),
    "twice": ({"names": ["a", "a"]}, r"^names\[1\]: 'a' is used twice; use each name once"),
    "names": ({"names": ["a"]}, r"^names: 1 names for 2 degrees of freedom; pass 2"),
    "reserved": ({"names": ["a", "ground"]}, r"^names\[1\]: 'ground' is reserved for the base"),
    "influence": (
        {"influence": [1.0]},
        r"^influence: an array of the shape \(1,\); pass 2 numbers",
    ),
    "loose": (
        {"stiffness": [[3.0, 0.0], [0.0, 0.0]], "damping": None},
        r"^masses\.dof_2: no spring, friction or stop holds this mass",
    ),
    "stop": (
        {"stops": {"s": vi.Link("dof_1", "dof_3", vi.RigidStop(0.5, 1.0))}},
        r"^stops\.s\.right: 'dof_3' is not a mass; did you mean",
    ),
    "no file": ({"mass": "nowhere.csv"}, r"^mass: 'nowhere\.csv' cannot be read \(No such file"),
    "no npz": ({"mass": "nowhere.npz"}, r"^mass: 'nowhere\.npz' cannot be read"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_matrices_are_one_line(case):
    changes, message = BAD[case]
    with pytest.raises(InputError, match=message) as caught:
        make(**changes)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("2,0\n0,x\n", r"line 2: '0,x' is not a row of numbers"),
        ("2,0\n0\n", r"line 2: 1 numbers, but the first row has 2"),
        ("2,0;0,0\n", r"line 1: it has commas and semicolons; use a decimal point"),
        ("", r"^mass: an array of the shape \(0,\)"),
    ],
)
def test_a_bad_file_names_its_line(tmp_path, text, message):
    path = tmp_path / "m.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        make(path)


@pytest.mark.parametrize("ending", ["npz", "npy"])
def test_a_file_of_another_kind_is_refused(tmp_path, ending):
    path = tmp_path / f"m.{ending}"
    path.write_text("no array", encoding="utf-8")
    with pytest.raises(InputError, match=r"^mass: '.*' is not a file of numpy arrays"):
        make(path)


def test_an_npz_file_without_the_matrix_lists_its_arrays(tmp_path):
    path = tmp_path / "m.npz"
    np.savez(path, first=M, second=K)
    with pytest.raises(InputError, match=r"contains first, second; name the array 'mass'"):
        make(path)
