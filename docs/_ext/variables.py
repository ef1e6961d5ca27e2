"""Tables of the variables that functions return: ``variables``, with the name of a function.

Names and dims are those of a short call in the tests, units and meaning those of the vocabulary.
The reference of each function that returns a dataset ends with its table.
"""

from __future__ import annotations

import sys
import tempfile
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import xarray as xr
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from node_tables import table

ROOT = Path(__file__).parents[2]
HEADINGS = {"Variable": 35, "Unit": 10, "Meaning": 55}


class Variables(SphinxDirective):
    """Tables of the variables that a function returns."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return a table for each set of dims."""
        groups: dict[str, list[tuple[str, ...]]] = {}
        for name, one in result(self.arguments[0]).variables.items():
            words = [one.attrs[key] for key in ("long_name", "comment") if key in one.attrs]
            units = (
                one.attrs["units"].removeprefix("1").replace(" s-2", "/s²").replace(" s-1", "/s")
            )
            cells = (str(name), units.replace("s-1", "1/s"), "; ".join(words))
            groups.setdefault(", ".join(map(str, one.dims)), []).append(cells)
        return [
            table(HEADINGS, rows, f"Over {dims}" if dims else "Single values")
            for dims, rows in groups.items()
        ]


@cache
def result(name: str) -> xr.Dataset:
    """Return the result of a public function in a short call, with all of its arguments."""
    sys.path[:0] = [str(ROOT / "tests")]
    import arguments

    folder = Path(tempfile.mkdtemp())
    arguments.write_files(folder)
    function, keywords = arguments.calls(folder)[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the calls are short on purpose
        return function(**keywords)


def _append(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Append its table to the documentation of a function that returns a dataset of its own."""
    returns = (obj.__doc__ or "").partition("    Returns\n")[2]
    if what == "function" and "    xarray.Dataset\n" in returns[:60] and obj.__name__ != "load":
        lines += ["", ".. rubric:: Variables", "", f".. variables:: {obj.__name__}", ""]


def setup(app: Sphinx) -> dict[str, Any]:
    """Listen to what Sphinx does."""
    app.add_directive("variables", Variables)
    app.connect("autodoc-process-docstring", _append, priority=900)  # after numpydoc
    return {"parallel_read_safe": True, "parallel_write_safe": True}
