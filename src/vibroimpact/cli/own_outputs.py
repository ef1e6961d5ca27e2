"""The option --compute: own outputs as formulas."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, TypeAlias

from cyclopts import Parameter

from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import vibroimpact as vi

Compute: TypeAlias = Annotated[
    tuple[str, ...],
    Parameter(
        negative="",
        help="Compute an own output of each motion, such as 'power [W] = "
        "mean(isolator.damping*velocity**2)': its name, its units, and a formula of time "
        "histories, numbers of the rig, and max, min, mean, rms and integral over one period. The "
        "option may be repeated.",
    ),
]

_WRITTEN = re.compile(r"\s*(\w+)\s*(?:\[([^\]]*)\])?\s*=(?!=)\s*(.+)", re.DOTALL)


def own_outputs(texts: Iterable[str]) -> dict[str, vi.Output] | None:
    """Read outputs such as ``power [W] = mean(isolator.damping*velocity**2)``, or return None.

    Raises
    ------
    InputError
        If a text is not a name with a formula.
    """
    from vibroimpact.response.outputs import Output

    outputs: dict[str, vi.Output] = {}
    for text in texts:
        match = _WRITTEN.fullmatch(text)
        if match is None:
            raise InputError(
                f"--compute: {text!r} is not a name with a formula; write it as 'power [W] = "
                "mean(isolator.damping*velocity**2)'"
            )
        name, units, formula = match.groups()
        if name in outputs:
            raise InputError(f"--compute: {name!r} is given twice; remove one of the two")
        outputs[name] = Output(formula, units=(units or "").strip() or "1")
    return outputs or None
