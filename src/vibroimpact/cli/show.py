"""``vibroimpact show``: the rig, its natural frequencies and modes, and a drawing."""

from __future__ import annotations

from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls


@calls(None, "System")
def show(
    rig: opt.RigName,
    /,
    *,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Print the rig, its natural frequencies, modes, equilibrium and parameters, and draw it.

    It lists the paths of the parameters with their values. Nothing is simulated. The drawing shows
    the masses, the links, and the stops with their gaps to scale. Modes are those without stops;
    curved links have their initial stiffness. The command writes this file (--name sets NAME):

    - NAME-system.png: the drawing

    For example:

        vibroimpact show B2-G1-A3
        vibroimpact show neighbours.toml --set gap=1cm
        vibroimpact show frame.toml --figure pdf --figure-width 180mm
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import parameter_values
    from vibroimpact.facts import system as facts
    from vibroimpact.figures.assembly import oscillator_drawing

    what = subject(rig, changes, output.name, unshaken=True, masses=True)
    summary = facts.facts(what.system)
    values = parameter_values.facts(what.rig)
    with results(what, output) as written:
        if what.system.by_mass:
            drawn = figures.assembly_drawing(what.assembly, title=what.title)
        else:
            drawn = oscillator_drawing(what.oscillator, title=what.title)
        written.draw("drawing", "system", drawn)
    summary_text = facts.text(summary), parameter_values.text(what.rig)
    return written.tell({**summary, "parameters": values}, *summary_text)
