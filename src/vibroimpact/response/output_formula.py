"""Formulas of own outputs: one number from the time histories of a motion.

Python's parser reads the text, which is never run as code. Only arithmetic, comparisons and the
functions below are accepted.
"""

from __future__ import annotations

import ast
import functools
import math
import operator
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, advised, alternatives, meant, shown, suggested
from vibroimpact.model.parameters import canonical, suggestion

_Value = NDArray[np.float64]

_LONGEST = 300
"""Largest number of characters of a formula."""

CONSTANTS = {"pi": math.pi}

_ELEMENTWISE: dict[str, Callable[..., Any]] = {
    "abs": np.abs,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tanh": np.tanh,
    "sign": np.sign,
}
_OVER_TIME = ("max", "min", "mean", "rms", "integral")
FUNCTIONS = (*_OVER_TIME, *_ELEMENTWISE)

_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}


class OutputFormula(NamedTuple):
    """A formula that has been checked."""

    text: str
    histories: tuple[str, ...]
    """Names of time histories that it contains."""
    parameters: tuple[str, ...]

    def value(self, time: _Value, values: Mapping[str, Any]) -> float:
        """Return the number.

        Values of names are in SI units; `time` (s) holds the samples of time histories.

        Raises
        ------
        InputError
            If the result is a time history instead of a number.
        """
        with np.errstate(all="ignore"):
            result = np.asarray(_value(ast.parse(self.text, mode="eval").body, time, values))
        if result.ndim:
            raise InputError(
                f"{self.text!r} is a time history, not a number; apply max, min, mean, rms or "
                "integral"
            )
        return float(result)


def read_output_formula(
    text: str, histories: tuple[str, ...], parameters: tuple[str, ...]
) -> OutputFormula:
    """Parse a formula and check its names.

    Parameters
    ----------
    histories, parameters
        Names of the time histories and parameters that the rig has.

    Raises
    ------
    InputError
        If the formula cannot be read, contains an unknown name, or is not one number.
    """
    text = text.strip()
    if not 0 < len(text) <= _LONGEST:
        raise InputError(f"it has {len(text)} characters; use 1 to {_LONGEST} characters")
    try:
        tree = ast.parse(text, mode="eval").body
    except SyntaxError as error:
        raise InputError(
            f"{shown(text)} cannot be read ({error.msg}); use a formula such as "
            "'max(abs(velocity))'"
        ) from None
    except (ValueError, RecursionError, MemoryError):
        raise InputError(
            f"{shown(text)} cannot be read; use a formula such as 'max(abs(velocity))'"
        ) from None
    names = tuple(dict.fromkeys(_names(tree, histories, parameters)))
    held = tuple(name for name in names if name in histories)
    made = OutputFormula(text, held, tuple(name for name in names if name not in histories))
    some = np.array([0.0, 1.0])
    made.value(some, {name: some if name in histories else 1.0 for name in names})
    return made


def _names(part: ast.AST, histories: tuple[str, ...], parameters: tuple[str, ...]) -> list[str]:
    """Return the names in a part of the tree, and refuse what formulas do not accept."""
    match part:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float()):
            return []
        case ast.Name() | ast.Attribute():
            name = ast.unparse(part)
            if name in CONSTANTS:
                return []
            known = (*histories, *parameters)
            if name not in known and canonical(name, known) not in known:
                some = [*[one for one in parameters if one != "frequency"][:2], "frequency"]
                parts = [one for one in known if one.startswith(f"{name}.")]
                near = suggested(parts[0]) if parts else suggestion(name, known)
                raise InputError(
                    f"{name!r} is neither a time history nor a parameter of the rig; "
                    f"{advised(near, ', '.join(histories))}, or a parameter such as "
                    f"{alternatives(some)}"
                )
            return [name]
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=one):
            return _names(one, histories, parameters)
        case ast.BinOp(op=ast.BitXor()):
            raise InputError(f"{ast.unparse(part)!r}: ^ is not a power here; write **")
        case ast.BinOp(left=one, op=op, right=other) if type(op) in _OPERATORS:
            return [*_names(one, histories, parameters), *_names(other, histories, parameters)]
        case ast.Compare(left=one, ops=[op], comparators=[other]) if type(op) in _OPERATORS:
            return [*_names(one, histories, parameters), *_names(other, histories, parameters)]
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
            if name not in FUNCTIONS:
                use = advised(meant(name, FUNCTIONS), alternatives(FUNCTIONS))
                raise InputError(f"{name!r} is not a function that outputs accept; {use}")
            if not (len(args) == 1 or (name in ("max", "min") and len(args) > 1)):
                raise InputError(f"{ast.unparse(part)!r}: {name} has one argument")
            return [symbol for one in args for symbol in _names(one, histories, parameters)]
        case _:
            pass
    raise InputError(
        f"{ast.unparse(part)!r} is not accepted; use + - * / ** ( ), comparisons with < and >, and "
        "functions"
    )


def _value(part: ast.AST, time: _Value, values: Mapping[str, Any]) -> Any:
    match part:
        case ast.Constant(value=int() | float() as value):
            return np.float64(value)
        case ast.Name() | ast.Attribute():  # a path, such as isolator.damping
            name = ast.unparse(part)
            return CONSTANTS[name] if name in CONSTANTS else values[name]
        case ast.UnaryOp(op=op, operand=one):
            return _OPERATORS[type(op)](_value(one, time, values))
        case ast.BinOp(left=one, op=op, right=other):
            both = _value(one, time, values), _value(other, time, values)
            return _OPERATORS[type(op)](*map(np.asarray, both))
        case ast.Compare(left=one, ops=[op], comparators=[other]):
            both = _value(one, time, values), _value(other, time, values)
            return np.asarray(_OPERATORS[type(op)](*both), dtype=np.float64)
        case ast.Call(func=ast.Name(id=name), args=args):
            arguments = [np.asarray(_value(one, time, values), dtype=np.float64) for one in args]
            if name in _ELEMENTWISE:
                return _ELEMENTWISE[name](arguments[0])
            if len(arguments) > 1:  # the larger of two, sample by sample
                return functools.reduce(np.maximum if name == "max" else np.minimum, arguments)
            return _over_time(name, arguments[0], time)
    raise AssertionError(ast.dump(part))


def _over_time(name: str, values: _Value, time: _Value) -> Any:
    if not values.ndim:
        return values * (time[-1] - time[0]) if name == "integral" else values
    if name in ("max", "min"):
        return values.max() if name == "max" else values.min()
    if name == "rms":
        return np.sqrt(_over_time("mean", values**2, time))
    integral = np.trapezoid(values, time)
    return integral if name == "integral" else integral / (time[-1] - time[0])
