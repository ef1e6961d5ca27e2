"""The explorer's page in a real browser: from a slider that moves to the frame that shows it."""

import asyncio
import shutil
import threading

from benchmarks.report import Table, met, targets
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.run import serving

_MOVES = 200
_COARSE, _FINE = 50.0, 300.0

TURNED = """async ({ id, moves }) => {
    const knob = document.getElementById(id);
    const painted = (fine) => new Promise((done) => {
        const seen = new MutationObserver(() => {
            if (fine && document.body.dataset.fine !== "true") return;
            seen.disconnect();
            done();
        });
        const attributeFilter = ["data-drawn", "data-fine"];
        seen.observe(document.body, { attributes: true, attributeFilter });
    });
    const taken = [];
    for (let k = 0; k < moves; k++) {
        knob.value = 100 + ((k * 37) % 300);
        const [begun, drawn] = [performance.now(), painted(false)];
        knob.dispatchEvent(new Event("input", { bubbles: true }));
        await drawn;
        taken.push(performance.now() - begun);
        await new Promise((done) => setTimeout(done, 16));
    }
    const [begun, drawn] = [performance.now(), painted(true)];
    knob.dispatchEvent(new Event("change", { bubbles: true }));
    await drawn;
    const fine = performance.now() - begun;
    taken.sort((a, b) => a - b);
    return { median: taken[moves >> 1], most: taken[Math.floor(0.95 * moves)], fine };
}"""
"""Turns a knob so many times; milliseconds until the curves are drawn, then until they are fine."""


def chromium() -> str | None:
    """Where the system's browser is, if it has one."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return next(filter(None, map(shutil.which, names)), None)


def page() -> Table | None:
    """Measure the page; nothing where there is no browser, or nothing that drives it."""
    try:
        from playwright.sync_api import sync_playwright
    except ModuleNotFoundError:
        return None
    browser = chromium()
    if browser is None:
        return None
    ready = threading.Event()
    where: list[str] = []

    def told(address: str) -> None:
        where.append(address)
        ready.set()

    server = serving(preset(FIRST), "127.0.0.1", 0, told)
    threading.Thread(target=lambda: asyncio.run(server), daemon=True).start()
    ready.wait()
    with sync_playwright() as driver:
        shown = driver.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        opened = shown.new_page(viewport={"width": 1280, "height": 720})
        opened.goto(where[0])
        opened.wait_for_selector("body[data-settled]", timeout=300_000)  # it may have to compile
        took = opened.evaluate(TURNED, {"id": "knob-stops-gap", "moves": _MOVES})
        shown.close()
    table = targets("The explorer's page")
    for words, name, limit in (
        (f"slider to painted frame, median of {_MOVES} moves, ms", "median", _COARSE),
        ("fine curves after it is let go, ms", "fine", _FINE),
    ):
        value = took[name]
        table.add(words, f"{value:.0f}", f"under {limit:g} ms", met(value < limit))
    table.add("slider to painted frame, 95 of 100 within, ms", f"{took['most']:.0f}", "", "")
    table.notes.append(
        f"The page shows {FIRST}, and the slider changes its gap. Chromium runs without a screen "
        "at 1280 × 720."
    )
    return table
