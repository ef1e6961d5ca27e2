"""The site: what checks it notices what is wrong."""

from __future__ import annotations

import re
import subprocess
import sys
from fnmatch import fnmatch

import pytest

from benchmarks.page import chromium
from docs.check_links import broken
from docs.snippets import ROOT

CODE = re.compile(r"^(```+|~~~+).*?^\1", re.M | re.S)
CONTENTS = re.compile(r"^```\{toctree\}\n(.*?)^```", re.M | re.S)


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/other.html").write_text('<h1 id="here">x</h1><a href="../page.html">y</a>')
    page = '<a href="sub/other.html#{}"><img src="{}"></a><a href="https://x.y/z">z</a>'
    (tmp_path / "page.html").write_text(page.format("here", "sub/other.html"))
    assert broken(tmp_path) == []
    (tmp_path / "page.html").write_text(page.format("there", "no.png"))
    assert broken(tmp_path) == ["page.html: no.png", "page.html: sub/other.html#there"]


def test_every_page_stands_in_the_contents_of_another():
    pages = [path for path in (ROOT / "docs").rglob("*.md") if path != ROOT / "docs/index.md"]
    listed = {
        str((page.parent / entry.split("<")[-1].strip("> ")).resolve())
        for page in [*pages, ROOT / "docs/index.md"]
        for contents in CONTENTS.findall(page.read_text(encoding="utf-8"))
        for entry in contents.splitlines()
        if entry and not entry.startswith(":")
    }
    left = {str(page.with_suffix("")) for page in pages}
    assert {page for page in left if not any(fnmatch(page, entry) for entry in listed)} == set()


def test_nothing_is_taken_for_a_comment_or_for_the_end_of_a_cell():
    """A line that begins with % is not shown, and | ends a cell within a formula, too."""
    for page in (ROOT / "docs").rglob("*.md"):
        text = CODE.sub("", page.read_text(encoding="utf-8"))
        for line in text.splitlines():
            assert not line.lstrip().startswith("%"), f"{page.name}: {line}"
            if line.startswith("|"):
                cells = re.split(r"(?<!\\)\|", line)
                assert not any(cell.count("$") % 2 for cell in cells), f"{page.name}: {line}"


def test_a_page_that_is_wider_than_a_telephone_is_found(tmp_path):
    """In a process of its own, for a browser may be open in this one."""

    def checked():
        words = (sys.executable, ROOT / "docs/check_widths.py", tmp_path)
        done = subprocess.run(words, capture_output=True, text=True)
        return done.returncode, done.stdout

    if chromium() is None:
        pytest.skip("no browser")
    page = '<meta name="viewport" content="width=device-width"><div style="width:{}px">x</div>'
    (tmp_path / "docs/gallery").mkdir(parents=True)
    for name in ("page.html", "docs/gallery/index.html"):
        (tmp_path / name).write_text(page.format(300))
    assert checked() == (0, "no page is wider than a telephone\n")
    (tmp_path / "page.html").write_text(page.format(900))
    code, report = checked()
    assert code == 1
    assert re.fullmatch(r"page\.html: 9\d\d pixels wide on a screen of 390\n", report)
