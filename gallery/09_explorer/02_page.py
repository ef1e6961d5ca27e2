"""
All knobs
=========

``vibroimpact explore`` opens this page in a browser. Every number of the rig is a knob; curves,
motion and scenario follow it within a tenth of a second, and a click on a curve shows the motion
there, with its sound.

.. image:: /docs/images/explorer.png
   :alt: Knobs on the left, resonance curves in the middle, the motion on the right.

What the page says in words is what Python says:
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer.png'

import vibroimpact as vi

print(vi.classify_scenario("B2-G1-A3"))

# vi.explore("B2-G1-A3") opens the page, in a notebook too.
