"""Study files of assemblies: what is written is read as the same rig."""

import re
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
import vibroimpact.cli
from vibroimpact.errors import InputError
from vibroimpact.model.study import read_rig_study, study_text

BUILDING = """
name = "two storeys"

[assembly.masses]
base = "300 t"
Roof-2 = "250 t"

[assembly.links]
isolator = { left = "ground", right = "base", kind = "bilinear", elastic_stiffness = "20 MN/m", post_yield_stiffness = "5 MN/m", yield_force = "200 kN", damping = "0.2 MN s/m" }

[assembly.links.storey]
left = "base"
right = "Roof-2"
stiffness = "200 MN/m"
damping = 0

[assembly.stops]
moat = { left = "base", right = "ground", stiffness = "60 MN/m", damping = 0, gap = "10 cm" }
pad = { left = "ground", right = "Roof-2", kind = "rigid", restitution = 0.6, gap = "20 cm" }

[assembly.forces]
Roof-2 = "5 kN"

[assembly.damping]
ratio = 0.02

[excitation]
amplitude = "5 kN"
phase = "90 deg"
on = "Roof-2"
"""  # noqa: E501


def read(tmp_path, text):
    path = tmp_path / "building.toml"
    path.write_text(text, encoding="utf-8")
    return read_rig_study(path)


def test_a_study_file_describes_an_assembly(tmp_path):
    rig = read(tmp_path, BUILDING)
    assert rig.name == "two storeys"
    assert rig.frequency is None
    assert rig.shaking.on == "Roof-2"
    assembly = rig.system
    assert assembly.names == ("base", "Roof-2")
    assert assembly.links["isolator"].law == vi.BilinearIsolator(20e6, 5e6, 200e3, 0.2e6)
    assert assembly.stops["pad"] == vi.Link("ground", "Roof-2", vi.RigidStop(0.6, 0.2))
    assert assembly.forces == {"Roof-2": 5e3}
    assert assembly.damping == vi.ModalDamping(0.02)


def test_a_study_that_is_written_is_read_as_the_same_rig(tmp_path):
    rig = read(tmp_path, BUILDING)
    again = read(tmp_path, study_text(rig))
    assert again == rig
    assert study_text(again) == study_text(rig)


@pytest.mark.parametrize(
    "rig",
    [
        vi.Rig(vi.chain([2.0, 1.0], [3.0, 4.0], 0.02, "rayleigh"), "0.05 g", name="a"),
        vi.Rig(
            vi.chain(
                [2.0, 1.0],
                [3.0, 4.0],
                [0.02, 0.1],
                stops={
                    "p": vi.Link("floor_1", "floor_2", vi.JankowskiBumper(5.0, 0.1, 0.6)),
                    "q": vi.Link("ground", "floor_1", vi.PowerBumper(5.0, 0.1, restitution=0.6)),
                    "r": vi.Link("floor_2", "ground", vi.Law("k*d + q*d**2", 0.1, k=3.0, q=1.0)),
                },
                units="none",
            ),
            0.5,
            name="b",
        ),
        vi.Rig(
            vi.Assembly.from_matrices(np.eye(2), None, [[2.0, -1.0], [-1.0, 1.0]], ["x", "y"]),
            vi.Periodic(1.0, ["5 N", "2 N"], on="y"),
            name="c",
        ),
        vi.Rig(vi.chain([2.0], [3.0]), name="d"),
        vi.Rig(vi.Oscillator(2.0, vi.Isolator(3.0, 0.1), vi.Bumper(3.0, 0.1, 0.2)), 0.5, name="e"),
    ],
    ids=lambda rig: rig.name,
)
def test_every_kind_of_rig_is_written_and_read(tmp_path, rig):
    again = read(tmp_path, study_text(rig))
    assert again.system == rig.system
    assert again.name == rig.name
    if rig.shaking is None:
        assert again.shaking is None
    else:
        assert again.shaking == rig.shaking.replace(frequency=1.0)


def test_matrices_may_be_files_beside_the_study(tmp_path):
    np.savetxt(tmp_path / "k.csv", [[3.0, -1.0], [-1.0, 1.0]], delimiter=",")
    np.savez(tmp_path / "m.npz", [[2.0, 0.0], [0.0, 1.0]])
    text = """
        [assembly.matrices]
        mass = "m.npz"
        stiffness = "k.csv"
        names = ["lower", "upper"]

        [assembly.stops.pad]
        left = "lower"
        right = "upper"
        kind = "rigid"
        restitution = 0.5
        gap = 0.1
    """
    assembly = read(tmp_path, text).system
    assert assembly.names == ("lower", "upper")
    np.testing.assert_array_equal(assembly.stiffness_matrix, [[3.0, -1.0], [-1.0, 1.0]])


def test_a_record_is_not_written():
    rig = vi.Rig(vi.chain([2.0], [3.0]), vi.Record([0.0, 1.0, 0.0], 0.1))
    with pytest.raises(InputError, match=r"^shaking: a record cannot be written"):
        study_text(rig)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'right = "base"',
            'right = "bse"',
            r"assembly\.links\.isolator\.right: 'bse' is not a mass",
        ),
        ('"250 t"', '"250 m"', r"assembly\.masses\.Roof-2: '250 m' is a length"),
        (', gap = "20 cm"', "", r"assembly\.stops\.pad\.gap: missing"),
        (
            'on = "Roof-2"',
            "",
            r"excitation: 5 kN acts on one of 2 masses; state which, such as on = \"Roof-2\"",
        ),
        ('on = "Roof-2"', 'on = "attic"', r"excitation\.on: 'attic' is not a mass"),
        ("[assembly.damping]", "[assembly.dmping]", r"assembly\.dmping: unknown key; .*damping\?"),
        ('name = "two storeys"', 'case = "B2-G1-A3"', r"both case and assembly are given"),
    ],
)
def test_an_error_names_the_file_and_the_path(tmp_path, old, new, message):
    assert old in BUILDING
    with pytest.raises(InputError, match=message) as caught:
        read(tmp_path, BUILDING.replace(old, new))
    assert str(caught.value).startswith("study '")
    assert "\n" not in str(caught.value)


def test_a_command_of_one_mass_refuses_it(tmp_path, capsys):
    from vibroimpact.cli import main

    path = tmp_path / "building.toml"
    path.write_text(BUILDING, encoding="utf-8")
    assert main(["classify", str(path)]) != 0
    text = capsys.readouterr().err
    assert "one mass, not an assembly of several masses" in text
    assert text.count("\n") == 1
    accepting = [
        path.stem
        for path in Path(vibroimpact.cli.__file__).parent.glob("*.py")
        if "masses=True)" in path.read_text(encoding="utf-8")
    ]
    listed = re.search(r"use vibroimpact (.*)", text)[1]
    assert sorted(re.split(", | or ", listed)) == sorted(accepting)
