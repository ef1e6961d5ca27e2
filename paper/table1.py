"""Table 1: the dimensionless parameters of the campaign, as computed and as printed."""

from __future__ import annotations

from paper.report_item import Item, Table
from paper.study import PublishedStudy
from vibroimpact.model import laboratory

_NAMES = (*laboratory.GAPS, *laboratory.BUMPERS)

PRINTED: dict[str, dict[str, float]] = {
    "A1": dict(zip(_NAMES, (0.47, 0.62, 0.78, 0.93, 2.9, 15.0, 20.0, 67.8), strict=True)),
    "A2": dict(zip(_NAMES, (0.30, 0.40, 0.49, 0.59, 3.5, 17.8, 23.7, 80.1), strict=True)),
    "A3": dict(zip(_NAMES, (0.22, 0.29, 0.36, 0.43, 3.8, 19.4, 25.9, 87.5), strict=True)),
}
"""Values in the paper: δ by gap and λ by bumper, for each acceleration."""


def computed() -> dict[str, dict[str, float]]:
    """Return the same values, computed from the parameters of the rig and not rounded."""
    values = laboratory.table_1()
    return {a: values.gap[a] | values.stiffness_ratio[a] for a in laboratory.ACCELERATIONS}


def written(name: str, value: float) -> str:
    """Return a value with the decimals of the paper: two for gaps, one for stiffness ratios."""
    return f"{value:.2f}" if name in laboratory.GAPS else f"{value:.1f}"


def table(study: PublishedStudy) -> Table:
    """Return a table with a row of computed and a row of printed values for each acceleration."""
    head = tuple(f"δ {n}" if n in laboratory.GAPS else f"λ {n}" for n in _NAMES)
    rows = [
        (a, source, *(written(n, values[a][n]) for n in _NAMES))
        for a in laboratory.ACCELERATIONS
        for source, values in (("computed", computed()), ("printed", PRINTED))
    ]
    return Table(("acceleration", "values", *head), tuple(rows))


ITEM = Item(
    key="table1",
    title="Table 1: dimensionless gaps and stiffness ratios",
    caption=(
        "The table lists the dimensionless gap δ = G/(2 u_max) and the stiffness ratio λ of bumper "
        "to isolator, for the three table accelerations. u_max is the largest displacement of free "
        "flight at any frequency. The text of the paper prints the mass, the gaps and the "
        "stiffness of B2. It does not print the stiffness of B1, B3, B4 and the isolator. These "
        "were chosen so that the printed table results. Each row of computed values is rounded to "
        "the digits that the paper gives, and stands above the row of printed values. The text "
        "defines δ as the sum of both sides, but the printed numbers are those of one side. Both "
        "parameters change with the acceleration although the gaps and bumpers do not, because the "
        "isolator softens."
    ),
    table=table,
)
