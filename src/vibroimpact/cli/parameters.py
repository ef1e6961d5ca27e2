"""Options that name a parameter and its range."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, TypeAlias

from cyclopts import Parameter

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject

PARAMETERS = {
    "Shaking": "frequency, amplitude",
    "Constant force on the mass": "force",
    "Both stops": (
        "gap, bumper-stiffness, bumper-damping, restitution, bumper-exponent, dissipation, "
        "bumper-mass"
    ),
    "Right stop": (
        "right-gap, right-stiffness, right-damping, right-restitution, right-exponent, "
        "right-dissipation, right-mass"
    ),
    "Left stop": (
        "left-gap, left-stiffness, left-damping, left-restitution, left-exponent, "
        "left-dissipation, left-mass"
    ),
    "Stiffness of both bumpers, with damping in proportion": "proportional-stiffness",
    "Stiffness of both bumpers, with constant restitution": "stiffness-at-restitution",
    "Isolator": "stiffness, damping, damping-exponent, friction",
    "Isolator, with constant damping ratio": "isolator-period",
    "Bilinear or Bouc-Wen isolator": "elastic-stiffness, post-yield-stiffness, yield-force",
    "Bouc-Wen isolator (β and γ)": "beta, gamma",
    "Polynomial isolator": "cubic, quintic",
    "Exponential isolator": (
        "reversal-stiffness, final-stiffness, decay, hardening, hardening-force"
    ),
    "Dimensionless": "stiffness-ratio, gap-ratio, relaxation-time, damping-ratio",
}
"""Names of all parameters by what has them, written out because ``--help`` must not import what
computes."""

_NAMES = "".join(f"- {what}: {names}\n" for what, names in PARAMETERS.items())

Varied: TypeAlias = Annotated[
    str,
    Parameter(
        help=(
            "Parameter that is varied. The rig must have this parameter. The names are:\n\n"
            f"{_NAMES}"
            "- Constant NAME in a formula: isolator-NAME, bumper-NAME, right-NAME, left-NAME\n\n"
        )
    ),
]
Least: TypeAlias = Annotated[
    str | None,
    Parameter(
        name="--from",
        allow_leading_hyphen=True,
        help=(
            "Lowest value of the parameter, such as 0.9Hz or 3mm. Only the frequency has a "
            "default: the value in the study file (table [sweep]). If the file states none, the "
            "default is 0.27 × the natural frequency. For laboratory cases it is 0.3 Hz."
        ),
    ),
]
Largest: TypeAlias = Annotated[
    str | None,
    Parameter(
        name="--to",
        allow_leading_hyphen=True,
        help=(
            "Highest value of the parameter, such as 1.3Hz or 7mm. Only the frequency has a "
            "default: the value in the study file (table [sweep]). If the file states none, the "
            "default is 4.5 × the natural frequency. For laboratory cases it is 5 Hz."
        ),
    ),
]


def option_range(
    what: Subject,
    name: str,
    low: str | None,
    high: str | None,
    options: tuple[str, str] = ("--from", "--to"),
    field: str = "--parameter",
) -> tuple[float, float]:
    """Read the range of a parameter (SI units) from two options. A frequency has defaults.

    Parameters
    ----------
    what
        The rig. The units may depend on its laws and on its shaking.
    name
        Name of the parameter.
    low, high
        Texts of the options.
    options
        Names of the options that hold the ends.
    field
        Name of the option that names the parameter.

    Raises
    ------
    InputError
        If the parameter is unknown, if an end is missing or invalid, or if the range is empty.
    """
    from vibroimpact.cli.frequency_grid import NO_DEFAULT, default_span
    from vibroimpact.model import to_si
    from vibroimpact.model.parameters import parameter
    from vibroimpact.model.units import pretty

    varied = parameter(name, what.rig, field)
    defaults = default_span(what) if name == "frequency" else (None, None)
    ends: list[float] = []
    for option, text, default in zip(options, (low, high), defaults, strict=True):
        end = default if text is None else text
        if end is None:
            which = "highest" if ends else "lowest"
            missing = f"missing, and {name} has no default range; pass the {which} {name}"
            raise InputError(f"{option}: {NO_DEFAULT if name == 'frequency' else missing}")
        if name == "frequency":
            ends.append(to_si(end, varied.quantity, option, above=0.0))
        else:
            least, most = varied.least, varied.most
            ends.append(to_si(end, varied.quantity, option, minimum=least, maximum=most))
    if not ends[0] < ends[1]:
        raise InputError(
            f"{options[1]}: {pretty(ends[1], varied.quantity)} is not above the lower end of the "
            f"range, {pretty(ends[0], varied.quantity)}; raise the upper end"
        )
    return ends[0], ends[1]
