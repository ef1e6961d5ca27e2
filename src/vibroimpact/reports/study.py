"""A rig as a study file, which all commands accept."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from vibroimpact.datasets.description import oscillator_parameters
from vibroimpact.model import Oscillator


def study_text(name: str, oscillator: Oscillator, amplitude: float, about: str = "") -> str:
    """Return the text of a study file (TOML), with numbers in SI units and with all digits.

    Parameters
    ----------
    name
        Name of the study.
    oscillator
        The oscillator.
    amplitude
        Peak base acceleration (m/s²).
    about
        Comment at the beginning of the file. Default: no comment.
    """
    lines = [f"# {line}" for line in about.splitlines()]
    lines += [f"name = {json.dumps(name, ensure_ascii=False)}", "", "[oscillator]"]
    for key, value in oscillator_parameters(oscillator).items():
        if value is not None:
            lines.append(f"{key} = {_value(value)}")
    lines += ["", "[excitation]", f"amplitude = {amplitude!r}", ""]
    return "\n".join(lines)


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        inside = ", ".join(f"{k} = {_value(v)}" for k, v in value.items() if v is not None)
        return f"{{ {inside} }}"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)
