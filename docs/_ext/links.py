"""Links that read well in the plain files, made right for the site.

A link to a script of the gallery leads to its page, one to an HTML file to that file, and one to a
folder is only its text.
"""

from __future__ import annotations

import shutil
from pathlib import Path, PurePosixPath
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx

PAGES = ("docs/explorer.html",)
"""Pages that are in the repository as they are shown."""


def setup(app: Sphinx) -> dict[str, Any]:
    """Listen to what Sphinx does."""
    # Before Sphinx collects what is to be downloaded.
    app.connect("doctree-read", _as_in_the_files, priority=100)
    app.connect("build-finished", _pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _as_in_the_files(app: Sphinx, document: nodes.document) -> None:
    name = app.env.docname
    for link in list(document.findall(addnodes.pending_xref)):
        if Path(app.srcdir, name).parent.joinpath(link["reftarget"]).is_dir():
            link.replace_self(link.children)
    for link in list(document.findall(addnodes.download_reference)):
        target, _ = app.env.relfn2path(link["reftarget"], name)
        target = PurePosixPath(target).as_posix()
        if target in PAGES:
            up = "../" * name.count("/")
            link.replace_self(nodes.reference("", "", *link.children, refuri=up + target))
        elif target.startswith("gallery/") and target.endswith(".py"):
            where = "/docs/" + target.removesuffix(".py")
            page = addnodes.pending_xref(
                "",
                *link.children,
                refdomain="std",
                reftype="doc",
                reftarget=where,
                refdoc=name,
                refexplicit=True,
                refwarn=True,
            )
            link.replace_self(page)


def _pages(app: Sphinx, error: Exception | None) -> None:
    for page in PAGES if error is None else ():
        shutil.copy(Path(app.srcdir, page), Path(app.outdir, page))
