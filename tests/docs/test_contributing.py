"""CONTRIBUTING, and the docstrings that it refers to, name files, folders and functions that exist.

The contents name every decision.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

from docs.snippets import ROOT

PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
PACKAGE = ROOT / "src" / "vibroimpact"
BELOW = (ROOT, PACKAGE, PACKAGE / "engine")


def test_the_paths_are_there():
    text = PAGE + _how_to_add()
    paths = set(re.findall(r"`((?:[\w.-]+/)*[\w-]+(?:\.py|\.txt|\.toml|\.md|/))`", text))
    assert len(paths) > 40
    missing = {path for path in paths if not any((at / path).exists() for at in BELOW)}
    assert missing == set()


def _file(path: str) -> Path | None:
    """Find a file by its path, or a module of the engine by its name: `taylor.carry`."""
    if path.endswith(".py"):
        return next(at / path for at in BELOW if (at / path).exists())
    module = PACKAGE / "engine" / path.replace(".", "/")
    files = (module.with_suffix(".py"), module / "__init__.py")
    return next((file for file in files if file.exists()), None)


def _how_to_add() -> str:
    """Return the docstrings of the modules that the last part of "How to add" refers to."""
    part = PAGE.split("### In the engine")[1].split("\n## ")[0]
    files = {_file(path) for path in re.findall(r"^- \*\*.*?`(engine/[\w/]+\.py)`", part, re.M)}
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in sorted(files)]
    return "\n".join(ast.get_docstring(tree) for tree in trees)


def test_what_a_file_is_said_to_have_is_in_it():
    """As `slopes` of `taylor/carry.py`, and in docstrings of `taylor.carry`."""
    said = re.findall(
        r"`([A-Za-z_]\w*)`(?: and `([A-Za-z_]\w*)`)?\s+(?:of|in)\s+`([\w/]+\.py|[a-z_.]+)`",
        PAGE + _how_to_add(),
    )
    files = [(names, _file(path)) for *names, path in said]
    assert sum(file is not None for _, file in files) > 20
    for names, file in files:
        words = set(re.findall(r"\w+", file.read_text(encoding="utf-8"))) if file else set(names)
        assert set(filter(None, names)) <= words, file


def test_a_name_of_another_module_is_in_it():
    """As `growth.grow`, in docstrings and comments: some module `growth` has the word."""
    modules: dict[str, list[Path]] = {}
    for file in PACKAGE.rglob("*.py"):
        name = file.stem if file.stem != "__init__" else file.parent.name
        modules.setdefault(name, []).append(file)
    texts = {file: file.read_text(encoding="utf-8") for of in modules.values() for file in of}
    texts[PACKAGE / "__init__.py"] = (PACKAGE / "__init__.pyi").read_text(encoding="utf-8")
    checked, missing = 0, []
    for file, text in texts.items():
        for module, name in re.findall(r"(?<![`\w])`(?:\w+\.)*([a-z_]+)\.(\w+)`(?!`)", text):
            if module in modules and name != "py":
                words = {word for one in modules[module] for word in re.findall(r"\w+", texts[one])}
                folders = {one.parent / name for one in modules[module] if one.stem == "__init__"}
                checked += 1
                if name not in words and not any(
                    one.is_dir() or one.with_suffix(".py").exists() for one in folders
                ):
                    missing.append(f"{file.relative_to(PACKAGE)}: {module}.{name}")
    assert checked > 100
    assert missing == []


def test_a_folder_of_the_package_has_its_row():
    folders = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert folders <= set(re.findall(r"^\| `(\w+)/` \|", PAGE, re.M))


def test_every_module_of_the_engine_has_its_row():
    rows = re.findall(r"^\| (`.*?) \| ", PAGE, re.M)
    named = {name for row in rows for name in re.findall(r"`(\w+)\.py`", row)}
    modules = {path.stem for path in (PACKAGE / "engine").glob("*.py")} - {"__init__"}
    assert modules <= named | {"entry"}


def test_decisions_are_listed():
    pages = {path.name for path in (ROOT / "docs" / "decisions").glob("0*.md")}
    contents = (ROOT / "docs" / "decisions" / "index.md").read_text(encoding="utf-8")
    assert pages == set(re.findall(r"\]\(([\w-]+\.md)\)", contents))
