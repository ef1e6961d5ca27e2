"""Links that read well in the plain files, made right for the site.

A link to the gallery or to a script of it leads to its page, and one to another folder is only its
text. Docstrings name what is public without the package, and
pages by their files.
"""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

from vibroimpact.explorer.offline_page import page
from vibroimpact.explorer.presets import FIRST, preset

EXPLORER = "docs/explorer.html"
"""The explorer's page without a server."""


def setup(app: Sphinx) -> dict[str, Any]:
    """Listen to what Sphinx does."""
    # Before Sphinx collects what is to be downloaded.
    app.connect("doctree-read", _as_in_the_files, priority=100)
    app.connect("missing-reference", _public)
    app.connect("autodoc-process-docstring", _pages_of_files, priority=100)
    app.connect("build-finished", _pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _pages_of_files(
    app: Sphinx, what: str, name: str, of: Any, options: Any, lines: list[str]
) -> None:
    lines[:] = [re.sub(r"\bdocs/([\w/-]+)\.md\b", r":doc:`/docs/\1`", line) for line in lines]


def _as_in_the_files(app: Sphinx, document: nodes.document) -> None:
    name = app.env.docname
    for link in list(document.findall(addnodes.pending_xref)):
        target = _target(app, link)
        if Path(app.srcdir, target).is_dir():
            in_gallery = target.split("/")[0] == "gallery"
            new = [_page(link, f"/docs/{target}/index", name)] if in_gallery else link.children
            link.replace_self(new)
    for link in list(document.findall(addnodes.download_reference)):
        target = _target(app, link)
        if target.startswith("gallery/") and target.endswith(".py"):
            link.replace_self(_page(link, "/docs/" + target.removesuffix(".py"), name))


def _target(app: Sphinx, link: nodes.Element) -> str:
    """What a link leads to, from the repository's root."""
    target, _ = app.env.relfn2path(link["reftarget"], app.env.docname)
    return PurePosixPath(target).as_posix()


def _page(link: nodes.Element, where: str, name: str) -> nodes.Node:
    """The same link to a page of the site."""
    return addnodes.pending_xref(
        "",
        *link.children,
        refdomain="std",
        reftype="doc",
        reftarget=where,
        refdoc=name,
        refexplicit=True,
        refwarn=True,
    )


def _public(
    app: Sphinx, env: BuildEnvironment, link: addnodes.pending_xref, text: nodes.Element
) -> nodes.Node | None:
    """A name that a docstring of another module gives as ``vibroimpact`` has it."""
    python = env.domains["py"]
    name = f"vibroimpact.{link.get('reftarget')}"
    if link.get("refdomain") != "py" or name not in python.objects:
        return None
    where = link["refdoc"]
    return python.resolve_xref(env, where, app.builder, "obj", name, link, text)


def _pages(app: Sphinx, error: Exception | None) -> None:
    if error is None:
        Path(app.outdir, EXPLORER).write_text(page(preset(FIRST)), encoding="utf-8")
