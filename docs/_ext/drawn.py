"""The gallery: its scripts in `gallery/`, run in the build, and the pictures that they make.

A script ends a block with what a figure function returns, as in a notebook; that is its picture.
Scripts run again when they, or the package, have changed.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

from vibroimpact.engine import jit

ROOT = Path(__file__).parents[2]
PAGES = ROOT / "docs" / "gallery"

DOTS_PER_INCH = 150


class Pictures:
    """Keeps the picture of the figure, axes or several axes that a block of code ends with."""

    def __repr__(self) -> str:
        return "the last value of a block, if it is drawn"

    def __call__(self, block: Any, block_vars: dict[str, Any], gallery: dict[str, Any]) -> str:
        """Write the picture, and return the reST that shows it."""
        values = block_vars["example_globals"]
        figure = _figure_of(values.get("___"))
        if figure is None:
            return ""
        values["___"] = None  # or the next block would show it again
        path = next(block_vars["image_path_iterator"])
        figure.savefig(path, dpi=DOTS_PER_INCH)
        return figure_rst([path], gallery["src_dir"])


def _figure_of(value: Any) -> Figure | None:
    if isinstance(value, tuple | np.ndarray) and len(value):
        value = np.ravel(np.array(value, dtype=object))[0]
    if isinstance(value, Figure):
        return value
    return value.get_figure(root=True) if isinstance(value, Artist) else None


def unannounced(gallery: dict[str, Any], script: str) -> None:
    """Have the engine compile without a word, which would stand among what a script prints."""
    jit.announce = lambda text: None


GALLERY = {
    "examples_dirs": "gallery",
    "gallery_dirs": "docs/gallery",
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": (Pictures(),),
    "capture_repr": (),
    "parallel": True,
    "abort_on_example_error": True,
    "reset_modules": (unannounced,),
    "backreferences_dir": "docs/gallery/uses",
    "doc_module": ("vibroimpact",),
    "prefer_full_module": {r"vibroimpact\.figures\."},
    "inspect_global_variables": False,
    "show_signature": False,
    "download_all_examples": False,
    "write_computation_times": False,
    "remove_config_comments": True,
    "thumbnail_size": (480, 360),
}


def forget_what_is_stale() -> None:
    """Have all scripts run again if the package is another one, and drop pages without a script."""
    for page in PAGES.glob("*/*.rst"):
        script = ROOT / "gallery" / page.parent.name / f"{page.stem}.py"
        if page.stem != "index" and not script.is_file():
            page.unlink()
    stamp, now = PAGES / "package.sha256", _package()
    if not stamp.is_file() or stamp.read_text() != now:
        for mark in PAGES.rglob("*.md5"):
            mark.unlink()
        PAGES.mkdir(parents=True, exist_ok=True)
        stamp.write_text(now)


def _package() -> str:
    digest = hashlib.sha256()
    for path in sorted((ROOT / "src").rglob("*.py")):
        digest.update(path.relative_to(ROOT).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()
