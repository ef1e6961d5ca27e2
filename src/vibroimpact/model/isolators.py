"""What carries the mass: its spring and its damping."""

from __future__ import annotations

from typing import Annotated, ClassVar

from vibroimpact.model.kinds import Named
from vibroimpact.model.quantities import DAMPING, STIFFNESS
from vibroimpact.model.validation import Accepts, constructor


class Isolator(Named):
    """The linear spring and dashpot that carry the mass (the paper's damper D).

    Its kind, ``"linear"``, need not be named in a table.

    Parameters
    ----------
    stiffness
        K in N/m, at least 0; or text such as ``"26.8 kN/m"``.
    damping
        C in N s/m, at least 0; or text such as ``"1.1 kN s/m"``.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "linear"
    usual: ClassVar[bool] = True

    stiffness: Annotated[float, Accepts(STIFFNESS, minimum=0.0)]
    damping: Annotated[float, Accepts(DAMPING, minimum=0.0)]

    @constructor
    def __init__(self, stiffness: float | str, damping: float | str) -> None:
        super().__init__(stiffness=stiffness, damping=damping)
