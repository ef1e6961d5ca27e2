"""Running something in a new process."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
_CACHE = "VIBROIMPACT_CACHE_DIR"
_NUMBA = {"VIBROIMPACT_ENGINE": "numba"}


@dataclass(frozen=True, slots=True)
class Ended:
    """How a process went."""

    seconds: float
    """Time on the wall."""
    work: float
    """Processor time, its own children included; 0 where the system does not tell."""
    output: str
    errors: str


def execute(command: Sequence[str], environment: Mapping[str, str] | None = None) -> Ended:
    """Run a command to its end; it may import `benchmarks`.

    Raises
    ------
    RuntimeError
        With what it said, if it failed.
    """
    # Python's own cache of compiled modules is used as everywhere.
    inherited = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    before = os.times()
    begin = time.perf_counter()
    done = subprocess.run(
        command,
        cwd=ROOT,
        env={**inherited, **(environment or {})},
        capture_output=True,
        text=True,
        check=False,
    )
    seconds = time.perf_counter() - begin
    after = os.times()
    work = after.children_user + after.children_system
    work -= before.children_user + before.children_system
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} failed:\n{done.stderr}")
    return Ended(seconds, work, done.stdout, done.stderr)


def python(code: str, environment: Mapping[str, str] | None = None) -> Ended:
    """Run Python code."""
    return execute([sys.executable, "-c", code], environment)


def vibroimpact(*words: str, environment: Mapping[str, str] | None = None) -> Ended:
    """Run the command line."""
    return execute([str(Path(sys.executable).with_name("vibroimpact")), *words], environment)


@contextmanager
def empty_cache() -> Iterator[dict[str, str]]:
    """Make the environment of processes in which numba compiles, into a new cache."""
    with tempfile.TemporaryDirectory() as folder:
        yield {_CACHE: folder, **_NUMBA}


@contextmanager
def nothing_kept() -> Iterator[dict[str, str]]:
    """Make the environment of the first process after an installation: no cache, no fonts found."""
    with tempfile.TemporaryDirectory() as folder:
        yield {_CACHE: folder, "MPLCONFIGDIR": folder}


def compiled(environment: Mapping[str, str]) -> int:
    """Count the functions in a cache, one for each flow that asked for it."""
    return len(list(Path(environment[_CACHE]).rglob("*.nbi")))
