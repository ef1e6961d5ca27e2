"""Values of a wrong kind in a table, and words for them."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator
from pydantic_core import ErrorDetails

from vibroimpact.errors import InputError, shown


def _number_or_text(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise InputError(f"{shown(value)} is not a number or a string with a unit")
    return value


def _whole_number(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value // 1:
        raise InputError(f"{shown(value)} is not a whole number")
    return value


NumberOrText: TypeAlias = Annotated[float | str, BeforeValidator(_number_or_text)]
"""A value that is read later, because its quantity depends on other values."""
WholeNumber: TypeAlias = Annotated[int, BeforeValidator(_whole_number)]


def wrong_kind(mistake: ErrorDetails) -> str:
    """Describe what is wrong with a value, in the words of this package instead of pydantic's."""
    kind, context = mistake["type"], mistake.get("ctx", {})
    if kind == "literal_error":
        return f"is unknown; use {context['expected']}"
    if kind == "greater_than_equal":
        return f"is less than {context['ge']}"
    if kind == "less_than_equal":
        return f"is greater than {context['le']}"
    for start, words in _NOT.items():
        if kind.startswith(start):
            return words
    message = mistake["msg"]
    return f"is invalid: {message[:1].lower()}{message[1:]}"


_NOT = {
    "string_": "is not a string in quotes",
    "list_": "is not a list in brackets",
    "dict_": "is not a table of names and values",
    "int_": "is not a whole number",
    "float_": "is not a number",
    "bool_": "is not true or false",
}
"""What is wrong with a value, by the beginning of pydantic's name of the error."""


def path_of(where: str, steps: list[int | str]) -> str:
    """Return the path of a value, such as ``excitation.amplitudes[1]``."""
    path = where
    for step in steps:
        if isinstance(step, int):
            path += f"[{step}]"
        else:
            path += f".{step}" if path else step
    return path
