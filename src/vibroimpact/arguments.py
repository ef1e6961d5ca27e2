"""Check the kind of an argument before it is used, so that a mistake is one line."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from vibroimpact.errors import InputError, shown, unknown

LONGEST_PATH = 4096
"""Letters of a path, as operating systems take them."""


def check_path(value: object, field: str) -> Path:
    """Return the path of a file.

    Raises
    ------
    InputError
        If it is not a text or a path, or no file system takes it.
    """
    path = value if isinstance(value, str) else None
    if isinstance(value, os.PathLike):
        path = os.fspath(value)
    if not isinstance(path, str):
        raise InputError(f"{field}: {shown(value)} is not a path; the path of a file is accepted")
    if "\0" in path or len(path) > LONGEST_PATH or not _is_encodable(path):
        raise InputError(
            f"{field}: {shown(path)} cannot be a path; at most {LONGEST_PATH} letters without "
            "control characters are accepted"
        )
    return Path(path)


def check_mapping(value: object, field: str, what: str) -> Mapping[str, Any]:
    """Return a mapping whose keys are texts.

    Parameters
    ----------
    value
        The argument.
    field
        Its name.
    what
        What is accepted, in words.

    Raises
    ------
    InputError
        If it is not a mapping, or one of its keys is not a text.
    """
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise InputError(f"{field}: {shown(value)}; {what} is accepted")
    return value


def check_texts(value: object, field: str) -> None:
    """Refuse anything but None and a mapping of texts to texts.

    Raises
    ------
    InputError
        If it is something else.
    """
    held = {} if value is None else check_mapping(value, field, "a mapping of texts to texts")
    for key, one in held.items():
        if not isinstance(one, str):
            raise InputError(f"{field}[{key!r}]: {shown(one)} is not a text; a text is accepted")


def check_variables(value: Any, names: Collection[str], field: str, what: str) -> None:
    """Refuse anything but a dataset that has certain variables.

    Raises
    ------
    InputError
        If it is not a dataset, or a variable is missing.
    """
    held = getattr(value, "data_vars", None)
    if not isinstance(held, Mapping) or not all(name in value.variables for name in names):
        raise InputError(f"{field}: {shown(value)} is not {what}; {what} is accepted")


def check_name(value: object, names: Collection[str], field: str) -> str:
    """Return a text that is one of several.

    Raises
    ------
    InputError
        If it is another, or not a text.
    """
    if not isinstance(value, str) or value not in names:
        raise InputError(f"{field}: {unknown(value, names)}")
    return value


def check_progress(value: Any) -> None:
    """Refuse a `progress` that cannot be called.

    Raises
    ------
    InputError
        If it is neither None nor a function.
    """
    if value is not None and (isinstance(value, type) or not callable(value)):
        raise InputError(
            f"progress: {shown(value)}; None or a function of the number done and the number in "
            "all, such as progress_bar(), is accepted"
        )


def check_list(value: Any, field: str, most: int, what: str) -> list[Any]:
    """Return the items of a list, an array or another collection.

    Raises
    ------
    InputError
        If it is not a list, is a text, or holds more than `most`.
    """
    is_list = hasattr(value, "__len__") and getattr(value, "ndim", 1) > 0
    if isinstance(value, str | bytes | Mapping) or not is_list:
        raise InputError(f"{field}: {shown(value)} is not a list; {what} is accepted")
    if len(value) > most:
        raise InputError(f"{field}: {len(value)} of them; at most {most} are accepted")
    return list(value)


def _is_encodable(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
