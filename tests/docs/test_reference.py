"""The reference has every public name, each on one page."""

from __future__ import annotations

import re
from collections import Counter

import vibroimpact as vi
from docs._ext.parameter_rows import rows
from docs.snippets import ROOT
from vibroimpact import figures

LISTED = re.compile(r"^\.\. currentmodule:: (\S+)\n\n\.\. autosummary::\n((?: .*\n|\n)*)", re.M)


def test_every_public_name_occurs_once():
    counts: Counter[str] = Counter()
    for page in (ROOT / "docs/reference").glob("*.md"):
        for module, names in LISTED.findall(page.read_text(encoding="utf-8")):
            counts.update(f"{module}.{name}" for name in re.findall(r"^   (\w+)$", names, re.M))
    public = {f"vibroimpact.{name}" for name in vi.__all__}
    public -= {"vibroimpact.__version__", "vibroimpact.laboratory"}  # the latter is a module
    public |= {f"vibroimpact.model.laboratory.{name}" for name in ("case", "campaign")}
    public |= {f"vibroimpact.figures.{name}" for name in figures.__all__}
    assert {name: count for name, count in counts.items() if count > 1} == {}
    assert public == set(counts)


def test_the_table_of_parameters_states_units_bounds_and_laws():
    table = {path: cells for path, *cells in rows()}
    assert table["gap"][1:] == ["m", "any", "every stop"]
    assert table["isolator.cubic"][1:] == ["N m-3", "any", "PolynomialIsolator"]
    assert table["stops.restitution"][2:] == [
        "0 to 1",
        "JankowskiBumper, PowerBumper, RigidStop",
    ]
    assert table["gap_ratio"][0] == "gap ratio of each side (G / u_max)"
    assert all(
        cells[-1] for path, cells in table.items() if path.startswith(("isolator.", "stops."))
    )
