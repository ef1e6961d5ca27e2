"""The functions that Python calls with a rig."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from vibroimpact.engine.compilation import Compiled
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.parameters import free_rig


class Entry(Compiled):
    """A compiled function whose first argument is a rig's vector.

    It is compiled once, for all flows; the function itself gets the memory of a plan, with the
    functions of the rig's flow, as its first argument.
    """

    def __init__(
        self, function: Callable[..., Any], signature: str, groups: tuple[str, ...]
    ) -> None:
        super().__init__(function, signature)
        self.groups = ("motion", *groups)

    def __call__(self, rig: Any, *args: Any) -> Any:
        """Run, compiling or loading first what is called for the first time in the process."""
        return self.on(plan_of(rig, self.groups), rig, *args)

    def on(self, plan: Any, rig: Any, *args: Any) -> Any:
        """Run on a plan of the rig (`plan_of`), which keeps what its flow counts."""
        return self.of(plan)(plan, rig, *args)

    def prepare(self, *rigs: Any) -> None:
        """Compile for the flows of these rigs, or load from the cache; for bumpers if none."""
        for rig in rigs or (free_rig(),):
            self.of(plan_of(rig, self.groups))


def entry(signature: str, *groups: str) -> Callable[[Callable[..., Any]], Entry]:
    """Mark a function that Python calls.

    Parameters
    ----------
    signature
        That of the rig and what follows it.
    groups
        Of the functions of a flow (`flow_tables`) that it calls besides those of the motion.
    """
    return lambda function: Entry(function, signature, groups)
