"""
Impacts are heard in the overtones
==================================

A free flight answers a sine with a sine. Two equal impacts a cycle add the odd harmonics, and a
motion that has lost its symmetry the even ones, too.
"""

import vibroimpact as vi
from vibroimpact.figures import spectrum_lines

case = vi.laboratory.case("B3-10mm-A3")
spectra = {
    f"{hertz} Hz": vi.fourier_spectrum(
        vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, hertz)))
    )
    for hertz in (1.12, 2.0)
}
spectrum_lines(spectra)
