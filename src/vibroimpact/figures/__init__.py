"""Datasets in, matplotlib Axes out: a figure a file.

Nothing else in the package imports matplotlib, and nothing here touches pyplot's global state:
without given axes a figure is made on a `matplotlib.figure.Figure` of its own, which the
returned axes carry as ``.figure``.
"""

from vibroimpact.figures.history import time_history
from vibroimpact.figures.resonance import resonance_curves
from vibroimpact.figures.style import save_figure

__all__ = ["resonance_curves", "save_figure", "time_history"]
