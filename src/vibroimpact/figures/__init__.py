"""Functions that draw datasets and return matplotlib Axes. Each module draws one kind of figure.

No other part of the package imports matplotlib. These functions do not change the global state of
pyplot. If no axes are passed, a function makes a new figure, which is the attribute ``.figure`` of
the returned axes. A notebook displays the returned axes. `save_figure` writes the figure to a file.
"""

from __future__ import annotations

import lazy_loader

# The figures, and where each lives, are listed in the stub beside this file.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
