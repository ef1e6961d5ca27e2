"""``vibroimpact sweep``: resonance curves of a rig."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls


@calls("sweep", "Frequencies", direction="directions", compute="outputs")
def sweep(
    rig: opt.RigName,
    /,
    *,
    start: Annotated[opt.Text, Parameter(name="--from")] = None,
    stop: Annotated[opt.Text, Parameter(name="--to")] = None,
    step: opt.Text = None,
    frequencies: opt.Text = None,
    direction: Literal["forward", "backward", "both"] | None = None,
    physical: opt.Physical = None,
    compute: opt.Compute = (),
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    tolerance: Annotated[float | None, Parameter(group=opt.COMPUTATION)] = None,
    max_cycles: Annotated[opt.Whole | None, Parameter(group=opt.COMPUTATION)] = None,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Sweep the forcing frequency up and down, and draw the resonance curves.

    At each frequency, the motion is simulated until it is steady. The motion at the next frequency
    starts from the final state and phase of this motion, as in a stepped-sine test. The command
    prints resonances, jumps and hysteresis. It writes these files (--name sets NAME):

    - NAME-sweep.nc: all data
    - NAME-sweep.png: the resonance curves
    - NAME-sweep.txt: the summary

    For a rig of several masses (table [assembly] of a study file), the figure shows the largest
    displacement of each mass, and further figures show accelerations and contact forces.

    For example:

        vibroimpact sweep B2-G1-A3 --parameters identified
        vibroimpact sweep B3-10mm-A3 --from 0.3Hz --to 4Hz --step 0.01Hz
        vibroimpact sweep B2-G1-A3 --set left.gap=9mm --set right=none --output one-sided
        vibroimpact sweep building.toml --normalised --direction forward --json
        vibroimpact sweep B2-G1-A3 --compute 'power [W] = mean(isolator.damping*velocity**2)'

    Parameters
    ----------
    start
        Lowest frequency, such as 0.3Hz. Default: the value in the study file (table [sweep]). If
        the file states none, the default is 0.45 × the natural frequency. For laboratory cases it
        is 0.5 Hz.
    stop
        Highest frequency, such as 4Hz. Default: the value in the study file (table [sweep]). If the
        file states none, the default is 4.5 × the natural frequency. For laboratory cases it is
        5 Hz.
    step
        Step between frequencies, such as 0.01Hz. Default: the value in the study file (table
        [sweep]). If the file states none, the default is about a hundredth of the natural
        frequency. For laboratory cases it is 0.01 Hz, a tenth of the step in the published tests.
    frequencies
        List of frequencies, such as 0.5Hz,0.7Hz,1.1Hz. Replaces --from, --to and --step. Default:
        the list in the study file (table [sweep]), if it has one.
    direction
        Order of the frequencies: forward (rising), backward (falling) or both. Default: the order
        in the study file (table [sweep]), or both.
    tolerance
        Relative tolerance of a steady motion. A motion counts as steady when its state, recorded
        once per forcing cycle, is within this tolerance of a periodic orbit whose period is at most
        16 forcing cycles. Default: the value in the study file (table [sweep]), or 1e-12.
    max_cycles
        Largest number of forcing cycles to wait for a steady motion. If a motion is still
        approaching a periodic orbit by then, for example with light damping, the limit is increased
        up to 50-fold. Default: the number in the study file (table [sweep]), or 2000.
    physical
        Draw accelerations (g), displacements (mm) and contact forces instead of the normalised
        excursions η_a and η_d. Default: --normalised for a laboratory case.
    """
    from rich.console import Group

    from vibroimpact.cli.assembly import draw_sweep
    from vibroimpact.cli.frequency_grid import default_range, list_frequencies
    from vibroimpact.cli.results import draws_physical, results
    from vibroimpact.cli.rig import subject
    from vibroimpact.datasets.files import write_whole
    from vibroimpact.engine.status import MORE_CYCLES
    from vibroimpact.facts import assembly_sweep as masses
    from vibroimpact.facts import rig as rig_facts
    from vibroimpact.facts import sweeps
    from vibroimpact.facts.tables import as_text
    from vibroimpact.response import resonance
    from vibroimpact.response.confirmed_jumps import confirm_jumps, confirmed_mass_jumps
    from vibroimpact.response.sweep import advice

    what = subject(rig, changes, output.name, masses=True)
    what.refuse_of_masses(normalised=physical is False)
    table = what.sweep_table
    grid = list_frequencies(start, stop, step, frequencies, table, default_range(what))
    outputs = opt.own_outputs(compute)
    way = direction or table.direction or "both"
    with results(what, output) as written:
        with written.progress("sweeping") as progress:
            data = vi.sweep(
                what.rig,
                grid,
                **opt.stated(
                    directions=None if way == "both" else (way,),
                    phase=what.phase,
                    tolerance=table.tolerance if tolerance is None else tolerance,
                    max_cycles=table.max_cycles if max_cycles is None else max_cycles,
                    threads=threads,
                    outputs=outputs,
                ),
                progress=progress,
            )
        hints = [line.replace(MORE_CYCLES, "--max-cycles") for line in advice(data)]
        summary: dict[str, Any]
        if what.system.by_mass:
            written.write(data, "sweep", figures.mass_resonance)
            draw_sweep(written, data)
            mass_jumps = confirmed_mass_jumps(what.rig, data)
            summary = masses.facts(data, mass_jumps, hints)
            text = masses.text(data, mass_jumps, hints)
        else:
            features = confirm_jumps(what.rig, data, resonance.features(data))
            units = draws_physical(data, physical)
            curves = figures.resonance_curves
            written.write(data, "sweep", curves, curve_features=features, physical=units)
            summary = sweeps.facts(data, features, hints)
            text = sweeps.text(data, features, hints)
        whole = as_text(Group(rig_facts.text(what.rig), text))
        written.files["summary"] = write_whole(written.path("sweep", "txt"), whole)
    return written.tell(summary, text)
