"""The thresholds between scenarios, with their reasons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from numbers import Real

from vibroimpact.errors import InputError, shown


@dataclass(frozen=True)
class Thresholds:
    """The thresholds of `classify_scenario`, all dimensionless.

    Attributes
    ----------
    prominence
        Least prominence of a secondary resonance in η_a, as a share of its height. No measurement
        could detect smaller ripples. It separates S2 from S3.
    extent
        Least width of all secondary left hystereses and non-regular resonances together, as a
        share of the natural frequency. A test steps by 0.08 to 0.09 of it (0.1 Hz, the paper's
        Section 3): if they are narrower, a test may have no frequency step within them. It
        separates S2 and S3 from S4.
    touch
        Largest value of 1 - δ0 for which a contact is called grazing: the share by which the gap is
        smaller than the amplitude without stops. The tests called grazing in the paper's Fig. 14
        have 0.07, the next ones 0.22. It separates S1 from S2 and S6.
    deformation
        Largest penetration, as a share of the gap, of a grazing contact: a lightly damped mass
        that grazes on one motion may hit hard on another. It separates S1 from S2 and S6.

    Raises
    ------
    InputError
        If a threshold is not a number greater than 0 and at most 1.
    """

    prominence: float = 0.02
    extent: float = 0.08
    touch: float = 0.1
    deformation: float = 0.1

    def __post_init__(self) -> None:
        for name in self.names():
            value = getattr(self, name)
            number = isinstance(value, Real) and not isinstance(value, bool)
            if not (number and 0.0 < value <= 1.0):
                raise InputError(
                    f"{name}: {shown(value)}; a number greater than 0 and at most 1 is accepted"
                )

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """Names of the thresholds."""
        return tuple(field.name for field in fields(cls))

    def variations(self) -> Iterator[tuple[str, Thresholds]]:
        """Yield thresholds with one of them halved or doubled, with its name and value."""
        for name in self.names():
            for factor in (0.5, 2.0):
                yield name, replace(self, **{name: min(1.0, factor * getattr(self, name))})


def checked(given: object) -> Thresholds:
    """Return the thresholds to use; None gives the defaults.

    Raises
    ------
    InputError
        If it is something else.
    """
    if given is None:
        return Thresholds()
    if not isinstance(given, Thresholds):
        raise InputError(f"thresholds: {given!r}; a Thresholds, or None, is accepted")
    return given
