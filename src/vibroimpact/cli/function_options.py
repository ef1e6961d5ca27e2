"""Help and defaults of options, which are read from the library function that a command calls.

The source of the function is parsed, not imported, so that ``--help`` does not import what
computes.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import re
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any, NamedTuple, TypeVar, get_args, get_origin, get_type_hints

import docstring_parser
from cyclopts import Group, Parameter

REQUIRED = inspect.Parameter.empty
"""Default of an argument that has no default, or whose default is not a literal."""

RENAMED: dict[str, dict[str, str]] = {}
"""For each module of a command: options by the argument that they set, if the two names differ."""

_Command = TypeVar("_Command", bound=Callable[..., Any])
_PACKAGE = Path(__file__).parents[1]


class Argument(NamedTuple):
    """An argument of a library function."""

    help: str
    default: Any


def calls(
    function: str | None, group: str, sort_key: int = 1, **arguments: str
) -> Callable[[_Command], _Command]:
    """Copy help and defaults of a command's options from the function that the command calls.

    If an option has the name of an argument, its help is the description of the argument, unless
    the docstring of the command describes the option. Its default is the default of the argument,
    unless the command has its own default.

    Parameters
    ----------
    function
        Name of the public function, such as "branch". None if the command calls no public function.
    group
        Heading of the options in the help.
    sort_key
        Position of this heading among all headings.
    arguments
        Names of arguments by option, if the two names differ.
    """
    heading = Group(group, sort_key=sort_key)

    def decorate(command: _Command) -> _Command:
        library = read_arguments(function) if function else {}
        docstring = inspect.getdoc(command) or ""
        own = _descriptions(docstring)
        hints = get_type_hints(command, include_extras=True)
        options = inspect.signature(command).parameters
        defaults = dict(command.__kwdefaults__ or {})
        for name, option in options.items():
            if is_group(hints[name]):
                continue
            key = arguments.get(name, name)
            text = own.get(name) or _help_of(hints[name])
            default = defaults.get(name)
            if function and key in library:
                text = text or describe(function, key)
                if option.default is REQUIRED and library[key].default is not REQUIRED:
                    default = defaults[name] = library[key].default
                elif default is None:
                    default = library[key].default
            is_option = option.kind is inspect.Parameter.KEYWORD_ONLY
            command.__annotations__[name] = _documented(
                hints[name],
                heading if is_option else None,
                with_default(text, default) if is_option else text,
            )
        module = command.__module__.rpartition(".")[2]
        RENAMED[module] = {arguments[name]: _flag(name, hints[name]) for name in arguments}
        command.__kwdefaults__ = defaults
        command.__doc__ = docstring.partition("\n\nParameters\n")[0]
        command.called_function = function  # type: ignore[attr-defined]
        command.called_arguments = arguments  # type: ignore[attr-defined]
        return command

    return decorate


@cache
def read_arguments(function: str) -> Mapping[str, Argument]:
    """Read the arguments of a public function from its source.

    Raises
    ------
    KeyError
        If there is no public function with this name.
    """
    stub = (_PACKAGE / "__init__.pyi").read_text(encoding="utf-8")
    modules = {name: module for module, name in re.findall(r"from \.(\S+) import (\w+) as", stub)}
    source = _PACKAGE.joinpath(*modules[function].split(".")).with_suffix(".py")
    tree = ast.parse(source.read_text(encoding="utf-8"))
    definition = next(
        node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == function
    )
    described = _descriptions(ast.get_docstring(definition) or "")
    signature = definition.args
    plain = [*signature.posonlyargs, *signature.args]
    expressions: dict[str, ast.expr | None] = {one.arg: None for one in plain}
    expressions |= zip(
        [one.arg for one in plain[len(plain) - len(signature.defaults) :]],
        signature.defaults,
        strict=True,
    )
    names = [one.arg for one in signature.kwonlyargs]
    expressions |= zip(names, signature.kw_defaults, strict=True)
    return {
        name: Argument(described.get(name, ""), _literal(expression))
        for name, expression in expressions.items()
    }


def describe(function: str, argument: str) -> str:
    """Return the description of an argument, also if it only refers to another: "As in `sweeps`."""
    text = read_arguments(function)[argument].help
    elsewhere = re.fullmatch(r"As (?:in|of) (\w+)\.", text)
    return describe(elsewhere[1], argument) if elsewhere else text


def with_default(text: str, default: Any) -> str:
    """Add the default to the help of an option, unless it is stated. Flags and lists have none."""
    if default is REQUIRED or default is None or default == () or isinstance(default, bool):
        return text
    if "efault:" in text:
        return text
    value = f"{default:g}" if isinstance(default, float) else str(default)
    sentences = re.split(r"(?<=\.)\s+", text)
    if len(sentences) == 1:
        return f"{text.removesuffix('.')} (default: {value})."
    return f"{text} Default: {value}."


def _descriptions(docstring: str) -> dict[str, str]:
    """Return the descriptions of the parameters in a NumPy docstring, as plain sentences."""
    descriptions = {}
    for one in docstring_parser.parse(docstring, docstring_parser.DocstringStyle.NUMPYDOC).params:
        for name in one.arg_name.split(","):
            descriptions[name.strip()] = _plain(one.description or "")
    return descriptions


def _plain(text: str) -> str:
    """Return a description for the command line, without None and without markup."""
    text = " ".join(text.split())
    text = re.sub(r'``"([^"`]*)"``', r"\1", text)
    text = text.replace("`", "")
    return re.sub(r"(; |\b)None for ", lambda m: ". Default: " if m[1] else "Default: ", text)


def _literal(expression: ast.expr | None) -> Any:
    try:
        return REQUIRED if expression is None else ast.literal_eval(expression)
    except ValueError:  # a named constant
        return REQUIRED


def is_group(hint: Any) -> bool:
    """Return whether an annotation is a group of options, which has its own documentation."""
    return dataclasses.is_dataclass(hint)


def _settings(hint: Any) -> list[Parameter]:
    """Return the settings of an annotation, including those of the members of a union."""
    if get_origin(hint) is not Annotated:
        return [one for member in get_args(hint) for one in _settings(member)]
    return [one for one in hint.__metadata__ if isinstance(one, Parameter)]


def _help_of(hint: Any) -> str:
    """Return the help in an annotation."""
    return next((one.help for one in reversed(_settings(hint)) if one.help), "")


def _documented(hint: Any, group: Group | None, text: str) -> Any:
    """Return an annotation with this help, and with a group unless it already has one."""
    has_group = group is None or any(one.group for one in _settings(hint))
    bare, *metadata = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    first = Parameter() if has_group else Parameter(group=group)
    return Annotated[(bare, first, *metadata, Parameter(help=text, show_default=False))]


def _flag(name: str, hint: Any) -> str:
    """Return the option as a user writes it."""
    names = [one.name for one in _settings(hint) if one.name]
    return next(iter(names[-1])) if names else f"--{name.replace('_', '-')}"
