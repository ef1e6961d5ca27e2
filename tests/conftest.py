"""The option that chooses how large the samples are."""

from __future__ import annotations

import gc
import importlib.util
import os
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

import samples


def python_of(dispatcher: Any) -> Any:
    """Let a kernel that Python calls run as Python."""
    dispatcher._compile_for_args = lambda *args, **kwargs: dispatcher.py_func
    return dispatcher


def buffer_of(stack: Callable[[int], Any]) -> Callable[[int], Any]:
    """Let what gives room on the stack of a compiled kernel give an array in Python."""

    def make(size: int) -> Any:
        buffer = stack(size)
        buffer.__class__ = type(
            "Buffer", (type(buffer),), {"__call__": lambda self: np.empty(size)}
        )
        return buffer

    return make


NUMBA = importlib.util.find_spec("numba") is not None
# Tests call kernels besides the entries; those of an installation without numba call none.
if NUMBA:
    os.environ["VIBROIMPACT_KERNELS"] = "1"
from vibroimpact.datasets import description  # noqa: E402
from vibroimpact.engine import jit, native  # noqa: E402

os.environ.pop("VIBROIMPACT_KERNELS", None)

description.CHECKS_DIMS = True
jit.WITHIN["no_cpython_wrapper"] = False  # tests call kernels
if NUMBA and native.find_library():
    # Of kernels that a test calls nothing is compiled: they run as Python, unless an entry of a
    # test has them compiled. Without the library, that is where its sources changed, all are.
    jit._within = python_of
    from vibroimpact.engine import memory

    memory.stack = buffer_of(memory.stack)
    memory.workspace = memory.stack(memory.TERMS)

# The first example of a test imports and compiles: its time says nothing of the test. The small
# sample is the same for everybody, so that no change is blamed for a chance; the full one is drawn.
settings.register_profile("full", deadline=None)
settings.register_profile("small", max_examples=15, deadline=None, derandomize=True, database=None)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--full", action="store_true", help="full samples instead of small ones")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "full: only in the full run; a smaller sample stays daily")
    samples.full = config.getoption("full")
    settings.load_profile("full" if samples.full else "small")


@pytest.fixture(scope="session", autouse=True)
def coarse_pictures() -> Iterator[None]:
    """Fewer pixels in PNG files, which take as long to write as the figure to draw."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("vibroimpact.figures.style._SCREEN", samples.sample(200.0, 72.0))
        yield


@pytest.fixture(scope="module")
def blank_pictures() -> Iterator[None]:
    """In the daily run, PNG files are blank: for tests of what is written, not of what is seen."""
    from vibroimpact.figures.notebook import NotebookFigure

    save = NotebookFigure.savefig

    def blank(figure: NotebookFigure, file: Any, **how: Any) -> None:
        if samples.full or how.get("format") != "png":
            save(figure, file, **how)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(NotebookFigure, "savefig", blank)
        yield


def pytest_collection_finish() -> None:
    """Search seldom for garbage, and never among the tests: a twelfth of the time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 20)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if samples.full:
        return
    later = [item for item in items if item.get_closest_marker("full")]
    items[:] = [item for item in items if not item.get_closest_marker("full")]
    config.hook.pytest_deselected(items=later)
