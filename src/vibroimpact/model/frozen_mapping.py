"""Mappings that cannot be changed, for parts of the model that users name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeVar

from pydantic import BaseModel, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

_V = TypeVar("_V")


class FrozenMapping(Mapping[str, _V]):
    """A mapping from names to values that is immutable, hashable and keeps its order.

    Two of them are equal if their names and values are equal in the same order, since the order is
    that of results.
    """

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, _V] | Iterable[tuple[str, _V]] = ()) -> None:
        self._values: dict[str, _V] = dict(values)

    def __getitem__(self, name: str) -> _V:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, FrozenMapping):
            return tuple(self.items()) == tuple(other.items())
        return self._values == other

    def __hash__(self) -> int:
        return hash(tuple(self.items()))

    def __repr__(self) -> str:
        return repr(self._values)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Return a schema that accepts only these mappings, and writes them as plain tables."""
        return core_schema.is_instance_schema(
            cls,
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda mapping: {
                    name: one.model_dump() if isinstance(one, BaseModel) else one
                    for name, one in mapping.items()
                }
            ),
        )
