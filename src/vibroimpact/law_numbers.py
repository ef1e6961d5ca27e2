"""What a law passes to the engine: plain numbers, which stand in a rig's vector.

Forces are in N, not yet per unit mass.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

SYMBOLS = (
    "end", "x", "v", "|x|", "|v|", "number", "+", "-", "*", "/", "neg", "power", "real power",
    "exp", "sqrt", "sinh", "cosh", "tanh", "sin", "cos",
)  # fmt: skip
"""Of a formula. Behind ``number`` and ``real power`` stands which number, behind ``power`` the
whole exponent."""

WITH_DIGIT = ("number", "power", "real power")

WORDS, OWN_NUMBERS = 5, 8
"""Room of a formula: words of symbols, and numbers."""

BITS, IN_WORD = 5, 10
"""Of a symbol; symbols in a word, which a float holds exactly."""

MOST_SYMBOLS = IN_WORD * WORDS
LARGEST = 2**BITS - 1
"""Largest whole exponent."""

ABSOLUTE_X, ABSOLUTE_V = 1, 2
"""Flags of a formula: whether the sign of the displacement or of the velocity matters."""


class IsolatorNumbers(NamedTuple):
    """What an isolator does besides its spring and dashpot.

    The force is K u + cubic u³ + quintic u⁵ + 2 sinh · sinh(sinh_rate u) + hysteretic z, with
    z′ = u′ (slope − (knee + turning s_v s_z) |z|^sharpness), s_v and s_z the signs of u′ and of z;
    with a limit, z′ = u′ as long as |z| stays below it. The dashpot has C |u′|^drag. A friction
    force, and a formula (`pack`), come on top.
    """

    cubic: float = 0.0
    quintic: float = 0.0
    sinh: float = 0.0
    sinh_rate: float = 0.0
    hysteretic: float = 0.0
    slope: float = 1.0
    turning: float = 0.0
    knee: float = 0.0
    sharpness: float = 1.0
    limit: float = math.inf
    friction: float = 0.0
    drag: float = 1.0
    own: tuple[float, ...] = ()


class PowerLaw(NamedTuple):
    """A stop without memory: k δⁿ (1 + χ δ′), and c δ^¼ δ′ while it is approached.

    Attributes
    ----------
    stiffness, exponent
        k (N/mⁿ) and n.
    dissipation
        χ (s/m); below 0 minus the number d of χ = d / closing speed.
    viscous
        c, N s m^(−5/4).
    gap
        G0_j (m).
    """

    stiffness: float
    exponent: float
    dissipation: float
    viscous: float
    gap: float


class OwnStop(NamedTuple):
    """A stop without memory that follows a formula of its deformation and the rate of that.

    Attributes
    ----------
    own
        The formula, from `pack`.
    gap
        G0_j (m).
    """

    own: tuple[float, ...]
    gap: float


class Wall(NamedTuple):
    """A rigid wall.

    Attributes
    ----------
    law
        Name of its law of rebound in `engine.stops.rebound.LAWS`.
    numbers
        The numbers of the law.
    gap
        G0_j (m).
    """

    law: str
    numbers: tuple[float, ...]
    gap: float


class MemoryStop(NamedTuple):
    """A stop with a memory of its own.

    Attributes
    ----------
    law
        Name of its law in `engine.stops.memory_laws.LAWS`.
    numbers
        The numbers of the law.
    gap
        G0_j (m).
    """

    law: str
    numbers: tuple[float, ...]
    gap: float


StopNumbers = tuple[Any, ...]
"""K_j (N/m), C_j (N s/m) and G0_j (m) of a bumper; e and G0_j (m) of a rigid stop with a constant
coefficient of restitution; a `Wall`, a `PowerLaw`, an `OwnStop` or a `MemoryStop`."""


class Program(NamedTuple):
    """The operations of a formula in reverse Polish notation, and the numbers that they name."""

    symbols: tuple[int, ...]
    numbers: tuple[float, ...]

    def names(self) -> list[str]:
        """Return the symbols without the digits behind some of them."""
        symbols: list[str] = []
        digit = False
        for one in self.symbols:
            if not digit:
                symbols.append(SYMBOLS[one])
            digit = not digit and SYMBOLS[one] in WITH_DIGIT
        return symbols


def pack(program: Program, stiffness: float) -> tuple[float, ...]:
    """Write a formula as numbers of a rig's vector; `stiffness` is that at rest (N/m)."""
    symbols = [*program.symbols, *[0] * (MOST_SYMBOLS - len(program.symbols))]
    words = [
        float(sum(one << BITS * i for i, one in enumerate(symbols[at : at + IN_WORD])))
        for at in range(0, MOST_SYMBOLS, IN_WORD)
    ]
    named = program.names()
    flags = ABSOLUTE_X * ("|x|" in named) + ABSOLUTE_V * ("|v|" in named)
    numbers = [*program.numbers, *[0.0] * (OWN_NUMBERS - len(program.numbers))]
    return (*words, float(flags), *numbers, 1.0, stiffness)
