"""Check that no page of a built site is wider than a telephone: what is wide scrolls by itself.

python docs/check_widths.py FOLDER

Looked at are all pages but those of single names and pictures, which one template makes. Without a
browser, or what drives it, nothing is.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

WIDTH = 390
ALIKE = ("reference/api/", "docs/gallery/", "_static/")


def wide(site: Path, browser: str) -> list[str]:
    """Each page that can be scrolled sideways, as a line."""
    from playwright.sync_api import sync_playwright

    pages = [path.relative_to(site).as_posix() for path in sorted(site.rglob("*.html"))]
    chosen = [name for name in pages if not any(part in name for part in ALIKE)]
    found = []
    with sync_playwright() as driver:
        shown = driver.chromium.launch(executable_path=browser, args=["--no-sandbox"])
        page = shown.new_page(viewport={"width": WIDTH, "height": 800})
        for name in [*chosen, "docs/gallery/index.html"]:
            page.goto((site / name).as_uri())
            page.evaluate("window.MathJax?.startup?.promise")
            width = page.evaluate("document.documentElement.scrollWidth")
            if width > WIDTH:
                found.append(f"{name}: {width} pixels wide on a screen of {WIDTH}")
        shown.close()
    return found


if __name__ == "__main__":
    here = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
    lines = wide(Path(sys.argv[1]).resolve(), here) if here else []
    words = "no page is wider than a telephone" if here else "no browser: widths are not checked"
    print("\n".join(lines) or words)
    sys.exit(bool(lines))
