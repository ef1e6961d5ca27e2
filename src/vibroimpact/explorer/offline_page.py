"""The page without a server, as one file: its worker has the engine as WebAssembly.

All of the page but the source of its numbers is that of the server's page.
"""

from __future__ import annotations

import base64
import gzip
import json
import re
from importlib import resources

from vibroimpact.engine import native
from vibroimpact.errors import InputError
from vibroimpact.explorer.engine_layout import WASM
from vibroimpact.explorer.offline_facts import check, facts
from vibroimpact.explorer.state import PageState

_WORKER = (
    "units.js",
    "engine.js",
    "rig.js",
    "sweep.js",
    "motion.js",
    "basins.js",
    "session.js",
    "worker.js",
)
_PAGE = ("plot.js", "save.js", "knobs.js", "curves.js", "motion.js", "plane.js", "main.js")
_IMPORT = re.compile(r'^import (\{[^}]*\}) from "\./(.*)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?(?:class|const|function)\*? (\w+))", re.MULTILINE)
_LINKED = (
    '<link rel="stylesheet" href="/style.css">\n<script type="module" src="/main.js"></script>\n'
)


def page(first: PageState) -> str:
    """Return the page that starts with a state, as one HTML text.

    Raises
    ------
    InputError
        If only Python computes the rig: a law is not linear, or the rig has no units. Also if the
        module of WebAssembly is missing, or made of other sources.
    """
    check(first)
    if not _is_current():
        raise InputError(
            "page: the engine of the page is not made of the engine's present sources; run make "
            "kernels"
        )
    engine = gzip.compress((native.FOLDER / WASM).read_bytes(), mtime=0)
    table = json.dumps(facts(first), separators=(",", ":"), ensure_ascii=False)
    parts = {
        "application/gzip": ("engine", base64.b64encode(engine).decode()),
        "application/json": ("facts", table.replace("<", "\\u003c")),
        "text/plain": ("worker", worker()),
    }
    scripts = [
        f'<script type="{kind}" id="{id}">{text}</script>' for kind, (id, text) in parts.items()
    ]
    program = _bundle({"link.js": "worker", **dict.fromkeys(_PAGE, "page")})
    scripts.append(f'<script type="module">\n{program}</script>')
    frame = _read("page", "index.html")
    assert _LINKED in frame
    style = f"<style>\n{_read('page', 'style.css')}</style>\n"
    frame = frame.replace(_LINKED, style).replace("<body>", '<body class="offline">')
    return frame.replace("</body>", "\n".join([*scripts, "</body>"]))


def _is_current() -> bool:
    digest = native.FOLDER / native.DIGEST
    here = (native.FOLDER / WASM).exists() and digest.exists()
    return here and digest.read_text().strip() == native.digest()


def worker() -> str:
    """Return the program of the worker."""
    return _bundle(dict.fromkeys(_WORKER, "worker"))


def _bundle(folders: dict[str, str]) -> str:
    """Return modules, each after those that it imports, as one program: a function for each."""
    parts = ["const modules = {};"]
    for name, folder in folders.items():
        text = _read(folder, name)
        exported = ", ".join(groups[1] for groups in _EXPORT.findall(text))
        text = _EXPORT.sub(r"\1", _IMPORT.sub(r'const \1 = modules["\2"];', text))
        parts.append(f'modules["{name}"] = (() => {{\n{text}return {{ {exported} }};\n}})();')
    return "\n".join(parts) + "\n"


def _read(folder: str, name: str) -> str:
    return (resources.files(__package__) / folder / name).read_text(encoding="utf-8")
