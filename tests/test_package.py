"""The package as a whole: version, imports, public names, layers, pins."""

from __future__ import annotations

import ast
import importlib
import inspect
import re
import subprocess
import sys
import tomllib
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import distribution
import vibroimpact as vi

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def test_one_version():
    assert vi.__version__ == version("vibroimpact")
    assert re.fullmatch(r"\d+\.\d+\.\d+(\.dev\d+)?", vi.__version__)
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert "## [Unreleased]" in changes or f"## [{vi.__version__}]" in changes


@pytest.mark.parametrize(
    ("code", "heavy"),
    [
        pytest.param(
            "import vibroimpact",
            {"numpy", "numba", "xarray", "pydantic", "pint", "matplotlib", "h5py", "rich"},
            id="import",
        ),
        pytest.param(
            "import vibroimpact as vi; vi.laboratory.case('B2-G1-A3')",
            {"numba", "xarray", "pint", "matplotlib"},
            id="describing a rig needs no compiler",
        ),
        pytest.param(
            "import vibroimpact as vi; [getattr(vi, name) for name in vi.__all__]",
            {"matplotlib", "rich", "jinja2", "websockets"},
            id="names load nothing that draws or prints",
        ),
    ],
)
def test_import_is_light(code, heavy):
    code = f"{code}\nimport sys; print(*sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_what_tries_a_wheel_exists():
    for name in (*distribution.QUICK, *distribution.SHIPPED):
        file, _, function = name.partition("::")
        assert (ROOT / file).exists(), name
        assert not function or f"def {function}(" in (ROOT / file).read_text(encoding="utf-8"), name


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("Isolator", "stiffness damping"),
        ("Bumper", "stiffness damping gap"),
        ("Oscillator", "mass isolator right left"),
        ("Harmonic", "amplitude frequency phase"),
        ("State", "displacement velocity deformation"),
        ("from_dimensionless", "stiffness_ratio gap relaxation_time damping_ratio"),
        ("laboratory.case", "code parameters"),
        ("simulate", "rig cycles start samples"),
        ("sweep", "rig frequencies directions"),
    ],
)
def test_names_and_arguments_that_users_rely_on(name, arguments):
    thing = vi
    for part in name.split("."):
        thing = getattr(thing, part)
    taken = list(inspect.signature(thing).parameters)
    assert taken[: len(arguments.split())] == arguments.split()


def test_public_names_are_documented():
    for name in vi.__all__:
        thing = getattr(vi, name)
        assert name in dir(vi)
        if name != "__version__":
            assert inspect.getdoc(thing), name
    with pytest.raises(AttributeError, match="vibroimpact attribute nothing"):
        _ = vi.nothing


def test_a_module_says_what_it_is():
    for path in SOURCES:
        assert ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))), path


def test_all_modules_import():
    for path in SOURCES:
        parts = path.relative_to(ROOT / "src").with_suffix("").parts
        importlib.import_module(".".join(parts).removesuffix(".__init__"))


def test_layers():
    """A layer imports only what stands below it: the contracts in pyproject.toml hold."""
    program = Path(sys.executable).with_name("lint-imports")
    done = subprocess.run(
        [program, "--no-cache", "--no-logo"], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert " 0 broken" in done.stdout


def test_pins_are_plain_and_cover_all_that_is_installed():
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pinned = {}
    for line in lines:
        match = re.fullmatch(r"([A-Za-z0-9._-]+)==([A-Za-z0-9.!+_-]+)", line)
        assert match, f"{line!r} is no plain name==version"
        pinned[canonicalize_name(match[1])] = match[2]
    assert len(pinned) == len(lines)

    extras = PROJECT["project"]["optional-dependencies"]
    declared = [
        *PROJECT["project"]["dependencies"],
        *(requirement for extra in extras.values() for requirement in extra),
        *PROJECT["build-system"]["requires"],
    ]
    todo = [Requirement(text) for text in declared]
    seen = set()
    while todo:
        requirement = todo.pop()
        name = canonicalize_name(requirement.name)
        if (name, *requirement.extras) not in seen:
            seen.add((name, *requirement.extras))
            assert name in pinned, f"{name} is not in constraints.txt; make pins renews it"
            assert requirement.specifier.contains(pinned[name], prereleases=True), requirement
            try:
                below = [Requirement(text) for text in requires(name) or []]
            except PackageNotFoundError:  # of an extra that is not installed here
                continue
            todo += [
                r
                for r in below
                if not r.marker
                or any(r.marker.evaluate({"extra": e}) for e in (requirement.extras or {""}))
            ]
