"""Check the type of an argument before it is used, so that an error is one line."""

from __future__ import annotations

import itertools
import os
from collections.abc import Collection, Iterable, Mapping, Set, Sized
from pathlib import Path
from typing import Any, cast

from vibroimpact.errors import InputError, shown, unknown

LONGEST_PATH = 4096
"""Largest number of characters of a path in operating systems."""
STARTS = 'a dict of initial states by name, such as {"mine": State(0.01, 0.0)}'
"""Description of initial states."""
MOST_LISTED = 1_000_000
"""Largest number of items of a list that is not a record."""


def check_path(value: object, field: str) -> Path:
    """Return the path of a file.

    Raises
    ------
    InputError
        If it is not a string or a path, or if no file system accepts it.
    """
    path = value if isinstance(value, str) else None
    if isinstance(value, os.PathLike):
        path = os.fspath(value)
    if not isinstance(path, str):
        raise InputError(f"{field}: {shown(value)} is not a path; pass the path as a string")
    if len(path) > LONGEST_PATH:
        raise InputError(
            f"{field}: {shown(path)} has {len(path)} characters; pass a path of at most "
            f"{LONGEST_PATH} characters"
        )
    if "\0" in path or not _is_encodable(path):
        raise InputError(
            f"{field}: {shown(path)} contains a character that no path may contain; remove this "
            "character"
        )
    return Path(path)


def check_mapping(value: object, field: str, what: str) -> Mapping[str, Any]:
    """Return a mapping whose keys are strings.

    Parameters
    ----------
    value
        The argument.
    field
        Name of the argument.
    what
        Description of accepted values.

    Raises
    ------
    InputError
        If it is not a mapping, or if one of its keys is not a string.
    """
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise InputError(f"{field}: {shown(value)}; pass {what}")
    return value


def check_texts(value: object, field: str, example: str) -> None:
    """Check that a value is None or a mapping from strings to strings, of which `example` is one.

    Raises
    ------
    InputError
        If it is anything else.
    """
    what = f'a dict of strings, such as {{"displacement_excursion": "{example}"}}'
    held = {} if value is None else check_mapping(value, field, what)
    for key, one in held.items():
        if not isinstance(one, str):
            raise InputError(
                f"{field}[{key!r}]: {shown(one)} is not a string; pass a string such as {example!r}"
            )


def check_text(value: object, field: str) -> str:
    """Return a string.

    Raises
    ------
    InputError
        If it is anything else.
    """
    if not isinstance(value, str):
        raise InputError(f"{field}: {shown(value)}; pass a string")
    return value


def check_variables(value: Any, names: Collection[str], field: str, what: str) -> None:
    """Check that a value is a dataset with given variables. `what` describes accepted datasets.

    Raises
    ------
    InputError
        If it is not a dataset, or if a variable is missing.
    """
    held = getattr(value, "data_vars", None)
    if not isinstance(held, Mapping) or not all(name in value.variables for name in names):
        raise InputError(f"{field}: {shown(value)}; pass {what}")


def check_name(value: object, names: Collection[str], field: str) -> str:
    """Return a name that must be one of the given names.

    Raises
    ------
    InputError
        If it is another name, or if it is not a string.
    """
    if not isinstance(value, str) or value not in names:
        raise InputError(f"{field}: {unknown(value, names)}")
    return value


def check_progress(value: Any, field: str) -> Any:
    """Return a function that reports progress.

    Raises
    ------
    InputError
        If it is not a function.
    """
    if isinstance(value, type) or not callable(value):
        raise InputError(
            f"{field}: {shown(value)}; pass progress_bar(), a function of two numbers (the "
            "completed and the total work), or None"
        )
    return value


def check_list(
    value: object, field: str, most: int = MOST_LISTED, what: str = "a list"
) -> tuple[Any, ...]:
    """Return the items of a list, an array or another collection.

    Parameters
    ----------
    value
        The argument.
    field
        Name of the argument.
    most
        Largest number of items.
    what
        Description of accepted values.

    Raises
    ------
    InputError
        If it is not a list, if it is a string, or if it has more than `most` items.
    """
    if not is_list(value):
        raise InputError(f"{field}: {shown(value)} is not a list; pass {what}")
    items = tuple(itertools.islice(cast("Iterable[Any]", value), most + 1))
    if len(items) > most:
        raise InputError(f"{field}: more than {most} items; pass at most {most}")
    return items


def is_list(value: object) -> bool:
    """Return whether a value is a sequence of items. Strings, bytes and mappings are not."""
    value = getattr(value, "magnitude", value)  # of a quantity
    is_scalar = isinstance(value, str | bytes | Mapping) or getattr(value, "ndim", 1) == 0
    return isinstance(value, Iterable) and not is_scalar


def is_pair(value: object) -> bool:
    """Return whether a value has two items in a fixed order."""
    return is_list(value) and not isinstance(value, Set) and _length(value) == 2


def check_flag(value: object, field: str) -> bool:
    """Return a truth value, which may be a value of numpy.

    Raises
    ------
    InputError
        If it is neither True nor False.
    """
    kind = getattr(getattr(value, "dtype", None), "kind", "")  # of a value of numpy
    if not isinstance(value, bool) and (kind != "b" or getattr(value, "ndim", 1)):
        raise InputError(f"{field}: {shown(value)}; pass True or False")
    return bool(value)


def _length(value: object) -> int:
    return len(value) if isinstance(value, Sized) else -1


def _is_encodable(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
