"""
The jump of a vibro-impact energy sink
======================================

A ball of 5 % of the mass of its host moves freely between two stops of the host. If it hits each
stop once per cycle, it takes so much energy out of the host that the host moves 5 to 20 times less
than without the ball. These motions begin at a fold. They are stable between a Neimark–Sacker
bifurcation and a symmetry breaking.
"""

from math import tau

import vibroimpact as vi
from vibroimpact.figures import mass_branches, mass_histories, mass_spectra, pair_portrait

sink = vi.Assembly(
    masses={"host": 1.0, "ball": 0.05},
    links={"spring": vi.Link("ground", "host", vi.Isolator(1.0, 0.02))},
    stops={
        "right": vi.Link("ball", "host", vi.RigidStop(restitution=0.75, gap=0.5)),
        "left": vi.Link("host", "ball", vi.RigidStop(restitution=0.75, gap=0.5)),
    },
    units="none",
)
rig = vi.Rig(sink, vi.Harmonic(0.03, 1.0 / tau, of="force", on="host"))
orbit = vi.orbit(rig, vi.steady(rig, vi.State(displacement={"host": 0.5}, velocity={"ball": 1.0})))
mass_branches(vi.branch(rig, orbit, vary={"amplitude": (0.005, 0.05)}))

# %%
# Seen from the host, the ball flies from stop to stop:
pair_portrait(orbit, "ball", "host", quantity="approach")

# %%
# If the force falls below the Neimark–Sacker bifurcation, the ball no longer hits each stop once
# per cycle, and the host jumps to motions that are several times larger:


def at(amplitude):
    """Return the rig with another amplitude of the force."""
    return vi.Rig(sink, vi.Harmonic(amplitude, 1.0 / tau, of="force", on="host"))


above = vi.steady(at(0.021), orbit)
mass_histories(vi.simulate(at(0.019), 150, above, 32))

# %%
# With one impact at each stop per cycle, half a cycle apart, the motions have odd harmonics only:
mass_spectra(vi.fourier_spectrum(vi.steady(rig, orbit)), quantity="displacement")
