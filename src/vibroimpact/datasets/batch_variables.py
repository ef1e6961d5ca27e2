"""Output variables of computations with many motions: basins, manifolds of saddles and maps."""

from __future__ import annotations

from vibroimpact.datasets.variable import Variable, along, integer, text

MANY_MOTIONS: dict[str, Variable] = {
    **along(
        "attractor",
        attractor=integer("number of the steady motion", "the largest first"),
        mirror_image=integer("number of the mirror image", "-1: not among the motions"),
        border_distance=Variable(
            "m",
            "distance of the motion from the border of its basin",
            "at the section, with velocities divided by the angular frequency of the forcing; "
            "infinite if no state leads to another motion",
        ),
    ),
    **along(
        ("*", "velocity displacement"),
        basin=integer(
            "steady motion that the state leads to",
            "its number; -1: the state was given up, -2: the state lies beyond a rigid stop",
        ),
        capture_cycles=integer(
            "forcing cycles until it was certain to which motion the state leads",
            "-1: not simulated",
        ),
        level=integer(
            "level of refinement at which the node was computed",
            "-1: not computed; the node has the scenario of the square around it",
        ),
    ),
    **along(
        "point",
        section_attractor=integer("number of the motion that the point belongs to"),
        curve_number=integer("number of the curve that the point is on"),
        curve_displacement=Variable(
            "m", "relative displacement on a curve", "NaN where the curve jumps at a rigid stop"
        ),
        curve_velocity=Variable("m s-1", "relative velocity on a curve"),
    ),
    **along(
        ("attractor", "* attractor"),
        states=integer("number of states that lead to the motion"),
        share=Variable("1", "share of the states that lead to the motion"),
        **{
            f"share_{end}": Variable(
                "1",
                f"{which} end of the 95% interval of the share",
                "computed as for randomly drawn states; the share on a grid is more accurate",
            )
            for end, which in (("low", "lower"), ("high", "upper"))
        },
    ),
    **along(
        "*",
        given_up=integer("number of states that were given up"),
        scenario=integer("scenario", "S0 to S6, or 7 for none of them; -1: not computed yet"),
        confidence=Variable(
            "1",
            "confidence in the scenario",
            "share of the variations of the thresholds (halved and doubled) that do not change the "
            "scenario",
        ),
        extent=Variable(
            "1",
            "width of secondary left hystereses and non-regular resonances divided by the natural "
            "frequency",
        ),
        penetration_ratio=Variable("1", "largest penetration divided by the gap"),
        resonance_ratio=Variable(
            "1",
            "frequency of the primary resonance divided by its value without stops",
            "of η_d, forward",
        ),
        peak_eta_a_forward=Variable("1", "largest η_a, forward"),
        peak_eta_a_backward=Variable("1", "largest η_a, backward"),
        peak_eta_d_forward=Variable("1", "largest η_d, forward"),
        peak_eta_d_backward=Variable("1", "largest η_d, backward"),
        jump_down_ratio=Variable(
            "1", "frequency of the downward jump divided by the natural frequency"
        ),
        jump_up_ratio=Variable(
            "1", "frequency of the upward jump divided by the natural frequency"
        ),
        contact_low_ratio=Variable(
            "1", "lowest frequency with contact divided by the natural frequency"
        ),
        contact_high_ratio=Variable(
            "1", "highest frequency with contact divided by the natural frequency"
        ),
        left_hysteresis_count=integer("number of left hystereses"),
        secondary_count=integer("number of regular secondary resonances"),
        irregular_count=integer("number of ranges that are not regular"),
        chaotic_count=integer("number of ranges with chaotic motions"),
        quasi_periodic_count=integer("number of ranges with quasi-periodic motions"),
        subharmonic_count=integer("number of ranges with subharmonic motions"),
        mirrored_pair_count=integer("number of ranges with mirrored pairs of motions"),
    ),
    **along(
        "",
        basin_entropy=Variable("1", "basin entropy of boxes of 5 × 5 states"),
        border_entropy=Variable(
            "1", "basin entropy of the boxes on a border", "above ln 2 the border is fractal"
        ),
        uncertainty_exponent=Variable(
            "1",
            "exponent of the share of uncertain states",
            "1 for a smooth border; the dimension of the border is 2 minus this exponent",
        ),
        uncertainty_exponent_error=Variable("1", "standard error of the uncertainty exponent"),
    ),
    **along(
        "curve",
        curve_kind=text("stable or unstable"),
        curve_saddle=integer("number of the saddle that the curve belongs to"),
        curve_length=Variable(
            "1", "length of the curve", "in units in which each side of the window has the length 1"
        ),
        curve_ended=text("why the curve ends"),
    ),
    **along(
        "saddle",
        saddle_displacement=Variable("m", "relative displacement of the saddle"),
        saddle_velocity=Variable("m s-1", "relative velocity of the saddle"),
        saddle_period=integer("period of the saddle in forcing cycles"),
        multiplier_growing=Variable(
            "1", "Floquet multiplier of the growing disturbance at the saddle"
        ),
        multiplier_dying=Variable(
            "1", "Floquet multiplier of the decaying disturbance at the saddle"
        ),
    ),
    **along(
        "crossing",
        crossing_displacement=Variable("m", "relative displacement where two curves cross"),
        crossing_velocity=Variable("m s-1", "relative velocity where two curves cross"),
        crossing_stable=integer("number of the stable curve that is crossed"),
        crossing_unstable=integer("number of the unstable curve that crosses it"),
    ),
}
