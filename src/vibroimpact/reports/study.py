"""A rig as a study file, which every command takes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from vibroimpact.datasets.description import oscillator_parameters
from vibroimpact.model import Oscillator


def study_text(name: str, oscillator: Oscillator, amplitude: float, about: str = "") -> str:
    """The text of a study file (TOML): numbers in SI units, with all their digits.

    Parameters
    ----------
    name
        Of the study.
    oscillator
        The rig.
    amplitude
        Peak base acceleration (m/s²).
    about
        A comment above it.
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
