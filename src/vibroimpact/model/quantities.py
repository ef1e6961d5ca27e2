"""The kinds of physical quantities: which units each takes and how it is written."""

from __future__ import annotations

from dataclasses import dataclass

GRAVITY = 9.80665
"""Standard acceleration of gravity in m/s² (the *g* of ``"0.05 g"``)."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A kind of physical quantity: which units it takes and how it is written.

    Attributes
    ----------
    name
        What it is called in messages, such as ``"length"``.
    base
        Exponents of the SI base units, with the radian counted as a base unit so that an
        angle is told from a ratio and an angular frequency from a frequency.
    symbol
        The SI unit, such as ``"m"``; empty for a ratio.
    example
        Text with units that is accepted, such as ``"15 mm"``.
    number
        The same example as a plain SI number.
    scales
        Units for printing, largest first: (smallest magnitude printed in it, its size in
        SI units, its symbol).
    """

    name: str
    base: tuple[tuple[str, int], ...]
    symbol: str
    example: str
    number: float
    scales: tuple[tuple[float, float, str], ...]

    @property
    def phrase(self) -> str:
        """The name with its article, such as ``"a length"``."""
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"


LENGTH = Quantity(
    "length",
    (("meter", 1),),
    "m",
    "15 mm",
    0.015,
    ((1.0, 1.0, "m"), (1e-4, 1e-3, "mm"), (0.0, 1e-6, "µm")),
)
MASS = Quantity(
    "mass",
    (("kilogram", 1),),
    "kg",
    "550 kg",
    550,
    ((1e4, 1e3, "t"), (0.1, 1.0, "kg"), (0.0, 1e-3, "g")),
)
STIFFNESS = Quantity(
    "stiffness",
    (("kilogram", 1), ("second", -2)),
    "N/m",
    "510 kN/m",
    510000,
    ((1e10, 1e9, "GN/m"), (1e7, 1e6, "MN/m"), (1e3, 1e3, "kN/m"), (0.0, 1.0, "N/m")),
)
DAMPING = Quantity(
    "damping",
    (("kilogram", 1), ("second", -1)),
    "N s/m",
    "1.1 kN s/m",
    1100,
    ((1e7, 1e6, "MN s/m"), (1e2, 1e3, "kN s/m"), (0.0, 1.0, "N s/m")),
)
ACCELERATION = Quantity(
    "acceleration",
    (("meter", 1), ("second", -2)),
    "m/s²",
    "0.05 g",
    0.4903325,
    ((0.0, 1.0, "m/s²"),),
)
FREQUENCY = Quantity(
    "frequency",
    (("second", -1),),
    "Hz",
    "2.5 Hz",
    2.5,
    ((1e3, 1e3, "kHz"), (0.0, 1.0, "Hz")),
)
TIME = Quantity(
    "time",
    (("second", 1),),
    "s",
    "20 ms",
    0.02,
    ((0.1, 1.0, "s"), (0.0, 1e-3, "ms")),
)
VELOCITY = Quantity(
    "velocity",
    (("meter", 1), ("second", -1)),
    "m/s",
    "150 mm/s",
    0.15,
    ((1.0, 1.0, "m/s"), (0.0, 1e-3, "mm/s")),
)
FORCE = Quantity(
    "force",
    (("kilogram", 1), ("meter", 1), ("second", -2)),
    "N",
    "120 N",
    120,
    ((1e6, 1e6, "MN"), (1e3, 1e3, "kN"), (0.0, 1.0, "N")),
)
ANGLE = Quantity("angle", (("radian", 1),), "rad", "90 deg", 1.5708, ((0.0, 1.0, "rad"),))
DIMENSIONLESS = Quantity("dimensionless number", (), "", "0.15", 0.15, ((0.0, 1.0, ""),))
