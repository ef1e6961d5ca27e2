"""
One knob
========

Turn the gap of a rig, and see the resonance bend, jump, and straighten again. The page below has
its curves within it and asks no server: it can be mailed, or put into a report.

.. raw:: html

   <iframe src="../../explorer.html" title="One knob: the gap of a rig" loading="lazy"
     style="width: 100%; height: 44rem; border: 1px solid var(--pst-color-border)"></iframe>

`Open it alone <../../explorer.html>`_. The program writes a page like it, of three gaps.
"""

# sphinx_gallery_thumbnail_path = 'docs/images/explorer-strip.png'

from vibroimpact.explorer.family import family, page

whole = page(family(values=(5e-3, 7.5e-3, 15e-3)))
print(f"{len(whole) / 1024:.0f} KiB, all in one file")
