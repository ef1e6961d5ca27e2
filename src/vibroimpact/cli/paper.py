"""``vibroimpact paper``: the published study computed again, with a verdict on each statement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from vibroimpact.cli.options import COMPUTATION, OUTPUT, FileName, Whole
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from rich.console import RenderableType

    from vibroimpact.paper.claim import Claim
    from vibroimpact.paper.item import Item
    from vibroimpact.paper.report import Report

_CLAIMS = "claims"


def paper(
    *,
    only: Annotated[
        str | None,
        Parameter(
            help=(
                "A part: keys of figures and tables such as fig15 or table1, and 'claims', "
                "separated by commas. It is written to files of these names: fig15.md, fig15.html."
            ),
            allow_leading_hyphen=True,
        ),
    ] = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many sweeps run at once; one a processor."),
    ] = None,
    output: Annotated[
        FileName,
        Parameter(
            name=["--output", "-o"],
            group=OUTPUT,
            help="Folder for the files; made if it does not exist.",
        ),
    ] = "out/paper",
    figure: Annotated[
        Literal["png", "svg"], Parameter(group=OUTPUT, help="Format of the figures.")
    ] = "png",
    json: Annotated[
        bool,
        Parameter(
            group=OUTPUT,
            negative="",
            show_default=False,
            help="Print the summary as JSON, for other programs, and nothing else.",
        ),
    ] = False,
) -> int:
    """Compute the published study again, and judge each of its statements.

    Writes report.md and report.html: all figures and tables that the model can compute, and the
    paper's testable statements, each with what was computed, the deciding numbers and a verdict:
    reproduced, not reproduced, or not to be told without the experiment's data. They are counted by
    kind, for some outcomes were open and others follow from the rules or the inputs. The images go
    into the folder "figures" beside them. A statement that is not reproduced is no error.

    For example:

        vibroimpact paper
        vibroimpact paper --only claims --json
        vibroimpact paper --only fig15,fig16 --output results --figure svg
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.model.count_checks import whole
    from vibroimpact.paper.claims import CLAIMS
    from vibroimpact.paper.items import ITEMS

    if threads is not None:
        threads = whole(threads, "threads")
    items, claims = chosen(only, ITEMS, CLAIMS)
    with output_folder(output) as folder:
        from vibroimpact.paper import report
        from vibroimpact.paper.study import PublishedStudy

        with progress_bar("computing the study") as progress:
            found = report.compute(
                PublishedStudy(threads),
                folder.path,
                items,
                claims,
                whole=only is None,
                figure=figure,
                progress=progress,
            )
        files = report.write(found, folder.path)
        images = {one.item.key: folder / one.image for one in found.shown if one.image}
    tell(_text(found), _facts(found), folder, {**files, **images}, json)
    return 0


def chosen(
    only: str | None, items: tuple[Item, ...], claims: tuple[Claim, ...]
) -> tuple[tuple[Item, ...], tuple[Claim, ...]]:
    """Items and claims that ``--only`` names, in the paper's order; all if it is None.

    Raises
    ------
    InputError
        If a key is unknown.
    """
    if only is None:
        return items, claims
    known = [*(item.key for item in items), _CLAIMS]
    keys = [key.strip() for key in only.split(",")]
    for key in keys:
        if key not in known:
            raise InputError(f"--only: {key!r} is unknown; {', '.join(known)} are accepted")
    return tuple(item for item in items if item.key in keys), claims if _CLAIMS in keys else ()


def _facts(found: Report) -> dict[str, Any]:
    return {
        "verdicts": {str(verdict): count for verdict, count in found.counts.items()},
        "kinds": {
            str(kind): {str(verdict): count for verdict, count in counts.items()}
            for kind, counts in found.kinds.items()
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
            for one in found.judged
        ],
    }


def _text(found: Report) -> RenderableType:
    from rich.console import Group
    from rich.padding import Padding
    from rich.text import Text

    from vibroimpact.paper.claim import Verdict

    parts: list[RenderableType] = []
    if found.judged:
        parts.append(Text(f"Statements of the paper: {len(found.judged)}"))
        parts += [Text(f"  {count:3} {verdict}") for verdict, count in found.counts.items()]
        parts += [Text(), Text("By kind")]
        for kind, counts in found.kinds.items():
            told = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
            parts.append(Text(f"  {kind}: {told}"))
        lost = found.of(Verdict.NOT_REPRODUCED)
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
