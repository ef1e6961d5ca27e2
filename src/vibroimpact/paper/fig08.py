"""Fig. 8: the motions of scenario S3 at three frequencies, B2-G1-A3."""

from __future__ import annotations

from matplotlib.figure import Figure

from vibroimpact.figures import motion_page
from vibroimpact.paper.fig07 import CODE
from vibroimpact.paper.item import Item
from vibroimpact.paper.study import PublishedStudy

PLACES = (
    "$f_{I}$, secondary resonance",
    "$f_{II}$, valley",
    "$f_{III}$, before the downward jump",
)


def draw(study: PublishedStudy) -> Figure:
    """Portrait, spectrum and histories; a column for each frequency."""
    columns = {
        f"{place}: {frequency:.2f} Hz": {
            f"{direction} sweep": study.motion(CODE, frequency, direction, samples=1024)
            for direction in ("forward", "backward")
        }
        for place, frequency in zip(PLACES, study.regular_places(CODE), strict=True)
    }
    return motion_page(columns)[0, 0].get_figure(root=True)  # type: ignore[no-any-return]


ITEM = Item(
    key="fig08",
    title="Fig. 8: motions of scenario S3, B2-G1-A3",
    caption=(
        "From above: phase portrait, spectrum of absolute acceleration, and two forcing cycles of "
        "displacement, acceleration and velocity at the three frequencies marked in Fig. 7, "
        "computed with the Simplified Nonlinear Model where the paper shows measurements. At the "
        "secondary resonance and in the valley both sweeps reach the same motion, with one impact "
        "on each bumper per cycle and many harmonics. Just before the downward jump a large motion "
        "with impacts coexists with a small one in free flight (bands are contacts, the forward "
        "sweep's in the upper half). The computed motions are their own mirror images; the "
        "measured ones are lopsided, as the rig's gaps were not quite equal."
    ),
    draw=draw,
)
