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


@calls(None, "Study")
def paper(
    *,
    only: opt.Text = None,
    threads: opt.Threads = None,
    output: opt.OutputFolder = "out/paper",
    figure: Annotated[Literal["png", "svg"], Parameter(group=opt.OUTPUT)] = "png",
    json: opt.Json = False,
) -> int:
    """Compute the published study again, and compare its statements with the results.

    The command writes report.md and report.html. They contain all figures and tables that the model
    can compute, and the testable statements of the paper. The images are in the folder "figures"
    next to the reports.

    For each statement, the report gives the computed quantity, the numbers on which the verdict is
    based, and the verdict: reproduced, not reproduced, or not testable without the data of the
    experiment. If a statement is not reproduced, the command does not fail. The report counts the
    statements separately by kind, because they are not equally strong tests. The computation could
    have refuted some statements. Others must hold because of the classification rules, the inputs
    or the equations.

    For example:

        vibroimpact paper
        vibroimpact paper --only claims --json
        vibroimpact paper --only fig15,fig16 --output results --figure svg

    Parameters
    ----------
    only
        Parts to compute, separated by commas. A part is the key of a figure or table, such as fig15
        or table1, or the word "claims" for the statements. The report is then named after these
        parts, such as fig15.md and fig15.html. Default: all parts.
    output
        Folder for the files, which is created if it does not exist (default: out/paper).
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
            raise InputError(f"--only: {key!r} is unknown; {', '.join(known)} are accepted")
    return tuple(item for item in items if item.key in keys), claims if _CLAIMS in keys else ()
