"""
Brute force and continuation in one diagram
===========================================

The dots are steady motions, which were simulated at each gap (brute force). The thin line is the
branch of their orbit, dashed where it is unstable; the vertical lines are its bifurcations, which
numerical continuation has located to ten digits. Wherever the dots split, there is a line.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

rig = vi.laboratory.case("B3-10mm-A3").rig.at("1.12 Hz")
span = ("4.72 mm", "5.1 mm")
diagram = vi.bifurcation_diagram(rig, {"gap": span}, 77)
branch = vi.branch(rig, vary={"gap": span})
section_diagram(diagram, branches=branch)
