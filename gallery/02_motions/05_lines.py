"""
Fourier spectrum: impacts add overtones
=======================================

A linear rig without contacts responds to a sine with a sine. Two equal impacts per cycle add the
odd harmonics. A motion that has lost its symmetry has even harmonics, too.
"""

import vibroimpact as vi
from vibroimpact.figures import spectrum_lines

spectra = {
    f"{hertz} Hz": vi.fourier_spectrum(vi.steady("B3-10mm-A3", frequency=hertz))
    for hertz in (1.12, 2.0)
}
spectrum_lines(spectra)
