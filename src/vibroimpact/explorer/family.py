"""A page without a server: one knob, and precomputed resonance curves for each of its values.

``python -m vibroimpact.explorer.family docs/explorer.html`` writes the page of the documentation.
"""

from __future__ import annotations

import json
import re
import sys
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from vibroimpact.explorer.change import moved
from vibroimpact.explorer.controls import controls
from vibroimpact.explorer.pictures import curves, scenario
from vibroimpact.explorer.presets import FIRST, preset

KNOB = "stops.gap"
VALUES = tuple(float(f"{gap:.4g}") for gap in np.linspace(0.0, 37.5e-3, 31))
"""Gaps in m: from bumpers that touch the mass to a gap that the mass does not reach."""
_MODULES = ("plot.js", "curves.js", "still.js")


def family(values: tuple[float, ...] = VALUES) -> dict[str, Any]:
    """Return the curves and the scenario at each value of the knob."""
    first = preset(FIRST)
    members = []
    for value in values:
        state = moved(first, KNOB, value)
        data = curves.swept(state, fine=False)
        picture = curves.curves(state, data, fine=False)
        found = scenario.careful(state, lambda done, total: None)
        knob = next(one for one in controls(state, first) if one.path == KNOB)
        members.append({"text": knob.text, "curves": picture, "scenario": found})
    label = f"gap of both stops of {FIRST}"
    begun = next(one.value for one in controls(first, first) if one.path == KNOB)
    start = min(range(len(values)), key=lambda k: abs(values[k] - begun))
    return {"label": label, "start": start, "members": members}


def page(found: dict[str, Any]) -> str:
    """Return the page as one HTML text, which contains its style sheet and its program."""
    folder = resources.files(__package__) / "page"
    # One program: what the modules import of one another stands above them.
    parts = [(folder / name).read_text(encoding="utf-8") for name in _MODULES]
    program = re.sub(r"^import .*\n|^export ", "", "\n".join(parts), flags=re.MULTILINE)
    style = (folder / "style.css").read_text(encoding="utf-8")
    data = json.dumps(found, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
    frame = (folder / "still.html").read_text(encoding="utf-8")
    for mark, text in (("STYLE", style), ("FAMILY", data), ("PROGRAM", program)):
        frame = frame.replace(f"/*{mark}*/", text)
    return frame


if __name__ == "__main__":
    whole = page(family())
    Path(sys.argv[1]).write_text(whole, encoding="utf-8")
