"""What README and docs show is what happens."""

from __future__ import annotations

import codeop
import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

import samples
from docs.snippets import FENCE, PAGES, PICTURE, ROOT, run_page

LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)")


def name(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_blocks_run_and_print_what_is_shown(page, tmp_path, monkeypatch, blank_pictures):
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    try:
        for shown in run_page(text, name(page), samples.full):
            line = text.count("\n", 0, shown.start) + 1
            assert shown.agrees, (
                f"{name(page)}:{line} shows\n{shown.expected}\nbut this is printed\n{shown.printed}"
            )
    finally:
        plt.close("all")
    if page.parent.name == "tutorials" and samples.full:
        assert all(any(Path().rglob(Path(target).name)) for target in PICTURE.findall(text))


@pytest.mark.parametrize(
    "page", [page for page in PAGES if page.name != "CONTRIBUTING.md"], ids=name
)
def test_blocks_can_be_pasted_into_the_prompt(page):
    """Where a statement with a body ends at an empty line, and not before."""
    text = page.read_text(encoding="utf-8")
    for block in FENCE.finditer(text):
        if block[1] in ("python", "py"):
            line = text.count("\n", 0, block.start(2)) + 1
            assert refused(block[2]) is None, f"{name(page)}:{line}: {refused(block[2])}"


def refused(code: str) -> str | None:
    """The line at which the interactive prompt refuses a block; None if it takes all."""
    statement: list[str] = []
    compiled = codeop.CommandCompiler()
    for line in [*code.splitlines(), ""]:
        statement.append(line)
        try:
            if compiled("\n".join(statement)) is not None:
                statement.clear()
        except SyntaxError:
            return line
    return "\n".join(statement) or None


def test_what_the_prompt_refuses_is_noticed():
    assert refused("for i in range(3):\n    print(i)\n\nprint(3)\n") is None
    assert refused("for i in range(3):\n    print(i)\nprint(3)\n") == "print(3)"
    assert refused("print(\n") == "print(\n"


@pytest.mark.parametrize(
    "page", [*PAGES, ROOT / "CHANGELOG.md", ROOT / "benchmarks/README.md"], ids=name
)
def test_links_lead_somewhere(page):
    for target in LINK.findall(page.read_text(encoding="utf-8")):
        path, _, heading = target.partition("#")
        there = (page.parent / path).resolve() if path else page
        assert "://" in target or there.exists(), f"{name(page)} links to {target}"
        if heading and there.suffix == ".md":
            assert heading in anchors(there), f"{name(page)} links to {target}"


def anchors(page: Path) -> set[str]:
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_a_wrong_page_is_noticed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = "```python\nprint(1)\nprint(2)\n```\n\n```text\n{}\n```\n"
    assert [shown.agrees for shown in run_page(page.format("1\n2"))] == [True]
    assert [shown.agrees for shown in run_page(page.format("..."))] == [True]
    assert [shown.agrees for shown in run_page(page.format("1\n3"))] == [False]
    assert [shown.agrees for shown in run_page("```python\nprint(1)\n```\n")] == [False]
    later = f"<!--full-run-->\n\n{page.format('3')}"
    assert [shown.agrees for shown in run_page(later)] == [False]
    assert list(run_page(later, full=False)) == []
    wrong = "```console\n$ vibroimpact sweep B9-G1-A3\n{}```\n"
    assert [shown.agrees for shown in run_page(wrong.format(""))] == [False]
    with pytest.raises(AssertionError, match="ended with 2"):
        list(run_page(wrong.format("...\n")))
    with pytest.raises(AssertionError, match="vibroimpact only"):
        list(run_page("```console\n$ rm -r x\n```\n"))
