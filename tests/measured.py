"""Where measured reference data lie, which are not part of the project.

In the folder that ``VIBROIMPACT_MEASURED`` names, or in ``shared/data`` beside a folder above this
one; tests that need them skip, saying so, where they are absent.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest


def find(name: str) -> Path | None:
    """The path of a file or folder, if it is there."""
    named = os.environ.get("VIBROIMPACT_MEASURED")
    roots = [Path(named)] if named else [up / "shared/data" for up in Path(__file__).parents]
    return next((root / name for root in roots if (root / name).exists()), None)


def measured(name: str) -> Path:
    """The same; the test is skipped where it is absent."""
    if (path := find(name)) is None:
        pytest.skip(f"the measured data {name} are absent")
    return path
