"""The table of the parameters of a rig: ``parameters``, a directive without arguments.

Paths, units and bounds are those of `PARAMETERS`; the last column names the laws that have one.
"""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from vibroimpact.model import Law
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.parameters import PARAMETERS, Parameter
from vibroimpact.model.stops import STOPS

HEADINGS = {"Path": 25, "Quantity": 35, "Unit": 10, "Accepted": 10, "Of": 20}


class Parameters(SphinxDirective):
    """A table of all parameters of one mass; those of one stop have a path with its side."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        group = nodes.tgroup(cols=len(HEADINGS))
        group += [nodes.colspec(colwidth=width) for width in HEADINGS.values()]
        group += nodes.thead("", _row([nodes.Text(heading) for heading in HEADINGS]))
        group += nodes.tbody("", *(_row([nodes.literal(text=p), *map(nodes.Text, cells)])
                                   for p, *cells in rows()))  # fmt: skip
        return [nodes.table("", group, classes=["colwidths-given"])]


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


def _row(cells: Any) -> nodes.row:
    return nodes.row("", *(nodes.entry("", nodes.paragraph("", "", cell)) for cell in cells))


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directive."""
    app.add_directive("parameters", Parameters)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
