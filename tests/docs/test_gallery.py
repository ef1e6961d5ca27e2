"""The gallery: every figure function is in it, and its scripts run."""

from __future__ import annotations

import ast

import pytest
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from numpy import ravel

from docs.snippets import ROOT
from samples import sample
from vibroimpact import figures

SCRIPTS = sorted((ROOT / "gallery").glob("*/*.py"))
DRAWN = [path for path in SCRIPTS if "explorer" not in path.parent.name]


def test_it_is_large():
    assert len(DRAWN) >= 30
    assert len({path.name for path in SCRIPTS}) == len(SCRIPTS)


def test_every_figure_function_is_in_it():
    text = "\n".join(path.read_text(encoding="utf-8") for path in SCRIPTS)
    used = {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
    assert set(figures.__all__) - used == set()


def test_every_folder_says_what_it_shows():
    for folder in {path.parent for path in SCRIPTS}:
        assert (folder / "GALLERY_HEADER.rst").is_file(), folder.name


@pytest.mark.parametrize("path", DRAWN[:: sample(1, 60)], ids=lambda path: path.stem)
def test_a_script_ends_with_its_picture(path):
    *before, last = ast.parse(path.read_text(encoding="utf-8")).body
    values = {"__name__": "__main__"}
    exec(compile(ast.Module(before, []), str(path), "exec"), values)
    assert isinstance(last, ast.Expr)
    shown = eval(compile(ast.Expression(last.value), str(path), "eval"), values)
    first = shown if isinstance(shown, Figure) else ravel(shown)[0]
    assert isinstance(first, Figure | Artist)
    assert first.get_figure(root=True).axes
