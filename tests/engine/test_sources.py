"""Kernels are plain arithmetic: nothing is allocated, built or raised in them."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
from pathlib import Path

import pytest
from numba.core.dispatcher import Dispatcher

import vibroimpact.engine

ENGINE = Path(vibroimpact.engine.__file__).parent
COMPILED = {"kernel", "inlined", "not_inlined", "entry"}
BUILT = (
    ast.List,
    ast.Dict,
    ast.Set,
    ast.ListComp,
    ast.SetComp,
    ast.DictComp,
    ast.GeneratorExp,
    ast.JoinedStr,
)


def decorators(function: ast.FunctionDef) -> set[str]:
    nodes = (d.func if isinstance(d, ast.Call) else d for d in function.decorator_list)
    return {d.id for d in nodes if isinstance(d, ast.Name)}


def forbidden(source: str) -> list[str]:
    """What stands in the compiled functions of a source and must not, with its line."""
    wrong = []
    for function in ast.walk(ast.parse(source)):
        if not isinstance(function, ast.FunctionDef) or not decorators(function) & COMPILED:
            continue
        for node in (n for statement in function.body for n in ast.walk(statement)):
            numpy = isinstance(node, ast.Name) and node.id == "np"
            # A slice makes a view; entries pass on rows of what they were given.
            sliced = isinstance(node, ast.Slice) and "entry" not in decorators(function)
            if numpy or sliced or isinstance(node, (*BUILT, ast.Raise, ast.Try)):
                wrong.append(f"{function.name}, line {node.lineno}: {ast.unparse(node)}")
    return wrong


def test_no_kernel_allocates() -> None:
    files = sorted(ENGINE.rglob("*.py"))
    assert len(files) > 20
    wrong = {p.name: uses for p in files if (uses := forbidden(p.read_text(encoding="utf-8")))}
    assert wrong == {}


@pytest.mark.parametrize(
    "line",
    [
        "room = np.zeros(3)",
        "a[:] = 0.0",
        "b = a[1:]",
        "b = [0.0, 1.0]",
        "raise ValueError(a)",
        "b = f'{a}'",
    ],
)
@pytest.mark.parametrize("decorator", ["kernel", "inlined", "not_inlined"])
def test_the_search_finds_what_it_is_for(line: str, decorator: str) -> None:
    assert forbidden(f"@{decorator}\ndef f(a):\n    {line}\n")
    assert not forbidden(f"def f(a):\n    {line}\n")


def test_python_calls_no_kernel():
    """Above the engine only entries are used: kernels cannot be called from Python."""
    wrong = []
    for info in pkgutil.walk_packages(vibroimpact.__path__, "vibroimpact."):
        if info.name.startswith("vibroimpact.engine.") or info.name == "vibroimpact.__main__":
            continue
        module = importlib.import_module(info.name)
        values = list(vars(module).values())
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                owner = vars(module).get(node.value.id)
                if inspect.ismodule(owner) and owner.__name__.startswith("vibroimpact.engine"):
                    values.append(getattr(owner, node.attr, None))
        wrong += [(info.name, one.__name__) for one in values if isinstance(one, Dispatcher)]
    assert not wrong
