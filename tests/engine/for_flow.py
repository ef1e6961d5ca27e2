"""A function of a test that is compiled for each flow, with a plan whose type is the flow's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from vibroimpact.engine.compilation import Compiled
from vibroimpact.engine.flow_dispatch import flow_of


class ForFlow(Compiled):
    def __call__(self, rig: Any, *args: Any) -> Any:
        memory = flow_of(rig)
        return self.of(memory)(memory, rig, *args)


def for_flow(signature: str) -> Callable[[Callable[..., Any]], ForFlow]:
    return lambda function: ForFlow(function, signature)
