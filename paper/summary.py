"""The verdicts on the statements of the paper, as plain values and as text."""

from __future__ import annotations

from typing import Any

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from paper.claim import Verdict
from paper.report import Report


def facts(results: Report) -> dict[str, Any]:
    """Return the verdicts as plain values."""
    return {
        "verdicts": {str(verdict): count for verdict, count in results.counts.items()},
        "kinds": {
            str(kind): {str(verdict): count for verdict, count in counts.items()}
            for kind, counts in results.kinds.items()
        },
        "claims": [
            {
                "key": one.claim.key,
                "section": one.claim.section,
                "statement": one.claim.statement,
                "computed": one.claim.quantity,
                "kind": str(one.claim.kind),
                "verdict": str(one.finding.verdict),
                "number": one.finding.number,
            }
            for one in results.judged
        ],
    }


def text(results: Report) -> RenderableType:
    """Return the verdicts by kind, and the statements that are not reproduced."""
    parts: list[RenderableType] = []
    if results.judged:
        parts.append(Text(f"Statements of the paper: {len(results.judged)}"))
        parts += [Text(f"  {count:3} {verdict}") for verdict, count in results.counts.items()]
        parts += [Text(), Text("By kind")]
        for kind, counts in results.kinds.items():
            shares = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
            parts.append(Text(f"  {kind}: {shares}"))
        lost = results.of(Verdict.NOT_REPRODUCED)
        if lost:
            parts += [Text(), Text("Not reproduced")]
        for one in lost:
            statement = Text(f"{one.claim.key}: {one.claim.statement}")
            number = Text(f"computed: {one.finding.number}")
            parts += [
                Padding(statement, (0, 0, 0, 2), expand=False),
                Padding(number, (0, 0, 0, 4), expand=False),
            ]
    return Group(*parts)
