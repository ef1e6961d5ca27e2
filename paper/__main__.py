"""Compute the published study again, with a verdict on each statement: `make paper`.

The report has all figures and tables of the paper that the model can compute. For each statement
it gives the computed values and a verdict: reproduced, not reproduced, or not testable without the
measured data. Verdicts are counted by kind of statement, since not all are equally strong tests:
some could have been contradicted by the computation, others follow from the rules, the inputs or
the equations.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from paper import claims, items, report, summary
from paper.claim import Claim
from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.cli.output import output_folder, progress_bar, tell, warnings_in_lines
from vibroimpact.errors import InputError
from vibroimpact.model.argument_types import whole
from vibroimpact.stderr import print_line

_CLAIMS = "claims"


def main(arguments: Sequence[str] | None = None) -> int:
    """Compute, write the report and print a summary.

    Returns
    -------
    int
        Exit code: 0, or 2 for invalid input. A statement that is not reproduced does not
        make the command fail.
    """
    parser = argparse.ArgumentParser(
        prog="python -m paper",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--only",
        help="parts, separated by commas: figures and tables such as fig15 or table1, or 'claims' "
        "for all statements. Default: all",
    )
    parser.add_argument("--threads", type=int, help="number of threads. Default: one per processor")
    parser.add_argument("-o", "--output", default="out/paper", help="folder. Default: %(default)s")
    parser.add_argument("--figure", choices=("png", "svg"), default="png", help="format of images")
    parser.add_argument("--json", action="store_true", help="print the summary as JSON")
    words = parser.parse_args(arguments)
    try:
        with warnings_in_lines():
            _compute(words)
    except InputError as error:
        print_line(f"error: {error}")
        return 2
    return 0


def _compute(words: argparse.Namespace) -> None:
    threads = words.threads if words.threads is None else whole(words.threads, "threads")
    chosen = _chosen(words.only, items.ITEMS, claims.CLAIMS)
    with output_folder(words.output) as folder:
        with progress_bar("computing the study") as progress:
            results = report.compute(
                PublishedStudy(threads),
                folder.path,
                *chosen,
                whole=words.only is None,
                figure=words.figure,
                progress=progress,
            )
        files = report.write(results, folder.path)
        images = {one.item.key: folder / one.image for one in results.shown if one.image}
    tell(summary.text(results), summary.facts(results), folder, {**files, **images}, words.json)


def _chosen(
    only: str | None, every: tuple[Item, ...], statements: tuple[Claim, ...]
) -> tuple[tuple[Item, ...], tuple[Claim, ...]]:
    """Return the items and claims that ``--only`` names, in the order of the paper.

    Raises
    ------
    InputError
        If a key is unknown.
    """
    if only is None:
        return every, statements
    known = [*(item.key for item in every), _CLAIMS]
    keys = [key.strip() for key in only.split(",")]
    for key in keys:
        if key not in known:
            raise InputError(
                f"--only: {key!r} is unknown; pass one or more of these, separated by commas: "
                f"{', '.join(known)}"
            )
    return tuple(item for item in every if item.key in keys), statements if _CLAIMS in keys else ()


if __name__ == "__main__":
    sys.exit(main())
