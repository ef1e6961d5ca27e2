"""Output variables of earthquakes, of the design of stops and of ensembles."""

from __future__ import annotations

from vibroimpact.datasets.variable import Variable, integer, text, truth

DESIGN: dict[str, Variable] = {
    # sweeps, branches and earthquakes
    "peak_displacement": Variable("m", "largest relative displacement to either side", part="mass"),
    "peak_acceleration": Variable(
        "m s-2",
        "largest absolute acceleration, without sign",
        "excluding impacts on rigid stops",
        part="mass",
    ),
    # earthquakes
    "residual_displacement": Variable("m", "displacement at which the mass comes to rest"),
    "residual_swing": Variable(
        "m", "half the width of the last swing around the residual displacement"
    ),
    "record": text("name of the record"),
    "scale": Variable("1", "level of shaking"),
    "factor": Variable("1", "number that the record is multiplied by"),
    "intensity": Variable("1", "intensity measure of the unscaled record"),
    "fractile": Variable("1", "share of the records whose peak is below the value"),
    "exceeding": integer("number of records whose peak is above the limit"),
    "probability": Variable("1", "share of the records whose peak is above the limit"),
    "median_capacity": Variable("1", "level at which half of the records reach the limit"),
    "dispersion": Variable(
        "1", "standard deviation of the logarithm of the level at which records reach the limit"
    ),
    "fitted_probability": Variable("1", "fitted probability of exceeding the limit"),
    "bound": text("lower or upper end of a confidence interval"),
    "median_capacity_bound": Variable("1", "confidence interval of the median capacity"),
    "dispersion_bound": Variable("1", "confidence interval of the dispersion"),
    "fitted_probability_bound": Variable("1", "confidence band of the fitted probability"),
    # sizing
    "penetration": Variable("m", "largest displacement beyond a gap"),
    "hitting": Variable(
        "1",
        "share of the records under which the mass hits a stop",
        "for sines: whether the mass hits a stop",
    ),
    "pareto": truth("whether no other design is better in both displacement and acceleration"),
    "within_limits": Variable("1", "whether the design satisfies all limits"),
    "displacement_frequency": Variable("Hz", "frequency of the largest displacement"),
    "acceleration_frequency": Variable("Hz", "frequency of the largest acceleration"),
    "unsettled_count": Variable("1", "number of frequency steps without a periodic motion"),
    "common_gap": Variable("m", "smallest gap of both sides without contact"),
    "evaluations": integer("number of designs that were tried"),
    # ensembles
    "uncertain_parameter": text("uncertain parameter"),
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
}
