"""Fig. 16: the motions of scenario S4, B3 with a total gap of 10 mm at A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import motion_page
from vibroimpact.paper.fig15 import BRANCH, CODE, LOW
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy


def draw(study: PublishedStudy) -> Figure:
    """Left hysteresis on the left, the motion that does not repeat itself on the right."""
    left, wild = study.other_places(CODE, LOW)
    columns = {
        f"$f_{{I}}$, left hysteresis: {left:.2f} Hz": {
            f"{direction} sweep": study.motion(CODE, left, direction)
            for direction in ("forward", "backward")
        },
        f"$f_{{II}}$, non-regular: {wild:.2f} Hz": {
            "one of the pair": study.motion(CODE, wild, "forward"),
            "its mirror image": study.mirror_image(CODE, wild, "forward"),
            "antisymmetric, unstable": study.antisymmetric_orbit(CODE, wild, *BRANCH),
        },
    }
    return motion_page(columns)[0, 0].get_figure(root=True)  # type: ignore[no-any-return]


ITEM = Item(
    key="fig16",
    title="Fig. 16: motions of scenario S4, B3 with a total gap of 10 mm at A3",
    caption=(
        "Portraits, spectra and two forcing cycles at the frequencies marked in Fig. 15. Left: "
        "inside a left hysteresis two periodic motions coexist; that of the forward sweep is "
        "smaller and hits each bumper twice a cycle, that of the backward sweep once. Right: a "
        "pair of motions, mirror images of each other and displaced to one side each, and between "
        "them a smaller antisymmetric orbit, which is unstable. The paper calls the pair "
        "quasi-periodic; computed, it is chaotic: disturbances grow exponentially, and its "
        "spectrum is continuous between the lines. Contacts are bands, in two tiers on the left "
        "(forward above) and in three on the right (one of the pair, its mirror image, the "
        "antisymmetric orbit). The pair shares one spectrum: what is seen is the mirror image's, "
        "drawn over the other."
    ),
    draw=draw,
)
