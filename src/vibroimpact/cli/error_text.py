"""Error messages in the words of the command line: names of options, and a hint about quotes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from cyclopts import CycloptsError
from cyclopts.exceptions import UnknownCommandError, UnknownOptionError, UnusedCliTokensError

from vibroimpact.cli.function_options import RENAMED
from vibroimpact.errors import alternatives, short_line

_FIELD = re.compile(r"([a-z_.]+)(?=(\[\d+\])?: )")
_VARIED = re.compile(r"vary\[(['\"])(.+?)\1\](\[\d+\])?")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_PAIR = re.compile(r"parameter (--[a-z-]+) requires 2 positional arguments")
_UNIT = re.compile(r"[A-Za-zµ°]+(\^?-?[²³]|\^-?\d|[23])?([*/·][A-Za-z]+(\^?-?\d|[²³])?)*")
_ELSEWHERE = {
    "--F0": ("--amplitude", "write it as --amplitude 450N"),
    "--force": ("--amplitude", "write it as --amplitude 450N"),
    "--unbalance": ("--amplitude", 'write it as --amplitude "0.4 kg m"'),
    "--acceleration": ("--amplitude", "write it as --amplitude 0.05g"),
    "--displacement": ("--amplitude", "write it as --amplitude 5mm"),
    "--period": ("--set", "write the period of the isolator as --set isolator_period=2.5s"),
    "--natural-frequency": ("--set", "write its reciprocal as --set isolator_period=2.5s"),
    "--stiffness": ("--set", "write it as --set isolator.stiffness=30kN/m"),
    "--damping": ("--set", 'write it as --set "isolator.damping=1 kN s/m"'),
    "--from": ("--vary", "write the range as --vary frequency=0.5Hz:4Hz"),
    "--to": ("--vary", "write the range as --vary frequency=0.5Hz:4Hz"),
    "--mass": ("--set", "write it as --set mass=550kg"),
}
"""Options that users expect, the option of the command that replaces each, and what to do."""


def in_words(error: Exception, words: Sequence[str]) -> str:
    """Return one line that states what is wrong with the words of a command line."""
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        count = len(error.unused_tokens)
        unused = " ".join(error.unused_tokens)
        line = f"{unused!r} {f'are {count} words' if count > 1 else 'is one word'} too many"
    elif isinstance(error, UnknownCommandError) and error.app is not None:
        # cyclopts lists only some of the commands.
        first, _, _ = str(error).partition(" Available commands:")
        names = alternatives(name for name in error.app if not name.startswith("-"))
        line = f"{first} Use {names}"
    elif isinstance(error, UnknownOptionError) and (advice := _replacement(error)):
        line = f"Unknown option: {advice}"
    elif pair := _PAIR.search(str(error)):
        line = _as_two_words(pair[1], words)
    else:
        line = str(error).rstrip(".")
    if isinstance(error, CycloptsError):
        line += " See --help" if line.endswith("?") else "; see --help"
    return short_line(_as_option(line, words) + _quoting(words))


def _replacement(error: UnknownOptionError) -> str:
    """Return an unknown option and what to write instead, if another option replaces it."""
    option = (error.token.keyword or error.token.value).partition("=")[0]
    replacement, advice = _ELSEWHERE.get(option, ("", ""))
    known = {name for argument in error.argument_collection for name in argument.names}
    return f"{option}; {advice}" if replacement in known else ""


def _as_two_words(option: str, words: Sequence[str]) -> str:
    """Describe an option whose name and value are one word: ``--limit penetration=5mm``."""
    after = [words[i + 1] for i, word in enumerate(words[:-1]) if word == option]
    after += [word.partition("=")[2] for word in words if word.startswith(f"{option}=")]
    for written in after:
        name, equals, value = written.partition("=")
        if equals and name and value:
            return (
                f"{option}: {written!r} is one word; write the name and the value as two words: "
                f"{option} {name} {value}"
            )
    return f"{option}: a name and a value are required, as two words"


def _as_option(message: str, words: Sequence[str]) -> str:
    """Replace the name of a field by the option that the user wrote, such as --max-cycles."""
    module = words[0].replace("-", "_") if words else ""
    for argument in RENAMED.get(module, ()):
        if re.match(rf"{re.escape(argument)}(\[[^\]]*\])?: ", message):
            return _in_options(message, RENAMED[module])
    if varied := _VARIED.match(message):
        return f"--vary: {varied[2]}{message[varied.end() :]}"
    field = _FIELD.match(message)
    if field is None:
        return message
    option = f"--{field[1].replace('_', '-').rpartition('.')[2]}"
    is_written = any(word.partition("=")[0] == option for word in words)
    return option + message[field.end(1) :] if is_written else message


def _in_options(message: str, renamed: Mapping[str, str]) -> str:
    """Replace an argument by its option, at the start of a message and before an index."""
    for argument, option in renamed.items():
        name = re.escape(argument)
        message = re.sub(rf"^{name}(?=(\[[^\]]*\])?: )|\b{name}(?=\[\d+\])", option, message)
    return message


def _quoting(words: Sequence[str]) -> str:
    """Return a hint about quotes if the shell has split a value and its unit into words."""
    for i, option in enumerate(words[:-2]):
        if not (option.startswith("--") and _NUMBER.fullmatch(words[i + 1].rpartition("=")[2])):
            continue
        unit = []
        for word in words[i + 2 :]:
            if not _UNIT.fullmatch(word):
                break
            unit.append(word)
        if unit:
            value = " ".join((words[i + 1], *unit))
            return f'; put quotes around a value with blanks, as in {option} "{value}"'
    return ""
