"""The table of the page on validation, computed anew in every build."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]
PAGE = "docs/validation"


def setup(app: Sphinx) -> dict[str, Any]:
    """Listen to what Sphinx does."""
    app.connect("env-get-outdated", lambda *_: [PAGE])
    app.connect("source-read", _compute)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _compute(app: Sphinx, name: str, text: list[str]) -> None:
    if name == PAGE:
        sys.path[:0] = [str(ROOT / "tests"), str(ROOT)]  # of the tests, and of the study
        from literature.comparisons.table import renewed

        text[0] = renewed(text[0])
