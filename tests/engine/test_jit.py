"""The cache of compiled code: loaded by the next process, safe for several at once."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from engine.compiled import ENTRIES, RIGS, compile_for, entries
from samples import sample
from vibroimpact.engine import cache as files
from vibroimpact.engine import native
from vibroimpact.engine.flow_dispatch import ONE_MASS

ENTRY = """\
from vibroimpact.engine.rigless_entry import rigless_entry


@rigless_entry("f8(f8[::1])")
def first(given, rig):
    return rig[0]
"""
"""An entry that is compiled at once: how long it takes decides nothing here."""

LOAD = f"""\
import sys
sys.path.insert(0, {str(Path(__file__).parents[1])!r})
from engine.compiled import ENTRIES, RIGS, compile_for, entries
from vibroimpact.engine.flow_tables import GROUPS
for part in (*RIGS, ENTRIES):
    compile_for(part)
for function in (*GROUPS.values(), *entries()):
    assert function._compiled
    for compiled in function._compiled.values():
        assert compiled.stats.cache_hits and not compiled.stats.cache_misses, function.__name__
"""
NOTICE = "compiling the engine"

SMALL = """\
from vibroimpact.engine.rigless_entry import RiglessEntry
from vibroimpact.engine.parameters import free_rig
first = eval("lambda given, rig: rig[0]")
assert RiglessEntry(first, "f8(f8[::1])")(free_rig()) == 1.0
"""
"""A small entry, where what is tested is the place where its code goes."""


def start(code: str, cache: Path, **environment: str) -> subprocess.Popen[str]:
    own = {"VIBROIMPACT_ENGINE": "numba", "VIBROIMPACT_CACHE_DIR": str(cache)}
    env = {**os.environ, **own, **environment}
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-c", code],
        env=env,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def run(code: str, cache: Path, **environment: str) -> str:
    """Run in a fresh process; what it wrote on standard error."""
    process = start(code, cache, **environment)
    _, error = process.communicate()
    assert process.returncode == 0, error
    return error


def test_an_entry_is_compiled_for_one_signature(tmp_path: Path) -> None:
    """What may not be written to is another type: refused, not compiled half a minute for."""
    refused = """
kept = free_rig()
kept.flags.writeable = False
made = RiglessEntry(first, "f8(f8[::1])")
made(free_rig())
try:
    made(kept)
except TypeError:
    pass
else:
    raise AssertionError("compiled")
"""
    run(SMALL + refused, tmp_path)


@pytest.mark.full
def test_processes_share_the_cache_safely(tmp_path: Path) -> None:
    """Two at once on an empty cache: one compiles, one waits and loads; so does a third."""
    (tmp_path / "small.py").write_text(ENTRY)
    prepare = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import small; small.first.prepare()"
    )
    both = [start(prepare, tmp_path) for _ in range(2)]
    errors = [process.communicate()[1] for process in both]
    assert [process.returncode for process in both] == [0, 0], errors
    assert sorted(NOTICE in error for error in errors) == [False, True]
    assert NOTICE not in run(prepare, tmp_path)
    assert len(list(tmp_path.glob("engine-*"))) == 1
    # A damaged file is no reason to fail, now or ever after.
    for path in tmp_path.rglob("*.nb[ic]"):
        path.write_bytes(path.read_bytes()[:40])
    assert NOTICE in run(prepare, tmp_path)
    assert NOTICE not in run(prepare, tmp_path)


PREPARE = """\
import os, sys
os.umask(0)
sys.path.insert(0, {folder!r})
import small
small.first.prepare()
"""


@pytest.fixture
def cached(tmp_path: Path) -> tuple[str, Path]:
    """Code that prepares an entry, and the cache in which it has done so, with a careless umask."""
    (tmp_path / "small.py").write_text(ENTRY)
    code = PREPARE.format(folder=str(tmp_path))
    assert NOTICE in run(code, tmp_path / "cache")
    return code, tmp_path / "cache"


def test_a_flipped_bit_in_compiled_code_is_noticed(cached: tuple[str, Path]) -> None:
    code, folder = cached
    for suffix in sample(("nbi", "nbc"), ("nbc",)):
        (path,) = folder.rglob(f"*.{suffix}")
        content = bytearray(path.read_bytes())
        content[len(content) // 2] ^= 16
        path.write_bytes(content)
        assert NOTICE in run(code, folder)
        assert NOTICE not in run(code, folder)


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="no owners and modes here")
def test_code_that_others_may_write_to_is_not_run(cached: tuple[str, Path]) -> None:
    code, folder = cached
    made = [folder, *folder.rglob("*")]
    assert not [path for path in made if path.stat().st_mode & 0o022]
    assert NOTICE not in run(code, folder)
    for depth in sample(("", "engine-*", "engine-*/*"), ("engine-*",)):
        (path,) = folder.glob(depth) if depth else (folder,)
        path.chmod(0o777)
        error = run(code, folder)
        assert f"other users may write to {str(path)!r}" in error
        assert NOTICE in error
        path.chmod(0o755)
        assert NOTICE not in run(code, folder)
    (path,) = folder.rglob("*.nbc")
    path.chmod(0o666)  # the file alone is made again
    error = run(code, folder)
    assert NOTICE in error
    assert f"other users may write to {str(path)!r}" in error
    assert "removed and compiled again" in error
    assert not [path for path in made if path.exists() and path.stat().st_mode & 0o022]


@pytest.mark.skipif(native.find_library() is not None, reason="the engine is machine code already")
def test_entries_and_functions_of_flows_are_loaded() -> None:
    """A process that finds the engine compiled compiles nothing."""
    assert len(ONE_MASS) == 8
    assert {flow.__name__ for flow in ONE_MASS} == set(RIGS)
    assert len(entries()) >= 9
    for part in (*RIGS, ENTRIES):
        compile_for(part)  # at once where it has been
    assert NOTICE not in run(LOAD, files.own_folder().parent)


def test_where_the_cache_cannot_be_written_a_process_compiles_for_itself_and_says_so_once(
    tmp_path: Path,
) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("in the way")
    (line,) = run(f"for name in 'abc':\n{textwrap.indent(SMALL, '    ')}", blocked).splitlines()
    assert NOTICE in line


def test_without_the_compiler_an_entry_is_the_function() -> None:
    code = (
        "from vibroimpact.engine import batch\n"
        "batch.trajectory.prepare()\n"
        "assert set(batch.trajectory._compiled.values()) == {batch.trajectory.function}"
    )
    run(code, Path("unused"), NUMBA_DISABLE_JIT="1")


def test_the_folder_changes_with_the_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for source in Path(files.__file__).parent.glob("*.py"):
        (tmp_path / source.name).write_bytes(source.read_bytes())
    monkeypatch.setattr(files, "__file__", str(tmp_path / "cache.py"))
    before = files.own_folder()
    assert files.own_folder() == before
    (tmp_path / "crossing.py").write_text("# edited")
    assert files.own_folder() != before
