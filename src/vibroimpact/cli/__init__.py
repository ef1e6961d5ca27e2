"""The command line: one short module for each command.

A command reads its arguments and calls one function of the library. Its module imports the
computing parts only when the command runs, so that ``vibroimpact --help`` responds at once.

A new command is a module with one function, and an entry of `_COMMANDS`. The decorator `calls` of
`cli/function_options.py` names the library function, from which it copies help and defaults. The
rig comes from `subject` of `cli/rig.py`, shared options from `cli/options.py`, which a topic of
`cli/topics.py` explains; `results` of `cli/results.py` writes and prints, and its `draw` saves a
further figure. A command checks no values and composes no sentences: the library function checks,
and `facts` composes. `tests/cli/test_function_options.py` lists the options whose default differs,
with the reasons.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import copy_context
from typing import Any

from cyclopts import App, CycloptsError

from vibroimpact import stderr
from vibroimpact._version import __version__
from vibroimpact.cli.error_text import in_words
from vibroimpact.cli.garbage_collection import search_no_more, search_seldom
from vibroimpact.cli.output import busy, font_warnings_once, warnings_in_lines
from vibroimpact.cli.terminal import (
    flush,
    give_up_stdout,
    hold_closed_streams,
    take_any_encoding,
)
from vibroimpact.errors import InputError
from vibroimpact.stderr import print_line

_HELP = """
Compute the exact dynamics of oscillators that hit deformable stops.

A rig is a mass on an isolator between two bumpers (deformable stops), shaken by its base. Most
commands require a rig: the code of a published laboratory test, such as B2-G1-A3, or the path of a
study file that describes your own rig (vibroimpact help rigs).

For example:

    vibroimpact init study.toml
    vibroimpact show study.toml
    vibroimpact sweep B2-G1-A3
    vibroimpact sweep B3-10mm-A3 --from 0.3Hz --to 4Hz --step 0.01Hz
    vibroimpact sweep study.toml --gap 12mm --output results
    vibroimpact motion B2-G1-A3 --frequency 2.6Hz
    vibroimpact branch B2-G1-A3
    vibroimpact bifurcation B3-10mm-A3 --vary frequency=0.9Hz:1.3Hz
    vibroimpact basins B3-10mm-A3 --frequency 0.7Hz
    vibroimpact manifolds B3-10mm-A3 --frequency 0.7Hz
    vibroimpact basin-stability B2-G1-A3 --vary frequency=1.5Hz:2.7Hz
    vibroimpact simulate B2-G1-A3 --frequency 2.5Hz
    vibroimpact record quake.AT2
    vibroimpact earthquake B2-G1-A3 quake.AT2
    vibroimpact design B2-G1-A3
    vibroimpact identify test.csv --rig B2-G1-A3 --free isolator.stiffness,gap
    vibroimpact ensemble B2-G1-A3 --uncertain gap=normal:5%
    vibroimpact classify B2-G1-A3
    vibroimpact map --vary stiffness_ratio=0.5:100:log --vary gap_ratio=0:1
    vibroimpact explore B2-G1-A3
    vibroimpact cache --clean others

To see the options of a command, run: vibroimpact COMMAND --help

What the commands share is explained by: vibroimpact help rigs, and vibroimpact help output

Exit codes: 0 (completed), 1 (results could not be written), 2 (invalid input), 130 (interrupted),
143 (terminated).
"""

_COMMANDS = (
    "init",
    "show",
    "sweep",
    "motion",
    "branch",
    "bifurcation",
    "curve",
    "basins",
    "manifolds",
    "basin-stability",
    "simulate",
    "record",
    "earthquake",
    "design",
    "ensemble",
    "classify",
    "explore",
    "identify",
    "map",
    "cache",
    "help",
)
"""Each command is a function in a module of the same name; that of `map` is scenario_map."""


def main(arguments: Iterable[str] | None = None) -> int:
    """Run the command of these words (default: those of the system), and return its exit code."""
    if arguments is not None:
        return _run(list(arguments))
    hold_closed_streams()
    search_seldom()
    code = _run(sys.argv[1:])
    search_no_more()
    # Only the end of the interpreter remains. An interrupt must not turn it into a failure.
    signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    return code


class _Terminated(KeyboardInterrupt):
    """SIGTERM: it ends a command as Ctrl-C does, and leaves no unfinished files."""


@contextmanager
def _terminable() -> Iterator[None]:
    """Turn SIGTERM into an exception. Only the main thread receives signals."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def raised(*_: Any) -> None:
        raise _Terminated

    before = signal.signal(signal.SIGTERM, raised)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _run(words: list[str]) -> int:
    """Run a command, and return its exit code."""
    take_any_encoding()
    stderr.busy = busy
    try:
        with _terminable(), warnings_in_lines(), font_warnings_once():
            # In a context of its own: the rig of a command may be written without units.
            result = copy_context().run(_app(words), words)
        flush()
    except (InputError, CycloptsError) as error:
        return _failed(in_words(error, words), 2)
    except _Terminated:
        print_line("terminated")
        return 143
    except KeyboardInterrupt:
        print_line("interrupted")
        return 130
    except (BrokenPipeError, SystemExit):
        # The reader of the output has closed it, as `head` does. The files are already written.
        # rich, which prints the help, turns this error into an exit.
        give_up_stdout()
        return 0
    except OSError as error:
        give_up_stdout()
        why = error.strerror or str(error)
        if error.filename is None:  # a stream, which has no name
            return _failed(f"the output cannot be written ({why})", 1)
        return _failed(f"{error.filename!r} cannot be used ({why})", 1)
    return result if isinstance(result, int) else 0


def print_help(command: str) -> tuple[str, ...] | None:
    """Print the help of a command; return the commands if it is none of them."""
    if command not in _COMMANDS:
        return _COMMANDS
    _app([command])([command, "--help"])
    return None


def _failed(message: str, code: int) -> int:
    """Print an error, and return the exit code."""
    print_line(f"error: {message}")
    return code


def _app(words: Sequence[str] = ()) -> App:
    """Return the commands. All are imported, unless the first word is the name of a command."""
    app = App(
        name="vibroimpact",
        help=_HELP,
        help_format="markdown",
        version=f"vibroimpact {__version__}",
        exit_on_error=False,
        print_error=False,
        suppress_keyboard_interrupt=False,
        result_action="return_value",
    )
    # Commands are registered by path. cyclopts imports the path when the command runs.
    for command in _COMMANDS:
        module = command.replace("-", "_")
        function = "scenario_map" if command == "map" else module
        app.command(f"vibroimpact.cli.{module}:{function}", name=command)
    if not words or words[0] not in _COMMANDS:
        for command in _COMMANDS:
            app[command]  # imports the command, because the help lists all summaries
    app.register_install_completion_command(
        help="Install completion of commands and options in bash, zsh, fish or PowerShell."
    )
    return app
