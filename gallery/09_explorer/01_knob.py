"""
The explorer in one file
========================

If you move a slider, you see the resonance curves bend, jump and straighten again. The page below
computes them itself: it contains the compiled engine, and needs neither a server nor an
installation. You can therefore send it by mail or include it in a report.

.. raw:: html

   <iframe src="../../explorer.html" title="The explorer of a rig" loading="lazy"
     style="width: 100%; height: 44rem; border: 1px solid var(--pst-color-border)"></iframe>

`Open the page alone <../../explorer.html>`_. The command
``vibroimpact explore B2-G1-A3 --save explorer.html`` writes it, and so does this program for a rig
with rigid stops:
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer-strip.png'

import vibroimpact as vi
from vibroimpact.explorer.offline_page import page
from vibroimpact.explorer.state import begin

wall = vi.RigidStop(restitution=0.6, gap="10 mm")
rig = vi.Rig(vi.Oscillator("550 kg", vi.Isolator("26.29 kN/m", "1.1 kN s/m"), wall, wall), "0.05 g")
whole = page(begin(rig, "rigid stops"))
print(f"{len(whole) / 1024:.0f} KiB, all in one file")
