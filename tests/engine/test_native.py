"""The library of machine code: it gives what numba gives, and is used for its own sources only."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from vibroimpact.engine import compilation, jit, native

MOTIONS = """\
import json, sys
import vibroimpact as vi
from vibroimpact.engine import native
case = vi.laboratory.case("B2-G1-A3")
yielding = vi.BoucWenIsolator("2 N/m", "0.5 N/m", "0.5 N", "0.1 N s/m")
curved = vi.Rig(vi.Oscillator("1 kg", yielding, vi.PowerBumper("20 N/m^1.5", "0.5 m")), "1 N")
pair = vi.Assembly(
    masses={"a": "1 kg", "b": "2 kg"},
    links={k: vi.Link("ground", k, vi.Isolator("1 N/m", "0.1 N s/m")) for k in "ab"},
    stops={"s": vi.Link("a", "b", vi.Bumper("30 N/m", "0.3 N s/m", "0.2 m"))},
)
hexes = []
def keep(*values):
    hexes.extend(float(v).hex() for value in values for v in value.values.ravel())
swept = vi.sweep(case, case.frequencies[::50])
keep(swept["eta_a"], swept["section"])
for rig, frequency in ((case, "2 Hz"), (curved, "0.3 Hz"), (vi.Rig(pair, "1 m/s^2"), "0.2 Hz")):
    motion = vi.simulate(rig, 20, frequency=frequency)
    keep(motion["final_state"], motion["event_time"])
    if rig is not case:
        keep(vi.steady(rig, frequency=frequency)["displacement_max"])
print(json.dumps([native.find_library() is not None, "numba" in sys.modules, hexes]))
"""

CURRENT = (native.FOLDER / native.DIGEST).read_text() == native.digest()
LIBRARY = native.shipped() if CURRENT else None
"""Also where VIBROIMPACT_ENGINE is numba, as in the full run: processes choose for themselves."""

here = pytest.mark.skipif(LIBRARY is None, reason="no library: make kernels")


def motions(engine: str) -> tuple[bool, bool, list[str]]:
    # numba for the same processors as the library
    assert LIBRARY is not None
    level = LIBRARY.stem.rpartition("-")[2]
    cpu = {"NUMBA_CPU_NAME": f"x86-64-{level}", "NUMBA_CPU_FEATURES": ""}
    environment = {**os.environ, "VIBROIMPACT_ENGINE": engine, **cpu}
    environment.pop("VIBROIMPACT_KERNELS", None)
    done = subprocess.run(
        [sys.executable, "-c", MOTIONS], env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    native_code, numba, hexes = json.loads(done.stdout)
    return native_code, numba, hexes


def test_the_library_of_the_repository_is_of_these_sources() -> None:
    assert CURRENT, "run make kernels"
    assert (native.FOLDER / "page.wasm").exists(), "run make kernels"


@here
def test_numba_is_not_imported() -> None:
    assert motions("")[:2] == (True, False)


def test_numba_that_is_needed_and_lacking_is_named_in_one_line(tmp_path) -> None:
    code = (
        "import sys; sys.modules['numba'] = None\n"
        "from vibroimpact.cli import main; sys.exit(main(['sweep', 'B2-G1-A3']))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "VIBROIMPACT_ENGINE": "numba"},
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert "VIBROIMPACT_ENGINE is numba" in line
    assert "install it with: pip install numba" in line


OWN_OBSERVER = """\
import numpy as np
from engine.observers.test_power import find_power
from vibroimpact.engine.parameters import free_rig
find_power(free_rig(), 1.0, 0.4, 0.0, np.zeros(20), 1, np.zeros(4))
print("compiled")
"""


@here
@pytest.mark.parametrize("kernels", [False, True])
def test_an_observer_of_ones_own_is_compiled_or_says_how(kernels: bool) -> None:
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])}
    environment |= {"VIBROIMPACT_ENGINE": ""}
    environment.pop("VIBROIMPACT_KERNELS", None)
    if kernels:
        environment["VIBROIMPACT_KERNELS"] = "1"
    done = subprocess.run(
        [sys.executable, "-c", OWN_OBSERVER], env=environment, capture_output=True, text=True
    )
    if kernels:
        assert done.stdout == "compiled\n", done.stderr
    else:
        last = done.stderr.splitlines()[-1]
        assert "find_power: the engine's machine code does not contain it" in last
        assert "VIBROIMPACT_KERNELS=1" in last


@here
@pytest.mark.full
@pytest.mark.skipif(native.machine() != "x86_64", reason="levels are named as numba names them")
def test_same_bits_as_numba() -> None:
    compiled = motions("numba")
    assert compiled[:2] == (False, True)
    assert motions("")[2] == compiled[2]


@pytest.mark.skipif(native.find_library() is None, reason="numba compiles in this process")
def test_arrays_that_the_code_cannot_read_are_refused() -> None:
    from vibroimpact.engine import spectra
    from vibroimpact.engine.rigless_entry import NoRig

    symbol = spectra.respond.symbol(NoRig)
    respond = native.function(symbol, spectra.respond.signature, "f8")
    one, counter, out = np.ones(2), np.array([0, 1]), np.zeros((2, spectra.FOUND))
    with pytest.raises(TypeError, match="float32"):
        respond(NoRig(), one.astype(np.float32), 0.1, one, one, counter, out)
    with pytest.raises(TypeError, match="C order"):
        respond(NoRig(), np.ones(4)[::2], 0.1, one, one, counter, out)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    made = tmp_path / "libraries"
    made.mkdir(mode=0o755)
    name = native.name_of(sys.platform, native.machine(), native.levels()[-1])
    (made / name).write_bytes(b"")
    (made / native.DIGEST).write_text(native.digest())
    monkeypatch.setattr(native, "FOLDER", made)
    monkeypatch.delenv("VIBROIMPACT_ENGINE", raising=False)
    return made


def choice() -> native.LibraryChoice:
    return native.choose.__wrapped__()


def library_path() -> Path | None:
    return choice().path


def test_a_library_of_other_sources_is_not_used_and_that_is_announced(
    folder: Path, monkeypatch
) -> None:
    assert library_path() is not None
    (folder / native.DIGEST).write_text("0")
    assert library_path() is None
    lines: list[str] = []
    monkeypatch.setattr(jit, "announce", lines.append)
    monkeypatch.setattr(jit, "_announced", threading.Event())
    made = choice()
    monkeypatch.setattr(native, "choose", lambda: made)
    for _ in range(2):
        with compilation.Compiled(choice, "f8(f8)")._announced("Alone"):
            pass
    (line,) = lines
    assert "was made of other sources (make kernels)" in line


def test_a_library_that_others_may_write_is_not_used(folder: Path) -> None:
    (path,) = (one for one in folder.iterdir() if one.name != native.DIGEST)
    path.chmod(0o666)
    assert choice().unexpected
    assert repr(str(path)) in choice().why
    assert library_path() is None
    path.chmod(0o644)
    assert library_path() == path


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="no owners and modes here")
def test_a_library_of_the_owner_of_the_sources_is_used_and_of_another_user_is_not(
    folder: Path, monkeypatch
) -> None:
    (path,) = (one for one in folder.iterdir() if one.name != native.DIGEST)
    source = folder.parent / "native.py"
    source.touch()
    user = os.getuid()
    if user == 0:
        for one in (folder, path, source):
            os.chown(one, 12345, -1)
    else:
        monkeypatch.setattr(os, "getuid", lambda: user + 1)
    monkeypatch.setattr(native, "SOURCE", source)
    assert library_path() == path
    path.chmod(0o646)
    assert "chmod go-w" in choice().why
    path.chmod(0o644)
    monkeypatch.setattr(native, "SOURCE", Path("/"))  # root's
    assert choice().unexpected
    assert f"{str(folder)!r} belongs to another user" in choice().why
    assert library_path() is None


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="no owners and modes here")
def test_a_library_that_a_group_may_write_is_used_if_the_group_is_its_owner_alone(
    folder: Path, monkeypatch
) -> None:
    import grp
    import pwd

    (path,) = (one for one in folder.iterdir() if one.name != native.DIGEST)
    folder.chmod(0o775)
    path.chmod(0o664)
    group = path.stat().st_gid

    def account(name: str, user: int = os.getuid()) -> pwd.struct_passwd:
        return pwd.struct_passwd((name, "x", user, group, "", "/", "/bin/sh"))

    def used(name: str, *members: str, others: tuple[str, ...] = ()) -> bool:
        accounts = [account("ann"), *(account(one, 12345) for one in others)]
        monkeypatch.setattr(pwd, "getpwuid", lambda user: accounts[0])
        monkeypatch.setattr(pwd, "getpwall", lambda: accounts)
        held = grp.struct_group((name, "x", group, list(members)))
        monkeypatch.setattr(grp, "getgrgid", lambda group: held)
        return library_path() == path

    assert used("ann")
    assert used("ann", "ann")
    assert not used("users")
    assert not used("ann", "bob")
    assert not used("ann", others=("bob",))
    assert "chmod go-w" in choice().why


def test_a_processor_that_lacks_features_takes_a_lower_level(folder: Path, monkeypatch) -> None:
    assert native.levels() == list(native.LEVELS[native.machine()])[-len(native.levels()) :]
    monkeypatch.setattr(native, "levels", list)
    assert library_path() is None
    assert not choice().unexpected
