"""``vibroimpact simulate``: the time history of one motion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, NamedTuple

from cyclopts import Group, Parameter

from vibroimpact.cli.options import OutputOptions, RigName, RigOptions, Whole
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Record, Repeated, State

_MOTION = Group("Motion", sort_key=1)
_WITH_UNITS = Parameter(group=_MOTION, allow_leading_hyphen=True)


def simulate(
    rig: RigName,
    /,
    *,
    frequency: Annotated[
        str | None, _WITH_UNITS, Parameter(help="Excitation frequency, such as 2.5Hz.")
    ] = None,
    cycles: Annotated[
        float | None, Parameter(group=_MOTION, help="How many forcing cycles; 100.")
    ] = None,
    samples: Annotated[
        Whole | None,
        Parameter(
            group=_MOTION,
            help="Samples per cycle, 256; or per step of a record, 1. No value depends on it.",
        ),
    ] = None,
    displacement: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Displacement at the start, such as 5mm; the equilibrium."),
    ] = None,
    velocity: Annotated[
        str | None, _WITH_UNITS, Parameter(help="Velocity at the start, such as 100mm/s; 0.")
    ] = None,
    tail: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="How long the motion is followed behind a record, such as 10s; 0."),
    ] = None,
    shown: Annotated[
        float, Parameter(group=_MOTION, help="How many cycles, the last ones, are drawn.")
    ] = 3.0,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Follow one motion at a fixed frequency, or through a record, and draw its time history.

    Prints the state at the end and the contacts per cycle; writes NAME-FREQUENCY-history.nc
    (all samples, and every contact and detachment at its exact time) and
    NAME-FREQUENCY-history.png.

    For example:

        vibroimpact simulate B2-G1-A3 --frequency 2.5Hz
        vibroimpact simulate B3-10mm-A3 --frequency 1.06Hz --cycles 1000 --shown 10
        vibroimpact simulate B2-G1-A3 --frequency 2.5Hz --displacement 12mm
        vibroimpact simulate quake.toml --tail 10s
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell, warn
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    given = _given(what, frequency, cycles, samples, tail, displacement, velocity)
    if not shown > 0.0:
        raise InputError(f"--shown: {shown:g}; a number of cycles greater than 0 is accepted")

    with output_folder(out.output) as folder:
        import warnings

        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.figures import record_history, save_figure, time_history
        from vibroimpact.model import Record
        from vibroimpact.response.simulate import simulate as run

        with warnings.catch_warnings(record=True) as caught, progress_bar("following") as progress:
            warnings.simplefilter("always", RuntimeWarning)
            data = run(
                Rig(what.oscillator, given.excitation),
                given.cycles,
                given.start,
                given.samples,
                tail=given.tail,
                progress=progress,
            )
        data.attrs["title"] = what.name
        for warning in caught:
            warn(str(warning.message))
        if not data.sizes["time"]:
            raise InputError(f"no motion was found ({data.attrs['message']})")
        if isinstance(given.excitation, Record):
            axes = record_history(data, title=what.title)
            stem = folder / f"{what.slug}-history"
        else:
            hertz = f"{given.excitation.frequency:.10g}Hz"
            axes = time_history(data, cycles=shown, title=f"{what.title}, {hertz[:-2]} Hz")
            stem = folder / f"{what.slug}-{hertz}-history"
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(axes[0], f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), **summary.motion_facts(data)}
    text = Together(summary.rig_text(what), summary.motion_text(facts))
    tell(text, facts, folder, files, out.json)
    return 0


class _Given(NamedTuple):
    """What is to be simulated."""

    excitation: Repeated | Record
    cycles: float | None
    samples: int | None
    tail: float | str | None
    start: State


def _given(
    what: Subject,
    frequency: str | None,
    cycles: float | None,
    samples: int | None,
    tail: str | None,
    displacement: str | None,
    velocity: str | None,
) -> _Given:
    """Take each value from its option, else from the study, else by default.

    Raises
    ------
    InputError
        If there is no frequency, or a value cannot be used.
    """
    from vibroimpact.cli.study import SimulateTable
    from vibroimpact.model import Record, State, equilibrium, to_si
    from vibroimpact.model.count_checks import check_samples
    from vibroimpact.model.quantities import FREQUENCY, LENGTH, TIME, VELOCITY

    table = what.study.simulate if what.study else SimulateTable()
    u, v = table.displacement, table.velocity
    if displacement is not None:
        u = to_si(displacement, LENGTH, "--displacement")
    elif u is None:
        u = equilibrium(what.oscillator).displacement
    if velocity is not None:
        v = to_si(velocity, VELOCITY, "--velocity")
    start = State(u, v)
    if samples is not None and samples < 1:
        raise InputError(f"--samples: {samples}; a whole number of at least 1 is accepted")
    if isinstance(what.shaking, Record):
        for option, value in (("--frequency", frequency), ("--cycles", cycles)):
            if value is not None:
                raise InputError(
                    f"{option}: {value}, but a record shakes this rig, which has none; --tail is "
                    "accepted beside it"
                )
        behind = table.tail if tail is None else to_si(tail, TIME, "--tail", minimum=0.0)
        return _Given(what.shaking, None, samples or table.samples, behind, start)
    if tail is not None or table.tail is not None:
        raise InputError("--tail: given, but no record shakes this rig; --cycles is accepted")
    if frequency is not None:
        hertz = to_si(frequency, FREQUENCY, "--frequency", above=0.0)
    elif table.frequency is not None:
        hertz = table.frequency
    else:
        raise InputError("--frequency: missing; a frequency greater than 0 is accepted, as 2.5Hz")
    if cycles is None:
        cycles = table.cycles or 100.0
    if not 0.0 < cycles < math.inf:
        raise InputError(f"--cycles: {cycles:g}; a number greater than 0 is accepted, such as 100")
    if samples is None:
        samples = table.samples if table.samples is not None else 256
    check_samples(cycles, samples, "--cycles")
    return _Given(what.at(hertz), cycles, samples, None, start)
