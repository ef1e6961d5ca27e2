"""
One slider: the gap
===================

If you move the slider for the gap, you see the resonance curve bend, jump and straighten again. The
page below contains the curves for all positions of the slider, so it needs no server. You can
therefore send it by mail or include it in a report.

.. raw:: html

   <iframe src="../../explorer.html" title="One slider: the gap of a rig" loading="lazy"
     style="width: 100%; height: 44rem; border: 1px solid var(--pst-color-border)"></iframe>

`Open the page alone <../../explorer.html>`_. The program below writes a similar page for three
gaps.
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer-strip.png'

from vibroimpact.explorer.family import family, page

whole = page(family(values=(5e-3, 7.5e-3, 15e-3)))
print(f"{len(whole) / 1024:.0f} KiB, all in one file")
