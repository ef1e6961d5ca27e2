"""What the benchmarks take from the package and from each other exists: they are run seldom."""

from __future__ import annotations

import ast
import importlib
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[1]
PATHS = sorted((ROOT / "benchmarks").rglob("*.py"))
OWN = ("benchmarks", "vibroimpact")


def imported(name: str) -> ModuleType | None:
    """A module; None where it needs another program that is not installed."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if str(error.name).partition(".")[0] in OWN:
            raise
        return None


def has(module: ModuleType, name: str) -> bool:
    if hasattr(module, name):
        return True
    return hasattr(module, "__path__") and imported(f"{module.__name__}.{name}") is not None


@pytest.mark.parametrize("path", PATHS, ids=lambda path: str(path.relative_to(ROOT)))
def test_what_a_module_uses_exists(path: Path) -> None:
    """Also what it imports in a function, and attributes of the modules that it imports."""
    name = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
    parts = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    for part in parts:
        if isinstance(part, ast.ImportFrom) and str(part.module).partition(".")[0] in OWN:
            assert part.module
            if module := imported(part.module):
                for one in part.names:
                    assert has(module, one.name), f"{part.module} has no {one.name}"
    here = imported(name)
    if here is None:
        pytest.skip("needs another program")
    for part in parts:
        if isinstance(part, ast.Attribute) and isinstance(part.value, ast.Name):
            module = vars(here).get(part.value.id)
            if isinstance(module, ModuleType) and module.__name__.partition(".")[0] in OWN:
                assert has(module, part.attr), f"{module.__name__} has no {part.attr}"


def test_each_command_has_a_smallest_task() -> None:
    from benchmarks.fixed import COMMANDS
    from vibroimpact import cli

    assert set(COMMANDS) == set(cli._COMMANDS)
