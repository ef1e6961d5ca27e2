"""By default, figures show η only for published cases, in Python and on the command line alike."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact import figures
from vibroimpact.cli import main

CASE = "B2-G1-A3"
GRID = [1.5, 2.0, 2.5]
SPAN = (1.95, 2.05)
GAP = {"gap": "normal:5%"}

RIGS = {
    "code": (CASE, True),
    "rig of a case": (vi.laboratory.case(CASE).rig, True),
    "case with other gaps": (
        vi.laboratory.case(CASE).rig.with_parts(
            vi.laboratory.case("B2-G2-A3").oscillator, vi.Harmonic("0.05 g", 1.0)
        ),
        True,
    ),
    "own rig": (vi.Rig(vi.laboratory.case(CASE).oscillator, "0.05 g"), False),
    "study of a case": ("case.toml", False),
    "own study": ("own.toml", False),
}

FIGURES = {
    "resonance_curves": (
        lambda rig: figures.resonance_curves(vi.sweep(rig, GRID)),
        ["normalised excursion of absolute acceleration $\\eta_a$ (–)"],
        ["largest absolute acceleration (g)"],
    ),
    "resonance_family": (
        lambda rig: figures.resonance_family(vi.sweeps([rig, rig], GRID)),
        ["\\eta_d"],
        ["E_d$ (mm)"],
    ),
    "branch_diagram of a branch": (
        lambda rig: figures.branch_diagram(vi.branch(rig, frequency=2.0, vary={"frequency": SPAN})),
        ["$\\eta_d$ (–)"],
        ["largest displacement (mm)"],
    ),
    "branch_diagram of all branches": (
        lambda rig: figures.branch_diagram(
            vi.resonance_diagram(rig, {"frequency": SPAN}, longest=1, starts=2, random=0)
        ),
        ["$\\eta_d$ (–)"],
        ["largest displacement (mm)"],
    ),
    "resonance_bands": (
        lambda rig: figures.resonance_bands(
            vi.ensemble(rig, GAP, partial(vi.sweeps, frequencies=GRID), 4)
        ),
        ["$\\eta_a$ (–)", "$\\eta_d$ (–)"],
        ["largest absolute acceleration (g)", "largest displacement (mm)"],
    ),
}

COMMANDS = {
    "sweep": (("--frequencies", "1.5Hz,2Hz"), "eta_a", "(g)"),
    "branch": (
        ("--vary", "frequency=1.95Hz:2.05Hz", "--longest", "1", "--random", "0"),
        "eta_d",
        "largest displacement (mm)",
    ),
    "ensemble": (
        ("--uncertain", "gap=normal:5%", "--draws", "4", "--frequencies", "1.5Hz,2Hz"),
        "eta_a",
        "(g)",
    ),
}


@pytest.fixture(autouse=True)
def studies(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(f'case = "{CASE}"\n', encoding="utf-8")
    (tmp_path / "own.toml").write_text(
        '[oscillator]\nmass = "550 kg"\n'
        'isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }\n'
        'right = { stiffness = "280 kN/m", damping = "2 kN s/m", gap = "8 mm" }\n'
        'left = { stiffness = "280 kN/m", damping = "2 kN s/m", gap = "8 mm" }\n'
        '[excitation]\namplitude = "0.05 g"\n',
        encoding="utf-8",
    )


def labels(drawn) -> list[str]:
    axes = np.ravel(np.asarray(drawn, dtype=object))
    return [" ".join(ax.get_ylabel().split()) for ax in axes]


EACH = sample(
    [(rig, figure) for rig in RIGS for figure in FIGURES],
    [*((rig, "resonance_curves") for rig in RIGS), *(("own rig", figure) for figure in FIGURES)],
)


@pytest.mark.parametrize(("rig", "figure"), EACH)
def test_in_python(rig, figure):
    (rig, published), (draw, eta, physical) = RIGS[rig], FIGURES[figure]
    texts = labels(draw(rig))
    expected = eta if published else physical
    assert len(texts) >= len(expected)
    assert [part in text for part, text in zip(expected, texts, strict=False)] == [True] * len(
        expected
    )


def test_a_family_with_an_own_rig_is_drawn_in_its_units():
    family = vi.sweeps([RIGS["code"][0], RIGS["own rig"][0]], GRID)
    assert "(mm)" in labels(figures.resonance_family(family))[0]


@pytest.mark.parametrize(
    ("rig", "published"),
    sample([RIGS["code"], RIGS["study of a case"], RIGS["own study"]], [RIGS["own study"]]),
)
@pytest.mark.parametrize("command", sample([*COMMANDS], ["sweep", "branch"]))
def test_on_the_command_line(command, rig, published, monkeypatch):
    options, eta, physical = COMMANDS[command]
    drawn = []

    def kept(figure, path, **others):
        drawn.append(labels(figure)[0])
        return path

    monkeypatch.setattr(figures, "save_figure", kept)
    for option, shows_eta in ((None, published), ("--physical", False), ("--normalised", True)):
        words = [command, rig, *options, *([option] if option else [])]
        assert main(words) == 0
        assert (eta if shows_eta else physical) in drawn[-1]


def test_no_eta_where_the_motion_without_stops_is_unbounded():
    """Not even for a published rig: curves divided by a resonance without damping are flat."""
    case = vi.laboratory.case(CASE)
    undamped = case.oscillator.replace(isolator=case.oscillator.isolator.replace(damping=0.0))
    rig = case.rig.with_parts(undamped)
    assert rig.published
    for draw, data in (
        (figures.resonance_curves, vi.sweep(rig, GRID)),
        (figures.branch_diagram, vi.branch(rig, frequency=2.0, vary={"frequency": SPAN})),
        (figures.resonance_bands, vi.ensemble(rig, GAP, partial(vi.sweeps, frequencies=GRID), 4)),
    ):
        assert "eta" not in " ".join(labels(draw(data)))
