"""Records on the command line: reading their files, those of a study, and scaling."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from cyclopts import Group, Parameter

import vibroimpact as vi
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
READING = Group("Reading of records (default of each option: what the file states)", sort_key=1)

Scale: TypeAlias = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Factor by which each record is multiplied. Pass one factor for all records, or one "
        "per record, separated by commas, such as 0.2,0.5. Default: 1.",
    ),
]
Peak: TypeAlias = Annotated[
    str | None,
    Parameter(
        allow_leading_hyphen=True,
        help="Peak acceleration to which each record is scaled, such as 0.3g. Pass one peak for "
        "all records, or one per record, separated by commas. Default: the records are not scaled "
        "to a peak.",
    ),
]

_Stated: TypeAlias = Annotated[str | None, Parameter(group=READING)]


@Parameter(name="*")
@dataclass(frozen=True)
class RecordOptions:
    """Options that replace statements in the files of records."""

    component: _Stated = None
    """Component (direction) that is read, if the file has several. Pass its name in the file, such
    as HNE, Up or 90, or its position in the file, starting from 1. For several records, pass one
    component for all, or one per record, such as 90,Up."""
    unit: _Stated = None
    """Unit of the values, such as g or cm/s^2. If it is a unit of length, such as mm, the values
    are displacements and are differentiated twice. If it is none, the values are the numbers of a
    rig without units. Required if the file states no unit. For several
    records, pass one unit for all, or one per record."""
    step: Annotated[_Stated, Parameter(allow_leading_hyphen=True)] = None
    """Time between samples, such as 10ms. It replaces the step or the times in the file. For
    several records, pass one step for all, or one per record."""
    decimal: Annotated[Literal[".", ","] | None, Parameter(group=READING)] = None
    """Decimal mark of the numbers in the file, if the file is a text table. Default: detected from
    the table."""

    def arguments(self) -> dict[str, Any]:
        """Return the options as arguments of `Record.read`, without the component."""
        return {"unit": self.unit, "step": self.step, "decimal": self.decimal}

    def read(self, files: Iterable[str]) -> dict[str, vi.Record]:
        """Read the files of records, by their names.

        Raises
        ------
        InputError
            If one cannot be read, or two have one name.
        """
        records: dict[str, vi.Record] = {}
        names = list(files)
        options = (("--component", self.component), ("--unit", self.unit), ("--step", self.step))
        said = (one_or_each(option, text, len(names)) for option, text in options)
        for file, *own in dict.fromkeys(zip(names, *said, strict=True)):
            component, unit, step = own
            name = record_name(file, component)
            if name in records:
                raise InputError(
                    f"RECORD: {file!r} has the same file name as another record; rename one of the "
                    "two files"
                )
            records[name] = vi.Record.read(
                file, component, unit=unit, step=step, decimal=self.decimal
            )
        return records


def one_or_each(option: str, text: str | None, count: int) -> list[str | None]:
    """Return one text per record, from one text for all records or one per record.

    Raises
    ------
    InputError
        If there are several texts, but not as many as records.
    """
    parts: list[str | None] = [text]
    if text is not None and count > 1:
        parts = [part.strip() for part in text.split(",")]
    if len(parts) not in (1, count):
        raise InputError(
            f"{option}: {text!r} has {len(parts)} values for {count} records; pass one value for "
            f"all records, or {count} values"
        )
    return parts if len(parts) == count else parts * count


def record_name(file: str, component: str | None) -> str:
    """Return the name of a record: its file name, and its component if one was chosen."""
    return " ".join([Path(file).name.removesuffix(".gz"), *([component] if component else [])])


_TABLES = re.compile(r"\.(txt|csv|tsv|dat|asc|at2)(?= |$)", re.IGNORECASE)
"""Suffixes that say only that a file is a record. Others name its stage or component."""


def record_stems(names: Iterable[str]) -> dict[str, str]:
    """Return the part of file names for each record: its name without the suffix of its file.

    Records whose names differ only by it keep it.
    """
    from vibroimpact.model.names import file_stem

    every = list(names)
    short = {name: _TABLES.sub("", name) for name in every}
    many = Counter(one.lower() for one in short.values())
    return {name: file_stem(one if many[one.lower()] == 1 else name) for name, one in short.items()}


AS_STATED = RecordOptions()
"""No option replaces a statement in a file."""


def records_of_design(rig: str, *, with_own_record: bool = True) -> list[str]:
    """Return the paths of the records that the study lists in ``[design]``.

    A laboratory case has none. Without `with_own_record`, neither has a study whose excitation is a
    record.
    """
    from vibroimpact.cli.study import read_study

    path = Path(rig)
    if path.suffix.lower() != ".toml" and not path.is_file():
        path = path.with_name(f"{path.name}.toml") if path.name else path
        if not path.is_file():
            return []
    study = read_study(path)
    if study.excitation.record is not None and not with_own_record:
        return []
    return [str(path.parent / name) for name in study.design.records or []]


def record_of_study(what: Subject) -> dict[str, vi.Record]:
    """Return the record that is the excitation of a study.

    Raises
    ------
    InputError
        If the excitation of the study is not a record.
    """
    if not isinstance(what.shaking, vi.Record):
        raise InputError(
            "RECORD: missing; pass the file of a record, or a study that has a record as its "
            "excitation"
        )
    about = what.shaking.about
    return {record_name(about.source, about.component): what.shaking}


def scale_records(
    records: dict[str, vi.Record], scale: str | None, peak: str | None
) -> dict[str, vi.Record]:
    """Multiply records by factors, or scale them to peaks: one for all, or one per record."""
    if scale is None and peak is None:
        return records
    sizes = one_or_each("--scale", scale, len(records))
    peaks = one_or_each("--peak", peak, len(records))
    return {
        name: one.scaled(1.0 if size is None else size, peak=most)
        for (name, one), size, most in zip(records.items(), sizes, peaks, strict=True)
    }


def records_or_sines(
    what: Subject, named_records: dict[str, vi.Record], scale: str | None, peak: str | None
) -> dict[str, vi.Record] | None:
    """Return the scaled records of the options or of the study. None means sines.

    Raises
    ------
    InputError
        If records shall be scaled, but there are none.
    """
    records = named_records or (
        record_of_study(what) if isinstance(what.shaking, vi.Record) else {}
    )
    for option, value in (("--scale", scale), ("--peak", peak)):
        if value is not None and not records:
            raise InputError(
                f"{option}: {value!r}, but no record is given; use --amplitude to set the "
                "amplitude of a sine"
            )
    return scale_records(records, scale, peak) or None
