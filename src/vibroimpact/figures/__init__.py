"""Datasets in, matplotlib Axes out: a figure a file.

Nothing else in the package imports matplotlib, and nothing here touches pyplot's global state:
without given axes a figure is made of its own, which the returned axes carry as ``.figure``.
A notebook shows what is returned; `save_figure` writes it to a file.
"""

from __future__ import annotations

import lazy_loader

# The figures, and where each lives, are listed in the stub beside this file.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
