"""Numbers in a tree of model objects, named by paths such as ``right.gap``.

A path walks the fields of models and the names of mappings. Which numbers there are, with their
quantities and bounds, follows from the annotations of the fields (`Model.knobs`).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, get_args

from vibroimpact.errors import InputError, errors_at
from vibroimpact.model.validation import Accepts, Model

Steps = tuple[str, ...]
"""Names of fields, or keys of mappings, from the root of a tree to a number."""


class Place(NamedTuple):
    """A number in a tree of model objects."""

    steps: Steps
    value: float
    accepts: Accepts
    owner: Any
    """The object, or the mapping, that has the number."""


def walk(part: Any, steps: Steps = ()) -> Iterator[Place]:
    """Yield the numbers of an object and of its parts, in the order of their declaration."""
    if isinstance(part, Model):
        for name, (value, accepts) in part.knobs().items():
            yield Place((*steps, name), value, accepts, part)
        for name, field in type(part).model_fields.items():
            child = getattr(part, name)
            if isinstance(child, Mapping):
                items = _of_items(field.annotation)
                for key, value in child.items():
                    if items is not None and isinstance(value, float):
                        yield Place((*steps, name, key), value, items, child)
                    yield from walk(value, (*steps, name, key))
            else:
                yield from walk(child, (*steps, name))


def whole_numbers(part: Any, steps: Steps = ()) -> Iterator[tuple[Steps, int]]:
    """Yield place and value of the fields that take whole numbers only, which cannot be varied."""
    if isinstance(part, Mapping):
        for key, value in part.items():
            yield from whole_numbers(value, (*steps, key))
    elif isinstance(part, Model):
        for name in type(part).model_fields:
            value = getattr(part, name)
            if type(value) is int:
                yield (*steps, name), value
            yield from whole_numbers(value, (*steps, name))


def _of_items(annotation: Any) -> Accepts | None:
    """Return what the annotation of a mapping accepts as its items."""
    for part in get_args(annotation):
        if isinstance(part, Accepts):
            return part
        if (accepts := _of_items(part)) is not None:
            return accepts
    return None


def put(part: Any, values: Mapping[Steps, Any]) -> Any:
    """Return an object with other values at some paths, all set at once and validated.

    The values are numbers in SI units, strings with units, or whole parts; None removes a part. An
    absent part becomes a table of its values, which the object that has it reads.

    Raises
    ------
    InputError
        If a value is invalid, or if a path does not exist. The message begins with the path.
    """
    below: dict[str, dict[Steps, Any]] = defaultdict(dict)
    for (first, *rest), value in values.items():
        below[first][tuple(rest)] = value
    changed = {name: _child(part, name, rest) for name, rest in below.items()}
    if isinstance(part, Model):
        return part.replace(**changed)
    return {name: one for name, one in {**(part or {}), **changed}.items() if one is not None}


def _child(part: Any, name: str, values: Mapping[Steps, Any]) -> Any:
    if () in values:
        return values[()]
    child = part.get(name) if isinstance(part, Mapping) else getattr(part, name, None)
    if not isinstance(child, Model | Mapping | None):
        key = ".".join(next(iter(values)))
        raise InputError(f"{name}.{key}: {name} is a number, which has no fields; use {name!r}")
    with errors_at(f"{name}."):
        return put(child, values)
