"""Section 6: scenario S4, with non-regular motions near 1 Hz."""

from __future__ import annotations

import numpy as np
import xarray as xr

from paper.claim import Finding
from paper.claims.left import AROUND, CODE, curves, found_features, places
from paper.claims.reading import AbsentError, apart, at_most, claim, listed, turns
from paper.study import PublishedStudy
from vibroimpact.response.resonance import UNSETTLED_APART
from vibroimpact.scenarios.resonance_curves import UNEVEN

_CURVES = {"eta_a": "acceleration_excursion", "eta_d": "displacement_excursion"}
_CONSTANT = 0.25
"""Largest range of an excursion that is called constant, divided by the height of the resonance."""


@claim(
    "s4-no-hysteresis-near-1-hz",
    "6, Fig. 15",
    "Around 1 Hz, there is another secondary resonance, at which motions are non-regular. There, "
    "the forward and backward curves coincide.",
    "From 0.9 to 1.4 Hz, there must be frequencies without periodic motion, and no hysteresis. The "
    "largest relative difference of the directions must be below 10⁻⁶ where both are periodic, and "
    "below 10 % elsewhere.",
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
        f"no periodic motion: {ranges or 'at no frequency'}; differences {at_most(quiet)} where "
        f"periodic, {at_most(loud, '.1%')} elsewhere; {len(inside)} hystereses",
    )


@claim(
    "s4-plateau",
    "6, Fig. 15",
    "In the middle of the non-regular resonance near 1 Hz, the excursions are more or less "
    "constant.",
    "Over the frequencies at which the forward sweep does not become periodic, the range of η_a "
    "and of η_d must be at most a quarter of the height of this resonance. The height is measured "
    "from the unstable antisymmetric motion.",
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
        f"η_a {shares[0]:.0%}, η_d {shares[1]:.0%} of this height; over the middle half of these "
        f"frequencies {middle[0]:.0%} and {middle[1]:.0%}",
    )


@claim(
    "s4-pair",
    "6, Fig. 16",
    "In the middle of the non-regular resonance, two motions with the same excursion and opposite "
    "eccentricity coexist.",
    "Two motions are compared at f_II, the middle of the range without periodic motion: the "
    "motion of the forward sweep, and the motion that starts from its mirror image. Their "
    "excursions, and the amounts of their eccentricities, must agree within 10 %, because neither "
    "motion repeats itself.",
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
    "The two mirror-image motions of the non-regular resonance are quasi-periodic.",
    "The type of the motion is determined from the growth of disturbances. The largest Lyapunov "
    "exponent is zero for a quasi-periodic motion and positive for a chaotic motion.",
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
    start, stop = motion["contact_start"].values, motion["contact_stop"].values
    time, cycle = motion["time"].values, motion["cycle"].values
    period = (time[-1] - time[0]) / (cycle[-1] - cycle[0])
    number = np.floor((start - time[0]) / period).astype(int)
    whole = round(float(cycle[-1] - cycle[0]))
    return {
        name: [int(((stop == name) & (number == k)).sum()) for k in range(whole)]
        for name in motion["stop"].values.tolist()
    }


@claim(
    "s4-changing-impacts",
    "6, Fig. 16",
    "In the non-regular resonance, the number of impacts changes from cycle to cycle. The inner "
    "loop of each of the two mirror-image motions sometimes crosses one bumper, always the same "
    "one.",
    "In each recorded cycle at f_II of Fig. 15, there must be one impact on one side, and a "
    "changing number of impacts on the other side.",
)
def changing(study: PublishedStudy) -> Finding:
    """Count the impacts within the recorded window."""
    place = places(study)[1]
    counts = _by_cycle(study.motion(CODE, place, "forward"))
    steady = [name for name, numbers in counts.items() if set(numbers) == {1}]
    loose = [name for name, numbers in counts.items() if len(set(numbers)) > 1]
    listing = ", ".join(f"{name} {min(c)} to {max(c)}" for name, c in counts.items())
    return Finding(len(steady) == len(loose) == 1, f"{listing} per cycle at {place:.2f} Hz")


@claim(
    "s4-small-motion",
    "6, Fig. 16",
    "In the non-regular resonance, there is also a smaller periodic motion that is its own mirror "
    "image.",
    "The orbit on the branch of the antisymmetric motion at f_II of Fig. 15 must be its own "
    "mirror image. Its excursion must be smaller than that of the motion of the forward sweep.",
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
        f"excursion {sizes[0]:.2f} mm, compared with {sizes[1]:.2f} mm in the forward sweep; "
        f"eccentricity {at_most(offset, unit=' mm')}",
    )


@claim(
    "s4-small-motion-reached",
    "6",
    "In the non-regular resonance, the mass settles on the smaller antisymmetric motion if the "
    "initial conditions are suitable.",
    "The stability of the orbit. If the orbit is unstable, every motion that starts near it leaves "
    "it.",
)
def small_reached(study: PublishedStudy) -> Finding:
    """Use the Floquet multipliers of the orbit."""
    place = places(study)[1]
    orbit = study.antisymmetric_orbit(CODE, place, *AROUND)
    largest = float(np.hypot(orbit["multiplier_real"], orbit["multiplier_imag"]).max())
    return Finding(
        int(orbit["stable"]) == 1,
        f"largest Floquet multiplier {largest:.2f} at {place:.2f} Hz: a disturbance is multiplied "
        "by this factor in every cycle",
    )


def _uneven(study: PublishedStudy) -> xr.Dataset:
    """Return the forward sweep around 1 Hz; `uneven` is true where it reaches one of a pair."""
    data = curves(study).sel(direction="forward", frequency=slice(*AROUND))
    uneven = np.abs(data["eccentricity"]) > UNEVEN * data["displacement_excursion"]
    return data.assign(uneven=uneven & (data["motion"] == "periodic"))


@claim(
    "s4-pair-settles",
    "6",
    "Above the range of constant excursion, the two mirror-image motions continue. As the "
    "frequency rises, they become periodic and lose their inner loops.",
    "Above the range without periodic motion, the forward sweep must reach periodic motions with "
    "eccentricity at successive frequencies without a gap. The velocity must change its sign more "
    "than twice per cycle at the first of these frequencies, and twice at the last.",
)
def pair_settles(study: PublishedStudy) -> Finding:
    """Check the frequencies up to the one where the symmetry is restored."""
    places(study)
    data = _uneven(study)
    f = data["frequency"].values
    last = float(f[data["motion"].values != "periodic"].max())
    pairs = f[data["uneven"].values & (f > last)]
    if len(pairs) < 2:
        raise AbsentError(f"there is no periodic pair above {last:.2f} Hz")
    without_gap = float(pairs.max()) - last < 0.01 * len(pairs) + 0.005
    ends = [float(pairs.min()), float(pairs.max())]
    counts = [turns(study.motion(CODE, end, "forward", samples=1024)) for end in ends]
    return Finding(
        without_gap and counts[0] > 2.5 > counts[1],
        f"{ends[0]:.2f} to {ends[1]:.2f} Hz, above the range without periodic motion up to "
        f"{last:.2f} Hz; sign changes per cycle: {counts[0]:.0f}, then {counts[1]:.0f}",
    )


@claim(
    "s4-one-motion-before-the-hysteresis",
    "6",
    "Between the non-regular resonance and the primary hysteresis, there is again one periodic "
    "motion.",
    "At all frequencies between the two, both sweeps must reach the same motion. It must have a "
    "period of one forcing cycle and be its own mirror image.",
)
def one_motion(study: PublishedStudy) -> Finding:
    """Check both sweep directions."""
    places(study)
    right = [h for h in found_features(study).hysteresis if h.side == "right"]
    pairs = _uneven(study)
    f = pairs["frequency"].values
    not_one = f[pairs["uneven"].values | (pairs["motion"].values != "periodic")]
    if not right or not len(not_one):
        raise AbsentError("there is no non-regular resonance below a right hysteresis")
    low, high = float(not_one.max()) + 0.005, right[-1].low - 0.005
    data = curves(study).sel(frequency=slice(low, high))
    offset = float((np.abs(data["eccentricity"]) / data["displacement_excursion"]).max())
    holds = (
        bool((data["period"] == 1).all()) and offset < UNEVEN and float(apart(data).max()) < 1e-6
    )
    return Finding(
        holds,
        f"{float(data['frequency'][0]):.2f} to {float(data['frequency'][-1]):.2f} Hz: "
        f"eccentricity divided by excursion {at_most(offset)}",
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
