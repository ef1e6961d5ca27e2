"""CONTRIBUTING names files and folders that exist; the contents name every decision."""

from __future__ import annotations

import re

from docs.snippets import ROOT

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
PACKAGE = ROOT / "src" / "vibroimpact"
BELOW = (ROOT, PACKAGE, PACKAGE / "engine")


def test_the_paths_are_there():
    paths = set(re.findall(r"`((?:[\w.-]+/)*[\w-]+(?:\.py|\.txt|\.toml|\.md|/))`", PAGE))
    assert len(paths) > 40
    missing = {path for path in paths if not any((at / path).exists() for at in BELOW)}
    assert missing == set()


def test_what_a_file_is_said_to_have_is_in_it():
    """As `slopes` of `taylor/carry.py`."""
    said = re.findall(
        r"`([A-Za-z_]\w*)`(?: and `([A-Za-z_]\w*)`)?\s+(?:of|in)\s+`([\w/]+\.py)`", PAGE
    )
    assert len(said) > 30
    for *names, path in said:
        file = next(at / path for at in BELOW if (at / path).exists())
        words = set(re.findall(r"\w+", file.read_text(encoding="utf-8")))
        assert set(filter(None, names)) <= words, path


def test_a_folder_of_the_package_has_its_row():
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert folders <= set(re.findall(r"^\| `(\w+)/` \|", PAGE, re.M))


def test_every_module_of_the_engine_has_its_row():
    rows = re.findall(r"^\| (`.*?) \| ", PAGE, re.M)
    named = {name for row in rows for name in re.findall(r"`(\w+)\.py`", row)}
    modules = {path.stem for path in (PACKAGE / "engine").glob("*.py")} - {"__init__"}
    assert modules <= named | {"entry"}


def test_decisions_are_listed():
    pages = {path.name for path in (ROOT / "docs" / "decisions").glob("0*.md")}
    contents = (ROOT / "docs" / "decisions" / "index.md").read_text(encoding="utf-8")
    assert pages == set(re.findall(r"\]\(([\w-]+\.md)\)", contents))
