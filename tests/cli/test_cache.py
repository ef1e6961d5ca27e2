"""``vibroimpact cache``: what is kept is told, and removed where nobody uses it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from vibroimpact.engine import native
from vibroimpact.engine.cache import own_folder

COMMAND = "cache"
HOLD = """
import sys
from filelock import FileLock
with FileLock(sys.argv[1]):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def kept(tmp_path, monkeypatch) -> Path:
    """A cache of this version and of another one, two days old."""
    monkeypatch.setenv("VIBROIMPACT_CACHE_DIR", str(tmp_path / "kept"))
    own = own_folder()
    for folder, flows in ((own, ("Bumpers", "Curved")), (own.with_name("engine-0"), ("Bumpers",))):
        for flow in flows:
            parts = folder / flow / "engine_0123"
            parts.mkdir(parents=True)
            (folder / flow / "lock").touch()
            for name in ("batch.sweep-1.py311.nbi", "batch.sweep-1.py311.1.nbc"):
                (parts / name).write_bytes(bytes(10**6))
                if folder != own:
                    os.utime(parts / name, (time.time() - 180_000.0,) * 2)
    (own.parent / "mine.txt").write_text("kept")
    return own


def test_without_numba_the_folders_are_listed(run, kept, monkeypatch):
    pytest.importorskip("numba")  # which named the folders
    monkeypatch.setitem(sys.modules, "numba", None)
    code, out, errors = run()
    assert (code, errors) == (0, "")
    assert f"{kept.parent}: 2 folders, 6.0 MB" in out
    assert "of this version" not in out


def compiled(folder: Path) -> int:
    return len(list(folder.rglob("*.nb[ic]")))


def test_what_is_told(run, kept):
    code, out, errors = run()
    assert (code, errors) == (0, "")
    rows = [line.split() for line in out.splitlines() if line.startswith("engine-")]
    assert rows == [
        [kept.name, "4.0", "MB", "2", "just", "now", "of", "this", "version"],
        ["engine-0", "2.0", "MB", "1", "2", "days", "ago"],
    ]
    assert f"{kept.parent}: 2 folders, 6.0 MB" in out
    assert f"engine: {native.described()}" in out
    assert compiled(kept.parent) == 6


def test_other_versions_are_removed(run, kept):
    code, out, _ = run("--clean", "others", "--json")
    facts = json.loads(out)
    assert code == 0
    assert {p.name for p in kept.parent.iterdir()} == {kept.name, "mine.txt"}
    assert compiled(kept) == 4
    assert (facts["size"], facts["removed"], facts["in_use"]) == (4_000_000, 2_000_000, [])
    assert facts["kept"][0]["flows"] == ["Bumpers", "Curved"]


def test_all_is_removed_but_what_another_process_uses(run, kept):
    lock = kept / "Bumpers" / "lock"
    holds = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(lock)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    try:
        assert holds.stdout.readline().strip() == b"held"
        code, out, _ = run("--clean", "all")
        assert code == 0
        assert f"kept, because another process uses it: {kept.name}" in out
        assert (compiled(kept / "Bumpers"), compiled(kept / "Curved")) == (2, 0)
    finally:
        holds.communicate(b"")
    _, out, _ = run("--clean", "all")
    assert compiled(kept.parent) == 0
    assert lock.exists()  # for whoever waits for it
    assert "removed: 2.0 MB" in out


def test_an_empty_cache(run, tmp_path, monkeypatch):
    monkeypatch.setenv("VIBROIMPACT_CACHE_DIR", str(tmp_path / "none"))
    code, out, errors = run("--clean", "all")
    assert (code, errors) == (0, "")
    assert "0 folders, 0.0 MB" in out
    assert not (tmp_path / "none").exists()


def test_what_is_no_way_to_clean_is_refused(run, kept):
    code, _, errors = run("--clean", "some")
    assert code == 2
    assert "--clean" in errors
    assert compiled(kept.parent) == 6
