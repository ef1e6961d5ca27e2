"""Section 6: scenario S4, the motions that are not regular near 1 Hz."""

from __future__ import annotations

import numpy as np
import xarray as xr

from vibroimpact.paper.claim import Finding
from vibroimpact.paper.claims.left import AROUND, CODE, curves, found_features, places
from vibroimpact.paper.claims.reading import AbsentError, apart, claim, listed
from vibroimpact.paper.study import Study
from vibroimpact.response.resonance import UNSETTLED_APART
from vibroimpact.scenario.evidence import UNEVEN


@claim(
    "s4-no-hysteresis-near-1-hz",
    "6, Fig. 15",
    "Around 1 Hz lies a further secondary resonance at which motions are not regular, and there "
    "forward and backward curves coincide.",
    "Frequencies from 0.9 to 1.4 Hz that do not settle, the largest difference of the directions "
    "where they do, and hystereses there.",
)
def no_hysteresis(study: Study) -> Finding:
    """Where nothing settles, two windows of one motion differ a little."""
    wild = [r for r in found_features(study).unsettled if AROUND[0] < r.low < AROUND[1]]
    data = curves(study).sel(frequency=slice(*AROUND))
    settled = (data["motion"] == "periodic").all("direction")
    differ = apart(data)
    quiet, loud = float(differ.where(settled).max()), float(differ.where(~settled).max())
    inside = [h for h in found_features(study).hysteresis if AROUND[0] < h.low < AROUND[1]]
    ranges = ", ".join(f"{r.direction} {r.low:g} to {r.high:g} Hz" for r in wild)
    return Finding(
        bool(wild) and not inside,
        f"not settled: {ranges or 'nowhere'}; differences at most {quiet:.0e} where settled, "
        f"{loud:.1%} elsewhere; {len(inside)} hystereses",
    )


@claim(
    "s4-plateau",
    "6, Fig. 15",
    "In the middle of that resonance the excursions hardly change with the frequency.",
    "Range of η_a and of η_d over the frequencies that do not settle, over their mean: below 10 %.",
)
def plateau(study: Study) -> Finding:
    """Forward sweep."""
    places(study)
    data = curves(study).sel(direction="forward", frequency=slice(*AROUND))
    inside = data.where(data["motion"] != "periodic", drop=True)
    spread = [
        float((inside[c].max() - inside[c].min()) / inside[c].mean()) for c in ("eta_a", "eta_d")
    ]
    return Finding(max(spread) < 0.1, f"η_a {spread[0]:.1%}, η_d {spread[1]:.1%}")


@claim(
    "s4-pair",
    "6, Fig. 16",
    "There two motions coexist with the same excursion and opposite eccentricity.",
    "Excursion and eccentricity of the forward sweep's motion at f_II and of what its mirror image "
    "leads to: within 10 %, for neither repeats itself.",
)
def pair(study: Study) -> Finding:
    """A motion and its mirror image."""
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
    "The two motions of that pair are quasi-periodic.",
    "The kind of the motion by the growth of disturbances: the largest Lyapunov exponent of a "
    "quasi-periodic motion is zero, that of a chaotic one positive.",
)
def quasi_periodic(study: Study) -> Finding:
    """A planar map that contracts area has no attracting closed curve."""
    place = places(study)[1]
    motion = study.motion(CODE, place, "forward")
    kind = str(motion["motion"].item())
    largest, error = float(motion["exponents"][0]), float(motion["exponents_uncertainty"][0])
    return Finding(
        kind == "quasi-periodic",
        f"{kind} at {place:.2f} Hz: largest exponent {largest:+.3f} ± {error:.3f} 1/s",
    )


def _by_cycle(motion: xr.Dataset) -> dict[str, list[int]]:
    """Numbers of contacts that begin in each forcing cycle of the record, by side."""
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
    "The number of impacts changes from cycle to cycle: the inner loop of each motion of the pair "
    "crosses one bumper now and then, the same one always.",
    "Impacts in each cycle of the record at f_II: one a cycle on one side, a changing number on "
    "the other.",
)
def changing(study: Study) -> Finding:
    """By the record's window."""
    place = places(study)[1]
    counts = _by_cycle(study.motion(CODE, place, "forward"))
    steady = [name for name, found in counts.items() if set(found) == {1}]
    loose = [name for name, found in counts.items() if len(set(found)) > 1]
    told = ", ".join(f"{name} {min(c)} to {max(c)}" for name, c in counts.items())
    return Finding(len(steady) == len(loose) == 1, f"{told} a cycle at {place:.2f} Hz")


@claim(
    "s4-small-motion",
    "6, Fig. 16",
    "Beside the pair there is a smaller periodic motion that is its own mirror image.",
    "The orbit of the antisymmetric branch at f_II: excursion, eccentricity and symmetry.",
)
def small(study: Study) -> Finding:
    """By Newton's method."""
    place = places(study)[1]
    one = study.antisymmetric_orbit(CODE, place, *AROUND)
    other = study.motion(CODE, place, "forward")
    sizes = [1e3 * float(m["displacement_excursion"]) for m in (one, other)]
    offset = 1e3 * float(one["eccentricity"])
    holds = bool(one["antisymmetric"]) and sizes[0] < sizes[1] and abs(offset) < UNEVEN * sizes[0]
    return Finding(
        holds,
        f"excursion {sizes[0]:.2f} mm against {sizes[1]:.2f} mm, eccentricity {offset:.0e} mm",
    )


@claim(
    "s4-small-motion-reached",
    "6",
    "From suitable initial conditions that smaller motion is what the mass settles on.",
    "Stability of the orbit: whatever starts beside an unstable one leaves it.",
)
def small_reached(study: Study) -> Finding:
    """Its multipliers decide."""
    place = places(study)[1]
    found = study.antisymmetric_orbit(CODE, place, *AROUND)
    largest = float(np.hypot(found["multiplier_real"], found["multiplier_imag"]).max())
    return Finding(
        int(found["stable"]) == 1,
        f"largest multiplier {largest:.2f} at {place:.2f} Hz, so that a disturbance grows by that "
        "factor in every cycle",
    )


def _uneven(study: Study) -> xr.Dataset:
    """The forward sweep around 1 Hz, with `uneven` where it settles on one of a pair."""
    data = curves(study).sel(direction="forward", frequency=slice(*AROUND))
    uneven = np.abs(data["eccentricity"]) > UNEVEN * data["displacement_excursion"]
    return data.assign(uneven=uneven & (data["motion"] == "periodic"))


@claim(
    "s4-pair-settles",
    "6",
    "Behind the plateau a pair of mirrored motions goes on, which becomes periodic as the "
    "frequency rises.",
    "Frequencies above the range that does not settle at which the forward sweep settles on a "
    "motion with eccentricity.",
)
def pair_settles(study: Study) -> Finding:
    """Up to where the symmetry is restored."""
    places(study)
    data = _uneven(study)
    f = data["frequency"].values
    last = float(f[data["motion"].values != "periodic"].max())
    pairs = f[data["uneven"].values & (f > last)]
    holds = len(pairs) > 1 and float(pairs.max()) - last < 0.01 * len(pairs) + 0.005
    told = f"{pairs.min():.2f} to {pairs.max():.2f} Hz" if len(pairs) else "nowhere"
    return Finding(holds, f"{told}, behind {last:.2f} Hz")


@claim(
    "s4-one-motion-before-the-hysteresis",
    "6",
    "Between that resonance and the primary hysteresis there is again one periodic motion.",
    "Settled, of one forcing cycle, its own mirror image and the same in both directions, at all "
    "frequencies between the two.",
)
def one_motion(study: Study) -> Finding:
    """Both directions."""
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
        f"at most {offset:.0e} of the excursion",
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
