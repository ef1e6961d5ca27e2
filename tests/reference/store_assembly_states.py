"""Compute the motions that `assembly_states.py` holds, and write this file.

    python tests/reference/store_assembly_states.py          all of `assembly_cases`
    python tests/reference/store_assembly_states.py jankow   those whose name has this in it

A motion is stored if two runs of other orders and digits agree to 1e-27, and if each stop is
touched in the last quarter of it. It takes some minutes a case.
"""

from __future__ import annotations

import sys
from pathlib import Path

from mpmath import mp, mpf

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from reference.any_assembly import Motion, follow
from reference.assembly_cases import CASES, CYCLES, Case
from reference.assembly_states import STATES, Known

DIGITS = 25
LAST = 12
"""Events whose times are stored."""
MARKS = (1, CYCLES)


def difference(one: Motion, other: Motion) -> mpf:
    """The largest over all cycles, of displacements (m), and velocities over 2 pi / s."""
    n = len(one.peaks)
    return max(
        max(
            abs(a - b) / (1 if i < n else 2 * mp.pi)
            for i, (a, b) in enumerate(zip(*pair, strict=True))
        )
        for pair in zip(one.states, other.states, strict=True)
    )


def known(case: Case) -> Known:
    """A motion to 25 digits.

    Raises
    ------
    ValueError
        If it is not fit to be stored.
    """
    with mp.workdps(60):
        motion = follow(case.rig, CYCLES, case.start)
        other = follow(case.rig, CYCLES, case.start, order=36, digits=33, extremes=False)
        error = difference(motion, other)
        if error > mpf("1e-27"):
            raise ValueError(f"two runs differ by {mp.nstr(error, 3)} m")
        late = 0.75 * CYCLES * case.rig.harmonic.period
        for stop in case.rig.system.stops:
            if not any(one.stop == stop and one.time > late for one in motion.events):
                raise ValueError(f"the stop {stop} is not touched")
        print(f"  error {mp.nstr(error, 2)} m, {len(motion.events)} events", flush=True)

        def digits(x: mpf) -> str:
            return mp.nstr(x, DIGITS)

        return Known(
            tuple(tuple(map(digits, motion.states[n])) for n in MARKS),
            {name: digits(one) for name, one in motion.peaks.items()},
            {name: digits(one) for name, one in motion.forces.items()},
            len(motion.events),
            tuple((one.stop, one.kind, digits(one.time)) for one in motion.events[-LAST:]),
        )


def write(states: dict[str, Known]) -> None:
    """The file, in the order of its cases."""
    path = Path(__file__).with_name("assembly_states.py")
    head, _, _ = path.read_text().partition("STATES: ")
    lines = [f"{head}STATES: dict[str, Known] = {{"]
    for name in CASES:
        if name in states:
            one = states[name]
            lines += [f'    "{name}": Known(', "        ("]
            for state in one.states:
                lines += ["            (", *(f'                "{x}",' for x in state)]
                lines.append("            ),")
            lines.append("        ),")
            for extremes in (one.peaks, one.forces):
                lines.append("        {")
                lines += [f'            "{key}": "{x}",' for key, x in extremes.items()]
                lines.append("        },")
            lines += [f"        {one.events},", "        ("]
            lines += [f'            ("{a}", "{b}", "{x}"),' for a, b, x in one.last]
            lines += ["        ),", "    ),"]
    path.write_text("\n".join([*lines, "}", ""]))


def main(words: str) -> None:
    """Store the cases whose names have these words."""
    states = dict(STATES)
    for name, case in CASES.items():
        if words in name:
            print(name, flush=True)
            try:
                states[name] = known(case)
            except (ValueError, ArithmeticError) as error:
                print(f"  NOT STORED: {error}", flush=True)
                states.pop(name, None)
            write(states)


if __name__ == "__main__":
    main(" ".join(sys.argv[1:]))
