"""One function in place of several kernels: the type of a plan chooses when a caller is compiled.

The flows of one mass answer the same questions: tables of closed-form motion where all laws are
linear, Taylor series elsewhere, and tables again for isolators that yield or slide. A question is
declared once, with its arguments, below the kernels that answer it.
"""

from __future__ import annotations

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
        The kernels: where all laws are linear, of Taylor series, and of isolators that yield or
        slide (default: that of Taylor series).
    """
    kernels = linear, curved, yielding or curved

    def plain(plan: Any, *args: Any) -> Any:
        return kernels[laws(plan)](plan, *args)

    def of_type(plan: Any) -> Any:
        return kernels[getattr(plan, "laws", LINEAR)]

    return replacing(kernels, plain, of_type)


def replacing(
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
        The kernel that it is to numba, by the type of the plan.

    Raises
    ------
    TypeError
        If the arguments of a kernel are others.
    """

    def declare(described: F) -> F:
        name, wanted = described.__name__, _arguments(described)
        for one in kernels:
            if _arguments(one) != wanted:
                raise TypeError(f"{one.__module__}.{name}: not the arguments {', '.join(wanted)}")
        plain.__doc__, plain.__name__ = described.__doc__, name

        @overload(plain, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
        def _chosen(plan: Any, *args: Any) -> Any:
            return of_type(plan).py_func

        return plain  # type: ignore[return-value]

    return declare


def _arguments(function: Any) -> tuple[str, ...]:
    code = getattr(function, "py_func", function).__code__
    return code.co_varnames[: code.co_argcount]  # type: ignore[no-any-return]
