"""A law between two bodies of an assembly: a link with an isolator's law, or a stop."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, partial
from typing import Any, TypeAlias, cast, get_args

from pydantic import ConfigDict, field_validator, model_serializer, model_validator

from vibroimpact.errors import InputError, errors_at, shown, similar
from vibroimpact.model.assembly.names import GROUND
from vibroimpact.model.built_in_laws import as_isolator, as_stop
from vibroimpact.model.isolators import ISOLATORS, AnyIsolator, IsolatorLaw
from vibroimpact.model.isolators.design import designed, keys_of_mass
from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.own_law import Law
from vibroimpact.model.quantities import MASS
from vibroimpact.model.stops import STOPS, Bumper, Stop
from vibroimpact.model.stops.bumper import returning
from vibroimpact.model.unknown_keys import LIKENESS
from vibroimpact.model.validation import Accepts, Model, takes_fields

AnyLaw: TypeAlias = AnyIsolator | Stop
"""A law of a link or of a stop."""
_LAWS = (*get_args(AnyIsolator), *get_args(Stop))
_CARRIES = "carries"
_MASS = Accepts(MASS, above=0.0, meaning="mass")


class Link(Model):
    """A law between two bodies of an `Assembly`.

    With the law of an isolator, it is a link, and s = u_right − u_left: a linear link pushes the
    right body with −(k s + c s′), and the left body with the opposite force. With the law of a
    stop, it is a stop, and the closing displacement is s = u_left − u_right: the two bodies meet at
    s = gap, if the stop is not deformed.

    Parameters
    ----------
    left
        Name of the left body: a mass of the assembly, or ``"ground"``, the base.
    right
        Name of the right body. The positive direction is from left to right.
    law
        Any isolator, for a link; or any stop, for a stop.

    Raises
    ------
    InputError
        If a name is not a text, if both bodies are the same, or if the law is none.

    Examples
    --------
    >>> print(Link("ground", "base", Bumper("60 MN/m", "0.9 MN s/m", "10 cm")))
    Link(ground → base, Bumper(stiffness=60 MN/m, damping=900 kN s/m, gap=100 mm, memory=15 ms))
    """

    model_config = ConfigDict(arbitrary_types_allowed=True, ignored_types=(cached_property,))

    left: str
    right: str
    law: AnyLaw

    @takes_fields
    def __init__(self, left: str, right: str, law: AnyLaw) -> None: ...

    @field_validator("law", mode="wrap")
    @classmethod
    def _is_a_law(cls, value: Any, handler: Any) -> Any:
        if not isinstance(value, _LAWS):
            raise InputError(
                f"{shown(value)} is not a law; pass an isolator, such as Isolator(stiffness, "
                "damping), or a stop, such as Bumper(stiffness, damping, gap)"
            )
        if isinstance(value, Law):
            return as_stop(value) if value.is_stop else as_isolator(value)
        return value

    @model_validator(mode="after")
    def _two_bodies(self) -> Link:
        if self.left == self.right:
            raise InputError(
                f"right: {shown(self.right)} is also the left body; pass two different bodies"
            )
        return self

    @model_serializer
    def _as_table(self) -> dict[str, Any]:
        return {"left": self.left, "right": self.right, **self.law.model_dump()}

    @cached_property
    def _assumption(self) -> str:
        return ""

    @property
    def assumption(self) -> str:
        """What was assumed to read the law from a table: an empty string if nothing was."""
        return self._assumption

    def _assumes(self, text: str) -> None:
        """Set `assumption`, which copies with changes do not have."""
        vars(self)["_assumption"] = text

    @property
    def is_stop(self) -> bool:
        """Whether the law is that of a stop."""
        return (
            self.law.is_stop if isinstance(self.law, Law) else "gap" in type(self.law).model_fields
        )

    @property
    def isolator(self) -> AnyIsolator:
        """The law of a link."""
        return cast("AnyIsolator", self.law)

    @property
    def stop(self) -> Stop:
        """The law of a stop."""
        return cast("Stop", self.law)

    def rows(self) -> list[tuple[str, str]]:
        """Return the two bodies, and the rows of the law."""
        return [("between", f"{self.left} → {self.right}"), *self.law.rows()]

    def _read(self) -> Iterator[tuple[str, Any, str]]:
        for name in ("left", "right", "law"):
            value = getattr(self, name)
            yield name, value, str(value)

    def __str__(self) -> str:
        return f"Link({self.left} → {self.right}, {self.law})"


def read_link(
    value: Any, where: str, *, is_stop: bool, mass: Callable[[str, str, list[str]], float]
) -> Link:
    """Return a link or a stop of an assembly from a `Link` or from a table.

    A table has the keys ``left``, ``right`` and those of the law.

    Parameters
    ----------
    where
        Its path in error messages, such as ``"links.storey"``.
    mass
        Function of the left body, the right body and the keys that use the mass, which returns it
        (kg). Of a stop, the mass that meets there, by which the ``restitution`` of a table of a
        `Bumper` determines its damping. Of a link without ``carries``, the mass on it, by which
        design values such as a period determine its law.

    Raises
    ------
    InputError
        If it is invalid, or has the law of the other part.
    """
    wanted, other = ("stop", "link") if is_stop else ("link", "stop")
    if isinstance(value, Link):
        if value.is_stop != is_stop:
            raise InputError(
                f"{where}: {type(value.law).__name__} is the law of a {other}; move it to {other}s"
            )
        return value
    if not isinstance(value, Mapping):
        example = "Bumper(stiffness, damping, gap)" if is_stop else "Isolator(stiffness, damping)"
        raise InputError(
            f"{where}: {shown(value)} is not a {wanted}; pass a Link, such as "
            f'Link("{GROUND}", "base", {example})'
        )
    for end in ("left", "right"):
        if end not in value:
            others = [key for key in value if key not in ("left", "right")]
            if wrong := similar(end, others, LIKENESS):
                raise InputError(f"{where}.{wrong}: unknown key; did you mean {end}?")
            raise InputError(f"{where}.{end}: missing; add the name of a mass or 'ground'")
        if not isinstance(value[end], str):
            raise InputError(f"{where}.{end}: {shown(value[end])} is not the name of a mass")
    ends = (value["left"], value["right"])
    table = {name: one for name, one in value.items() if name not in ("left", "right")}
    with errors_at(f"{where}."):  # a law names its own fields
        return Link(*ends, _law(table, STOPS if is_stop else ISOLATORS, partial(mass, *ends)))


def _law(table: Mapping[str, Any], kinds: Kinds, mass: Callable[[list[str]], float]) -> Any:
    kind = kinds.kind_of(table)
    law = kinds.classes.get(kind)
    if law is None:
        raise InputError(f"kind: {kinds.unknown(table)}")
    if issubclass(law, IsolatorLaw):
        by = keys_of_mass(table, law)
        if _CARRIES in table:
            carried = _MASS.at(table[_CARRIES], _CARRIES)
            if not by:
                raise InputError(
                    f"{_CARRIES}: {shown(table[_CARRIES])}, but no other key of this link needs "
                    "the mass; remove it"
                )
            table = {name: one for name, one in table.items() if name != _CARRIES}
        elif by:
            carried = mass(by)
        return law.model_validate(designed(table, law, carried) if by else table)
    if law is Bumper and "restitution" in table:
        table = returning(table, mass(["restitution"]))
    return law.model_validate(table)
