"""Output variables of measurements and of fits to them."""

from __future__ import annotations

from vibroimpact.datasets.variable import Variable, along, integer, text

_OWN = "in the SI unit of the parameter"

FITS: dict[str, Variable] = {
    **along(
        "repeat",
        repeat=integer("number of the repetition, if a frequency was measured more than once"),
    ),
    **along(
        "time",
        mass_displacement=Variable("m", "absolute displacement of the mass"),
        base_displacement=Variable("m", "displacement of the base"),
    ),
    **along(
        "parameter",
        parameter=text("fitted parameter"),
        fitted_value=Variable("1", "fitted value", _OWN),
        start_value=Variable("1", "starting value of the fit", _OWN),
        standard_error=Variable("1", "standard error", _OWN),
        parameter_units=text("unit of the parameter"),
    ),
    **along("other_parameter", other_parameter=text("fitted parameter")),
    **along(
        "test",
        test=text("name of the test"),
        test_kind=text("kind of the test: curves or history"),
        amplitude_source=text("source of the amplitude of the test"),
        data_noise=Variable("1", "standard deviation of the measurement noise", "0: unknown"),
        residual_correlation=Variable("1", "correlation of neighbouring residuals"),
        residual_excess=Variable("1", "ratio of the residuals to the noise of the measurement"),
        residual_excess_chance=Variable("1", "probability that pure noise has at least this ratio"),
    ),
    **along(
        "parameter other_parameter",
        covariance=Variable("1", "covariance of the parameters", _OWN),
        correlation=Variable("1", "correlation of the parameters"),
    ),
    **along(
        "parameter bound",
        interval=Variable("1", "confidence interval", _OWN),
        interval_open=integer("whether a bound, not the data, limits the interval"),
    ),
    **along(
        "alternative parameter",
        alternative_value=Variable("1", "parameters of another rig that fits equally well", _OWN),
    ),
    **along(
        "alternative",
        alternative_rise=Variable(
            "1", "increase of the deviance for another rig that fits equally well"
        ),
        alternative_mirrored=Variable(
            "1", "whether the other rig is the mirror image of the fitted rig"
        ),
    ),
    **along(
        "parameter profile_point",
        profile_value=Variable("1", "value at which the parameter was fixed", _OWN),
        profile_rise=Variable("1", "increase of the deviance with all other parameters fitted"),
    ),
    **along(
        "bootstrap_draw parameter",
        bootstrap_value=Variable("1", "fitted value of a bootstrap sample", _OWN),
    ),
    **along(
        "posterior_draw parameter",
        posterior_value=Variable("1", "sample of the posterior", _OWN),
    ),
    **along(
        "point",
        point_test=text("test of the point"),
        point_direction=text("sweep direction of the point"),
        point_variable=text("measured variable"),
        point_place=Variable("1", "frequency (Hz) or time (s) of the point"),
        measured_value=Variable("1", "measured value", "in the SI unit of the measured variable"),
        modelled_value=Variable("1", "value of the fit", "in the SI unit of the measured variable"),
        fit_residual=Variable("1", "residual", "for curves: as a share of the value"),
    ),
    **along(
        ("test", "model"),
        noise=Variable("1", "standard deviation of the residuals"),
        residual_chance=Variable("1", "probability that pure noise has at least this correlation"),
    ),
    **along(
        ("", "model"),
        log_likelihood=Variable("1", "logarithm of the likelihood"),
        akaike=Variable("1", "Akaike's criterion, corrected for few points"),
        bayes=Variable("1", "Bayesian information criterion"),
    ),
    **along(
        "model",
        model=text("model"),
        akaike_weight=Variable("1", "Akaike weight of the model"),
        parameter_count=integer("number of fitted parameters"),
    ),
    **along(
        "candidate_amplitude",
        candidate_amplitude=Variable("m s-2", "peak base acceleration of the next test"),
    ),
    **along(
        "candidate_amplitude direction frequency",
        information=Variable(
            "1", "information that the test would give about all parameters", "in nats"
        ),
    ),
    **along(
        "candidate_amplitude direction frequency parameter",
        remaining_error=Variable("1", "standard error after the test divided by that before it"),
    ),
}
