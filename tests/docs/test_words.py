"""Words that the project avoids are noticed in pages, docstrings and messages, but not in code."""

from __future__ import annotations

import pytest

from docs.snippets import ROOT


@pytest.fixture
def avoided(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs")
    from check_words import avoided

    def uses(text, name="page.md"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return [use.removeprefix(f"{path}:") for use in avoided(path)]

    return uses


@pytest.mark.parametrize(
    ("text", "use"),
    [
        ("A warning is\nsaid.", "1: 'is said'; write: is stated, prints"),
        ("\nThis is no rig.", "2: 'is no rig'; write: is not a"),
        (
            "after\n\n```\nwas told\n```\n\nwas told",
            "7: 'told'; write: is reported, prints, states",
        ),
        ("One thread: one a thread.", "1: 'one a thread'; write: one per"),
        (
            "The name tells its unit, from here on.",
            "1: 'tells'; write: states, returns, shows, determines",
        ),
    ],
)
def test_a_use_is_found_at_its_line(avoided, text, use):
    assert avoided(text) == [use]


@pytest.mark.parametrize(
    "text",
    [
        "`told`",
        "```sh\ntold\n```",
        "there\n  is no gap",
        "told apart",
        "Tell a jump from a step",
        "no longer",
    ],
)
def test_other_text_is_left_alone(avoided, text):
    assert avoided(text) == []


def test_of_a_module_its_sentences_are_read(avoided):
    text = 'told = 1  # was told\nx = f"a {told} is told"\n"""\nIt is\n    told.\n"""\n'
    assert avoided(text, "a.py") == [
        "2: 'told'; write: is reported, prints, states",
        "5: 'told'; write: is reported, prints, states",
    ]
