"""The page without a server."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.explorer.family import VALUES, family, page

PAGE = Path(__file__).parents[2] / "docs/explorer.html"


@pytest.fixture(scope="module")
def held():
    text = PAGE.read_text(encoding="utf-8")
    return json.loads(re.search(r'id="family">(.*?)</script>', text, re.DOTALL)[1])


def test_the_page_of_the_documentation_is_that_of_today(held):
    few = (VALUES[0], VALUES[6], VALUES[-1])
    fresh = family(few)
    for value, member in zip(few, fresh["members"], strict=True):
        there = held["members"][VALUES.index(value)]
        assert there["scenario"]["scenario"] == member["scenario"]["scenario"]
        for k in range(2):
            for direction in ("forward", "backward"):
                np.testing.assert_allclose(
                    there["curves"]["panels"][k]["curves"][direction],
                    member["curves"]["panels"][k]["curves"][direction],
                    rtol=1e-3,
                )
    with_these = page(held)
    assert with_these == PAGE.read_text(encoding="utf-8")
    scenarios = [member["scenario"]["scenario"] for member in held["members"]]
    assert {"S5", "S3", "S2", "S0"} <= set(scenarios)


def test_its_numbers_are_those_of_a_sweep(held):
    curves = vi.sweep("B2-G1-A3", held["members"][held["start"]]["curves"]["frequency"])
    there = held["members"][held["start"]]["curves"]["panels"][0]["curves"]["forward"]
    np.testing.assert_allclose(there, curves["eta_a"].sel(direction="forward"), rtol=1e-4)


def test_it_is_played_with(browser):
    shown = browser.new_page()
    said = []
    shown.on("console", lambda one: said.append(one.text))
    shown.on("pageerror", lambda one: said.append(str(one)))
    shown.goto(PAGE.as_uri())
    curve = shown.locator("#panels [data-name='forward']").first
    before = curve.get_attribute("d")
    assert shown.inner_text("#value") == "7.5 mm"
    shown.focus("#knob")
    for _ in range(8):
        shown.keyboard.press("ArrowRight")
    assert shown.inner_text("#value") == "17.5 mm"
    assert curve.get_attribute("d") != before
    assert shown.inner_text("#scenario-name") == "S2"
    shown.close()
    assert said == []
