"""One function in place of several kernels: the type of a plan chooses when a caller is compiled.

The flows of one mass answer the same questions: with tables of closed-form motion where all laws
are linear, with Taylor series where they are curved; an isolator that yields or slides has tables
to the next event, and Taylor series for the rest. A question is declared once, with its arguments,
under a decorator that names the kernels which answer it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from vibroimpact.engine.compiler import overload
from vibroimpact.engine.jit import CHOSEN
from vibroimpact.engine.parameters import LINEAR, laws

F = TypeVar("F", bound=Callable[..., Any])


def by_laws(
    linear: Callable[..., Any],
    curved: Callable[..., Any],
    yielding: Callable[..., Any] | None = None,
) -> Callable[[F], F]:
    """Declare a function that calls the kernel of a plan's laws.

    Parameters
    ----------
    linear, curved, yielding
        The kernels: where all laws are linear (also of a plan whose type has no laws), where they
        are curved, and of an isolator that yields or slides (default: that of curved laws).
    """
    kernels = linear, curved, yielding or curved

    def plain(plan: Any, *args: Any) -> Any:
        return kernels[laws(plan)](plan, *args)

    def of_type(plan: Any) -> Any:
        return kernels[getattr(plan, "laws", LINEAR)]

    return in_place_of(kernels, plain, of_type)


def in_place_of(
    kernels: Iterable[Callable[..., Any]],
    plain: Callable[..., Any],
    of_type: Callable[[Any], Any],
) -> Callable[[F], F]:
    """Declare a function in place of kernels.

    Parameters
    ----------
    kernels
        All that it may call. Their arguments are those of the declaration, by name.
    plain
        What it does without a compiler.
    of_type
        What it is to numba, by the type of the plan: a kernel, or a function of Python.

    Raises
    ------
    TypeError
        If the arguments of a kernel are others.
    """

    def declare(described: F) -> F:
        wanted = _arguments(described)
        for one in kernels:
            if _arguments(one) != wanted:
                name = f"{one.__module__}.{one.__name__}"
                raise TypeError(f"{name}: its arguments are not {', '.join(wanted)}")

        @overload(plain, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
        def _chosen(plan: Any, *args: Any) -> Any:
            return _in_python(of_type(plan))

        return functools.update_wrapper(plain, described)  # type: ignore[return-value]

    return declare


def _in_python(function: Any) -> Any:
    return getattr(function, "py_func", function)


def _arguments(function: Any) -> tuple[str, ...]:
    code = _in_python(function).__code__
    return code.co_varnames[: code.co_argcount]  # type: ignore[no-any-return]
