"""Exact, fast dynamics of oscillators that hit deformable stops.

A mass on an isolator between two bumpers, shaken by its base::

    import vibroimpact as vi

    case = vi.laboratory.case("B2-G1-A3")
    curves = vi.sweep(case.oscillator, case.amplitude, case.frequencies)

Names are loaded when first used, so that importing the package takes no time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from vibroimpact._version import __version__

_HOME = {
    "Bumper": "model",
    "Dimensionless": "model",
    "Harmonic": "model",
    "InputError": "errors",
    "Isolator": "model",
    "Oscillator": "model",
    "Rig": "model",
    "State": "model",
    "from_dimensionless": "model",
    "laboratory": "model",
    "load": "response.files",
    "save": "response.files",
    "simulate": "response.simulate",
    "sweep": "response.sweep",
    "sweeps": "response.sweep",
    "to_dimensionless": "model",
}

__all__ = [
    "Bumper",
    "Dimensionless",
    "Harmonic",
    "InputError",
    "Isolator",
    "Oscillator",
    "Rig",
    "State",
    "__version__",
    "from_dimensionless",
    "laboratory",
    "load",
    "save",
    "simulate",
    "sweep",
    "sweeps",
    "to_dimensionless",
]

if TYPE_CHECKING:
    from vibroimpact.errors import InputError
    from vibroimpact.model import (
        Bumper,
        Dimensionless,
        Harmonic,
        Isolator,
        Oscillator,
        Rig,
        State,
        from_dimensionless,
        laboratory,
        to_dimensionless,
    )
    from vibroimpact.response.files import load, save
    from vibroimpact.response.simulate import simulate
    from vibroimpact.response.sweep import sweep, sweeps


def __getattr__(name: str) -> Any:
    """Load a public name from where it lives (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"module 'vibroimpact' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"vibroimpact.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
