"""Compute the states that `law_states.py` and `shaken_states.py` hold, and write these files.

    python tests/reference/store_law_states.py            all rigs of `law_cases`, `shaken_cases`
    python tests/reference/store_law_states.py drag 0.5   those whose name has these words in it

A rig is stored if two runs of other orders and digits agree to 1e-27, if it touches both stops
late in the motion, and if a disturbance of 1e-12 grows by less than 1e2. It takes some 10 s a rig.

Each state is added to its file as soon as it is known, so that several runs can store different
rigs. States of rigs that exist no more are removed.
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Any, NamedTuple

from mpmath import mp, mpf

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import vibroimpact as vi
from reference import law_cases, shaken_cases
from reference.any_law import Motion, follow
from reference.law_cases import Case

DIGITS = 25
SMALL = mpf("1e-12")

States = tuple[tuple[str, str], ...]


class Store(NamedTuple):
    """A file of states and the cases that it knows."""

    name: str
    about: str
    cases: dict[str, Case]


STORES = (
    Store(
        "law_states.py",
        "the rigs of `law_cases` after 1, 5 and 20 cycles from rest",
        law_cases.CASES,
    ),
    Store(
        "shaken_states.py",
        "the rigs of `shaken_cases` at their `marks`, from rest",
        shaken_cases.CASES,
    ),
)


def marks(one: Case) -> tuple[int, ...]:
    """Cycles, or lines of a record, behind which the state of a case is stored; its length last."""
    if one in law_cases.CASES.values():
        return (1, 5, law_cases.CYCLES)
    return shaken_cases.marks(one)


def span(shaken: vi.Harmonic | vi.Periodic | vi.Record) -> float:
    """How long a cycle or line lasts, s."""
    return shaken.step if isinstance(shaken, vi.Record) else shaken.period


def difference(one: Motion, other: Motion, speed: Any) -> mpf:
    """The largest over all cycles, m; velocities count over `speed`, 1/s."""
    pairs = zip(one.states, other.states, strict=True)
    return max(max(abs(a[0] - b[0]), abs(a[1] - b[1]) / speed) for a, b in pairs)


def states(one: Case) -> States:
    """u and v of a rig to 25 digits.

    Raises
    ------
    ValueError
        If it is not fit to be stored.
    """
    at, last = marks(one), marks(one)[-1]
    with mp.workdps(60):
        speed = 2 * mp.pi
        motion = follow(one.rig, one.shaken, last)
        other = follow(one.rig, one.shaken, last, order=36, digits=33)
        error = difference(motion, other, speed)
        if error > mpf("1e-29"):
            raise ValueError(f"two runs differ by {mp.nstr(error, 3)} m")
        disturbed = follow(one.rig, one.shaken, last, (SMALL, 0), order=36, digits=33)
        growth = difference(motion, disturbed, speed) / SMALL
        if growth > 100:
            raise ValueError(f"a disturbance grows by {mp.nstr(growth, 3)}")
        late = {event.kind for event in motion.events if event.time > at[1] * span(one.shaken)}
        for side in ("right", "left"):
            if not any(kind.endswith(side) for kind in late):
                raise ValueError(f"the {side} stop is not touched")
        kinds = [event.kind for event in motion.events]
        counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))
        print(f"  error {mp.nstr(error, 2)} m, growth {mp.nstr(growth, 3)}; {counts}", flush=True)
        stored = [motion.states[n] for n in at]
        return tuple((mp.nstr(u, DIGITS), mp.nstr(v, DIGITS)) for u, v in stored)


def put(store: Store, name: str, state: States | None) -> None:
    """Change one state in the file, where another run may have changed others; None removes it."""
    path = Path(__file__).with_name(store.name)
    known: dict[str, States] = runpy.run_path(str(path))["STATES"]
    kept = {one: states for one, states in known.items() if one != name}
    path.write_text(written(store, kept if state is None else {**kept, name: state}))


def written(store: Store, known: dict[str, States]) -> str:
    """The text of the file, in the order of its cases."""
    lines = [
        f'"""u (m) and v (m/s) of {store.about}.',
        "",
        "Written by `store_law_states.py`, from a run to forty digits; all digits are right.",
        '"""',
        "",
        "STATES: dict[str, tuple[tuple[str, str], ...]] = {",
    ]
    for name in store.cases:
        if name in known:
            lines.append(f'    "{name}": (')
            lines += [f'        ("{u}", "{v}"),' for u, v in known[name]]
            lines.append("    ),")
    return "\n".join([*lines, "}", ""])


def main(words: str) -> None:
    """Store the rigs whose names have these words."""
    for store in STORES:
        for name, one in store.cases.items():
            if words in name:
                print(name, flush=True)
                try:
                    put(store, name, states(one))
                except (ValueError, ArithmeticError) as error:
                    print(f"  NOT STORED: {error}", flush=True)
                    put(store, name, None)


if __name__ == "__main__":
    main(" ".join(sys.argv[1:]))
