"""The boundary of public functions: read the rig, check arguments, and choose the units."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from contextlib import nullcontext
from functools import cache, partial, wraps
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    ParamSpec,
    TypeAlias,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from vibroimpact.arguments import check_flag, check_name
from vibroimpact.model.written_units import written_for

_P = ParamSpec("_P")
_R = TypeVar("_R")
_Check: TypeAlias = Callable[[object, str], Any]


def public(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Check the arguments of a function by their annotations before it runs.

    - An argument of a type of `argument_types`, or of another ``Annotated[type, check]``, is what
      its check returns. So a rig that is a code or a file becomes a `Rig`.
    - A `bool` and a `Literal` are checked, too. Any of these may also be ``| None``.
    - If the first argument is a rig or a dataset, all values are read and written in its units. If
      it has no units, values with a unit are refused.
    """
    signature = inspect.signature(function)
    first = next(iter(signature.parameters), "")

    @cache
    def checks() -> dict[str, _Check]:
        hints = get_type_hints(function, include_extras=True)
        all_checks = {name: _check_of(hints[name]) for name in signature.parameters}
        return {name: check for name, check in all_checks.items() if check is not None}

    @wraps(function)
    def checked(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        try:
            bound = signature.bind(*args, **kwargs)
        except TypeError:
            return function(*args, **kwargs)  # the message names the function
        values = bound.arguments
        others = {name: check for name, check in checks().items() if name in values}
        subject = values.get(first)
        has_units = first in checks() or hasattr(subject, "attrs")
        if check := others.pop(first, None):
            subject = values[first] = check(subject, first)
        with written_for(subject) if has_units else nullcontext():
            for name, check in others.items():
                values[name] = check(values[name], name)
            return function(*bound.args, **bound.kwargs)

    return checked


def _check_of(hint: Any) -> _Check | None:
    """Return the check of the values of a type, or None if it has none."""
    origin, members = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        others = [one for one in members if one is not NoneType]
        check = _check_of(others[0]) if len(others) == 1 else None
        return check and partial(_unless_none, check)
    if origin is Annotated:
        return next((one for one in members[1:] if callable(one)), None)
    if origin is Literal:
        return lambda value, field: check_name(value, members, field)
    return check_flag if hint is bool else None


def _unless_none(check: _Check, value: object, field: str) -> Any:
    return None if value is None else check(value, field)
