"""Exact, fast dynamics of oscillators that hit deformable stops.

A mass on an isolator between two bumpers, shaken by its base::

    import vibroimpact as vi

    case = vi.laboratory.case("B2-G1-A3")
    curves = vi.sweep(case, case.frequencies)

Names are loaded when first used, so that importing the package takes no time.
"""

from __future__ import annotations

import lazy_loader

# The public names, and where each lives, are listed in the stub beside this file.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
