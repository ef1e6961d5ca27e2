"""
Fourier spectrum: impacts add overtones
=======================================

Without contacts, a linear rig responds to a sine with a sine, so the spectrum of its motion has one
line. Two equal impacts per cycle, one on each side, add the odd harmonics. If the motion has lost
its symmetry, its spectrum has even harmonics, too.
"""

import vibroimpact as vi
from vibroimpact.figures import spectrum_lines

spectra = {
    f"{hertz} Hz": vi.fourier_spectrum(vi.steady("B3-10mm-A3", frequency=hertz))
    for hertz in (1.12, 2.0)
}
spectrum_lines(spectra)
