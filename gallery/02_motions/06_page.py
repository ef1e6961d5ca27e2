"""
A motion on one page
====================

Portrait, spectrum and histories of a periodic motion, of one with twice the period, and of chaos,
all of one rig: a page for a report. The line below each heading says of what kind the motion is.
"""

import vibroimpact as vi
from vibroimpact.figures import motion_page

case = vi.laboratory.case("B3-10mm-A3")
motions = {
    f"{hertz} Hz": vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, hertz)))
    for hertz in (1.3, 1.107, 1.06)
}
motion_page(motions)
