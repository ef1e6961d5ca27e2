"""Functions that draw datasets and return matplotlib Axes. Each module draws one kind of figure.

No other part of the package imports matplotlib. These functions do not change the global state of
pyplot. If no axes are passed, a function makes a new figure, which is the attribute ``.figure`` of
the returned axes. A notebook displays the returned axes. `save_figure` writes the figure to a file.

A new figure is a module with one function of a dataset and, optionally, axes. It takes colours,
marks and panels from `style`, and new axes from `notebook`; `add_legend` of `legends` and the
decorator `finished` of `finish` fit its texts to the width of a column. It must be readable in
print and without colour. Curves over the frequency are panels of the class `Drawn` of
`resonance_panels`. List the function in the stub beside this file, in
`docs/reference/how-to-draw.md`, in `tests/figures/every_figure.py` (texts that overlap or are cut
off) and in an example of `gallery/`. A further panel of `resonance_curves` is a function as
`outputs` of `resonance_panels`, and a case in `tests/figures/every_figure.py`.
"""

from __future__ import annotations

import lazy_loader

# The figures, and where each lives, are listed in the stub beside this file.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
