"""The report: whole, well-formed, and the same statements in both of its files."""

from __future__ import annotations

from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from paper.claim import Claim, Finding, Verdict
from paper.claims import CLAIMS
from paper.claims.reasons import REASONS
from paper.report import Report, compute, write
from paper.report_item import Item, Table
from paper.study import PublishedStudy

_VOID = {"meta", "img", "br", "hr", "link", "input"}


class Page(HTMLParser):
    """Reads a page; fails where elements are not closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in _VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join("".join(self.words).split())

    def attributes(self, tag: str, name: str) -> list[str]:
        return [attrs[name] or "" for kind, attrs in self.tags if kind == tag and name in attrs]


def draw(study: PublishedStudy) -> Figure:
    figure = Figure()
    figure.subplots().plot([0, 1], [1, 0])
    return figure


def table(study: PublishedStudy) -> Table:
    return Table(("name", "a < b | c"), (("first", "1 & 2"), ("second", "x | y")))


ITEMS = (
    Item("fig90", "Fig. 90: a line", "A line that falls, with 1 < 2 & more.", draw=draw),
    Item("table9", "Table 9: words", "Two rows.", table=table),
)


def stub(claim: Claim, number: int) -> Claim:
    """A claim that needs no computation; the verdicts take turns."""
    holds = (True, False, None)[number % 3]
    return claim._replace(find=lambda study: Finding(holds, f"X < {number} & y | {number} Hz"))


@pytest.fixture
def made(tmp_path) -> tuple[Report, dict[str, Path]]:
    claims = tuple(stub(claim, k) for k, claim in enumerate(CLAIMS))
    report = compute(PublishedStudy(), tmp_path, ITEMS, claims)
    return report, write(report, tmp_path)


def test_files(made, tmp_path):
    _, files = made
    assert files == {"markdown": tmp_path / "report.md", "html": tmp_path / "report.html"}
    names = {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*") if p.is_file()}
    assert names == {"report.md", "report.html", "figures/fig90.png"}


def test_html(made, tmp_path):
    report, files = made
    source = files["html"].read_text(encoding="utf-8")
    page = Page(source)
    assert source.lstrip().lower().startswith("<!doctype html>")
    assert page.attributes("html", "lang") == ["en"]
    ids = [value for tag, attributes in page.tags if (value := attributes.get("id"))]
    assert len(set(ids)) == len(ids)
    assert {claim.key for claim in CLAIMS} | {"fig90", "table9"} <= set(ids)
    for image in page.attributes("img", "src"):
        assert (tmp_path / image).is_file()
    assert page.attributes("img", "alt") == ["Fig. 90: a line"]
    for target in page.attributes("a", "href"):
        assert target[1:] in ids if target.startswith("#") else (tmp_path / target).is_file()
    for claim in CLAIMS:
        assert claim.statement in page.text
        assert claim.quantity in page.text
    assert "X < 4 & y | 4 Hz" in page.text
    assert "A line that falls, with 1 < 2 & more." in page.text
    # Nothing is fetched from elsewhere.
    assert "http" not in source
    assert "<script" not in source
    linked = page.attributes("a", "href")
    for one in report.judged:
        assert (f"#{one.claim.key}" in linked) == (one.finding.holds is not True)
    count = sum(one.finding.verdict is Verdict.NOT_REPRODUCED for one in report.judged)
    assert source.count('<td class="verdict no">not reproduced</td>') == count + 1  # the summary


def test_markdown(made, tmp_path):
    report, files = made
    lines = files["markdown"].read_text(encoding="utf-8").splitlines()
    assert "![Fig. 90: a line](figures/fig90.png)" in lines
    assert "| name | a \\< b \\| c |" in lines
    assert "| second | x \\| y |" in lines
    head = lines.index(
        "| no. | section | statement | quantity and criterion | kind | verdict | result |"
    )
    rows = lines[head + 2 : head + 2 + len(CLAIMS)]
    for one, row in zip(report.judged, rows, strict=True):
        cells = [cell.strip() for cell in row.replace("\\|", "/").strip("|").split("|")]
        assert len(cells) == 7
        assert cells[0] == f'<a id="{one.claim.key}"></a>{one.place}'
        assert cells[1] == one.claim.section
        assert cells[4:6] == [one.claim.kind, one.finding.verdict]
    # Tables are not broken by empty lines, and stand apart from what is before them.
    for before, line in pairwise(lines):
        if line.startswith("| ---"):
            assert before.startswith("| ")
        if line.startswith("#"):
            assert not before
    for verdict, count in report.counts.items():
        by_kind = [counts[verdict] for counts in report.kinds.values()]
        assert sum(by_kind) == count
        assert f"| {' | '.join(map(str, (verdict, *by_kind, count)))} |" in lines
    for one in (*report.of(Verdict.NOT_REPRODUCED), *report.of(Verdict.NEEDS_DATA)):
        start = f"- [Statement {one.place}](#{one.claim.key}) "
        assert any(line.startswith(start) for line in lines)


def test_reasons_only_where_not_reproduced(made):
    report, files = made
    text = Page(files["html"].read_text(encoding="utf-8")).text
    for one in report.judged:
        lost = one.finding.verdict is Verdict.NOT_REPRODUCED
        assert bool(one.reason) == (lost and one.claim.key in REASONS)
        assert not one.reason or one.reason in text


def test_a_part_does_not_replace_the_whole(made, tmp_path):
    _, files = made
    before = files["html"].read_bytes()
    part = compute(PublishedStudy(), tmp_path, ITEMS[:1], (), whole=False, figure="svg")
    assert write(part, tmp_path)["html"] == tmp_path / "fig90.html"
    assert files["html"].read_bytes() == before
    page = Page((tmp_path / "fig90.html").read_text(encoding="utf-8"))
    assert page.attributes("img", "src") == ["figures/fig90.svg"]
    assert "part of the report" in page.text
    assert "Not reproduced" not in page.text
    assert (tmp_path / "figures/fig90.svg").read_text(encoding="utf-8").startswith("<?xml")


def test_progress(tmp_path):
    seen = []
    claims = (stub(CLAIMS[0], 0),)
    compute(PublishedStudy(), tmp_path, ITEMS, claims, progress=lambda *step: seen.append(step))
    assert seen == [(1, 3), (2, 3), (3, 3)]
