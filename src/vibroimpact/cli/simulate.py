"""``vibroimpact simulate``: the time history of one motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import AssemblyState


_CYCLES = 100.0
"""Number of forcing cycles if neither an option nor the study states it."""


@calls("simulate", "Motion")
def simulate(
    rig: opt.RigName,
    /,
    *,
    frequency: opt.Frequency = None,
    cycles: float | None = None,
    samples: opt.Whole | None = None,
    displacement: opt.Text = None,
    velocity: opt.Text = None,
    start: opt.Paths = (),
    tail: opt.Text = None,
    shown: float = 3.0,
    animation: Annotated[Literal["gif", "html"] | None, Parameter(group=opt.OUTPUT)] = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Simulate one motion, at one frequency or under an earthquake record, and draw its history.

    If a record in the study file shakes the rig, the motion lasts as long as the record. The
    command prints the final state and the number of contacts per forcing cycle. It writes these
    files (--name sets NAME):

    - NAME-FREQUENCY-history.nc: all samples, and each contact and detachment at its exact time
    - NAME-FREQUENCY-history.png: the time history

    If a record shakes the rig, the file names do not contain FREQUENCY.

    For a rig of several masses (table [assembly] of a study file), the command prints the largest
    displacement and acceleration of each mass, the largest deformation of each link, and the
    largest force or impulse and the number of contacts of each stop. Further figures show
    accelerations, contact forces, and the largest values over the order of the masses.

    For example:

        vibroimpact simulate B2-G1-A3 --frequency 2.5Hz
        vibroimpact simulate B3-10mm-A3 --frequency 1.06Hz --cycles 1000 --shown 10
        vibroimpact simulate B2-G1-A3 --frequency 2.5Hz --displacement 12mm
        vibroimpact simulate quake.toml --tail 10s
        vibroimpact simulate neighbours.toml --frequency 1.9Hz --animation html

    Parameters
    ----------
    cycles
        Number of forcing cycles that are simulated. Default: the number in the study file (table
        [simulate]), or 100.
    samples
        Number of samples per forcing cycle, or per time step of a record. It does not affect the
        computed motion. Default: the number in the study file (table [simulate]). If the file
        states none, the default is 256 per forcing cycle, or 1 per time step of a record.
    displacement
        Initial displacement, such as 5mm. Default: the value in the study file (table [simulate]),
        or the static equilibrium.
    velocity
        Initial velocity, such as 100mm/s. Default: the value in the study file (table [simulate]),
        or 0.
    start
        Of several masses, an initial value, COORDINATE=VALUE, such as velocity.ball=0.1m/s or
        displacement.base=1cm. The option may be repeated. Default: the static equilibrium.
    tail
        Duration of free vibration after a record, such as 10s. Default: the duration in the study
        file (table [simulate]), or 0.
    shown
        Number of forcing cycles in the figure, counted back from the end of the motion.
    animation
        Write an animation of several masses, too: gif for slides, or html for a page with a slider.
        Default: no animation.
    """
    from vibroimpact.cli.assembly import write_motion
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.cli.states import rig_at
    from vibroimpact.facts import assembly as masses
    from vibroimpact.facts import trajectory as facts
    from vibroimpact.model.argument_types import whole
    from vibroimpact.model.frequency_text import forcing, forcing_slug
    from vibroimpact.model.quantities import DIMENSIONLESS
    from vibroimpact.model.units import to_si

    what = subject(rig, changes, output.name, unshaken=True, masses=True)
    table = what.simulate_table
    begin = _start(what, displacement, velocity, start)
    if animation is not None and not what.system.by_mass:
        raise InputError(
            f"--animation: {animation!r}, but {what.name!r} has one mass; animations are made of "
            "assemblies of several masses; remove --animation"
        )
    samples = table.samples if samples is None else whole(samples, "samples")
    last = to_si(shown, DIMENSIONLESS, "--shown", above=0.0)
    of_record = isinstance(what.shaking, vi.Record)
    if of_record and frequency is not None:
        raise InputError(
            f"--frequency: {frequency}, but this rig is shaken by a record, which has no forcing "
            "frequency; remove --frequency"
        )
    shaken = what.rig if of_record else rig_at(what, frequency)
    if cycles is None and not of_record:
        cycles = table.cycles or _CYCLES
    with results(what, output) as written:
        with written.progress("simulating") as progress:
            data = vi.simulate(
                shaken,
                cycles,
                begin,
                samples,
                tail=table.tail if tail is None else tail,
                progress=progress,
            )
        if not data.sizes["time"]:
            raise InputError(f"the motion could not be simulated: {data.attrs['message']}")
        title, ending, cycled = what.title, "history", None
        if not of_record:
            hertz, cycled = shaken.periodic.frequency, last
            title += f", {forcing(hertz, 10) if shaken.is_shaken else 'free vibration'}"
            ending = f"{forcing_slug(hertz)}-history"
        if what.system.by_mass:
            write_motion(written, data, ending, title, cycled, animation)
        elif of_record:
            written.write(data, ending, figures.record_history, title)
        else:
            written.write(data, ending, figures.time_history, title, cycles=cycled)
    if what.system.by_mass:
        summary = masses.motion_facts(data)
        return written.tell(summary, masses.motion_text(summary))
    return written.tell(facts.facts(data), facts.text(data))


def _start(
    what: Subject, displacement: str | None, velocity: str | None, start: tuple[str, ...]
) -> vi.State | AssemblyState | None:
    """Return the initial state of the options, of the study, or at rest at the equilibrium.

    Several masses start at the equilibrium, which is the default of the library function.
    """
    from vibroimpact.cli.states import named_state
    from vibroimpact.model import equilibrium, to_si
    from vibroimpact.model.quantities import LENGTH, VELOCITY

    u, v = what.simulate_table.displacement, what.simulate_table.velocity
    if what.system.by_mass:
        what.refuse_of_masses(displacement=displacement, velocity=velocity)
        if u is not None or v:
            raise InputError(
                "simulate.displacement, simulate.velocity: the rig has several masses; remove "
                "them, and pass --start, such as --start velocity.NAME=0.1m/s"
            )
        return named_state("--start", start)
    if start:
        raise InputError(
            f"--start: {start[0]!r}, but {what.name!r} has one mass; use --displacement and "
            "--velocity"
        )
    if displacement is not None:
        u = to_si(displacement, LENGTH, "--displacement")
    elif u is None:
        u = equilibrium(what.oscillator).displacement
    return vi.State(u, v if velocity is None else to_si(velocity, VELOCITY, "--velocity"))
