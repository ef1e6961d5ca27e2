"""Entries that no rig goes into: the same compiler and cache, without a flow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from vibroimpact.engine.compilation import Compiled


class NoRig(NamedTuple):
    """What stands in the place of the room for a rig's plan."""

    nothing: float = 0.0


class RiglessEntry(Compiled):
    """A compiled function of numbers and arrays; it gets an `NoRig` as its first argument."""

    FIRST = "f8"

    def __call__(self, *args: Any) -> Any:
        """Run, compiling or loading first if this is the first call of the process."""
        return self.of(NoRig())(NoRig(), *args)

    def prepare(self, *rigs: Any) -> None:
        """Compile, or load from the cache."""
        self.of(NoRig())


def rigless_entry(signature: str) -> Callable[[Callable[..., Any]], RiglessEntry]:
    """Mark a function that Python calls; the signature is that of what follows the first."""
    return lambda function: RiglessEntry(function, signature)
