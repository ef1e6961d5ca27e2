"""Where a plan keeps the tables of an isolator that yields or slides.

They stand behind what a Taylor step needs, so that whoever asks the motion for its pieces or its
disturbances asks the Taylor flow, in the same plan.
"""

from __future__ import annotations

from vibroimpact.engine.linear.layout import BAND_X, SIZE
from vibroimpact.engine.series.layout import END

MOVES_RIGHT, MOVES_LEFT, ELASTIC = range(3)
"""Branches of a law. In the first two a constant force stands against the motion: that of friction,
or of what has yielded. In the third the element that yields is a spring."""

BRANCHES = 3
MODES = 3  # flight, pressed right, pressed left

# Headers are those of linear tables, but for the bounds: with e = ROOT |x′| + |x″| at a window's
# start, |x‴| h² ≤ TURN_E e + TURN_0 and, of the stop's force per unit mass, |F″| h² ≤ PUSH_E e +
# PUSH_0 all over it.
ROOT = BAND_X
TURN_E = ROOT + 1
TURN_0 = ROOT + 2
PUSH_E = ROOT + 3
PUSH_0 = ROOT + 4
BEND_0 = ROOT + 5  # and |x″| ≤ e + BEND_0

TABLES = END
PLAN = TABLES + BRANCHES * MODES * SIZE
"""Length of a plan."""
