"""Coexisting steady motions at one frequency, which are reached from several initial states."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import NamedTuple, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import STARTS, check_mapping
from vibroimpact.datasets.description import describe
from vibroimpact.engine.status import Status
from vibroimpact.model import AssemblyState, Repeated, State
from vibroimpact.model.argument_types import (
    MaxEvents,
    NonNegativeInt,
    PositiveInt,
    RandomStarts,
    check_samples,
)
from vibroimpact.model.public import public
from vibroimpact.model.read_rig import AnyRig, as_rig_of_any_masses
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.sweep_starts import arrivals
from vibroimpact.stability.equivalence import image_of, mirrors, same
from vibroimpact.stability.nearest_state import nearest_state, random_state
from vibroimpact.stability.settled_motion import (
    Settled,
    approach,
    reach,
    reach_at_rest,
)
from vibroimpact.stability.steady import ExponentCycles, describe_motion, steady
from vibroimpact.tasks.threads import Progress, counted

_Start: TypeAlias = State | AssemblyState | NDArray[np.float64]


class _Kept(NamedTuple):
    """A motion, and the initial states that led to it or to its mirror image."""

    settled_motion: Settled
    motion: xr.Dataset
    starts: list[str]
    mirrored_starts: list[str]


@public
def coexisting_motions(
    rig: AnyRig,
    *,
    frequency: float | str | None = None,
    frequencies: Iterable[float | str] | None = None,
    starts: Mapping[str, State | xr.DataArray | xr.Dataset] | None = None,
    random: RandomStarts = 12,
    seed: NonNegativeInt = 0,
    window: PositiveInt = 200,
    max_cycles: PositiveInt = 2000,
    exponent_cycles: ExponentCycles = 20_000,
    max_events: MaxEvents = 10_000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Find the coexisting steady motions at one frequency from several initial states.

    The initial states are rest, the final state of a forward sweep from below, the final state of a
    backward sweep from above, the states in ``starts``, and random states. If the rig is symmetric,
    the mirror images of the motions are initial states as well. Motions that differ only by a shift
    of whole forcing cycles count as one motion. A motion and its mirror image also count as one.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    frequency
        Forcing frequency (Hz). Default: the frequency of the rig.
    frequencies
        Rising frequencies of the sweeps, in Hz. Frequencies below the forcing frequency are swept
        upwards, and frequencies above it are swept downwards. Default: from 0.3 to 6 times the
        natural frequency, in steps of a hundredth of it. If the isolator has no stiffness, the
        forcing frequency replaces the natural frequency.
    starts
        Further initial states, by name.
    random
        Number of random initial states. Their displacements and velocities are at most 1.5 times
        the largest values in the motions from all other initial states.
    seed
        Seed of the random initial states. The same seed gives the same initial states.
    window, max_cycles, exponent_cycles, max_events
        As in `steady`.
    progress
        A `progress_bar`, or a function that is called after each initial state, with the number of
        completed initial states and the number of all initial states. The latter is None as long as
        mirror images may be added.

    Returns
    -------
    xarray.Dataset
        The dim ``attractor`` counts the motions from the largest to the smallest excursion. The
        variables are the single numbers of `steady` (``motion``, ``period``, extremes, impacts,
        exponents, energies, …) and ``evidence``. ``starts`` names the initial states that led to a
        motion. ``mirrored_starts`` names the initial states that led to its mirror image.
        ``mirror_pair`` states whether the mirror image is a different motion. Motions whose
        computation was given up come last; ``status`` gives the reason.

        ``final_state`` is a state from which the motion can be continued. To compute the time
        history of the first motion in a result ``found``, call
        ``steady(rig, start=found.isel(attractor=0))``.

        Of an assembly, sizes have the dims ``mass`` and ``stop``. The order is that of the largest
        excursion of all masses.

    Raises
    ------
    InputError
        If a value is invalid.
    """
    rig = as_rig_of_any_masses(rig, frequency=frequency)
    engine_system(rig.system).check_size()
    motions = find_motions(
        rig,
        frequencies=frequencies,
        starts=starts,
        random=random,
        seed=seed,
        samples=1,
        window=window,
        max_cycles=max_cycles,
        exponent_cycles=exponent_cycles,
        max_events=max_events,
        progress=progress,
    )
    bare = [_without_history(one) for one in motions]
    most = max(one.sizes["exponent"] for one in bare)
    # Of an assembly, more exponents are known of a periodic motion.
    bare = [one.pad(exponent=(0, most - one.sizes["exponent"])) for one in bare]
    data = xr.concat(bare, "attractor", combine_attrs="drop_conflicts")
    data = data.assign_coords(attractor=np.arange(len(motions)))
    return describe(data, "vibroimpact.coexisting_motions")


def _without_history(motion: xr.Dataset) -> xr.Dataset:
    """Return the variables that are one number, word or state of a motion."""
    kept = [
        name
        for name, one in motion.items()
        if set(one.dims) <= {"component", "exponent", "mass", "stop"} and name != "initial_state"
    ]
    words = {name: motion.attrs[name] for name in ("evidence", "starts", "mirrored_starts")}
    bare = motion[kept].assign(words)
    bare.attrs = {name: value for name, value in motion.attrs.items() if name not in words}
    return bare


@public
def find_motions(
    rig: Rig,
    *,
    frequencies: Iterable[float | str] | None = None,
    starts: Mapping[str, State | xr.DataArray | xr.Dataset] | None = None,
    random: RandomStarts = 12,
    seed: NonNegativeInt = 0,
    samples: PositiveInt = 256,
    window: PositiveInt = 200,
    max_cycles: PositiveInt = 2000,
    exponent_cycles: ExponentCycles = 20_000,
    max_events: MaxEvents = 10_000,
    progress: Progress | None = None,
) -> list[xr.Dataset]:
    """Find the coexisting motions as datasets of `steady`, with their histories.

    The attributes ``starts`` and ``mirrored_starts`` of each name the initial states that led to it
    and to its mirror image. Parameters and errors are those of `coexisting_motions`.
    """
    system, excitation = rig.system, rig.harmonic
    states = engine_system(system)
    check_samples(window, samples, "window")
    named = check_mapping({} if starts is None else starts, "starts", STARTS)
    kept: list[_Kept] = []
    given_up: dict[Status, tuple[_Start, list[str]]] = {}
    options = (samples, window, exponent_cycles, max_events)
    followed = counted(progress) or (lambda _: None)

    def follow_start(name: str, start: _Start) -> None:
        steady_motion = approach(rig, start, max_cycles=max_cycles, max_events=max_events)
        if steady_motion.status in (Status.DONE, Status.NOT_SETTLED):
            steady_motion = _at_phase(steady_motion, excitation, max_events)
        if steady_motion.status in (Status.DONE, Status.NOT_SETTLED):
            _add_motion(kept, steady_motion, name, options)
        else:
            given_up.setdefault(steady_motion.status, (start, []))[1].append(name)
        followed(name)

    follow_start("rest", states.read(None).replace(phase=excitation.phase))
    for name, start in arrivals(rig, frequencies, max_cycles, max_events).items():
        follow_start(name, start)
    for name, state in named.items():
        follow_start(name, states.read(state))
    size = max((reach(one.settled_motion, one.settled_motion.state) for one in kept), default=0.0)
    size = size or reach_at_rest(rig)
    generator = np.random.default_rng(seed)
    for number in range(random):
        drawn = random_state(rig, generator, size, excitation.angular_frequency)
        follow_start(f"random {number + 1}", nearest_state(rig, drawn))
    if kept and kept[0].settled_motion.symmetric:
        for one in tuple(kept):  # `follow_start` may add to them
            if not bool(one.motion["antisymmetric"]):
                image = image_of(one.settled_motion, max_events)
                if image is not None:
                    follow_start("mirror image", image.state)
    kept.sort(key=lambda one: -float(one.motion["displacement_excursion"].max()))
    motions = [_labelled(one, max_events) for one in kept]
    for first_start, names in given_up.values():
        # Told with a warning, and once.
        motion = steady(
            Rig(system, excitation),
            states.state(first_start, excitation.phase)
            if isinstance(first_start, np.ndarray)
            else first_start,
            samples,
            window=window,
            max_cycles=max_cycles,
            max_events=max_events,
        ).assign(mirror_pair=False)
        motion.attrs |= {"starts": ", ".join(names), "mirrored_starts": ""}
        motions.append(describe(motion, "vibroimpact.coexisting_motions"))
    return motions


def _labelled(one: _Kept, max_events: int) -> xr.Dataset:
    pair = (
        one.settled_motion.symmetric
        and not bool(one.motion["antisymmetric"])
        and not mirrors(one.settled_motion, one.settled_motion, max_events)
    )
    data = one.motion.assign(mirror_pair=pair)
    data.attrs["starts"] = ", ".join(one.starts)
    data.attrs["mirrored_starts"] = ", ".join(one.mirrored_starts)
    data.attrs["created_by"] = "vibroimpact.coexisting_motions"
    return describe(data, "vibroimpact.coexisting_motions")


def _at_phase(motion: Settled, excitation: Repeated, max_events: int) -> Settled:
    """Return the motion at the section of the excitation, for any phase of its initial state."""
    ahead = ((excitation.phase - motion.excitation.phase) / (2.0 * math.pi)) % 1.0
    there = motion.engine.at_phase(excitation.phase)
    if ahead == 0.0:
        return motion._replace(engine=there)
    status, state = motion.engine.propagate(motion.state, ahead, max_events)
    if status is not Status.DONE:
        return motion._replace(status=status)
    return motion._replace(state=state, engine=there)


def _add_motion(
    kept: list[_Kept], motion: Settled, name: str, options: tuple[int, int, int, int]
) -> None:
    """Add a new motion, or add its initial state to a known motion."""
    for one in kept:
        if (
            one.settled_motion.period != motion.period
            or one.settled_motion.status is not motion.status
        ):
            continue
        if same(one.settled_motion, motion, options[3]):
            one.starts.append(name)
            return
        if motion.symmetric and mirrors(one.settled_motion, motion, options[3]):
            one.mirrored_starts.append(name)
            return
    kept.append(_Kept(motion, describe_motion(motion, *options), [name], []))
