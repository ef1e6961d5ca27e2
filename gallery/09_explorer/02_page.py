"""
The explorer: all parameters
============================

``vibroimpact explore`` opens this page in a browser. Every parameter of the rig has a slider.
Curves, motion and scenario follow within a tenth of a second. A click on a curve shows the motion
at that point, with its sound.

.. image:: /docs/images/explorer.png
   :alt: Knobs on the left, resonance curves in the middle, the motion on the right.

Python gives the same text as the page:
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer.png'

import vibroimpact as vi

print(vi.classify_scenario("B2-G1-A3"))

# vi.explore("B2-G1-A3") opens the page, in a notebook too.
