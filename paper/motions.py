"""Figs. 8, 12, 16 and 18: motions at the frequencies that are marked in the resonance curves."""

from __future__ import annotations

from matplotlib.figure import Figure

from paper import fig15
from paper.curves import S3, S5, S5_RANGE
from paper.report_item import Item
from paper.study import PublishedStudy
from vibroimpact.figures import (
    clearances,
    motion_page,
    phase_portrait,
    spectrum_lines,
    time_history,
)
from vibroimpact.response.spectrum import fourier_spectrum

PLACES = (
    "$f_{I}$, secondary resonance",
    "$f_{II}$, valley",
    "$f_{III}$, before the downward jump",
)


def _regular(study: PublishedStudy) -> Figure:
    """Draw portrait, spectrum and time histories, with a column for each frequency."""
    columns = {
        f"{place}: {frequency:.2f} Hz": {
            f"{direction} sweep": study.motion(S3, frequency, direction, samples=1024)
            for direction in ("forward", "backward")
        }
        for place, frequency in zip(PLACES, study.regular_places(S3), strict=True)
    }
    return motion_page(columns)[0, 0].get_figure(root=True)  # type: ignore[no-any-return]


def _fitted(study: PublishedStudy) -> Figure:
    """Draw the motions at the three frequencies side by side."""
    figure = Figure(figsize=(12.6, 4.6), layout="constrained")
    axes = figure.subplots(1, len(PLACES))
    places = study.regular_places(S3, "identified")
    for ax, place, frequency in zip(axes, PLACES, places, strict=True):
        phase_portrait(
            {
                f"{direction} sweep": study.motion(
                    S3, frequency, direction, "identified", samples=1024
                )
                for direction in ("forward", "backward")
            },
            ax,
        )
        handles = ax.get_legend().legend_handles
        ax.get_legend().remove()
        ax.set_title(f"{place}: {frequency:.2f} Hz", fontsize="medium")
    for ax in axes[1:]:
        ax.set_ylabel("")
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _irregular(study: PublishedStudy) -> Figure:
    """Draw the left hysteresis on the left, and the non-periodic motion on the right."""
    left, wild = study.other_places(fig15.CODE, fig15.LOW)
    columns = {
        f"$f_{{I}}$, left hysteresis: {left:.2f} Hz": {
            f"{direction} sweep": study.motion(fig15.CODE, left, direction)
            for direction in ("forward", "backward")
        },
        f"$f_{{II}}$, non-regular: {wild:.2f} Hz": {
            "one of the pair": study.motion(fig15.CODE, wild, "forward"),
            "its mirror image": study.mirror_image(fig15.CODE, wild, "forward"),
            "antisymmetric, unstable": study.antisymmetric_orbit(fig15.CODE, wild, *fig15.BRANCH),
        },
    }
    return motion_page(columns)[0, 0].get_figure(root=True)  # type: ignore[no-any-return]


def _attached(study: PublishedStudy) -> Figure:
    """Draw portrait and spectrum above, time histories below left, and clearances below right."""
    curve = study.curves(S5, None, *S5_RANGE)["eta_d"].sel(direction="forward")
    frequency = float(curve["frequency"][int(curve.values.argmax())])
    motion = study.motion(S5, frequency, "forward", samples=8192)
    figure = Figure(figsize=(12.0, 12.0), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=[1.5, 1.0, 1.0, 1.0])
    phase_portrait(motion, figure.add_subplot(grid[0, 0]))
    spectrum_lines(fourier_spectrum(motion), figure.add_subplot(grid[0, 1]))
    first = figure.add_subplot(grid[1, 0])
    histories = [first, *(figure.add_subplot(grid[i, 0], sharex=first) for i in (2, 3))]
    time_history(motion, histories, cycles=2.0)
    for ax in histories[:-1]:
        ax.tick_params(labelbottom=False)
    clearances(motion, [figure.add_subplot(grid[1, 1]), figure.add_subplot(grid[2:, 1])])
    figure.suptitle(f"resonance, {frequency:.2f} Hz")
    return figure


ITEMS = (
    Item(
        key="fig08",
        title="Fig. 8: motions of scenario S3, B2-G1-A3",
        caption=(
            "The three columns are the three frequencies marked in Fig. 7. From top to bottom, "
            "each column shows the phase portrait, the spectrum of absolute acceleration, and two "
            "forcing cycles of displacement, acceleration and velocity. The motions are computed "
            "with the Simplified Nonlinear Model. The paper shows measurements. At the secondary "
            "resonance and in the valley, both sweeps reach the same motion, with one impact on "
            "each bumper per cycle and many harmonics. Just before the downward jump, a large "
            "motion with impacts coexists with a small motion in free flight. Bands mark contacts, "
            "and those of the forward sweep are in the upper half. The computed motions are their "
            "own mirror images. The measured motions are not symmetric, because the two gaps of "
            "the rig were not quite equal."
        ),
        draw=_regular,
    ),
    Item(
        key="fig12",
        title="Fig. 12: phase portraits of the fitted model, B2-G1-A3",
        caption=(
            "Relative velocity against relative displacement at the three frequencies marked in "
            "Fig. 11, computed with the parameters fitted to this test. Diamonds mark one phase of "
            "the forcing, and dashed lines mark the gaps. At the secondary resonance, the orbit "
            "has small inner loops. The computed orbit in the paper has them, too. The paper "
            "compares its orbits with measured orbits. These are not published as numbers and are "
            "missing here."
        ),
        draw=_fitted,
    ),
    Item(
        key="fig16",
        title="Fig. 16: motions of scenario S4, B3 with a total gap of 10 mm at A3",
        caption=(
            "Phase portraits, spectra and two forcing cycles at the frequencies marked in Fig. 15. "
            "Left: in a left hysteresis, two periodic motions coexist. The motion of the forward "
            "sweep is smaller and hits each bumper twice per cycle. The motion of the backward "
            "sweep hits each bumper once per cycle. Right: there are two motions that are mirror "
            "images of each other, each displaced to one side. Between these two lies a smaller "
            "antisymmetric orbit, which is unstable. The paper calls the pair quasi-periodic. The "
            "computed pair is chaotic: disturbances grow exponentially, and the spectrum is "
            "continuous between the lines. Bands mark contacts. The left column has two rows of "
            "bands, with the forward sweep above the backward sweep. The right column has three: "
            "one motion of the pair, its mirror image and the antisymmetric orbit. The two motions "
            "of the pair have the same spectrum, so that only the spectrum of the mirror image, "
            "which is drawn last, is visible."
        ),
        draw=_irregular,
    ),
    Item(
        key="fig18",
        title="Fig. 18: motion of scenario S5 at resonance, B3 without a gap at A3",
        caption=(
            "Phase portrait, spectrum, time histories and clearances (the distances from the mass "
            "to each bumper) at the resonance of Fig. 17. The motion is nearly a sine. The mass "
            "seems to be in contact with one bumper or the other all the time. The magnified panel "
            "(lower right) shows two very short flights per cycle, in which both clearances are "
            "open. In a flight, the bumper that the mass has just left still has a small "
            "deformation. The bumper that the mass meets next has recovered its shape long before."
        ),
        draw=_attached,
    ),
)
