"""``vibroimpact motion``: the steady motions of a rig at one or several frequencies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import named_state, rig_at
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import AssemblyState

MOST_COLUMNS = 6
"""Largest number of columns that fit on a page."""


@calls("coexisting_motions", "Motion")
def motion(
    rig: opt.RigName,
    /,
    *,
    frequency: opt.Text = None,
    branch: Literal["forward", "backward", "all"] = "all",
    random: opt.Whole,
    window: opt.Whole,
    samples: opt.Whole = 256,
    start: opt.Paths = (),
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Find the steady motions at a frequency, classify them, and draw them on one page.

    For each motion, the command prints its type (periodic, quasi-periodic, chaotic or undecided)
    and the evidence for the type. It also prints the extremes and the contacts. It writes these
    files (--name sets NAME):

    - NAME-FREQUENCY-motion.nc: the samples, contacts, spectrum and Poincaré section of each motion,
      with one NetCDF group per motion
    - NAME-FREQUENCY-motion.png: phase portraits, spectra and time histories

    For a rig of several masses (table [assembly] of a study file), the command finds the steady
    motion that is reached from the equilibrium, or from --start, at one frequency. It draws
    histories, contact forces, the largest values over the order of the masses, and the spectra of
    their accelerations.

    For example:

        vibroimpact motion B2-G1-A3 --frequency 2.6Hz
        vibroimpact motion B3-10mm-A3 --frequency 1.06Hz --branch forward
        vibroimpact motion B2-G1-A3 --frequency 0.58Hz,0.8Hz,2.6Hz --output figure8

    Parameters
    ----------
    frequency
        Forcing frequency, such as 0.58Hz, or several frequencies, such as 0.58Hz,0.8Hz,2.6Hz.
        Default: the frequency in the study file (table [simulate]). If there is none, the option is
        required.
    branch
        Motions that are found. forward: the motion that a rising frequency sweep reaches. backward:
        the motion that a falling frequency sweep reaches. all: all motions that are reached from
        sweeps, from rest and from random initial states. Default: all.
    random
        Number of random initial states, which are used with --branch all. Their displacements and
        velocities are at most 1.5 times the largest values in the motions from all other initial
        states.
    samples
        Number of samples per forcing cycle. It affects only the time history in the files.
    start
        Of several masses, an initial value, COORDINATE=VALUE, such as velocity.ball=0.1m/s. The
        option may be repeated. Default: the static equilibrium.
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import motions as facts
    from vibroimpact.model.frequency_text import forcing, forcing_slug
    from vibroimpact.stability.named_motions import named_motions

    what = subject(rig, changes, output.name, masses=True)
    shaken = _rigs(what, frequency)
    if what.system.by_mass:
        return _of_masses(what, shaken, samples, named_state("--start", start), output)
    if start:
        raise InputError(
            f"--start: {start[0]!r}, but {what.name!r} has one mass, whose motions are found from "
            "several initial states; remove --start"
        )
    options = {"random": random, "window": window, "samples": samples}
    with results(what, output) as written:
        by_frequency = {}
        for hertz, one in shaken.items():
            with written.progress("finding motions") as progress:
                by_frequency[hertz] = named_motions(one, branch, **options, progress=progress)
        drawn = {
            hertz: {name: data for name, data in motions.items() if data.sizes["time"]}
            for hertz, motions in by_frequency.items()
        }
        for hertz, motions in drawn.items():
            if not motions:
                raise InputError(
                    f"--frequency: no steady motion was found at {forcing(hertz, 10)}; change the "
                    "frequency or the rig"
                )
        groups = {
            f"{forcing_slug(hertz)} {name}" if len(by_frequency) > 1 else name: data
            for hertz, motions in drawn.items()
            for name, data in motions.items()
        }
        ending = f"{'-'.join(map(forcing_slug, by_frequency))}-motion"
        columns = facts.columns(drawn, MOST_COLUMNS)
        written.write(groups, ending, figures.motion_page, drawn=columns)
    return written.tell({"motions": facts.facts(by_frequency)}, facts.text(by_frequency))


def _of_masses(
    what: Subject,
    shaken: dict[float, vi.Rig],
    samples: int,
    start: AssemblyState | None,
    output: opt.OutputOptions,
) -> int:
    """Find, draw and print the steady motion of several masses that is reached from a state."""
    from vibroimpact.cli.assembly import write_motion
    from vibroimpact.cli.results import results
    from vibroimpact.facts import assembly as facts
    from vibroimpact.model.frequency_text import forcing, forcing_slug
    from vibroimpact.stability.named_motions import with_spectrum

    if len(shaken) > 1:
        raise InputError(
            f"--frequency: {len(shaken)} frequencies, but {what.name!r} has several masses, whose "
            "motion is drawn at one frequency; pass one"
        )
    ((hertz, one),) = shaken.items()
    with results(what, output) as written:
        with written.progress("finding motions") as progress:
            data = with_spectrum(vi.steady(one, start, samples, progress=progress))
        title, ending = f"{what.title}, {forcing(hertz, 10)}", f"{forcing_slug(hertz)}-motion"
        write_motion(written, data, ending, title, None)
        lines = figures.mass_spectra(data, title=title)
        written.draw("spectrum", f"{ending}-spectrum", lines)
        summary = facts.steady_facts(data)
    return written.tell(summary, facts.steady_text(summary))


def _rigs(what: Subject, frequency: str | None) -> dict[float, vi.Rig]:
    """Return the rig at each frequency of the option, or at the frequency in the study."""
    texts = [None] if frequency is None else [part.strip() for part in frequency.split(",")]
    rigs = {one.periodic.frequency: one for one in (rig_at(what, text) for text in texts)}
    if len({f"{hertz:.6g}" for hertz in rigs}) < len(texts):
        raise InputError(
            f"--frequency: two frequencies in {frequency!r} have the same first six digits; remove "
            "one of the two"
        )
    if len(rigs) > MOST_COLUMNS:
        raise InputError(f"--frequency: {len(rigs)} frequencies; pass at most {MOST_COLUMNS}")
    return rigs
