"""From a case code or a study file, and the options that replace values, to a rig."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, NamedTuple

from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.study import Study, read_study
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Isolator, Model, Oscillator, Stop, laboratory, to_si
from vibroimpact.model.units import ACCELERATION
from vibroimpact.model.validation import Accepts

_SHARED = {"stiffness": "bumper_stiffness", "damping": "bumper_damping", "gap": "gap"}
"""Fields of a bumper, and the options that set them on both sides."""


class Subject(NamedTuple):
    """What a command works on."""

    name: str
    """For titles."""
    slug: str
    """For file names."""
    oscillator: Oscillator
    amplitude: float
    """Peak base acceleration in m/s²."""
    study: Study | None


def subject(text: str, options: RigOptions, name: str | None = None) -> Subject:
    """Return the rig that a case code or the path of a study file names, with changes.

    Raises
    ------
    InputError
        If the code or the file cannot be used, or a value of the options.
    """
    path = Path(text)
    study = read_study(path) if path.suffix.lower() == ".toml" or path.is_file() else None
    code = text if study is None else study.case
    parameters = options.parameters or (study.parameters if study else None)
    title = name or (study and (study.name or path.stem))
    amplitude = study.excitation.amplitude if study else None
    if code is not None:
        try:
            case = laboratory.case(code, parameters or "table")
        except InputError as error:
            raise InputError(f"study {text!r}: {error}" if study else str(error)) from None
        oscillator = case.oscillator
        amplitude = case.amplitude if amplitude is None else amplitude
        # Two parameter sets of one test are two rigs: neither may overwrite the other's files.
        set_name = "-identified" if parameters == "identified" else ""
        slug = _slug(title) if title else case.slug + set_name
        title = title or case.code + (
            ", identified parameters" if parameters == "identified" else ""
        )
    else:
        # Study sees to it that there is one.
        assert study is not None
        assert study.oscillator is not None
        if parameters is not None:
            raise InputError(
                f"--parameters: {parameters!r}, but {text!r} describes its own oscillator; "
                "a case has parameter sets"
            )
        oscillator = study.oscillator
        title = title or path.stem
        slug = _slug(title)
    if options.amplitude is not None:
        amplitude = to_si(options.amplitude, ACCELERATION, "--amplitude", above=0.0)
    if amplitude is None:
        raise InputError(
            f"study {text!r}: excitation.amplitude: missing; an acceleration greater than 0 is "
            'accepted, such as "0.05 g", there or as --amplitude'
        )
    return Subject(title, slug, changed(oscillator, options), amplitude, study)


def changed(oscillator: Oscillator, options: RigOptions) -> Oscillator:
    """Return the oscillator with the values that the options replace.

    Raises
    ------
    InputError
        If a value cannot be used, or a new bumper is not fully described.
    """
    isolator = {
        field: _value(Isolator, field, field, options)
        for field in ("stiffness", "damping")
        if getattr(options, field) is not None
    }
    changes: dict[str, Any] = {"isolator": oscillator.isolator.replace(**isolator)}
    if options.mass is not None:
        changes["mass"] = _value(Oscillator, "mass", "mass", options)

    removed = {"right": options.no_right, "left": options.no_left}
    shared = {
        field: _value(Bumper, field, option, options)
        for field, option in _SHARED.items()
        if getattr(options, option) is not None
    }
    # Both sides' options change what is there; they make bumpers only where there are none.
    present = [
        side for side in removed if getattr(oscillator, side) is not None and not removed[side]
    ]
    targets = present or [side for side in removed if not removed[side]]
    if shared and not targets:
        option = next(_SHARED[field] for field in shared)
        raise InputError(
            f"{_flag(option)}: given with --no-right and --no-left; it needs a bumper on some side"
        )
    for field in shared:
        if not any(_has(getattr(oscillator, side), field) for side in targets):
            raise InputError(
                f"{_flag(_SHARED[field])}: given, but every stop is rigid; it needs a bumper "
                "on some side"
            )
    for side in removed:
        own = {
            field: _value(Bumper, field, f"{side}_{field}", options)
            for field in _SHARED
            if getattr(options, f"{side}_{field}") is not None
        }
        if removed[side] and own:
            raise InputError(
                f"{_flag(f'{side}_{next(iter(own))}')}: given with --no-{side}; "
                "one of them is accepted"
            )
        bumper: Stop | None = None if removed[side] else getattr(oscillator, side)
        for field in own:
            if not _has(bumper, field):
                raise InputError(
                    f"{_flag(f'{side}_{field}')}: given, but the {side} stop is {bumper}; "
                    "it needs a bumper there"
                )
        values = {f: v for f, v in shared.items() if side in targets and _has(bumper, f)} | own
        if bumper is not None:
            bumper = bumper.replace(**values)
        elif values and not removed[side]:
            bumper = _new_bumper(side, values)
        changes[side] = bumper
    return oscillator.replace(**changes)


def _has(stop: Stop | None, field: str) -> bool:
    """Whether a stop has a field, or a new bumper would."""
    return field in (Bumper if stop is None else type(stop)).model_fields


def _new_bumper(side: str, values: dict[str, float]) -> Bumper:
    missing = [field for field in _SHARED if field not in values]
    if missing:
        raise InputError(
            f"{_flag(f'{side}_{missing[0]}')}: missing; the rig has no {side} bumper, and a new "
            "one needs a stiffness, a damping and a gap"
        )
    return Bumper(**values)


def _value(model: type[Model], field: str, option: str, options: RigOptions) -> float:
    """Read an option's text as the model reads the field; messages name the option."""
    accepts = next(m for m in model.model_fields[field].metadata if isinstance(m, Accepts))
    try:
        value = accepts(getattr(options, option))
    except InputError as error:
        raise InputError(f"{_flag(option)}: {error}") from None
    assert value is not None
    return value


def _flag(option: str) -> str:
    return f"--{option.replace('_', '-')}"


def _slug(name: str) -> str:
    """Return the name as a file name: without a slash, a space or a sign outside ASCII."""
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", name).strip("_.") or "rig"
