"""Attributes of an output variable."""

from __future__ import annotations

from collections.abc import Sequence, Set
from functools import partial
from typing import NamedTuple, Protocol


class Described(Protocol):
    """A variable that is described outside the vocabulary, such as a parameter that is varied."""

    @property
    def name(self) -> str:
        """Name of the variable."""
        ...

    @property
    def units(self) -> str:
        """Its units."""
        ...

    @property
    def long_name(self) -> str:
        """Its meaning."""
        ...


class Variable(NamedTuple):
    """The units of a variable, its meaning, the kind of its values, and the part that has it."""

    units: str
    long_name: str
    comment: str = ""
    kind: str = "number"
    """``number``, ``integer``, ``truth`` or ``text``."""
    part: str = ""
    """Dim of the parts of a rig: ``stop``, or, of an assembly only, ``mass`` or ``link``.

    It is missing where the value is that of all parts."""
    dims: tuple[str, ...] = ()
    """Each set of dims that the variable may have, apart from `part`, as words.

    ``*`` is any number of parameters that are varied, ``part`` a dim of parts, and ``...``
    whatever another function returns."""

    def has_dims(self, dims: Sequence[str], named: Set[str]) -> bool:
        """Return whether the variable may have these dims; those not named are parameters."""
        rest = tuple(one for one in dims if one != self.part)
        rest = rest[1:] if rest[:1] == (SAMPLES,) else rest
        return any(_fits(one.split(), rest, named) for one in self.dims)


def _fits(words: Sequence[str], dims: Sequence[str], named: Set[str]) -> bool:
    """Return whether dims are those of a set."""
    if not words:
        return not dims
    first, *others = words
    if first in ("*", "..."):
        return any(
            _fits(others, dims[k:], named)
            for k in range(len(dims) + 1)
            if first == "..." or named.isdisjoint(dims[:k])
        )
    if not dims or (dims[0] not in PARTS if first == "part" else dims[0] != first):
        return False
    return _fits(others, dims[1:], named)


SAMPLES = "sample"
"""First dim of any variable of an ensemble: its rigs."""
PARTS = ("stop", "mass", "link")
"""Dims of the parts of a rig."""


integer = partial(Variable, "1", kind="integer")
truth = partial(Variable, "1", kind="truth")
text = partial(Variable, "1", kind="text")


def along(dims: str | tuple[str, ...], /, **variables: Variable) -> dict[str, Variable]:
    """Return variables with their dims: one set of dims, or several."""
    sets = (dims,) if isinstance(dims, str) else dims
    return {name: one._replace(dims=sets) for name, one in variables.items()}


def each(sets: Sequence[str], dim: str) -> tuple[str, ...]:
    """Return sets of dims with one more dim at the end."""
    return tuple(f"{one} {dim}".lstrip() for one in sets)


STEADY = (
    "",
    "direction frequency",
    "rig direction frequency",
    "direction frequency repeat",
    "rig *",
    "start *",
    "point",
    "attractor",
    "* attractor",
    "fractile ...",
)
"""Dims of values of steady motions: of one motion, sweeps, measured curves, Lyapunov exponents,
diagrams, branches, coexisting motions, basins along a parameter, and ensembles."""
SHAKEN = ("", "record", "record scale *", "record scale rig *", "fractile ...")
"""Dims of values of the responses to records: of one response, suites, and suites of ensembles."""
ANY_PEAKS = (*STEADY, *SHAKEN, "*")
"""Dims of values of all of these motions, and of designs."""
CONTACTS = ("contact_number", "start * section_point")
"""Dims of values of contacts, also at the sections of a diagram."""
SECTION = ("section_point", "start * section_point", "point")
"""Dims of values at sections: of one motion, diagrams and basins."""
SPECTRUM = ("* natural_period", "orientation * natural_period", "*", "orientation *")
"""Dims of response spectra, over damping ratios, and of single values of them."""
