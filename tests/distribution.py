"""The built wheel and sdist, as a user gets them; a script, for ``make dist``.

``python tests/distribution.py dist python3.11 python3.13``: their contents are the repository's
files and no others; then, with each interpreter, the wheel is installed into a fresh environment
in which nothing can be compiled, sweeps a rig, is type-checked from outside, and passes the
tests that take little time. Where the engine is machine code, numba is removed, and no cache can be
written.
"""

from __future__ import annotations

import os
import platform
import re
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIBRARIES = "vibroimpact/engine/libraries/"
QUICK = (
    "tests/test_package.py::test_names_and_arguments_that_users_rely_on",
    "tests/model",
    "tests/analytic/test_free_flight.py",
    "tests/cli/test_main.py",
    "tests/cli/test_cache.py",
    "tests/datasets/test_files.py::test_there_and_back",
)
# Make's constraints are a relative path; here they are named in full.
WITHHELD = ("PYTHON", "PIP_CONSTRAINT", "PIP_BUILD_CONSTRAINT")
SHIPPED = ("tests/engine/test_native.py::test_numba_is_not_imported",)
"""Without numba."""
NEEDED = ("pytest", "hypothesis", "mpmath", "pyyaml", "mypy")


def tracked(*under: str) -> set[str]:
    """Files of the repository."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", *under], cwd=ROOT, check=True, capture_output=True, text=True
    )
    return {name for name in listed.stdout.split("\0") if name}


def library_of(wheel: Path) -> set[str]:
    """Name of the only library of a wheel: none if it is for any platform."""
    tag = wheel.stem.rpartition("-")[2]
    machine = "aarch64-v8" if tag.endswith(("aarch64", "arm64")) else "x86_64-v3"
    known = {"manylinux": "linux-{}.so", "macosx": "darwin-{}.dylib", "win": "win32-{}.dll"}
    return {name.format(machine) for system, name in known.items() if tag.startswith(system)}


def check_contents(wheel: Path, sdist: Path) -> None:
    """Refuse a file too many or too few, and links that lead nowhere on an index."""
    inside = set(zipfile.ZipFile(wheel).namelist())
    code = {name.removeprefix("src/") for name in tracked("src") if LIBRARIES not in name}
    about = {name for name in inside if ".dist-info/" in name}
    libraries = {name.removeprefix(LIBRARIES) for name in inside if LIBRARIES in name}
    assert libraries == {"digest", "page.wasm", *library_of(wheel)}, (wheel.name, libraries)
    own = {name for name in inside - about if LIBRARIES not in name}
    assert own == code, own ^ code
    files = {name.partition(".dist-info/")[2] for name in about}
    assert files == {"METADATA", "RECORD", "WHEEL", "entry_points.txt", "licenses/LICENSE"}, files
    assert "-py3-none-" in wheel.name, wheel.name
    (metadata,) = (name for name in about if name.endswith("/METADATA"))
    description = zipfile.ZipFile(wheel).read(metadata).decode()
    dead = re.findall(r"\]\((?!https?:)[^)]*\)", description)
    assert "## In Python" in description
    assert not dead, dead
    with tarfile.open(sdist) as packed:
        names = {one.name.partition("/")[2] for one in packed.getmembers() if one.isfile()}
    assert names == tracked() | {"PKG-INFO"}, names ^ tracked()
    size = wheel.stat().st_size / 1e6
    print(f"{wheel.name}: {size:.1f} MB, {len(inside)} files; {sdist.name}: {len(names)}")


def try_out(wheel: Path, python: str) -> None:
    """Install the wheel with an interpreter, and use it."""
    shipped = not wheel.name.endswith("-any.whl")
    with tempfile.TemporaryDirectory() as made:
        place = Path(made)
        (place / "in-the-way").touch()
        outside = {
            # No compiler is found, and nothing of what is installed here.
            **dict.fromkeys(("CC", "CXX", "FC"), "/bin/false"),
            "PATH": f"{place / 'env' / 'bin'}:/usr/bin:/bin",
            "HOME": str(place),
            "VIBROIMPACT_CACHE_DIR": str(place / ("in-the-way" if shipped else "compiled")),
        }
        environment = {
            **{name: v for name, v in os.environ.items() if not name.startswith(WITHHELD)},
            **outside,
        }

        def run(*words: object, where: Path = place) -> str:
            called = [str(w) for w in words]
            done = subprocess.run(
                called, cwd=where, env=environment, stdout=subprocess.PIPE, text=True
            )
            print(done.stdout, end="", flush=True)
            if done.returncode:
                sys.exit(f"{python}: {' '.join(called)} failed")
            return done.stdout

        subprocess.run([python, "-m", "venv", place / "env"], check=True)
        binary = place / "env" / "bin"
        pip = [binary / "python", "-m", "pip", "install", "--quiet", "--only-binary=:all:"]
        run(*pip, "-c", ROOT / "constraints.txt", wheel)
        if shipped:
            run(binary / "python", "-m", "pip", "uninstall", "--quiet", "--yes", "numba")
        (place / "empty").mkdir()
        run(binary / "vibroimpact", "--version", where=place / "empty")
        run(binary / "vibroimpact", "sweep", "B2-G1-A3", where=place / "empty")
        written = {path.name for path in (place / "empty" / "out").iterdir()}
        assert {"B2-G1-A3-sweep.nc", "B2-G1-A3-sweep.png"} <= written, written
        used = run(binary / "vibroimpact", "cache", where=place / "empty").splitlines()[0]
        assert used.startswith("engine: compiled by numba") != shipped, used
        run(*pip, "-c", ROOT / "constraints.txt", *NEEDED)
        (place / "user.py").write_bytes((ROOT / "tests" / "typing" / "user.py").read_bytes())
        run(binary / "mypy", "--strict", "user.py")
        tests = (*QUICK, *(SHIPPED if shipped else ()))
        run(binary / "python", "-m", "pytest", "-p", "no:cacheprovider", *tests, where=ROOT)
    print(f"{python}: installed without a compiler, sweeps, is typed and passes its quick tests")


if __name__ == "__main__":
    folder = Path(sys.argv[1]).resolve()
    wheels, (source,) = sorted(folder.glob("*.whl")), folder.glob("*.tar.gz")
    for made in wheels:
        check_contents(made, source)
        if "-any." in made.name or ("manylinux" in made.name and platform.machine() in made.name):
            for interpreter in sys.argv[2:]:
                try_out(made, interpreter)
