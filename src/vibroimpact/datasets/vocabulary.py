"""Units and meaning of every output variable."""

from __future__ import annotations

from vibroimpact.datasets.batch_variables import MANY_MOTIONS
from vibroimpact.datasets.variable import Variable
from vibroimpact.model.parameters import PARAMETERS

_OVER = (
    "divided by the largest excursion at any frequency without stops, for the same isolator and "
    "amplitude"
)
_RIGID = "infinite if the mass hit a rigid stop"
_CHATTER = (
    "a chatter that ends at rest on a rigid stop has infinitely many impacts; only the impacts "
    "before the chatter is regarded as complete are counted"
)

_OWN = "in the SI unit of the parameter"

VARIABLES: dict[str, Variable] = {
    # parameters that can be varied
    **{p.name: Variable(p.units, p.long_name, p.comment) for p in PARAMETERS.values()},
    # coordinates
    "direction": Variable("1", "sweep direction"),
    "rig": Variable("1", "rig"),
    "time": Variable("s", "time"),
    "cycle": Variable("1", "time in forcing cycles"),
    "start": Variable(
        "1", "initial state of the motions", "up, down: the final state at the value before"
    ),
    "component": Variable("1", "component of the state"),
    # sweep
    "displacement_excursion": Variable(
        "m", "excursion of relative displacement", "exact maximum minus exact minimum"
    ),
    "acceleration_excursion": Variable(
        "m s-2",
        "excursion of absolute acceleration",
        "exact maximum minus exact minimum, including one-sided values at contact and detachment",
    ),
    "eta_d": Variable(
        "1",
        "normalised excursion of relative displacement",
        _OVER,
    ),
    "eta_a": Variable(
        "1",
        "normalised excursion of absolute acceleration",
        _OVER,
    ),
    "displacement_max": Variable(
        "m", "largest relative displacement", "largest displacement to the right"
    ),
    "displacement_min": Variable(
        "m", "smallest relative displacement", "minus the largest displacement to the left"
    ),
    "acceleration_max": Variable("m s-2", "largest absolute acceleration"),
    "acceleration_min": Variable("m s-2", "smallest absolute acceleration"),
    "peak_impulse_right": Variable("N s", "largest impulse of an impact on the right rigid stop"),
    "peak_impulse_left": Variable("N s", "largest impulse of an impact on the left rigid stop"),
    "eccentricity": Variable("m", "eccentricity", "half the sum of the displacement's extremes"),
    "impacts_right": Variable("1", "contacts with the right stop per forcing cycle", _CHATTER),
    "impacts_left": Variable("1", "contacts with the left stop per forcing cycle", _CHATTER),
    "motion": Variable(
        "1",
        "kind of motion",
        "periodic, quasi-periodic, chaotic or undecided; a sweep distinguishes periodic and "
        "undecided only",
    ),
    "period": Variable("1", "period in forcing cycles", "0 where the motion did not settle"),
    "cycles": Variable(
        "1",
        "number of forcing cycles simulated, including the measured ones",
        "0 where the free motion was computed in closed form",
    ),
    "status": Variable("1", "how the computation ended"),
    "free_displacement_excursion": Variable(
        "m", "excursion of relative displacement in steady free flight"
    ),
    "free_acceleration_excursion": Variable(
        "m s-2", "excursion of absolute acceleration in steady free flight"
    ),
    "largest_free_displacement_excursion": Variable(
        "m", "largest excursion of relative displacement in free flight at any frequency"
    ),
    "largest_free_acceleration_excursion": Variable(
        "m s-2", "largest excursion of absolute acceleration in free flight at any frequency"
    ),
    "section": Variable(
        "1",
        "state at the stroboscopic section at the end of each frequency step",
        "components in m, m/s, m, m, rad and 1",
    ),
    # simulation
    "displacement": Variable("m", "relative displacement"),
    "velocity": Variable("m s-1", "relative velocity"),
    "acceleration": Variable(
        "m s-2", "absolute acceleration", "at a jump: the value just after the event"
    ),
    "base_acceleration": Variable("m s-2", "base acceleration"),
    "applied_force": Variable("N", "force on the mass"),
    "right_bumper": Variable("m", "deformation of the right bumper"),
    "left_bumper": Variable("m", "deformation of the left bumper, negative when compressed"),
    "right_clearance": Variable("m", "clearance between mass and right bumper"),
    "left_clearance": Variable("m", "clearance between mass and left bumper"),
    "contact": Variable("1", "stop touched: -1 left, 0 none, 1 right, 2 both"),
    "initial_state": Variable("1", "state at the beginning", "components as in final_state"),
    "isolator_memory": Variable(
        "m", "memory of the isolator", "the internal state z of its law; see State.isolator"
    ),
    "event_isolator_memory": Variable("m", "memory of the isolator at the event"),
    "final_state": Variable("1", "state at the end", "components in m, m/s, m, m, rad and 1"),
    "event_time": Variable("s", "time of the event"),
    "event_cycle": Variable("1", "forcing cycle of the event, counted from 0"),
    "event_cycle_time": Variable("s", "time of the event since the start of its cycle"),
    "event_contact": Variable(
        "1",
        "kind of event: 1 start of a contact, 0 end of a contact, 2 impact",
        "contact with a rigid stop means rest on it",
    ),
    "event_side": Variable("1", "stop of the event: -1 left, 1 right"),
    "event_displacement": Variable("m", "relative displacement at the event"),
    "event_velocity": Variable(
        "m s-1",
        "relative velocity at the event",
        "for an impact on a rigid stop: the value before the impact",
    ),
    "event_right_bumper": Variable("m", "deformation of the right bumper at the event"),
    "event_left_bumper": Variable("m", "deformation of the left bumper at the event"),
    "event_acceleration_before": Variable("m s-2", "absolute acceleration just before the event"),
    "event_acceleration_after": Variable("m s-2", "absolute acceleration just after the event"),
    # measurements
    "repeat": Variable("1", "number of the repetition, if a frequency was measured more than once"),
    "mass_displacement": Variable("m", "absolute displacement of the mass"),
    "base_displacement": Variable("m", "displacement of the base"),
    "contact_force": Variable("N", "contact force, with the sign of the sensor"),
    # fits
    "parameter": Variable("1", "fitted parameter"),
    "other_parameter": Variable("1", "fitted parameter"),
    "test": Variable("1", "name of the test"),
    "test_kind": Variable("1", "kind of the test: curves or history"),
    "amplitude_source": Variable("1", "source of the amplitude of the test"),
    "fitted_value": Variable("1", "fitted value", _OWN),
    "start_value": Variable("1", "starting value of the fit", _OWN),
    "standard_error": Variable("1", "standard error", _OWN),
    "parameter_units": Variable("1", "unit of the parameter"),
    "covariance": Variable("1", "covariance of the parameters", _OWN),
    "correlation": Variable("1", "correlation of the parameters"),
    "interval": Variable("1", "confidence interval", _OWN),
    "interval_open": Variable("1", "whether a bound, not the data, limits the interval"),
    "alternative_value": Variable("1", "parameters of another rig that fits equally well", _OWN),
    "alternative_rise": Variable(
        "1", "increase of the deviance for another rig that fits equally well"
    ),
    "alternative_mirrored": Variable(
        "1", "whether the other rig is the mirror image of the fitted rig"
    ),
    "profile_value": Variable("1", "value at which the parameter was fixed", _OWN),
    "profile_rise": Variable("1", "increase of the deviance with all other parameters fitted"),
    "bootstrap_value": Variable("1", "fitted value of a bootstrap sample", _OWN),
    "posterior_value": Variable("1", "sample of the posterior", _OWN),
    "point_test": Variable("1", "test of the point"),
    "point_direction": Variable("1", "sweep direction of the point"),
    "point_variable": Variable("1", "measured variable"),
    "point_place": Variable("1", "frequency (Hz) or time (s) of the point"),
    "measured_value": Variable("1", "measured value", "in the SI unit of the measured variable"),
    "modelled_value": Variable("1", "value of the fit", "in the SI unit of the measured variable"),
    "fit_residual": Variable("1", "residual", "for curves: as a share of the value"),
    "noise": Variable("1", "standard deviation of the residuals"),
    "data_noise": Variable("1", "standard deviation of the measurement noise", "0: unknown"),
    "residual_correlation": Variable("1", "correlation of neighbouring residuals"),
    "residual_chance": Variable("1", "probability that pure noise has at least this correlation"),
    "residual_excess": Variable("1", "ratio of the residuals to the noise of the measurement"),
    "residual_excess_chance": Variable("1", "probability that pure noise has at least this ratio"),
    "log_likelihood": Variable("1", "logarithm of the likelihood"),
    "akaike": Variable("1", "Akaike's criterion, corrected for few points"),
    "model": Variable("1", "model"),
    "akaike_weight": Variable("1", "Akaike weight of the model"),
    "parameter_count": Variable("1", "number of fitted parameters"),
    "bayes": Variable("1", "Bayesian information criterion"),
    "candidate_amplitude": Variable("m s-2", "peak base acceleration of the next test"),
    "information": Variable(
        "1", "information that the test would give about all parameters", "in nats"
    ),
    "remaining_error": Variable("1", "standard error after the test divided by that before it"),
    # contacts
    "contact_side": Variable("1", "stop of the contact: -1 left, 1 right"),
    "contact_start": Variable("s", "time at which the contact begins"),
    "contact_end": Variable("s", "time at which the contact ends"),
    "contact_start_phase": Variable("rad", "phase of the excitation at the start of the contact"),
    "contact_end_phase": Variable("rad", "phase of the excitation at the end of the contact"),
    "contact_duration": Variable("s", "duration of the contact"),
    "contact_duration_share": Variable(
        "1", "duration of the contact divided by the forcing period"
    ),
    "contact_start_velocity": Variable("m s-1", "relative velocity at the start of the contact"),
    "contact_end_velocity": Variable("m s-1", "relative velocity at the end of the contact"),
    "contact_peak_force": Variable("N", "largest contact force", "NaN for an impact"),
    "contact_impulse": Variable("N s", "impulse of the contact force"),
    "contact_penetration": Variable("m", "largest deformation of the bumper during the contact"),
    "contact_dissipated": Variable(
        "J", "energy lost in the bumper's dashpot during the contact, or in an impact"
    ),
    "contact_dissipated_relaxing": Variable(
        "J",
        "energy lost in the bumper's dashpot after the contact",
        "while it relaxes, until it is pressed again or the record ends",
    ),
    "contact_peak_acceleration": Variable(
        "m s-2",
        "largest absolute acceleration during the contact, without sign",
        "one-sided values at contact and detachment included",
    ),
    "contact_peak_time": Variable("s", "time of the largest absolute acceleration"),
    "contact_restitution": Variable(
        "1",
        "effective restitution coefficient",
        "separation velocity divided by closing velocity of the mass",
    ),
    "contact_closing_speed": Variable(
        "m s-1", "speed at which the clearance closes", "including the speed of a relaxing bumper"
    ),
    "contact_grazing": Variable("1", "whether the contact only grazes"),
    # sections
    "section_displacement": Variable("m", "relative displacement at the section"),
    "section_velocity": Variable("m s-1", "relative velocity at the section"),
    "section_right_bumper": Variable("m", "deformation of the right bumper at the section"),
    "section_left_bumper": Variable("m", "deformation of the left bumper at the section"),
    # spectrum
    "order": Variable("1", "frequency divided by the excitation frequency"),
    "line_frequency": Variable("Hz", "frequency of the spectral line"),
    "displacement_amplitude": Variable("m", "amplitude of relative displacement"),
    "velocity_amplitude": Variable("m s-1", "amplitude of relative velocity"),
    "acceleration_amplitude": Variable("m s-2", "amplitude of absolute acceleration"),
    "displacement_phase": Variable("rad", "phase of relative displacement (of a cosine)"),
    "velocity_phase": Variable("rad", "phase of relative velocity (of a cosine)"),
    "acceleration_phase": Variable("rad", "phase of absolute acceleration (of a cosine)"),
    # steady motion
    "antisymmetric": Variable("1", "whether u(t + T/2) = -u(t), T the period of the motion"),
    "mirror_distance": Variable(
        "1",
        "distance of the motion from its mirror image half a period later",
        "largest difference of states divided by the size of the motion; NaN if the rig is not "
        "symmetric",
    ),
    "exponents": Variable("s-1", "largest two Lyapunov exponents"),
    "exponents_uncertainty": Variable("s-1", "standard uncertainty of the Lyapunov exponents"),
    "exponents_cycles": Variable(
        "1", "number of forcing cycles over which the exponents were computed"
    ),
    "settling": Variable("1", "whether the motion was still converging to a periodic one"),
    "effective_damping": Variable(
        "s-1",
        "mean damping per unit mass, including that of compressed bumpers",
        "minus the sum of the two exponents, if the memory of the bumpers has decayed",
    ),
    "stable": Variable(
        "1",
        "whether the motion is stable: no small disturbance grows",
        "1 yes, 0 no, -1 undecided: not an orbit, no dissipation, or exactly at a bifurcation",
    ),
    "fold_frequency": Variable(
        "Hz", "frequency at which the branch of the primary resonance turns back"
    ),
    # branches
    "arclength": Variable("1", "arclength along the branch, in scaled components"),
    "branch": Variable("1", "number of the branch"),
    "piece": Variable(
        "1", "number of the smooth piece", "it changes where the sequence of contacts changes"
    ),
    "multiplier_real": Variable("1", "real part of the Floquet multipliers"),
    "multiplier_imag": Variable("1", "imaginary part of the Floquet multipliers"),
    "monodromy": Variable(
        "1",
        "derivative of the state after one period with respect to the initial state",
        "of u, u', u_R, u_L, in SI units",
    ),
    "residual": Variable("1", "error of the periodicity divided by the size of the motion"),
    "bifurcation_kind": Variable("1", "kind of bifurcation"),
    "bifurcation_value": Variable("1", "parameter at the bifurcation", "in the parameter's units"),
    "bifurcation_arclength": Variable("1", "arclength at the bifurcation"),
    "bifurcation_turns": Variable("1", "whether the branch turns back at the bifurcation"),
    "bifurcation_branch": Variable("1", "number of the branch of the bifurcation"),
    "bifurcation_displacement_excursion": Variable("m", "excursion of relative displacement"),
    "bifurcation_eta_d": Variable("1", "normalised excursion of relative displacement"),
    "bifurcation_eta_a": Variable("1", "normalised excursion of absolute acceleration"),
    "bifurcation_eccentricity": Variable("m", "eccentricity at the bifurcation"),
    "bifurcation_peak_displacement": Variable("m", "largest relative displacement"),
    "bifurcation_peak_acceleration": Variable("m s-2", "largest absolute acceleration"),
    "bifurcation_peak_force_right": Variable("N", "largest contact force of the right stop"),
    "bifurcation_peak_force_left": Variable("N", "largest contact force of the left stop"),
    "bifurcation_period": Variable("1", "period of the orbit in forcing cycles"),
    "bifurcation_contacts": Variable(
        "1", "contacts per period", "for a grazing bifurcation: on both of its sides"
    ),
    "bifurcation_antisymmetric": Variable("1", "whether the orbit is its own mirror image"),
    "cusp_first": Variable("1", "first parameter at the cusp", "in the parameter's units"),
    "cusp_second": Variable("1", "second parameter at the cusp", "in the parameter's units"),
    "bifurcation_multiplier_real": Variable("1", "real part of the Floquet multipliers"),
    "bifurcation_multiplier_imag": Variable("1", "imaginary part of the Floquet multipliers"),
    "bifurcation_section": Variable(
        "1", "state at the stroboscopic section", "components in m, m/s, m, m, rad and 1"
    ),
    "evidence": Variable("1", "reason for the classification of the motion"),
    "starts": Variable("1", "names of the initial states that led to the motion"),
    "mirrored_starts": Variable("1", "names of the initial states that led to its mirror image"),
    "mirror_pair": Variable("1", "whether the mirror image of the motion is a different motion"),
    "energy_supplied": Variable("J", "work of the base on the mass per forcing cycle"),
    "energy_isolator": Variable("J", "energy lost in the isolator per forcing cycle"),
    "energy_bumpers": Variable("J", "energy lost in the stops per forcing cycle"),
    "total_supplied": Variable("J", "work of the excitation on the mass during the whole motion"),
    "total_isolator": Variable("J", "energy lost in the isolator during the whole motion"),
    "total_bumpers": Variable("J", "energy lost in the stops during the whole motion"),
    # sweeps, branches and earthquakes
    "peak_displacement": Variable("m", "largest relative displacement to either side"),
    "peak_displacement_right": Variable("m", "largest relative displacement to the right"),
    "peak_displacement_left": Variable("m", "largest relative displacement to the left"),
    "peak_acceleration": Variable(
        "m s-2", "largest absolute acceleration, without sign", "excluding impacts on rigid stops"
    ),
    "peak_force": Variable("N", "largest contact force of either stop", _RIGID),
    "peak_force_right": Variable("N", "largest contact force of the right stop", _RIGID),
    "peak_force_left": Variable("N", "largest contact force of the left stop", _RIGID),
    # earthquakes
    "impulse": Variable("N s", "impulse of both stops' contact forces, without sign"),
    "impulse_right": Variable("N s", "impulse of the right stop's contact force"),
    "impulse_left": Variable("N s", "impulse of the left stop's contact force"),
    "impact_count": Variable("1", "number of contacts with either stop"),
    "impact_count_right": Variable("1", "number of contacts with the right stop"),
    "impact_count_left": Variable("1", "number of contacts with the left stop"),
    "residual_displacement": Variable("m", "displacement at which the mass comes to rest"),
    "residual_swing": Variable(
        "m", "half the width of the last swing around the residual displacement"
    ),
    "record": Variable("1", "name of the record"),
    "scale": Variable("1", "level of shaking"),
    "factor": Variable("1", "number that the record is multiplied by"),
    "intensity": Variable("1", "intensity measure of the unscaled record"),
    "fractile": Variable("1", "share of the records whose peak is below the value"),
    "exceeding": Variable("1", "number of records whose peak is above the limit"),
    "probability": Variable("1", "share of the records whose peak is above the limit"),
    "median_capacity": Variable("1", "level at which half of the records reach the limit"),
    "dispersion": Variable(
        "1", "standard deviation of the logarithm of the level at which records reach the limit"
    ),
    "fitted_probability": Variable("1", "fitted probability of exceeding the limit"),
    "bound": Variable("1", "lower or upper end of a confidence interval"),
    "median_capacity_bound": Variable("1", "confidence interval of the median capacity"),
    "dispersion_bound": Variable("1", "confidence interval of the dispersion"),
    "fitted_probability_bound": Variable("1", "confidence band of the fitted probability"),
    # sizing
    "penetration": Variable("m", "largest displacement beyond a gap"),
    "hitting": Variable(
        "1", "share of the records under which the mass hits a stop; for a sine: whether it does"
    ),
    "pareto": Variable(
        "1", "whether no other design is better in both displacement and acceleration"
    ),
    "within_limits": Variable("1", "whether the design satisfies all limits"),
    "displacement_frequency": Variable("Hz", "frequency of the largest displacement"),
    "acceleration_frequency": Variable("Hz", "frequency of the largest acceleration"),
    "unsettled_count": Variable("1", "number of frequency steps without a periodic motion"),
    **{
        f"required_gap{side}": Variable("m", f"gap of {which} side with which there is no contact")
        for side, which in (("", "each"), ("_right", "the right"), ("_left", "the left"))
    },
    "evaluations": Variable("1", "number of designs that were tried"),
    # ensembles
    "uncertain_parameter": Variable("1", "uncertain parameter"),
    "first_order": Variable(
        "1", "share of the variance due to the parameter alone", "Sobol's first-order index"
    ),
    "total_order": Variable(
        "1",
        "share of the variance due to the parameter and its interactions",
        "Sobol's total-order index",
    ),
    "first_order_interval": Variable("1", "95 % interval of the first-order index"),
    "total_order_interval": Variable("1", "95 % interval of the total-order index"),
    "mean": Variable("1", "mean of the response"),
    "variance": Variable("1", "variance of the response"),
    # response spectra
    "natural_period": Variable("s", "natural period", "0: rigid, the mass moves with the base"),
    "orientation": Variable(
        "1",
        "direction of the response",
        "the two components, and the median and the largest over 180 directions in steps of one "
        "degree",
    ),
    "spectral_displacement": Variable("m", "largest relative displacement, from rest"),
    "spectral_velocity": Variable("m s-1", "largest relative velocity, from rest"),
    "spectral_acceleration": Variable("m s-2", "largest absolute acceleration, from rest"),
    "pseudo_velocity": Variable("m s-1", "pseudo-velocity", "angular frequency times displacement"),
    "pseudo_acceleration": Variable(
        "m s-2", "pseudo-acceleration", "angular frequency squared times displacement"
    ),
    **MANY_MOTIONS,
}
