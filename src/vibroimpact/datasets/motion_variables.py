"""Output variables of one motion, of its orbit and of branches of orbits."""

from __future__ import annotations

from vibroimpact.datasets.variable import (
    CONTACTS,
    SECTION,
    STEADY,
    Variable,
    along,
    each,
    integer,
    text,
    truth,
)

STATE_UNITS = "components in m, m/s, m, rad and 1"
"""Of lengths and the memory of a link, velocities, the phase, and whether stops are touched."""

MOTIONS: dict[str, Variable] = {
    **along(
        "time",
        displacement=Variable("m", "relative displacement", part="mass"),
        velocity=Variable("m s-1", "relative velocity", part="mass"),
        acceleration=Variable(
            "m s-2",
            "absolute acceleration",
            "at a jump: the value just after the event",
            part="mass",
        ),
        base_acceleration=Variable("m s-2", "base acceleration"),
        applied_force=Variable("N", "force on the mass"),
        transmitted_force=Variable(
            "N",
            "force transmitted to the base",
            "of the isolator and the stops together, positive to the right; at a jump: the value "
            "just after the event",
        ),
        isolator_memory=Variable(
            "m", "memory of the isolator", "the internal state z of its law; see State.isolator"
        ),
    ),
    **along(
        ("component", "attractor component"),
        initial_state=Variable("1", "state at the beginning", "components as in final_state"),
        final_state=Variable("1", "state at the end", STATE_UNITS),
    ),
    **along(
        "event",
        event_isolator_memory=Variable("m", "memory of the isolator at the event"),
        event_time=Variable("s", "time of the event"),
        event_cycle=integer("forcing cycle of the event, counted from 0"),
        event_cycle_time=Variable("s", "time of the event since the start of its cycle"),
        event_contact=integer(
            "kind of event: 1 start of a contact, 0 end of a contact, 2 impact",
            "contact with a rigid stop means rest on it",
        ),
        event_displacement=Variable("m", "relative displacement at the event", part="mass"),
        event_velocity=Variable(
            "m s-1",
            "relative velocity at the event",
            "for an impact on a rigid stop: the value before the impact",
            part="mass",
        ),
        event_acceleration_before=Variable(
            "m s-2", "absolute acceleration just before the event", part="mass"
        ),
        event_acceleration_after=Variable(
            "m s-2", "absolute acceleration just after the event", part="mass"
        ),
        event_transmitted_force_before=Variable(
            "N", "force transmitted to the base just before the event"
        ),
        event_transmitted_force_after=Variable(
            "N", "force transmitted to the base just after the event"
        ),
    ),
    **along(
        "contact_number",
        contact_start=Variable("s", "time at which the contact begins"),
        contact_end=Variable("s", "time at which the contact ends"),
        contact_end_phase=Variable("rad", "phase of the excitation at the end of the contact"),
        contact_duration=Variable("s", "duration of the contact"),
        contact_duration_share=Variable(
            "1", "duration of the contact divided by the forcing period"
        ),
        contact_end_velocity=Variable(
            "m s-1", "relative velocity at the end of the contact", part="mass"
        ),
        contact_peak_force=Variable("N", "largest contact force", "NaN for an impact"),
        contact_impulse=Variable("N s", "impulse of the contact force"),
        contact_penetration=Variable("m", "largest deformation of the bumper during the contact"),
        contact_dissipated=Variable(
            "J", "energy lost in the bumper's dashpot during the contact, or in an impact"
        ),
        contact_dissipated_relaxing=Variable(
            "J",
            "energy lost in the bumper's dashpot after the contact",
            "while it relaxes, until it is pressed again or the record ends",
        ),
        contact_peak_acceleration=Variable(
            "m s-2",
            "largest absolute acceleration during the contact, without sign",
            "one-sided values at contact and detachment included",
        ),
        contact_peak_time=Variable("s", "time of the largest absolute acceleration"),
        contact_restitution=Variable(
            "1",
            "effective restitution coefficient",
            "separation velocity divided by closing velocity of the mass",
        ),
        contact_closing_speed=Variable(
            "m s-1",
            "speed at which the clearance closes",
            "including the speed of a relaxing bumper",
        ),
        contact_grazing=truth("whether the contact only grazes"),
    ),
    **along(
        CONTACTS,
        contact_start_phase=Variable("rad", "phase of the excitation at the start of the contact"),
        contact_start_velocity=Variable(
            "m s-1", "relative velocity at the start of the contact", part="mass"
        ),
    ),
    **along(
        SECTION,
        section_displacement=Variable("m", "relative displacement at the section", part="mass"),
        section_velocity=Variable("m s-1", "relative velocity at the section", part="mass"),
    ),
    **along(
        "order",
        order=Variable("1", "frequency divided by the excitation frequency"),
        line_frequency=Variable("Hz", "frequency of the spectral line"),
        displacement_amplitude=Variable("m", "amplitude of relative displacement", part="mass"),
        velocity_amplitude=Variable("m s-1", "amplitude of relative velocity", part="mass"),
        acceleration_amplitude=Variable("m s-2", "amplitude of absolute acceleration", part="mass"),
        displacement_phase=Variable(
            "rad", "phase of relative displacement (of a cosine)", part="mass"
        ),
        velocity_phase=Variable("rad", "phase of relative velocity (of a cosine)", part="mass"),
        acceleration_phase=Variable(
            "rad", "phase of absolute acceleration (of a cosine)", part="mass"
        ),
    ),
    **along(
        STEADY,
        antisymmetric=truth("whether u(t + T/2) = -u(t), T the period of the motion"),
        mirror_distance=Variable(
            "1",
            "distance of the motion from its mirror image half a period later",
            "largest difference of states divided by the size of the motion; NaN if the rig is not "
            "symmetric",
        ),
        exponents_cycles=integer("number of forcing cycles over which the exponents were computed"),
        effective_damping=Variable(
            "s-1",
            "mean damping per unit mass, including that of compressed bumpers",
            "minus the sum of the two exponents, if the memory of the bumpers has decayed",
        ),
        stable=integer(
            "whether the motion is stable: no small disturbance grows",
            "1 yes, 0 no, -1 undecided: not an orbit, no dissipation, or exactly at a bifurcation",
        ),
        mirror_pair=truth("whether the mirror image of the motion is a different motion"),
        energy_supplied=Variable("J", "work of the excitation on the mass per forcing cycle"),
        energy_isolator=Variable("J", "energy lost in the isolator per forcing cycle"),
        energy_bumpers=Variable("J", "energy lost in the stops per forcing cycle"),
    ),
    **along(
        each(STEADY, "exponent"),
        exponents=Variable("s-1", "largest Lyapunov exponents"),
        exponents_uncertainty=Variable("s-1", "standard uncertainty of the Lyapunov exponents"),
    ),
    **along("rig *", settling=truth("whether the motion was still converging to a periodic one")),
    **along(
        "fold",
        fold_frequency=Variable(
            "Hz", "frequency at which the branch of the primary resonance turns back"
        ),
    ),
    **along(
        "point",
        arclength=Variable("1", "arclength along the branch, in scaled components"),
        branch=integer("number of the branch"),
        piece=integer(
            "number of the smooth piece", "it changes where the sequence of contacts changes"
        ),
    ),
    **along(
        ("multiplier", "point multiplier"),
        multiplier_real=Variable("1", "real part of the Floquet multipliers"),
        multiplier_imag=Variable("1", "imaginary part of the Floquet multipliers"),
    ),
    **along(
        "component_after component_before",
        monodromy=Variable(
            "1",
            "derivative of the state after one period with respect to the initial state",
            "of u, u', u_right, u_left (positive when compressed) and the isolator's memory, if it "
            "has one; in SI units",
        ),
    ),
    **along(
        "",
        residual=Variable("1", "error of the periodicity divided by the size of the motion"),
        total_supplied=Variable("J", "work of the excitation on the mass during the whole motion"),
        total_isolator=Variable("J", "energy lost in the isolator during the whole motion"),
        total_bumpers=Variable("J", "energy lost in the stops during the whole motion"),
    ),
    **along(
        "bifurcation",
        bifurcation_kind=text("kind of bifurcation"),
        bifurcation_value=Variable("1", "parameter at the bifurcation", "in the parameter's units"),
        bifurcation_arclength=Variable("1", "arclength at the bifurcation"),
        bifurcation_turns=integer("whether the branch turns back at the bifurcation"),
        bifurcation_branch=integer("number of the branch of the bifurcation"),
        bifurcation_displacement_excursion=Variable(
            "m", "excursion of relative displacement", part="mass"
        ),
        bifurcation_eta_d=Variable("1", "normalised excursion of relative displacement"),
        bifurcation_eta_a=Variable("1", "normalised excursion of absolute acceleration"),
        bifurcation_eccentricity=Variable("m", "eccentricity at the bifurcation", part="mass"),
        bifurcation_peak_displacement=Variable("m", "largest relative displacement", part="mass"),
        bifurcation_peak_acceleration=Variable(
            "m s-2", "largest absolute acceleration", part="mass"
        ),
        bifurcation_peak_transmitted_force=Variable(
            "N", "largest force transmitted to the base, without sign"
        ),
        bifurcation_transmissibility=Variable("1", "transmissibility at the bifurcation"),
        bifurcation_period=integer("period of the orbit in forcing cycles"),
        bifurcation_contacts=text(
            "contacts per period", "for a grazing bifurcation: on both of its sides"
        ),
        bifurcation_antisymmetric=truth("whether the orbit is its own mirror image"),
    ),
    **along(
        "cusp_number",
        cusp_first=Variable("1", "first parameter at the cusp", "in the parameter's units"),
        cusp_second=Variable("1", "second parameter at the cusp", "in the parameter's units"),
    ),
    **along(
        "bifurcation multiplier",
        bifurcation_multiplier_real=Variable("1", "real part of the Floquet multipliers"),
        bifurcation_multiplier_imag=Variable("1", "imaginary part of the Floquet multipliers"),
    ),
    **along(
        "bifurcation component",
        bifurcation_section=Variable("1", "state at the stroboscopic section", STATE_UNITS),
    ),
    **along(
        "attractor",
        evidence=text("reason for the classification of the motion"),
        starts=text("names of the initial states that led to the motion"),
        mirrored_starts=text("names of the initial states that led to its mirror image"),
    ),
}
