"""The evidence in words: what tells the scenario is said, and first."""

from __future__ import annotations

import numpy as np

from scenarios.made import GRID, RIG, bump, inside, made, primary, slope
from vibroimpact.model.rig import Rig
from vibroimpact.scenarios.evidence import evidence
from vibroimpact.scenarios.evidence_text import in_words
from vibroimpact.scenarios.thresholds import Thresholds


def words_of(data, oscillator=RIG.oscillator) -> str:
    return in_words(evidence(Rig(oscillator, RIG.sine), data, 0.01), Thresholds())


def test_a_hysteresis_and_where_it_is():
    words = words_of(made(*primary()))
    assert words.startswith("right hysteresis 1.6")
    assert "no jumps" not in words


def test_a_regular_secondary_resonance():
    peak = bump(0.7, 0.05, 0.5)
    forward, backward = primary()
    assert "secondary resonance at 0.7 Hz" in words_of(made(forward + peak, backward + peak))


def test_motions_that_are_not_regular():
    forward, backward = primary()
    peak = np.where(inside(0.6, 0.8), 0.4, 0.0) + bump(0.7, 0.04, 0.4)
    data = made(forward + peak, backward + peak, period=np.where(inside(0.6, 0.8), 3, 1))
    assert "subharmonic resonance 0.6–0.8 Hz" in words_of(data)


def test_no_contact_and_no_bumper():
    free = 0.1 + bump(1.0, 0.3, 0.1)
    assert words_of(made(free)).startswith("no contact from 0.4–3 Hz; the gap is 0.3 times")
    assert words_of(made(free), RIG.oscillator.without_bumpers()).endswith("there is no bumper")


def test_a_resonance_beyond_the_frequencies():
    rising = slope(GRID[-1])
    assert "the primary resonance lies outside the frequency range" in words_of(made(rising))
