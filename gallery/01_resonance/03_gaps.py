"""
The gap bends the resonance curve
=================================

This figure compares the resonance curves of a mass between two bumpers for four gaps. If the gap is
smaller, the peak leans farther to the right, and the frequency range with two coexisting motions is
wider. Solid lines are upward sweeps, dashed lines are downward sweeps, and arrows are jumps.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_family

gaps = (5.0, 7.5, 15.0, 25.0)
rigs = {
    f"{gap:g} mm": f"B2-{2 * gap:g}mm-A3" for gap in gaps
}  # the name of the rig contains the sum of both gaps
curves = vi.sweeps(rigs, [k / 50 for k in range(25, 201)])
resonance_family(curves, title="B2-A3: gap on each side")
