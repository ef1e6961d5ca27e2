"""Which parameter is varied, and from where to where."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.frequency_grid import Span
    from vibroimpact.model import Oscillator
    from vibroimpact.model.excitation import Of

PARAMETERS = (
    "frequency, amplitude, force, gap, right-gap, left-gap, bumper-stiffness, right-stiffness, "
    "left-stiffness, proportional-stiffness, stiffness-at-restitution, bumper-damping, "
    "right-damping, left-damping, restitution, right-restitution, left-restitution, "
    "bumper-exponent, right-exponent, "
    "left-exponent, dissipation, right-dissipation, left-dissipation, bumper-mass, right-mass, "
    "left-mass, stiffness, damping, damping-exponent, friction, elastic-stiffness, "
    "post-yield-stiffness, yield-force, cubic, quintic, beta, gamma, reversal-stiffness, "
    "final-stiffness, decay, hardening, hardening-force, isolator-period, stiffness-ratio, "
    "gap-ratio, relaxation-time, damping-ratio"
)
"""Those of the registry, written out: help loads nothing that computes."""

Varied = Annotated[str, Parameter(help=f"What is varied, if the rig has it: {PARAMETERS}.")]
Least = Annotated[
    str | None,
    Parameter(
        name="--from",
        allow_leading_hyphen=True,
        help="Least value; of a frequency that of the sweep, as for branch.",
    ),
]
Largest = Annotated[
    str | None,
    Parameter(
        name="--to",
        allow_leading_hyphen=True,
        help="Largest value; of a frequency that of the sweep.",
    ),
]


def option_range(
    name: str,
    low: str | None,
    high: str | None,
    options: tuple[str, str],
    default: Span,
    field: str = "--parameter",
    rig: Oscillator | None = None,
    of: Of = "acceleration",
) -> tuple[float, float]:
    """A range of a parameter from two options; that of a frequency may have a default, in Hz.

    `field` is the option that names the parameter, whose unit may depend on the rig; `of` says
    what an amplitude is one of.

    Raises
    ------
    InputError
        If there is no such parameter, an end is missing or cannot be used, or none lies between.
    """
    from vibroimpact.cli.frequency_grid import NO_DEFAULT
    from vibroimpact.model import to_si
    from vibroimpact.model.parameters import parameter

    varied = parameter(name, field, of)
    if rig is not None:
        varied = varied.of(rig)
    given: list[str | float | None] = [low, high]
    if name == "frequency":
        given = [
            text if text is not None else otherwise
            for text, otherwise in zip(given, default, strict=True)
        ]
    ends = []
    for text, option in zip(given, options, strict=True):
        if text is None and name == "frequency":
            raise InputError(f"{option}: {NO_DEFAULT}")
        if text is None:
            raise InputError(f"{option}: missing; the end of the range of {name} is accepted")
        if name == "frequency":
            ends.append(to_si(text, varied.quantity, option, above=0.0))
        else:
            least, most = varied.least, varied.most
            ends.append(to_si(text, varied.quantity, option, minimum=least, maximum=most))
    if not ends[0] < ends[1]:
        raise InputError(
            f"{options[1]}: {given[1]} does not lie above {given[0]}; a larger value is accepted"
        )
    return ends[0], ends[1]
