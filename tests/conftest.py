"""The option that chooses how large the samples are."""

from __future__ import annotations

import gc
import importlib.util
import os
from collections.abc import Iterator

import pytest
from hypothesis import settings

import samples

# Tests call kernels besides the entries; those of an installation without numba call none.
if importlib.util.find_spec("numba"):
    os.environ["VIBROIMPACT_KERNELS"] = "1"
from vibroimpact.engine import jit

os.environ.pop("VIBROIMPACT_KERNELS", None)

jit.WITHIN["no_cpython_wrapper"] = False  # tests call kernels
# The first example of a test imports and compiles: its time says nothing of the test.
settings.register_profile("full", deadline=None)
settings.register_profile("small", max_examples=15, deadline=None)


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
