"""Renew the pictures of the explorer's page in docs/images: ``python tests/explorer/strip.py``."""

from __future__ import annotations

import asyncio
import io
import threading
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from benchmarks.page import chromium
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.run import serve

IMAGES = Path(__file__).parents[2] / "docs/images"
GAPS = ("7.5 mm", "15 mm", "25 mm")
_PATIENCE = 3000
_HEIGHT = 394
"""Of the first panel of the curves, with what stands above it."""


def main() -> None:
    """Look at the page in Chromium."""
    where: list[str] = []
    ready = threading.Event()

    def announce(address: str) -> None:
        where.append(address)
        ready.set()

    server = serve(preset(FIRST), announce)
    threading.Thread(target=lambda: asyncio.run(server), daemon=True).start()
    ready.wait()
    parts = []
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 720}, reduced_motion="reduce")
        page.goto(where[0])
        page.wait_for_selector("body[data-settled]", timeout=300_000)  # it may have to compile
        page.wait_for_timeout(_PATIENCE)
        _image(page.screenshot()).quantize(96).save(IMAGES / "explorer.png", optimize=True)
        for gap in GAPS:
            page.fill("#text-stops-gap", gap)
            page.keyboard.press("Enter")
            page.wait_for_timeout(_PATIENCE)
            page.evaluate("document.activeElement.blur()")
            knob = page.locator(".knob", has=page.locator("#text-stops-gap")).screenshot()
            box = page.locator("#curves").bounding_box()
            assert box is not None
            parts.append((_image(knob), _image(page.screenshot(clip={**box, "height": _HEIGHT}))))
        browser.close()
    width = max(curves.width for _, curves in parts)
    top = parts[0][0].height + 8
    strip = Image.new("RGB", (width * len(parts), top + _HEIGHT), "white")
    for i, (knob, curves) in enumerate(parts):
        strip.paste(knob, (i * width + (width - knob.width) // 2, 4))
        strip.paste(curves, (i * width, top))
    small = strip.resize((strip.width * 3 // 4, strip.height * 3 // 4), Image.Resampling.LANCZOS)
    small.quantize(80).save(IMAGES / "explorer-strip.png", optimize=True)


def _image(png: bytes) -> Image.Image:
    return Image.open(io.BytesIO(png)).convert("RGB")


if __name__ == "__main__":
    main()
