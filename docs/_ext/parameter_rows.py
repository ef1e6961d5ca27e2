"""Rows of the table of parameters; without Sphinx, so that a test reads them."""

from __future__ import annotations

from vibroimpact.model import Law
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.parameters import PARAMETERS, Parameter
from vibroimpact.model.stops import STOPS


def rows() -> list[tuple[str, str, str, str, str]]:
    """Return path, quantity, unit, bounds and laws of each parameter."""
    return [
        (name, words(one), one.units.removeprefix("1"), bounds(one), laws(name))
        for name, one in PARAMETERS.items()
        if name.count(".") < 2
    ]


def words(one: Parameter) -> str:
    """Return the name of a parameter, with its definition."""
    return f"{one.long_name} ({one.comment})" if one.comment else one.long_name


def bounds(one: Parameter) -> str:
    """Return the accepted values."""
    if one.least is None:
        return "any"
    if one.most is not None:
        return f"{one.least:g} to {one.most:g}"
    return f"{'≥' if one.zero else '>'} {one.least:g}"


def laws(path: str) -> str:
    """Return the classes of the laws that have a number with this path, but for formulas."""
    owner, _, field = path.rpartition(".")
    owner = "stops" if path == "gap" else owner
    kinds = {"isolator": ISOLATORS, "stops": STOPS}.get(owner)
    classes = {one for one in kinds.classes.values() if one is not Law} if kinds else set()
    having = {one for one in classes if field in one.model_fields}
    every = f"every {owner.removesuffix('s')}"
    return every if having and having == classes else ", ".join(sorted(c.__name__ for c in having))
