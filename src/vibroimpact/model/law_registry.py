"""Classes of laws, which the key ``kind`` of a table selects in a study file.

A part of a rig can have one of several laws. Each law is a class. In a table, ``kind`` selects the
law::

    right = { kind = "rigid", restitution = 0.8, gap = "7.5 mm" }

One law of each part is the default and needs no ``kind``. A new law is a class derived from
`Named`, and an entry in the `Kinds` of the field that contains the law.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self, get_args

from pydantic import (
    GetCoreSchemaHandler,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)
from pydantic_core import CoreSchema, core_schema

from vibroimpact.errors import InputError, alternatives, shown
from vibroimpact.model.validation import Choice, Model


class Named(Model):
    """A model object whose table has a kind."""

    kind: ClassVar[str]
    """Name of the law in a table."""
    words: ClassVar[str] = ""
    """Name of the law in the explorer, if it is not the kind."""
    usual: ClassVar[bool] = False
    """Whether a table without a kind describes this law."""

    @model_validator(mode="before")
    @classmethod
    def _of_this_kind(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or "kind" not in data:
            return data
        if data["kind"] != cls.kind:
            raise InputError(
                f"kind: {shown(data['kind'])} is not the kind of a {cls.__name__}; use {cls.kind!r}"
            )
        return {name: value for name, value in data.items() if name != "kind"}

    @model_serializer(mode="wrap")
    def _with_its_kind(self, fields: SerializerFunctionWrapHandler) -> dict[str, Any]:
        table = {
            name: value for name, value in fields(self).items() if not self._unsaid(name, value)
        }
        return table if self.usual else {"kind": self.kind, **table}

    @classmethod
    def _laws_with(cls, key: str) -> list[str]:
        """Return the other laws of the same part that have a key, with their kinds."""
        return [
            f"{law.__name__} (kind {law.kind!r})"
            for kinds in _KINDS
            if cls in kinds.classes.values()
            for law in kinds.classes.values()
            if law is not cls and key in law._table_keys()
        ]

    @classmethod
    def like(cls, *args: Any, **kwargs: Any) -> Any:
        """Return a law that is about as strong as another one, if it has an example."""
        return None

    @property
    def rigid(self) -> bool:
        """Whether the mass cannot pass the stop."""
        return False

    def between(self, meeting_mass: float) -> Self:
        """Return the law between two bodies of an assembly, which meet with this mass (kg)."""
        return self

    def summary(self) -> str:
        """Return the law in one line: its kind and its numbers, named as in a table."""
        rows = dict(self.rows())
        kind = rows.pop("kind", self.kind)
        words = [f"{name.replace('_', ' ')} {text}" for name, text in rows.items()]
        return ", ".join([kind, *words])

    def rows(self) -> list[tuple[str, str]]:
        """Return the rows of `Model.rows`, after the kind of the law if it is not the default."""
        return super().rows() if self.usual else [("kind", self.kind), *super().rows()]


class Kinds(Choice):
    """Annotation of a field that accepts several classes. The key ``kind`` selects the class.

    ``Annotated[Bumper | RigidStop | None, Kinds(Bumper, RigidStop)]`` accepts an object or a table
    of one of the two classes, or None.
    """

    def __init__(self, *classes: type[Named]) -> None:
        self.classes: Mapping[str, type[Named]] = {one.kind: one for one in classes}
        _KINDS.append(self)
        (self.usual,) = (one.kind for one in classes if one.usual)

    def kind_of(self, value: Any) -> str:
        """Return the kind of an object or a table, or the default kind for any other value."""
        if isinstance(value, Mapping):
            return str(value.get("kind", self.usual))
        return value.kind if isinstance(value, Named) else self.usual

    def unknown(self, value: Any) -> str:
        """Describe the error of a table with an unknown kind."""
        kind = value["kind"] if isinstance(value, Mapping) else self.kind_of(value)
        return f"{shown(kind)} is unknown; use {alternatives(map(repr, self.classes))}"

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return a schema with which pydantic selects the class by the kind."""
        schema: CoreSchema = core_schema.tagged_union_schema(
            {kind: handler.generate_schema(one) for kind, one in self.classes.items()},
            self.kind_of,
        )
        return core_schema.nullable_schema(schema) if type(None) in get_args(source) else schema


_KINDS: list[Kinds] = []
"""All fields that accept several laws."""
