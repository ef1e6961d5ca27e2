"""The kind of a motion that did not settle, from the growth of its disturbances.

The logarithm L of the growth of a disturbance over N cycles distinguishes the kinds by how it goes
with N, not by its size alone: in proportion to N and upwards if the motion is chaotic, downwards
if it still approaches a periodic one; on a torus it stays bounded, or grows like log N where
neighbouring tori shear (no dissipation).
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

BLOCKS = 32
"""Blocks of cycles whose means show how sure an average is."""
_BRIDGE = math.sqrt(math.pi / 2.0)
"""Mean range of a Brownian bridge: of the sum of independent numbers about its line, over √N σ."""
SIGNIFICANT = 5.0
"""Standard uncertainties by which an exponent must differ from zero."""
CLEAR = 20.0
"""Logarithm of a growth that no bounded wandering explains: 1e-16 has become 1e-7."""
CONSISTENT = 2.0
"""Standard uncertainties by which a mean growth may be larger than its estimate."""
WEAK = 0.0012
"""Mean growth per cycle below which chaos is not told from a torus: over 20,000 cycles, a torus
explains a logarithm of 24.8."""
BOUNDED = 5.0
"""A logarithm below this and 2 log N is as on a torus."""
ENOUGH = 1000
"""Cycles below which a bounded growth says nothing: a chaotic one may not have shown yet."""
FORGOTTEN = 1e-2
"""Share of the damping by which the sum of the exponents may differ from it over many cycles, where
bumpers forget; with bumpers that remember it differs by a good part."""
LONGEST = 64
"""Period of the longest orbit that is sought where a motion settles slowly."""
GROWING = 0.02
"""Share of the size by which each quarter of a motion that still grows is larger than the last."""
FALLING = 0.9
"""Share to which the distance from an orbit falls, quarter by quarter, while it is approached."""
SAME = 1e-8
"""Share of the motion's size within which two points of the section are one."""


class Judgement(NamedTuple):
    """The kind of a motion, and why."""

    motion: str
    """"periodic", "quasi-periodic", "chaotic" or "undecided"."""
    period: int
    """In forcing cycles; 0 unless periodic."""
    exponents: _Array
    """Both Lyapunov exponents, per cycle."""
    uncertainty: _Array
    """Their standard uncertainties, per cycle."""
    evidence: str
    returns: int = 0
    """Cycles after which a motion that still settles, slowly, all but returns; 0 for any other."""
    bounded: bool = False
    """Whether it is undecided for its uncertainty alone: more cycles tell a torus from chaos."""


# A wall that is grazed stretches disturbances without bound.
@np.errstate(invalid="ignore")
def averages(
    logarithms: _Array, group: int = 1, cycles: int | None = None
) -> tuple[_Array, _Array]:
    """Mean growth per cycle and its standard uncertainty.

    The quadratic mean of two estimates: from the means of blocks of cycles, and from how far the
    sum goes from a straight line. Blocks see too little of a rotation (a complex pair of
    multipliers) that comes again in each of them.

    Parameters
    ----------
    logarithms : ndarray, shape (group, exponent)
        Of each cycle, or their sums over groups of cycles that follow each other.
    group
        Cycles of a group.
    cycles
        In all, where the last group is not complete.

    Returns
    -------
    mean, uncertainty : ndarray, shape (exponent,)
        The uncertainty is infinite with fewer groups than `BLOCKS`.
    """
    count = len(logarithms)
    cycles = count * group if cycles is None else cycles
    mean = logarithms.sum(axis=0) / cycles if count else np.full(logarithms.shape[1], np.nan)
    size = count // BLOCKS
    if not size:
        return mean, np.full(len(mean), np.inf)
    lengths = np.full((count, 1), float(group))
    lengths[-1] -= count * group - cycles
    sums, long = (
        values[count - size * BLOCKS :].reshape(BLOCKS, size, -1).sum(axis=1)
        for values in (logarithms, lengths)
    )
    blocks = sums / long
    away = np.cumsum(logarithms - mean * lengths, axis=0)
    ends = (away.max(axis=0) - away.min(axis=0)) / (_BRIDGE * cycles)
    spread = blocks.std(axis=0, ddof=1) / math.sqrt(BLOCKS)
    # Of what is forgotten in each cycle nothing is left to be uncertain of.
    return mean, np.where(np.isneginf(mean), 0.0, np.sqrt(0.5 * (spread**2 + ends**2)))


@np.errstate(invalid="ignore")
def judge(logarithms: _Array, section: _Array, damping: _Array | None = None) -> Judgement:
    """Decide the kind of a motion.

    Where bumpers forget there is no quasi-periodic one (docs/theory.md, 6.5): then the exponents
    add up to minus the damping.

    Parameters
    ----------
    logarithms : ndarray, shape (cycles, 2)
        Growth of two orthogonal disturbances in each cycle.
    section : ndarray, shape (cycles, component)
        Points of the stroboscopic section, in comparable units.
    damping : ndarray, shape (cycles,), optional
        The damping per unit mass, integrated over each cycle.
    """
    cycles = len(logarithms)
    mean, uncertainty = averages(logarithms)
    if cycles < BLOCKS:
        return Judgement(
            "undecided", 0, mean, uncertainty, f"only {cycles} cycles could be followed"
        )
    total = np.cumsum(logarithms[:, 0])
    whole, half = float(total[-1]), float(total[cycles // 2 - 1])
    margin = BOUNDED + 2.0 * math.log(cycles)
    # An average of pure rounding differs from zero by nothing.
    apart = abs(mean[0]) > max(SIGNIFICANT * uncertainty[0], 1e-6 / cycles)
    grown = (
        f"the logarithm of a disturbance changes by {whole:+.4g} over {cycles} cycles, "
        f"{mean[0]:+.3g} ± {uncertainty[0]:.1g} per cycle"
    )
    if n := recurrence(section):
        return Judgement("periodic", n, mean, uncertainty, repeats(n))
    quarters = np.diff(np.concatenate([[0.0], total[np.arange(1, 5) * cycles // 4 - 1]]))
    if whole > CLEAR + margin and whole - half > CLEAR and quarters.min() > 0.0 and apart:
        return Judgement("chaotic", 0, mean, uncertainty, grown)
    if rise := growing(section):
        return Judgement("undecided", 0, mean, uncertainty, f"{grown}: the motion grows, {rise}")
    bounded = max(abs(whole), abs(half)) <= margin
    if bounded and apart and whole < 0.0:
        evidence = f"{grown}: disturbances still decay slowly"
        return Judgement("undecided", 0, mean, uncertainty, evidence, returns(section))
    if bounded and damping is not None and shrinks_as_damped(logarithms, damping):
        evidence = (
            f"{grown}: as in a quasi-periodic motion, but no quasi-periodic motion exists if the "
            "bumpers have no memory of the previous cycle; the motion settles slowly"
        )
        return Judgement("undecided", 0, mean, uncertainty, evidence, returns(section))
    if bounded and not abs(mean[0]) + CONSISTENT * uncertainty[0] <= WEAK:
        evidence = (
            f"{grown}: a quasi-periodic or a weakly chaotic motion, which more cycles tell apart"
        )
        return Judgement("undecided", 0, mean, uncertainty, evidence, bounded=True)
    if bounded and cycles >= ENOUGH:
        return Judgement(
            "quasi-periodic",
            0,
            mean,
            uncertainty,
            f"{grown}: no more than in a quasi-periodic motion",
        )
    return Judgement("undecided", 0, mean, uncertainty, f"{grown}: no clear trend")


def repeats(period: int) -> str:
    """The evidence for a periodic motion, in words."""
    return f"the section repeats after {period} cycle{'' if period == 1 else 's'}"


def shrinks_as_damped(logarithms: _Array, damping: _Array) -> bool:
    """Whether areas shrink as the damping says, and not otherwise: by the sum of the exponents."""
    lost = float(damping.mean())
    return lost > 0.0 and abs(float(logarithms.sum(axis=1).mean()) + lost) <= FORGOTTEN * lost


def growing(section: _Array) -> str:
    """By how much a motion grows from quarter to quarter, in words; nothing if it does not."""
    sizes = [math.sqrt(float((part[:, :2] ** 2).mean())) for part in np.array_split(section, 4)]
    if not min(np.diff(sizes)) > GROWING * sizes[-1]:
        return ""
    return f"to {sizes[-1] / sizes[0]:.3g} times its size from the first to the last quarter"


def settling(*stretches: _Array) -> bool:
    """Whether a motion still comes closer to a periodic one at the end of what was followed.

    Its distance from where it was a period ago then falls from quarter to quarter.

    Parameters
    ----------
    *stretches : ndarray, shape (cycles, component)
        Points of the section: all, or stretches that lie evenly over the cycles, and the end.
    """
    if sum(map(len, stretches)) < 2 * LONGEST:
        return False
    period = returns(stretches[-1])
    away = np.concatenate(
        [np.abs(one[period:] - one[:-period]).max(axis=1) for one in stretches if len(one) > period]
    )
    medians = [float(np.median(part)) for part in np.array_split(away, 4)]
    falls = all(after <= FALLING * before for before, after in pairwise(medians))
    return falls and medians[-1] > SAME * max(float(np.abs(one).max()) for one in stretches)


def returns(section: _Array) -> int:
    """After how many cycles, of at most `LONGEST`, a section comes closest to its end."""
    before = section[-LONGEST - 1 : -1]
    return len(before) - int(np.abs(before - section[-1]).max(axis=1).argmin())


def recurrence(section: _Array) -> int:
    """Period after which the last points of a section repeat, or 0.

    A period counts where the points of at least two of them agree.
    """
    cycles = len(section)
    scale = np.abs(section).max() or 1.0
    last = section[-1]
    near = np.abs(section[:-1] - last).max(axis=1) <= SAME * scale
    for i in np.flatnonzero(near)[::-1]:
        n = cycles - 1 - int(i)
        if 2 * n > cycles:
            return 0
        if np.abs(section[-n:] - section[-2 * n : -n]).max() <= SAME * scale:
            return n
    return 0
