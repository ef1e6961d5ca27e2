"""The stops of the registry whose class gives a formula. They need no entries in lists of tests."""

from __future__ import annotations

from vibroimpact.model.stops import STOPS, FormulaStop, StopLaw

FORMULA_STOPS: dict[str, type[FormulaStop]] = {
    kind: law for kind, law in STOPS.classes.items() if issubclass(law, FormulaStop)
}


def formula_stops(stiffness: float, gap: float) -> dict[str, StopLaw]:
    """One of each, of about a stiffness (N/m), for a mass and sizes of about 1."""
    sizes = (stiffness, 1.0, gap, 0.6, 1.0, 1.0)
    made = {kind: law.like(*sizes) for kind, law in FORMULA_STOPS.items()}
    return {kind: stop for kind, stop in made.items() if stop is not None}
