"""Check that no page of a built site is wider than a telephone: what is wide scrolls by itself.

python docs/check_widths.py FOLDER

Nor may a page's text be wider than its column, which would scroll and hide its end. Of the pages
of single names, which one template makes, those of the longest names are inspected, and of the
gallery its first. Without a browser, or what drives it, nothing is.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

WIDTH = 390
ALIKE, LONGEST = "reference/api/", 12
LEFT_OUT = ("docs/gallery/", "_static/")
WIDEST = """() => {
    const column = document.querySelector(".bd-article-container");
    const beyond = column ? column.scrollWidth - column.clientWidth : 0;
    return document.documentElement.scrollWidth + beyond;
}"""


def wide(site: Path, browser: str) -> list[str]:
    """Each page that can be scrolled sideways, as a line."""
    from playwright.sync_api import sync_playwright

    pages = [path.relative_to(site).as_posix() for path in sorted(site.rglob("*.html"))]
    chosen = [name for name in pages if not any(part in name for part in (ALIKE, *LEFT_OUT))]
    chosen += sorted((name for name in pages if ALIKE in name), key=len)[-LONGEST:]
    lines = []
    with sync_playwright() as driver:
        shown = driver.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        page = shown.new_page(viewport={"width": WIDTH, "height": 800})
        for name in [*chosen, "docs/gallery/index.html"]:
            page.goto((site / name).as_uri())
            page.evaluate("window.MathJax?.startup?.promise")
            width = page.evaluate(WIDEST)
            if width > WIDTH:
                lines.append(f"{name}: {width} pixels wide on a screen of {WIDTH}")
        shown.close()
    return lines


if __name__ == "__main__":
    here = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
    lines = wide(Path(sys.argv[1]).resolve(), here) if here else []
    words = "no page is wider than a telephone" if here else "no browser: widths are not checked"
    print("\n".join(lines) or words)
    sys.exit(bool(lines))
