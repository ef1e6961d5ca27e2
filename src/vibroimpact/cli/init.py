"""``vibroimpact init``: a commented study file to start from."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path
from typing import Literal

from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError, printable

Kind = Literal["mass", "neighbours", "frame", "record"]


@calls(None, "Study file")
def init(file: opt.FileName, /, *, kind: Kind = "mass") -> int:
    """Write a study file with comments, which you can run as it is and then change.

    An existing file is not replaced.

    For example:

        vibroimpact init wall.toml
        vibroimpact init neighbours.toml --kind neighbours
        vibroimpact init frame.toml --kind frame
        vibroimpact init building.toml --kind record

    Parameters
    ----------
    file
        Path of the new file, NAME.toml.
    kind
        What the file describes. mass: a mass between two bumpers. neighbours: two masses that pound
        each other. frame: an isolated frame of three storeys between two walls. record: an isolated
        building in an earthquake, with a synthetic record in the file NAME-record.csv.
    """
    from vibroimpact.datasets.files import write_whole

    path = Path(file)
    if path.suffix.lower() != ".toml":
        raise InputError(
            f"FILE: {str(path)!r} does not end in .toml, by which commands recognise a study file; "
            "add this ending"
        )
    record = path.with_name(f"{path.stem}-record.csv")
    made = {path: _text(kind, path, record)}
    if kind == "record":
        made = {record: _ground_motion(), **made}
    for one in made:
        if one.exists():
            raise InputError(f"FILE: {str(one)!r} exists already; pass another name, or remove it")
    for one, text in made.items():
        write_whole(one, text)
        print(printable(f"wrote {one}"))
    return 0


def _text(kind: Kind, path: Path, record: Path) -> str:
    """Return the text of a study file, in whose comments the paths stand."""
    files = resources.files("vibroimpact.cli") / "study_files"
    text = (files / f"{kind}.toml").read_text("utf-8")
    named = text.replace("{file}", str(path))
    # The path of a record is relative to the study file; in the comments it is that of the user.
    before, key, after = named.partition("\nrecord = ")
    before = before.replace("{record}", str(record))
    return _aligned(before) + key + after.replace("{record}", record.name)


def _aligned(text: str) -> str:
    """Align the descriptions of the commands in a comment, which follow two or more spaces."""
    shown = re.compile(r"^(#   vibroimpact .*?)  +(?=\S)", re.MULTILINE)
    wide = max(len(command) for command in shown.findall(text))
    return shown.sub(lambda match: f"{match[1]:{wide}}  ", text)


_STEP = 0.01
_SECONDS = 20.0
_PEAK = 0.4 * 9.80665
"""Time step (s), duration (s) and peak (m/s²) of the synthetic record."""


def _ground_motion() -> str:
    """Return a synthetic ground acceleration as CSV text: a sum of sines below an envelope."""
    import numpy as np

    from vibroimpact.model.units import plain

    rng = np.random.default_rng(1)
    time = np.arange(round(_SECONDS / _STEP)) * _STEP
    phases = rng.uniform(0.0, 2.0 * np.pi, 80)
    waves = np.sin(2.0 * np.pi * np.outer(time, np.linspace(0.2, 8.0, 80)) + phases)
    values = (time / 4.0) ** 2 * np.exp(-time / 2.0) * waves.sum(axis=1)
    values *= _PEAK / np.abs(values).max()
    rows = [f"{plain(t, 6)},{value:.6f}" for t, value in zip(time, values, strict=True)]
    return "\n".join(["time (s),acceleration (m/s^2)", *rows, ""])
