"""Check every link within a built site: files, pages and places in pages. Asks no network.

python docs/check_links.py FOLDER
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """What a page links to, and the places in it that can be linked to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.targets: set[str] = set()
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note one element."""
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.targets.add(value)
            elif name == "srcset" and value:
                self.targets.update(part.split()[0] for part in value.split(","))
            elif (name == "id" or (name == "name" and tag == "a")) and value:
                self.places.add(value)


def broken(site: Path) -> list[str]:
    """Each link that leads nowhere, as a line."""
    pages = {
        path: Page(path.read_text(encoding="utf-8"))
        for path in sorted(site.rglob("*.html"))
        if "_static" not in path.parts
    }
    lines = []
    for path, page in pages.items():
        for target in sorted(page.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = unquote(parts.fragment)
            known = pages.get(there)
            if not there.is_file() or (place and known and place not in known.places):
                lines.append(f"{path.relative_to(site)}: {target}")
    return lines


if __name__ == "__main__":
    lines = broken(Path(sys.argv[1]).resolve())
    print("\n".join(lines) or "all links within the site lead somewhere")
    sys.exit(bool(lines))
