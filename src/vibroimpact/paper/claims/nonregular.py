"""Section 6: scenario S4, with non-regular motions near 1 Hz."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.paper.claim import Finding
from vibroimpact.paper.claims.left import AROUND, CODE, curves, found_features, places
from vibroimpact.paper.claims.reading import AbsentError, apart, at_most, claim, listed, turns
from vibroimpact.paper.study import PublishedStudy
from vibroimpact.response.resonance import UNSETTLED_APART
from vibroimpact.scenarios.resonance_curves import UNEVEN

_CURVES = {"eta_a": "acceleration_excursion", "eta_d": "displacement_excursion"}
_CONSTANT = 0.25
"""Largest range of an excursion that is called constant, divided by the height of the resonance."""


@claim(
    "s4-no-hysteresis-near-1-hz",
    "6, Fig. 15",
    "Around 1 Hz lies a further secondary resonance at which motions are not regular, and there "
    "forward and backward curves coincide.",
    "Frequencies from 0.9 to 1.4 Hz that do not settle; no hysteresis there; and the largest "
    "difference of the directions: below 10⁻⁶ where they settle, and below 10 % elsewhere.",
)
def no_hysteresis(study: PublishedStudy) -> Finding:
    """Allow a small difference: two windows of one non-periodic motion differ a little."""
    wild = [r for r in found_features(study).unsettled if AROUND[0] < r.low < AROUND[1]]
    data = curves(study).sel(frequency=slice(*AROUND))
    settled = (data["motion"] == "periodic").all("direction")
    differ = apart(data)
    quiet, loud = float(differ.where(settled).max()), float(differ.where(~settled).max())
    inside = [h for h in found_features(study).hysteresis if AROUND[0] < h.low < AROUND[1]]
    ranges = ", ".join(f"{r.direction} {r.low:g} to {r.high:g} Hz" for r in wild)
    return Finding(
        bool(wild) and not inside and quiet < 1e-6 and loud < UNSETTLED_APART,
        f"not settled: {ranges or 'nowhere'}; differences {at_most(quiet)} where settled, "
        f"{at_most(loud, '.1%')} elsewhere; {len(inside)} hystereses",
    )


@claim(
    "s4-plateau",
    "6, Fig. 15",
    "In the middle of the non-regular resonance near 1 Hz the excursions are more or less "
    "constant.",
    "Range of η_a and of η_d over the frequencies at which the forward sweep does not become "
    "periodic: at most a quarter of the resonance's height above the unstable antisymmetric "
    "motion.",
)
def plateau(study: PublishedStudy) -> Finding:
    """Compare with the height of this resonance, because next to the primary one all look flat."""
    places(study)
    data = curves(study)
    near = data.sel(direction="forward", frequency=slice(*AROUND))
    wild = near["motion"].values != "periodic"
    half = np.flatnonzero(wild)
    half = half[len(half) // 4 : len(half) - len(half) // 4]
    along = study.antisymmetric_branch(CODE, *AROUND)
    order = np.argsort(along["frequency"].values)
    shares, middle = [], []
    for curve, excursion in _CURVES.items():
        eta = near[curve].values
        below = along[excursion].values[order] / float(data[f"free_{excursion}"].max())
        base = np.interp(near["frequency"].values, along["frequency"].values[order], below)
        height = float((eta - base).max())
        shares.append(float(np.ptp(eta[wild])) / height)
        middle.append(float(np.ptp(eta[half])) / height)
    return Finding(
        max(shares) <= _CONSTANT,
        f"η_a {shares[0]:.0%}, η_d {shares[1]:.0%} of that height; over the middle half of these "
        f"frequencies {middle[0]:.0%} and {middle[1]:.0%}",
    )


@claim(
    "s4-pair",
    "6, Fig. 16",
    "In the middle of the non-regular resonance two motions coexist with the same excursion and "
    "opposite eccentricity.",
    "Excursion and eccentricity of the forward sweep's motion at f_II and of what its mirror image "
    "leads to: within 10 %, for neither repeats itself.",
)
def pair(study: PublishedStudy) -> Finding:
    """Compare a motion with the motion from its mirror image."""
    place = places(study)[1]
    one = study.motion(CODE, place, "forward")
    other = study.mirror_image(CODE, place, "forward")
    sizes = [1e3 * float(m["displacement_excursion"]) for m in (one, other)]
    offsets = [1e3 * float(m["eccentricity"]) for m in (one, other)]
    holds = (
        offsets[0] * offsets[1] < 0.0
        and abs(offsets[0]) > 1e3 * UNEVEN * sizes[0]
        and abs(sum(offsets)) <= UNSETTLED_APART * abs(offsets[0])
        and abs(sizes[0] - sizes[1]) <= UNSETTLED_APART * sizes[0]
    )
    return Finding(
        holds,
        f"{place:.2f} Hz: eccentricities {listed(offsets, '+.3f')} mm, excursions "
        f"{listed(sizes, '.2f')} mm",
    )


@claim(
    "s4-quasi-periodic",
    "6, Fig. 16",
    "The two mirrored motions of the non-regular resonance are quasi-periodic.",
    "The kind of the motion by the growth of disturbances: the largest Lyapunov exponent of a "
    "quasi-periodic motion is zero, that of a chaotic one positive.",
)
def quasi_periodic(study: PublishedStudy) -> Finding:
    """Use Lyapunov exponents: an area-contracting planar map has no attracting closed curve."""
    place = places(study)[1]
    motion = study.motion(CODE, place, "forward")
    kind = str(motion["motion"].item())
    largest, error = float(motion["exponents"][0]), float(motion["exponents_uncertainty"][0])
    return Finding(
        kind == "quasi-periodic",
        f"{kind} at {place:.2f} Hz: largest exponent {largest:+.3f} ± {error:.3f} 1/s",
    )


def _by_cycle(motion: xr.Dataset) -> dict[str, list[int]]:
    """Return the number of contacts that begin in each recorded forcing cycle, by side."""
    start, side = motion["contact_start"].values, motion["contact_side"].values
    time, cycle = motion["time"].values, motion["cycle"].values
    period = (time[-1] - time[0]) / (cycle[-1] - cycle[0])
    number = np.floor((start - time[0]) / period).astype(int)
    whole = round(float(cycle[-1] - cycle[0]))
    return {
        name: [int(((side == sign) & (number == k)).sum()) for k in range(whole)]
        for name, sign in (("right", 1), ("left", -1))
    }


@claim(
    "s4-changing-impacts",
    "6, Fig. 16",
    "In the non-regular resonance the number of impacts changes from cycle to cycle: the inner "
    "loop of each of the two mirrored motions crosses one bumper now and then, always the same "
    "one.",
    "Impacts in each cycle of the record at f_II: one per cycle on one side, a changing number on "
    "the other.",
)
def changing(study: PublishedStudy) -> Finding:
    """Count the impacts within the recorded window."""
    place = places(study)[1]
    counts = _by_cycle(study.motion(CODE, place, "forward"))
    steady = [name for name, found in counts.items() if set(found) == {1}]
    loose = [name for name, found in counts.items() if len(set(found)) > 1]
    told = ", ".join(f"{name} {min(c)} to {max(c)}" for name, c in counts.items())
    return Finding(len(steady) == len(loose) == 1, f"{told} a cycle at {place:.2f} Hz")


@claim(
    "s4-small-motion",
    "6, Fig. 16",
    "In the non-regular resonance there is, beside the two mirrored motions, a smaller periodic "
    "motion that is its own mirror image.",
    "The orbit of the antisymmetric branch at f_II: excursion, eccentricity and symmetry.",
)
def small(study: PublishedStudy) -> Finding:
    """Compute the orbit by Newton's method."""
    place = places(study)[1]
    one = study.antisymmetric_orbit(CODE, place, *AROUND)
    other = study.motion(CODE, place, "forward")
    sizes = [1e3 * float(m["displacement_excursion"]) for m in (one, other)]
    offset = 1e3 * float(one["eccentricity"])
    holds = bool(one["antisymmetric"]) and sizes[0] < sizes[1] and abs(offset) < UNEVEN * sizes[0]
    return Finding(
        holds,
        f"excursion {sizes[0]:.2f} mm against {sizes[1]:.2f} mm, eccentricity "
        f"{at_most(offset, unit=' mm')}",
    )


@claim(
    "s4-small-motion-reached",
    "6",
    "In the non-regular resonance, from suitable initial conditions, the mass settles on the "
    "smaller antisymmetric motion.",
    "Stability of the orbit: whatever starts beside an unstable one leaves it.",
)
def small_reached(study: PublishedStudy) -> Finding:
    """Use the Floquet multipliers of the orbit."""
    place = places(study)[1]
    found = study.antisymmetric_orbit(CODE, place, *AROUND)
    largest = float(np.hypot(found["multiplier_real"], found["multiplier_imag"]).max())
    return Finding(
        int(found["stable"]) == 1,
        f"largest multiplier {largest:.2f} at {place:.2f} Hz, so that a disturbance grows by that "
        "factor in every cycle",
    )


def _uneven(study: PublishedStudy) -> xr.Dataset:
    """Return the forward sweep around 1 Hz; `uneven` is true where it reaches one of a pair."""
    data = curves(study).sel(direction="forward", frequency=slice(*AROUND))
    uneven = np.abs(data["eccentricity"]) > UNEVEN * data["displacement_excursion"]
    return data.assign(uneven=uneven & (data["motion"] == "periodic"))


@claim(
    "s4-pair-settles",
    "6",
    "Above the range of constant excursion the two mirrored motions go on; they become periodic "
    "and lose their inner loops as the frequency rises.",
    "Frequencies above the range that does not settle at which the forward sweep settles on a "
    "motion with eccentricity: without a gap; and changes of the velocity's sign a cycle at the "
    "first and the last of them: more than 2, then 2.",
)
def pair_settles(study: PublishedStudy) -> Finding:
    """Check the frequencies up to the one where the symmetry is restored."""
    places(study)
    data = _uneven(study)
    f = data["frequency"].values
    last = float(f[data["motion"].values != "periodic"].max())
    pairs = f[data["uneven"].values & (f > last)]
    if len(pairs) < 2:
        raise AbsentError(f"no pair settles above {last:.2f} Hz")
    without_gap = float(pairs.max()) - last < 0.01 * len(pairs) + 0.005
    ends = [float(pairs.min()), float(pairs.max())]
    counts = [turns(study.motion(CODE, end, "forward", samples=1024)) for end in ends]
    return Finding(
        without_gap and counts[0] > 2.5 > counts[1],
        f"{ends[0]:.2f} to {ends[1]:.2f} Hz, behind {last:.2f} Hz; changes of sign "
        f"{counts[0]:.0f}, then {counts[1]:.0f}",
    )


@claim(
    "s4-one-motion-before-the-hysteresis",
    "6",
    "Between the non-regular resonance and the primary hysteresis there is again one periodic "
    "motion.",
    "Settled, of one forcing cycle, its own mirror image and the same in both directions, at all "
    "frequencies between the two.",
)
def one_motion(study: PublishedStudy) -> Finding:
    """Check both sweep directions."""
    places(study)
    right = [h for h in found_features(study).hysteresis if h.side == "right"]
    pairs = _uneven(study)
    f = pairs["frequency"].values
    not_one = f[pairs["uneven"].values | (pairs["motion"].values != "periodic")]
    if not right or not len(not_one):
        raise AbsentError("no non-regular resonance below a right hysteresis")
    low, high = float(not_one.max()) + 0.005, right[-1].low - 0.005
    data = curves(study).sel(frequency=slice(low, high))
    offset = float((np.abs(data["eccentricity"]) / data["displacement_excursion"]).max())
    holds = (
        bool((data["period"] == 1).all()) and offset < UNEVEN and float(apart(data).max()) < 1e-6
    )
    return Finding(
        holds,
        f"{float(data['frequency'][0]):.2f} to {float(data['frequency'][-1]):.2f} Hz: eccentricity "
        f"{at_most(offset)} of the excursion",
    )


CLAIMS = (
    no_hysteresis,
    plateau,
    pair,
    quasi_periodic,
    changing,
    small,
    small_reached,
    pair_settles,
    one_motion,
)
