"""How the site is built: `make docs` writes it to out/site.

The source folder is the repository's root, so that links between README, docs and benchmarks lead
in the site where they lead in the files. Only what `include_patterns` names is read.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs" / "_ext"))

import drawn  # noqa: E402
import landing  # noqa: E402
from vibroimpact import __version__  # noqa: E402

# MathJax is copied into the site: formulas are shown without a network.
OFFLINE = importlib.util.find_spec("sphinx-mathjax-offline").submodule_search_locations[0]

project = "vibroimpact"
author = "the vibroimpact developers"
project_copyright = author
version = release = __version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "numpydoc",
    "sphinx_design",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "links",
    "validation",
    "parameters",
]

root_doc = "docs/index"
include_patterns = ["*.md", "benchmarks/README.md", "docs/**"]
exclude_patterns = ["docs/_*", ".*", "out", "src", "tests", "examples", "docs/**/*.ipynb"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
templates_path = [str(ROOT / "docs" / "_templates")]

# Headings have the anchors that a view of the plain files gives them.
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "attrs_inline"]
myst_dmath_double_inline = True

# A name in single backticks is one of the package's; any other has two.
default_role = "py:obj"
nitpicky = True
autosummary_generate = sorted(
    f"docs/reference/{path.name}" for path in ROOT.glob("docs/reference/*.md")
)
autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

mathjax_path = "mathjax/tex-chtml.js"
pygments_style = "default"

html_theme = "pydata_sphinx_theme"
html_title = f"vibroimpact {release}"
html_static_path = ["_static", f"{OFFLINE}/static"]
html_css_files = ["site.css"]
html_js_files = ["breaks.js"]
html_additional_pages = {"index": "landing.html"}
# Pages that are a section of their own have no contents of one beside them.
html_sidebars = {"docs/validation": [], "docs/index": []}
html_context = landing.CONTEXT
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "logo": {"text": "vibroimpact"},
    "navigation_with_keys": False,
    "header_links_before_dropdown": 6,
    "show_toc_level": 2,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
copybutton_prompt_text = r"\$ "
copybutton_prompt_is_regexp = True

sphinx_gallery_conf = drawn.GALLERY
suppress_warnings = ["config.cache"]


def setup(app):
    """Begin with what has to run again."""
    drawn.forget_what_is_stale()
