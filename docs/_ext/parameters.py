"""The table of the parameters of a rig: ``parameters``, a directive without arguments.

Paths, units and bounds are those of `PARAMETERS`; the last column names the laws that have one.
"""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from node_tables import table
from parameter_rows import rows

HEADINGS = {"Path": 25, "Quantity": 35, "Unit": 10, "Accepted": 10, "Of": 20}


class Parameters(SphinxDirective):
    """A table of all parameters of one mass; those of one stop have a path with its side."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        return [table(HEADINGS, rows())]


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directive."""
    app.add_directive("parameters", Parameters)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
