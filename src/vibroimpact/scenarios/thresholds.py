"""The thresholds between scenarios, with the reasons for their values."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from numbers import Real

from vibroimpact.errors import InputError, shown


@dataclass(frozen=True)
class Thresholds:
    """The thresholds between scenarios, which `classify_scenario` uses. All are dimensionless.

    Attributes
    ----------
    prominence
        Smallest prominence of a secondary resonance in η_a, as a share of its height. A measurement
        could not detect a less prominent resonance. This threshold separates S2 from S3.
    extent
        Smallest total width of all secondary left hystereses and non-regular resonances, as a share
        of the natural frequency. The frequency step of the tests is 0.1 Hz, which is 0.08 to 0.09
        of the natural frequency (the paper's Section 3). If the total width is smaller than this
        step, a test may have no frequency within them. This threshold separates S2 and S3 from S4.
    touch
        Largest value of 1 - δ0 for which a contact is called grazing. 1 - δ0 is the share by which
        the gap is smaller than the amplitude without stops. It is 0.07 in the tests that the
        paper's Fig. 14 calls grazing. The next larger value of a test is 0.22. This threshold
        separates S1 from S2 and S6.
    deformation
        Largest penetration of a grazing contact, as a share of the gap. It is required because a
        lightly damped mass may graze in one motion, and hit the stop hard in another motion. This
        threshold separates S1 from S2 and S6.

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
                    f"{name}: {shown(value)}; pass a number greater than 0 and at most 1"
                )

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """Return the names of the thresholds."""
        return tuple(field.name for field in fields(cls))

    def variations(self) -> Iterator[tuple[str, Thresholds]]:
        """Yield name and value of a halved or doubled threshold, and the thresholds with it."""
        for name in self.names():
            for factor in (0.5, 2.0):
                yield name, replace(self, **{name: min(1.0, factor * getattr(self, name))})


def checked(thresholds: object) -> Thresholds:
    """Return the thresholds to use; None gives the defaults."""
    if thresholds is None:
        return Thresholds()
    if not isinstance(thresholds, Thresholds):
        raise InputError(
            f"thresholds: {shown(thresholds)} is not a Thresholds; pass an object such as "
            "Thresholds(prominence=0.02), or None"
        )
    return thresholds
