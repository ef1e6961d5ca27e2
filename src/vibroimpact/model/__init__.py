"""What vibrates: oscillator, excitation and state, in physical or dimensionless form."""

from vibroimpact.model import laboratory
from vibroimpact.model.dimensionless import (
    Dimensionless,
    DimensionlessBumper,
    Rig,
    from_dimensionless,
    peak_displacement,
    to_dimensionless,
)
from vibroimpact.model.excitation import Harmonic
from vibroimpact.model.oscillator import Bumper, Isolator, Oscillator
from vibroimpact.model.state import State
from vibroimpact.model.units import GRAVITY, to_si
from vibroimpact.model.validation import Model, validate

__all__ = [
    "GRAVITY",
    "Bumper",
    "Dimensionless",
    "DimensionlessBumper",
    "Harmonic",
    "Isolator",
    "Model",
    "Oscillator",
    "Rig",
    "State",
    "from_dimensionless",
    "laboratory",
    "peak_displacement",
    "to_dimensionless",
    "to_si",
    "validate",
]
