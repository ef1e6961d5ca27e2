"""Study files: a rig and what is to be done with it, in TOML.

A file names a case of the laboratory or describes an oscillator; the rest is optional::

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

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, Self

from pydantic import Field, create_model, model_validator

from vibroimpact.errors import InputError
from vibroimpact.model import Model, Oscillator, Periodic, Record, Repeated, validate
from vibroimpact.model.laboratory import Parameters
from vibroimpact.model.quantities import ANGLE, DIMENSIONLESS, FREQUENCY, LENGTH, TIME, VELOCITY
from vibroimpact.model.rigs import as_shaking
from vibroimpact.model.validation import Accepts

_Frequency = Annotated[float | None, Accepts(FREQUENCY, above=0.0, optional=True)]


class ExcitationTable(Model):
    """``[excitation]``: what shakes the mass, at whatever frequency; or a record in a file.

    An amplitude is one of acceleration, displacement or force, by its unit. A record stands beside
    the study file; its `component` where the file has several, its `step` (s) and its `unit` where
    the file does not say them; a unit may be one of length.
    """

    amplitude: float | str | None = None
    amplitudes: list[float | str] | None = None
    phases: list[Annotated[float, Accepts(ANGLE)]] | None = None
    phase: Annotated[float, Accepts(ANGLE)] = 0.0
    record: str | None = None
    component: str | None = None
    step: Annotated[float | None, Accepts(TIME, above=0.0, optional=True)] = None
    unit: str | None = None

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        ways = {name: getattr(self, name) for name in ("amplitude", "amplitudes", "record")}
        given = [name for name, value in ways.items() if value is not None]
        if len(given) > 1:
            raise InputError(f"{' and '.join(given)} are given; one of them is accepted")
        beside = dict.fromkeys(("component", "step", "unit"), "record")
        for name, needs in (("phases", "amplitudes"), *beside.items()):
            if getattr(self, name) is not None and ways[needs] is None:
                raise InputError(f"{name} is given without {needs}; it is accepted beside it")
        return self

    def shaking(self, folder: Path) -> Repeated | Record | None:
        """What it describes; paths are relative to the folder.

        Raises
        ------
        InputError
            If the record cannot be read, or a value cannot be used.
        """
        if self.record is not None:
            return Record.read(folder / self.record, self.component, unit=self.unit, step=self.step)
        if self.amplitudes is not None:
            return Periodic(1.0, self.amplitudes, self.phases, self.phase)
        if self.amplitude is None:
            return None
        shaken, _ = as_shaking(self.amplitude, "amplitude")
        return shaken.replace(phase=self.phase)


class _SweepTable(Model):
    """``[sweep]``: which frequencies are held, and for how long."""

    to: _Frequency = None
    step: _Frequency = None
    frequencies: list[Annotated[float, Accepts(FREQUENCY, above=0.0)]] | None = None
    direction: Literal["forward", "backward", "both"] | None = None
    tolerance: Annotated[
        float | None, Accepts(DIMENSIONLESS, above=0.0, maximum=1.0, optional=True)
    ] = None
    max_cycles: Annotated[int | None, Field(ge=1)] = None

    @property
    def start(self) -> float | None:
        """The first frequency, ``from`` in the file, in Hz."""
        value: float | None = getattr(self, "from")
        return value

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.frequencies is not None and not (self.start is self.to is self.step is None):
            raise InputError(
                "frequencies are listed and given by from, to or step as well; "
                "one of the two is accepted"
            )
        return self


if TYPE_CHECKING:
    SweepTable = _SweepTable
else:
    # A class statement cannot name a field by a keyword of Python, but the file should say
    # what the command line says.
    SweepTable = create_model("SweepTable", __base__=_SweepTable, **{"from": (_Frequency, None)})


class SimulateTable(Model):
    """``[simulate]``: one motion."""

    frequency: _Frequency = None
    cycles: Annotated[float | None, Accepts(DIMENSIONLESS, above=0.0, optional=True)] = None
    samples: Annotated[int | None, Field(ge=1)] = None
    tail: Annotated[float | None, Accepts(TIME, minimum=0.0, optional=True)] = None
    displacement: Annotated[float | None, Accepts(LENGTH, optional=True)] = None
    velocity: Annotated[float, Accepts(VELOCITY)] = 0.0


class DesignTable(Model):
    """``[design]``: for what a rig is sized, and what may be chosen.

    Records stand beside the study file; without them the excitation counts. A range is a text
    LOW:HIGH[:log][:VALUES].
    """

    records: list[str] | None = None
    vary: dict[str, str] | None = None
    limits: dict[str, float | str] | None = None
    fractile: Annotated[
        float | None, Accepts(DIMENSIONLESS, minimum=0.0, maximum=1.0, optional=True)
    ] = None


class EnsembleTable(Model):
    """``[ensemble]``: what of the rig is uncertain, and how many rigs are drawn.

    A distribution is a text such as ``"normal:5%"`` or ``"uniform:5 mm:8 mm"``.
    """

    uncertain: dict[str, str] | None = None
    samples: Annotated[int | None, Field(ge=1)] = None
    method: Literal["sobol", "latin", "random"] | None = None
    seed: Annotated[int | None, Field(ge=0)] = None


class Study(Model):
    """A study file: ``case`` or ``[oscillator]``, and tables for the commands."""

    name: str | None = None
    case: str | None = None
    parameters: Parameters | None = None
    oscillator: Oscillator | None = None
    excitation: ExcitationTable = ExcitationTable()
    sweep: SweepTable = SweepTable()
    simulate: SimulateTable = SimulateTable()
    design: DesignTable = DesignTable()
    ensemble: EnsembleTable = EnsembleTable()

    @model_validator(mode="after")
    def _one_rig(self) -> Self:
        if (self.case is None) == (self.oscillator is None):
            given = "neither" if self.case is None else "both"
            raise InputError(
                f"{given} of case and oscillator given; one of them is accepted, "
                'such as case = "B2-G1-A3"'
            )
        if self.parameters is not None and self.case is None:
            raise InputError("parameters are given without a case; they are accepted beside one")
        return self


def read_study(path: Path) -> Study:
    """Read a study file.

    Raises
    ------
    InputError
        If it cannot be read, is not TOML, has an unknown key or a value that cannot be used;
        the line names the file and the path of the key in it.
    """
    try:
        # Some editors put a mark before the text, which "-sig" leaves out.
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(
            f"study: {str(path)!r} cannot be read ({error.strerror or error}); "
            "a study file or a case code is accepted"
        ) from None
    except UnicodeDecodeError:
        raise InputError(f"study: {str(path)!r} is not UTF-8 text; TOML is accepted") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"study: {str(path)!r} is not TOML ({error}); TOML is accepted") from None
    try:
        return validate(Study, data)
    except InputError as error:
        raise InputError(f"study {str(path)!r}: {error}") from None
