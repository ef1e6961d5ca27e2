"""
The explorer: all parameters
============================

The command ``vibroimpact explore`` opens this page in a browser. Every parameter of the rig has a
slider. When you move a slider, the resonance curves, the motion and the scenario (the class of the
resonance curves) change within a tenth of a second. When you click on a curve, the page shows the
motion at that point and plays its sound.

.. image:: /docs/images/explorer.png
   :alt: Sliders on the left, resonance curves in the middle, the motion on the right.

In Python, ``vi.classify_scenario`` gives the text that the page shows about the scenario:
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer.png'

import vibroimpact as vi

print(vi.classify_scenario("B2-G1-A3"))

# vi.explore("B2-G1-A3") opens the page, also from a notebook.
