"""What the README promises: short, with a picture that is made here, and how to cite."""

from __future__ import annotations

import re

import yaml

import vibroimpact as vi
from docs.snippets import PAGES, PICTURE, ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))


def test_it_is_short():
    assert README.count("\n") <= 150


def test_it_shows_what_make_demo_prints():
    demo = re.search(
        r"^demo:.*\n\t@\$\(BIN\)/(vibroimpact .*)$", (ROOT / "Makefile").read_text(), re.M
    )
    first = re.search(r"^```console\n\$ (.*)\n(?s:(.*?))^```$", README, re.M)
    assert first[1] == demo[1]
    assert "\n..." not in first[2]


def test_pictures_are_there():
    for page in PAGES:
        for target in PICTURE.findall(page.read_text(encoding="utf-8")):
            assert (page.parent / target).is_file(), f"{page.name} shows {target}"


def test_its_pictures_are_made_by_what_it_names():
    picture, fitted = PICTURE.findall(README)
    (script,) = re.findall(r"\]\((examples/\w+\.py)\)", README)
    for drawn, by in ((picture, script), (fitted, "docs/tutorials/experimenter.md")):
        assert drawn.rsplit("/", 1)[1] in (ROOT / by).read_text(encoding="utf-8")
        assert f"]({by})" in README


def test_the_numbers_of_its_building_stand_in_the_tutorial_that_computes_them():
    (building,) = re.findall(r"^\*\*A building.*?^$", README, re.M | re.S)
    (tutorial,) = re.findall(r"\]\((docs/tutorials/\w+\.md)\)", building)
    printed = (ROOT / tutorial).read_text(encoding="utf-8")
    numbers = re.findall(r"\d[\d.,]*\d", building)
    assert len(numbers) >= 7
    for number in numbers:
        assert re.search(rf"(?<![\d.]){re.escape(number)}\b", printed), number


def test_the_strip_of_the_explorer_is_drawn_by_its_script():
    page = (ROOT / "docs/how-to/explore.md").read_text(encoding="utf-8")
    script = (ROOT / "tests/explorer/strip.py").read_text(encoding="utf-8")
    assert PICTURE.findall(page)[-1].rsplit("/", 1)[1] in script


def test_citations():
    for key in ("cff-version", "message", "title", "authors"):
        assert CITATION[key]
    assert CITATION["cff-version"] == "1.2.0"
    assert CITATION["version"] == vi.__version__
    assert CITATION["license"] == "BSD-3-Clause"
    (paper,) = CITATION["references"]
    words = " ".join(README.split())
    assert paper["title"] in words
    for author in paper["authors"]:
        assert author["family-names"] in words
