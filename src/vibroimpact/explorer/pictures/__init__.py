"""The pictures of a state, as numbers and texts that are sent to a page.

Each picture is a function of a state. It calls the public functions of the package. Its texts come
from `vibroimpact.facts`, like those of the command line.

A new picture is a module here, a `Stage` of `explorer/session.py`, whose key has all values on
which the picture depends, and code in `explorer/page/` that draws it with `plot.js`.
``python tests/explorer/strip.py`` renews the screenshots.
"""
