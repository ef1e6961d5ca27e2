"""The report: all figures of the paper, computed again, and a verdict on each statement."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined

from paper.claim import Claim, Finding, Kind, Verdict
from paper.claims.reasons import REASONS
from paper.report_item import Item, Table
from paper.study import PublishedStudy
from vibroimpact._version import __version__
from vibroimpact.datasets.files import write_whole
from vibroimpact.figures import save_figure
from vibroimpact.model import GRAVITY, laboratory
from vibroimpact.scenarios.scenario import Scenario

Format = Literal["png", "svg"]
Progress = Callable[[int, int | None], None]

FIGURES = "figures"
"""Folder of the images, next to the report."""
_GRAZING = ("Ginf", "no bumpers: free flight")


class Shown(NamedTuple):
    """A figure or table in the report."""

    item: Item
    image: str | None
    """Path of the image, relative to the folder of the report."""
    table: Table | None


class Judged(NamedTuple):
    """A statement and its verdict."""

    claim: Claim
    finding: Finding
    place: int
    """Number of the statement in the report, starting from 1."""

    @property
    def reason(self) -> str:
        """The reason why the statement is not reproduced. Empty if there is none."""
        lost = self.finding.verdict is Verdict.NOT_REPRODUCED
        return REASONS.get(self.claim.key, "") if lost else ""


class Report(NamedTuple):
    """All computed figures, tables and statements."""

    shown: tuple[Shown, ...]
    judged: tuple[Judged, ...]
    whole: bool
    """Whether the report is complete, so that the user left out no part."""

    @property
    def counts(self) -> dict[Verdict, int]:
        """Number of statements by verdict."""
        verdicts = [one.finding.verdict for one in self.judged]
        return {verdict: verdicts.count(verdict) for verdict in Verdict}

    @property
    def kinds(self) -> dict[Kind, dict[Verdict, int]]:
        """Number of statements by kind and verdict. Kinds without statements are left out."""
        pairs = [(one.claim.kind, one.finding.verdict) for one in self.judged]
        return {
            kind: {verdict: pairs.count((kind, verdict)) for verdict in Verdict}
            for kind in Kind
            if any(kind is own for own, _ in pairs)
        }

    def of(self, verdict: Verdict) -> tuple[Judged, ...]:
        """Return the statements with a given verdict."""
        return tuple(one for one in self.judged if one.finding.verdict is verdict)

    @property
    def stem(self) -> str:
        """Name of the files. A partial report is named after its parts."""
        keys = [one.item.key for one in self.shown] + ["claims"] * bool(self.judged)
        return "report" if self.whole else "-".join(keys)


def compute(
    study: PublishedStudy,
    folder: Path,
    items: Sequence[Item],
    claims: Sequence[Claim],
    *,
    whole: bool = True,
    figure: Format = "png",
    progress: Progress | None = None,
) -> Report:
    """Judge the claims, draw the items, and write the images.

    Parameters
    ----------
    study
        The study with its computations.
    folder
        Folder of the report, which must exist. Images are written into its folder ``figures``.
    items, claims
        Items and claims that are computed.
    whole
        Whether these are all items and claims.
    figure
        File format of the images.
    progress
        Function that is called with the number of completed items and claims, and their total
        number.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    total = len(items) + len(claims)
    done = 0

    def step() -> None:
        nonlocal done
        done += 1
        if progress:
            progress(done, total)

    judged = []
    for place, claim in enumerate(claims, 1):
        judged.append(Judged(claim, claim.find(study), place))
        step()
    shown = []
    for item in items:
        shown.append(_shown(study, folder, item, figure))
        step()
    return Report(tuple(shown), tuple(judged), whole)


def _shown(study: PublishedStudy, folder: Path, item: Item, figure: Format) -> Shown:
    table = item.table(study) if item.table else None
    if item.draw is None:
        return Shown(item, None, table)
    (folder / FIGURES).mkdir(exist_ok=True)
    image = f"{FIGURES}/{item.key}.{figure}"
    save_figure(item.draw(study), folder / image)
    return Shown(item, image, table)


def write(report: Report, folder: Path) -> dict[str, Path]:
    """Write the report as Markdown and as HTML.

    Returns
    -------
    dict
        Paths of the files ``"markdown"`` and ``"html"``.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    names = {"markdown": "report.md.jinja", "html": "report.html.jinja"}
    files = {}
    for kind, template in names.items():
        text = _environment().get_template(template).render(report=report, **_facts())
        path = folder / f"{report.stem}{Path(template).stem.removeprefix('report')}"
        files[kind] = write_whole(path, text)
    return files


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("paper", "templates"),
        autoescape=lambda name: name is not None and name.endswith(".html.jinja"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["cell"] = _cell
    environment.filters["row"] = _row
    environment.filters["capital"] = _capital
    return environment


def _cell(text: str) -> str:
    """Escape a text for a cell of a Markdown table, without accidental emphasis."""
    plain = " ".join(text.split())
    for sign in "\\|*_<":
        plain = plain.replace(sign, f"\\{sign}")
    return plain


def _capital(text: str) -> str:
    """Capitalise the first letter of a text, unless it is a symbol such as η."""
    return text[:1].upper() + text[1:] if text[:1].isascii() else text


def _row(cells: Iterable[str]) -> str:
    """Return a row of a Markdown table."""
    return f"| {' | '.join(_cell(cell) for cell in cells)} |"


def _facts() -> dict[str, Any]:
    """Describe the rig for the introduction, from its parameters."""
    return {
        "version": __version__,
        "Verdict": Verdict,
        "Kind": Kind,
        "mass": f"{laboratory.MASS:g} kg",
        "glossary": (
            Table(
                ("bumper", "stiffness"),
                tuple((b, f"{1e-3 * k:g} kN/m") for b, k in laboratory.BUMPERS.items()),
            ),
            Table(
                ("gap", "total gap of both sides"),
                (*((g, f"{1e3 * w:g} mm") for g, w in laboratory.GAPS.items()), _GRAZING),
            ),
            Table(
                (
                    "acceleration",
                    "peak acceleration of the table",
                    "equivalent stiffness of the isolator",
                ),
                tuple(
                    (
                        a,
                        f"{x / GRAVITY:.2f} g",
                        f"{1e-3 * laboratory.ISOLATOR_STIFFNESS[a]:.1f} kN/m",
                    )
                    for a, x in laboratory.ACCELERATIONS.items()
                ),
            ),
        ),
        "scenarios": Table(
            ("scenario", "shape of the resonance curves"),
            tuple((s.label, s.meaning) for s in Scenario if s is not Scenario.UNCLASSIFIED),
        ),
    }
