"""Study files in TOML, which describe a rig and have tables for the commands.

A study file names a laboratory case or describes an oscillator. All other tables are optional::

    name = "moat-wall"

    [oscillator]
    mass = "550 kg"
    isolator = { stiffness = "26.8 kN/m", damping = "1.1 kN s/m" }
    right = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "7.5 mm" }
    left = { stiffness = "510 kN/m", damping = "0.9 kN s/m", gap = "9 mm" }

    [excitation]
    amplitude = "0.05 g"

    [sweep]
    from = "0.3 Hz"
    to = "4 Hz"
    step = "0.01 Hz"
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import (
    BeforeValidator,
    Field,
    ModelWrapValidatorHandler,
    create_model,
    model_validator,
)

from vibroimpact.errors import InputError
from vibroimpact.model import Model, study
from vibroimpact.model.quantities import DIMENSIONLESS, FREQUENCY, LENGTH, TIME, VELOCITY
from vibroimpact.model.quantity_lists import check_stated_units
from vibroimpact.model.validation import Accepts
from vibroimpact.model.wrong_kinds import NumberOrText, WholeNumber

_MOST = 2**63 - 1
"""Largest accepted whole number: the engine counts with 64 bits."""

_Frequency = Annotated[float | None, Accepts(FREQUENCY, above=0.0, optional=True)]


class _SweepTable(Model):
    """Table ``[sweep]``: the frequencies of a sweep, and the criterion of a steady motion."""

    to: _Frequency = None
    step: _Frequency = None
    frequencies: list[Annotated[float, Accepts(FREQUENCY, above=0.0)]] | None = Field(
        None, examples=['frequencies = ["1 Hz", "1.2 Hz"]']
    )
    direction: Literal["forward", "backward", "both"] | None = None
    tolerance: Annotated[
        float | None, Accepts(DIMENSIONLESS, above=0.0, maximum=1.0, optional=True)
    ] = None
    max_cycles: Annotated[WholeNumber | None, Field(ge=1, le=_MOST)] = None

    @property
    def start(self) -> float | None:
        """The lowest frequency in Hz. Its key in the file is ``from``."""
        value: float | None = getattr(self, "from")
        return value

    @model_validator(mode="wrap")
    @classmethod
    def _with_both_units(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        table = handler(data)
        if isinstance(data, Mapping):
            ends = [data[key] for key in ("from", "to") if data.get(key) is not None]
            check_stated_units(ends, FREQUENCY, "from, to")
        return table

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.frequencies is not None and not (self.start is self.to is self.step is None):
            raise InputError(
                "the list 'frequencies' is given together with 'from', 'to' or 'step'; remove "
                "either the list or the range"
            )
        return self


if TYPE_CHECKING:
    SweepTable = _SweepTable
else:
    # A class statement cannot name a field by a keyword of Python. The file should have the same
    # names as the command line.
    SweepTable = create_model("SweepTable", __base__=_SweepTable, **{"from": (_Frequency, None)})


class SimulateTable(Model):
    """Table ``[simulate]``: one motion."""

    frequency: _Frequency = None
    cycles: Annotated[float | None, Accepts(DIMENSIONLESS, above=0.0, optional=True)] = None
    samples: Annotated[WholeNumber | None, Field(ge=1, le=_MOST)] = None
    tail: Annotated[float | None, Accepts(TIME, minimum=0.0, optional=True)] = None
    displacement: Annotated[float | None, Accepts(LENGTH, optional=True)] = None
    velocity: Annotated[float, Accepts(VELOCITY)] = 0.0


def _flat(table: Any) -> Any:
    """Join the keys of nested tables: in TOML, ``right.gap = "5 mm:9 mm"`` makes two tables."""
    if not isinstance(table, Mapping):
        return table
    entries: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, Mapping):
            entries |= {f"{key}.{rest}": text for rest, text in _flat(value).items()}
        else:
            entries[key] = value
    return entries


class DesignTable(Model):
    """Table ``[design]``: the records, the parameters that are varied, and the limits.

    Paths of records are relative to the study file. Without records, the excitation of the study is
    used. A range is a text LOW:HIGH[:log][:VALUES].
    """

    records: list[str] | None = Field(None, examples=['records = ["first.csv", "second.csv"]'])
    vary: Annotated[dict[str, str] | None, BeforeValidator(_flat)] = Field(
        None, examples=['vary = { gap = "5 mm:9 mm:5" }']
    )
    limits: dict[str, NumberOrText] | None = Field(
        None, examples=['limits = { peak_force = "5 MN" }']
    )
    fractile: Annotated[
        float | None, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0, optional=True)
    ] = None


class EnsembleTable(Model):
    """Table ``[ensemble]``: the uncertain parameters, and the number of random rigs.

    A distribution is a string such as ``"normal:5%"`` or ``"uniform:5 mm:8 mm"``.
    """

    uncertain: Annotated[dict[str, str] | None, BeforeValidator(_flat)] = Field(
        None, examples=['uncertain = { gap = "7 mm:8 mm" }']
    )
    draws: Annotated[WholeNumber | None, Field(ge=1, le=_MOST)] = None
    method: Literal["sobol", "latin", "random"] | None = None
    seed: Annotated[WholeNumber | None, Field(ge=0, le=_MOST)] = None


class Study(study.RigStudy):
    """A study file: the key ``case`` or the table ``[oscillator]``, and tables for the commands."""

    sweep: SweepTable = SweepTable()
    simulate: SimulateTable = SimulateTable()
    design: DesignTable = DesignTable()
    ensemble: EnsembleTable = EnsembleTable()


def read_study(path: Path) -> Study:
    """Read a study file, with the tables of the commands.

    Raises
    ------
    InputError
        As in `vibroimpact.model.study.read_study`.
    """
    return study.read_study(path, Study)
