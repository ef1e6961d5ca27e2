"""The explorer's page in a real browser: from a slider that moves to the frame that shows it."""

import asyncio
import shutil
import tempfile
import threading
from pathlib import Path
from typing import Any

from benchmarks.report import Table, met, targets
from vibroimpact.explorer import offline_page
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.run import serve

_MOVES = 200
_COARSE, _FINE = 50.0, 300.0
_ALONE = 100.0
"""Without a server."""

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


def _turned(browser: Any, address: str) -> dict[str, float]:
    """Milliseconds of a page in which a slider is turned."""
    opened = browser.new_page(viewport={"width": 1280, "height": 720})
    opened.goto(address)
    opened.wait_for_selector("body[data-settled]", timeout=300_000)  # it may have to compile
    took: dict[str, float] = opened.evaluate(TURNED, {"id": "knob-stops-gap", "moves": _MOVES})
    opened.close()
    return took


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

    def remember(address: str) -> None:
        where.append(address)
        ready.set()

    server = serve(preset(FIRST), remember)
    threading.Thread(target=lambda: asyncio.run(server), daemon=True).start()
    ready.wait()
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        file = Path(folder, "explorer.html")
        file.write_text(offline_page.page(preset(FIRST)), encoding="utf-8")
        shown = driver.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        took, alone = (_turned(shown, address) for address in (where[0], file.as_uri()))
        size = file.stat().st_size
        shown.close()
    table = targets("The explorer's page")
    for words, times, limits in (
        ("", took, (_COARSE, _FINE)),
        ("without a server: ", alone, (_ALONE, _FINE)),
    ):
        for what, name, limit in (
            (f"slider to painted frame, median of {_MOVES} moves, ms", "median", limits[0]),
            ("fine curves after it is let go, ms", "fine", limits[1]),
        ):
            value = times[name]
            table.add(words + what, f"{value:.0f}", f"under {limit:g} ms", met(value < limit))
    table.add(
        "size of the file without a server, kB", f"{size / 1e3:.0f}", "under 1000", met(size < 1e6)
    )
    table.add("slider to painted frame, 95 of 100 within, ms", f"{took['most']:.0f}", "", "")
    table.notes.append(
        f"The page shows {FIRST}, and the slider changes its gap. Chromium runs without a screen "
        "at 1280 × 720."
    )
    return table
