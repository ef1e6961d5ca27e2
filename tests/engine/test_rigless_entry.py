"""Entries without a rig: compiled once, loaded from the cache by the next process."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from vibroimpact.engine import cache, native, spectra
from vibroimpact.engine.rigless_entry import NoRig

LOAD = """\
from vibroimpact.engine import spectra
from vibroimpact.engine.rigless_entry import NoRig
spectra.respond.prepare()
stats = spectra.respond._compiled[NoRig].stats
assert stats.cache_hits and not stats.cache_misses
"""


@pytest.mark.skipif(native.find_library() is not None, reason="the engine is machine code already")
def test_the_next_process_finds_it_compiled() -> None:
    spectra.respond.prepare()
    environment = {**os.environ, "VIBROIMPACT_CACHE_DIR": str(cache.own_folder().parent)}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", LOAD], env=environment, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_it_stops_when_it_is_told_to() -> None:
    counter = np.array([0, 1])
    out = np.full((2, spectra.FOUND), -1.0)
    one = np.ones(2)
    spectra.respond(np.array([0.0, 1.0]), 0.1, one, 0.05 * one, counter, out)
    assert (out == -1.0).all()
    assert set(spectra.respond._compiled) == {NoRig}
