"""What is heard of the motion that is shown, by an ear at the browser's sound."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi

CHAOTIC = "S4: motions that are not regular (B3, 10 mm, A3)"
EAR = """() => {
    window.heard = [];
    window.AudioContext = class extends AudioContext {
        constructor() { super(); window.ear = this; }
        get currentTime() { return performance.now() / 1000; }
        createOscillator() {
            const tone = super.createOscillator();
            const side = () => (tone.frequency.value > 300 ? 1 : -1);
            tone.start = (when) => window.heard.push([when, this.last, side()]);
            tone.stop = () => {};
            return tone;
        }
        createGain() {
            const one = super.createGain();
            one.gain.setValueAtTime = (value) => (this.last = value);
            one.gain.exponentialRampToValueAtTime = () => {};
            return one;
        }
    };
}"""
"""Notes when tones begin (s), how loud, and which."""
EYE = """() => {
    window.seen = [];
    let before = "";
    const look = (now) => {
        requestAnimationFrame(look);
        const mark = document.querySelector("#stage .hit").getAttribute("d");
        if (mark && !before) window.seen.push(now / 1000);
        before = mark;
    };
    requestAnimationFrame(look);
}"""
"""Notes when the mass begins to be seen in touch with a stop (s)."""
FRAMES = 0.06
"""Three of the page, and a sample of the motion (s)."""


def listened(page, seconds):
    """What is heard and seen from now on: moments, loudness and sides of tones; moments."""
    page.evaluate("() => { heard.length = 0; seen.length = 0; }")
    page.clock.run_for(1000 * seconds)
    heard, seen = page.evaluate("heard"), page.evaluate("seen")
    return np.array(heard).reshape(-1, 3).T, np.array(seen)


def moved(page, frequency):
    """Look at the motion at a frequency, named with care."""
    before = page.inner_text("#words-motion")
    page.fill("#frequency", frequency)
    page.keyboard.press("Enter")
    page.wait_for_function(
        "(old) => document.getElementById('words-motion').innerText !== old", arg=before
    )


def test_impacts_are_heard_when_they_are_seen(opened):
    page = opened()
    page.select_option("#presets", CHAOTIC)
    page.wait_for_function("() => document.title.startsWith('S4')")
    moved(page, "1.2 Hz")
    page.evaluate(EAR)
    page.check("#sound")
    page.wait_for_function("() => ear.state === 'running'")
    page.clock.install()
    page.evaluate(EYE)
    assert listened(page, 1)[0].size == 0  # the mass does not move yet
    page.check("#play")

    # Two impacts a cycle, one harder than the other, a quarter as fast as they are.
    case = vi.laboratory.case("B3-10mm-A3")
    motion = vi.steady(case, frequency=(frequency := 1.2), exponent_cycles=100)
    speed, start = motion.contact_closing_speed.values, motion.contact_start.values
    hard, fastest = int(np.argmax(speed)), float(np.abs(motion.velocity).max())
    (when, loud, side), seen = listened(page, 10)
    assert len(when) == 6
    assert np.abs(when - seen[: len(when)]).max() < FRAMES
    assert (np.diff(side) != 0.0).all()
    harder = loud == loud.max()
    assert np.diff(when[harder]) == pytest.approx(4.0 / frequency)
    between = (start[1 - hard] - start[hard]) % (1.0 / frequency)
    parted = (when[~harder][:2] - when[harder][:2]) % (4.0 / frequency)
    assert parted == pytest.approx(4.0 * between, abs=1e-3)
    assert loud[~harder] == pytest.approx(0.25 * speed.min() / fastest, rel=1e-2)

    # What is not regular is heard as far as it is drawn.
    moved(page, "1.1 Hz")
    (when, _, _), seen = listened(page, 8)
    assert 4 < len(when) < 8
    assert np.abs(when[:, np.newaxis] - seen).min(axis=1).max() < FRAMES

    # A page that was away goes on where it was.
    before = page.evaluate("heard.length")
    page.clock.fast_forward(60_000)
    page.clock.run_for(100)
    assert page.evaluate("heard.length") < before + 2

    page.uncheck("#sound")
    (when, _, _), seen = listened(page, 4)
    assert not len(when)
    assert len(seen)
    page.check("#sound")
    page.wait_for_function("() => ear.state === 'running'")
    assert listened(page, 4)[0].size
    page.uncheck("#play")
    assert not listened(page, 4)[0].size
    page.check("#play")
    moved(page, "5 Hz")
    assert not listened(page, 4)[0].size  # nothing is touched
