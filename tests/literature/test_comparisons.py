"""The rows of `docs/validation.md`: each agrees as far as its source allows, or says that not."""

from __future__ import annotations

from functools import cache

import pytest

from literature.comparisons import table
from literature.comparisons.comparison import AbsentError, Comparison

QUICK = {"heyoka 7.13.2", "OpenSeesPy 3.7.1.2"}


def name(one: Comparison) -> str:
    return f"{one.source}: {one.quantity}"


@cache
def ours(at: int) -> float:
    return float(table.COMPARISONS[at].ours())


@pytest.mark.parametrize(
    "at", range(len(table.COMPARISONS)), ids=[name(one) for one in table.COMPARISONS]
)
def test_it_agrees_as_far_as_the_source_allows(at: int) -> None:
    one = table.COMPARISONS[at]
    try:
        assert table.agrees(one, ours(at)) is (not one.differs)
        expected = table.row(one._replace(ours=lambda: ours(at)))
    except AbsentError as error:
        pytest.skip(f"it needs {error}")
    shown = table.PAGE.read_text(encoding="utf-8").splitlines()
    assert expected in shown, "python tests/literature/comparisons/table.py writes the page anew"


AGAIN = [one for one in table.COMPARISONS if one.again is not None]


@pytest.mark.parametrize("one", AGAIN, ids=[name(one) for one in AGAIN])
def test_the_other_program_still_gives_its_number(one: Comparison, request) -> None:
    if one.source not in QUICK and not request.config.getoption("full"):
        pytest.skip("it takes seconds; --full")
    try:
        again = one.again()
    except AbsentError as error:
        pytest.skip(f"it needs {error}")
    assert again == pytest.approx(one.value, abs=Comparison("", "", one.theirs, one.ours).allowed)


def test_rows_are_told_apart_and_the_page_has_no_others() -> None:
    assert len({(one.source, one.quantity) for one in table.COMPARISONS}) == len(table.COMPARISONS)
    text = table.PAGE.read_text(encoding="utf-8")
    shown = text[text.index(table.BEGIN) : text.index(table.END)]
    assert shown.count("\n| ") == len(table.COMPARISONS) + 2


def test_what_cannot_be_computed_here_stays_as_it_was(monkeypatch) -> None:
    def absent() -> float:
        raise AbsentError("a file")

    one = Comparison("somebody", "something", "1.0", absent)
    monkeypatch.setattr(table, "COMPARISONS", [one])
    before = "| somebody | something | 1.0 | 1.01 | +1.00% | 5.0% |"
    line = before.removesuffix(" |") + "; not computed in this build: it needs a file |"
    assert list(table.rows({})) == [
        "| somebody | something | – | – | not computed in this build: it needs a file | – |"
    ]
    assert table.table(before).splitlines()[-1] == line
    assert table.table(line).splitlines()[-1] == line


@pytest.mark.parametrize(
    ("theirs", "value", "allowed", "agrees"),
    [
        ("0.076", 0.0764, 5e-4, True),
        ("0.076", 0.0766, 5e-4, False),
        ("-1.36", -1.3566, 5e-3, True),
        ("12", 11.0, 0.5, False),
        ("2.5e-3", 2.54e-3, 5e-5, True),
        ("1.0", float("nan"), 0.05, False),
    ],
)
def test_half_a_unit_of_the_last_digit(theirs, value, allowed, agrees) -> None:
    one = Comparison("", "", theirs, lambda: value)
    assert one.allowed == pytest.approx(allowed)
    assert table.agrees(one, value) is agrees
