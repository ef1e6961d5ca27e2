"""Collect the program and the benchmark figures that the first page shows."""

from __future__ import annotations

import sys
from pathlib import Path

from markupsafe import Markup
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from benchmarks.results import number, rows  # noqa: E402

_CODE = (ROOT / "gallery" / "01_resonance" / "01_jumps.py").read_text(encoding="utf-8")
_TRAJECTORY = {row["Solver"]: row for row in rows("One trajectory")}
_HEYOKA = _TRAJECTORY["heyoka, specialised to P"]
_TIMES = "Times the engine's"

# The page shows the code only: the text is in the docstring and in the comments after it.
_PROGRAM = _CODE.split('"""')[2].split("# %%")[0].strip()

CONTEXT = {
    "example": Markup(highlight(_PROGRAM, PythonLexer(), HtmlFormatter(nowrap=True))),
    "speed": f"{number(_TRAJECTORY['vibroimpact, engine']['µs a period']):.1f}",
    "heyoka": f"{number(_HEYOKA[_TIMES]):.0f}",
}
