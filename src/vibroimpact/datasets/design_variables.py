"""Output variables of earthquakes, of the design of stops and of ensembles."""

from __future__ import annotations

from vibroimpact.datasets.variable import (
    ANY_PEAKS,
    SHAKEN,
    SPECTRUM,
    Variable,
    along,
    integer,
    text,
    truth,
)

DESIGN: dict[str, Variable] = {
    **along(
        ANY_PEAKS,
        peak_displacement=Variable(
            "m", "largest relative displacement to either side", part="mass"
        ),
        peak_acceleration=Variable(
            "m s-2",
            "largest absolute acceleration, without sign",
            "excluding impacts on rigid stops",
            part="mass",
        ),
    ),
    **along(
        SHAKEN,
        residual_displacement=Variable("m", "displacement at which the mass comes to rest"),
        residual_swing=Variable(
            "m", "half the width of the last swing around the residual displacement"
        ),
    ),
    **along(
        "record",
        record=text("name of the record"),
        intensity=Variable("1", "intensity measure of the unscaled record"),
    ),
    **along("scale", scale=Variable("1", "level of shaking")),
    **along("record scale", factor=Variable("1", "number that the record is multiplied by")),
    **along(
        "fractile",
        fractile=Variable("1", "share of the records whose peak is below the value"),
    ),
    **along(
        ("scale *", "scale * part"),
        exceeding=integer("number of records whose peak is above the limit"),
        probability=Variable("1", "share of the records whose peak is above the limit"),
        fitted_probability=Variable("1", "fitted probability of exceeding the limit"),
    ),
    **along(
        ("*", "* part"),
        median_capacity=Variable("1", "level at which half of the records reach the limit"),
        dispersion=Variable(
            "1", "standard deviation of the logarithm of the level at which records reach the limit"
        ),
    ),
    **along("bound", bound=text("lower or upper end of a confidence interval")),
    **along(
        ("bound *", "bound * part"),
        median_capacity_bound=Variable("1", "confidence interval of the median capacity"),
        dispersion_bound=Variable("1", "confidence interval of the dispersion"),
    ),
    **along(
        ("bound scale *", "bound scale * part"),
        fitted_probability_bound=Variable("1", "confidence band of the fitted probability"),
    ),
    **along(
        "*",
        penetration=Variable("m", "largest displacement beyond a gap"),
        hitting=Variable(
            "1",
            "share of the records under which the mass hits a stop",
            "for sines: whether the mass hits a stop",
        ),
        pareto=truth("whether no other design is better in both displacement and acceleration"),
        within_limits=Variable("1", "whether the design satisfies all limits"),
        acceleration_frequency=Variable("Hz", "frequency of the largest acceleration", part="mass"),
        unsettled_count=Variable("1", "number of frequency steps without a periodic motion"),
        common_gap=Variable("m", "smallest gap of both sides without contact"),
        evaluations=integer("number of designs that were tried"),
    ),
    **along(
        ("*", "stop"),
        displacement_frequency=Variable("Hz", "frequency of the largest displacement", part="mass"),
    ),
    **along("uncertain_parameter", uncertain_parameter=text("uncertain parameter")),
    **along(
        "... uncertain_parameter",
        first_order=Variable(
            "1", "share of the variance due to the parameter alone", "Sobol's first-order index"
        ),
        total_order=Variable(
            "1",
            "share of the variance due to the parameter and its interactions",
            "Sobol's total-order index",
        ),
    ),
    **along(
        "... uncertain_parameter bound",
        first_order_interval=Variable("1", "95 % interval of the first-order index"),
        total_order_interval=Variable("1", "95 % interval of the total-order index"),
    ),
    **along(
        "...",
        mean=Variable("1", "mean of the response"),
        variance=Variable("1", "variance of the response"),
    ),
    **along(
        ("natural_period", ""),
        natural_period=Variable("s", "natural period", "0: rigid, the mass moves with the base"),
    ),
    **along(
        "orientation",
        orientation=Variable(
            "1",
            "direction of the response",
            "the two components, and the median and the largest over 180 directions in steps of "
            "one degree",
        ),
    ),
    **along(
        SPECTRUM,
        spectral_displacement=Variable(
            "m", "largest relative displacement, from rest", part="mass"
        ),
        spectral_velocity=Variable("m s-1", "largest relative velocity, from rest", part="mass"),
        spectral_acceleration=Variable(
            "m s-2", "largest absolute acceleration, from rest", part="mass"
        ),
        pseudo_velocity=Variable(
            "m s-1", "pseudo-velocity", "angular frequency times displacement", part="mass"
        ),
        pseudo_acceleration=Variable(
            "m s-2",
            "pseudo-acceleration",
            "angular frequency squared times displacement",
            part="mass",
        ),
    ),
}
