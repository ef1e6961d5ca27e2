"""``vibroimpact paper``: compute the published study again, with a verdict per statement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.paper.claim import Claim
    from vibroimpact.paper.item import Item

_CLAIMS = "claims"


@calls(None, "Parts")
def paper(
    *,
    only: opt.Text = None,
    threads: opt.Threads = None,
    output: opt.OutputFolder = "out/paper",
    figure: Annotated[Literal["png", "svg"], Parameter(group=opt.OUTPUT)] = "png",
    json: opt.Json = False,
) -> int:
    """Recompute the results of the paper on the published tests, and check its statements.

    The paper is "Scenarios in the experimental response of a vibro-impact single-degree-of-freedom
    system and numerical simulations" by Stefani, De Angelis and Andreaus.

    The report contains all figures and tables of the paper that the model can compute. The command
    also checks statements of the paper about the response of the tested rigs. For each statement,
    the report gives the computed values and a verdict: reproduced, not reproduced, or not testable
    without the measured data. If a statement is not reproduced, the command does not fail.

    The report also counts the verdicts by kind of statement, because not all kinds are equally
    strong tests of the model. Some statements are real tests, because the computation could have
    contradicted them. Other statements must hold because of the classification rules, the inputs or
    the equations.

    The command writes these files:

    - report.md and report.html: the report with all figures, tables and statements
    - figures: a folder with the images of the report

    For example:

        vibroimpact paper
        vibroimpact paper --only claims --json
        vibroimpact paper --only fig15,fig16 --output results --figure svg

    Parameters
    ----------
    only
        Parts of the paper that are computed, separated by commas. A part is a figure or table, such
        as fig15 or table1, or the word "claims" for all statements. The report is then named after
        these parts, such as fig15.md and fig15.html. Default: all parts.
    output
        Folder for the written files (default: out/paper). A missing folder is created.
    figure
        File format of the figures.
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.model.count_checks import whole
    from vibroimpact.paper import report, summary
    from vibroimpact.paper.claims import CLAIMS
    from vibroimpact.paper.items import ITEMS
    from vibroimpact.paper.study import PublishedStudy

    if threads is not None:
        threads = whole(threads, "threads")
    items, claims = chosen(only, ITEMS, CLAIMS)
    with output_folder(output) as folder:
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
    tell(summary.text(found), summary.facts(found), folder, {**files, **images}, json)
    return 0


def chosen(
    only: str | None, items: tuple[Item, ...], claims: tuple[Claim, ...]
) -> tuple[tuple[Item, ...], tuple[Claim, ...]]:
    """Return the items and claims that ``--only`` names, in the order of the paper.

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
            raise InputError(
                f"--only: {key!r} is unknown; pass one or more of these, separated by commas: "
                f"{', '.join(known)}"
            )
    return tuple(item for item in items if item.key in keys), claims if _CLAIMS in keys else ()
