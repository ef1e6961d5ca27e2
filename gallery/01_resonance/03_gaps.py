"""
A gap bends the resonance
=========================

The narrower the gap, the farther right the peak leans and the wider the range in which two
motions coexist. Solid is the way up, dashed the way down; arrows are jumps.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_family

gaps = (5.0, 7.5, 15.0, 25.0)
rigs = {f"{gap:g} mm": f"B2-{2 * gap:g}mm-A3" for gap in gaps}  # a code has the gap of both sides
curves = vi.sweeps(rigs, [k / 50 for k in range(25, 201)])
resonance_family(curves, title="B2-A3: gap on each side")
