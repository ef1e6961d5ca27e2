"""The option that chooses how large the samples are."""

from __future__ import annotations

import pytest
from hypothesis import settings

import samples
from vibroimpact.engine import jit

jit.WITHIN["no_cpython_wrapper"] = False  # tests call kernels
settings.register_profile("small", max_examples=30)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--full", action="store_true", help="full samples instead of small ones")


def pytest_configure(config: pytest.Config) -> None:
    samples.full = config.getoption("full")
    if not samples.full:
        settings.load_profile("small")
