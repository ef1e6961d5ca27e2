"""Random rigs of all laws: no hang, no NaN, and nothing passive creates energy.

`python tests/properties/test_fuzz_laws.py 20000 1` looks at as many, from a seed; with the word
`shakings` behind it, under several harmonics, forces, displacements and records.
"""

from __future__ import annotations

import faulthandler
import sys
import warnings
from collections import Counter

import numpy as np
import pytest

import vibroimpact as vi
from properties.random_laws import any_shaking, random_rig
from reference.stored_energy import stored
from samples import sample

CYCLES = 8
LONGEST = 400.0
"""s; a rig takes milliseconds. One that hangs ends the process, with its place."""
EXACT = 1e-9
"""Of the energy that goes through a rig; what is left of it in the balance."""
ROUNDING = 1e-13
"""Of the largest kinetic energy: the rounding of a balance in which hardly any energy is left."""
NOTHING = 1e-30
"""J; the rounding of positions of a mass that does not move, as friction holds it."""


def survey(count: int, seed: int, shakings: bool = False) -> tuple[Counter[str], list[str]]:
    """Outcomes and faults."""
    rng = np.random.default_rng(seed)
    outcomes: Counter[str] = Counter()
    wrong = []
    for i in range(count):
        rig, shaken = random_rig(rng)
        if shakings:
            shaken = any_shaking(rng, shaken)
        faulthandler.dump_traceback_later(LONGEST, exit=True)
        status, problems = looked_at(rig, shaken)
        faulthandler.cancel_dump_traceback_later()
        outcomes[status] += 1
        wrong += [f"rig {i} of seed {seed}: {one}; {rig!r}, {shaken!r}" for one in problems]
    return outcomes, wrong


def looked_at(
    rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic | vi.Record
) -> tuple[str, list[str]]:
    """The outcome of a motion, and what is wrong with it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        cycles = None if isinstance(shaken, vi.Record) else CYCLES
        data = vi.simulate(vi.Rig(rig, shaken), cycles, samples=8, max_events=3000)
    status = data.attrs["message"].split(":")[0]
    return status, faults(rig, data, status)


def faults(rig: vi.Oscillator, data, status: str) -> list[str]:
    """What is wrong with a motion."""
    wrong = [status] if "range of floating-point numbers" in status else []
    names = ("displacement", "velocity", "acceleration", "final_state")
    wrong += [f"{name} is not finite" for name in names if not np.isfinite(data[name]).all()]
    pulled = (data["deformation"] < -1e-12).any("time").values
    wrong += [f"the {name} stop was pulled" for name in data["stop"].values[pulled]]
    if wrong or status != "done":
        return wrong
    totals = vi.totals(data)
    supplied, isolator, bumpers = (
        float(totals[f"total_{one}"]) for one in ("supplied", "isolator", "bumpers")
    )
    change = stored(rig, data, -1) - stored(rig, data, 0)
    through = abs(supplied) + abs(isolator) + abs(bumpers) + abs(change)
    kinetic = 0.5 * rig.mass * float((data["velocity"] ** 2).max())
    for name, lost in (("isolator", isolator), ("stops", bumpers)):
        if lost < -1e-12 * through:
            wrong.append(f"the {name} created {-lost:g} J")
    if abs(supplied - isolator - bumpers - change) > EXACT * through + ROUNDING * kinetic + NOTHING:
        wrong.append(f"{supplied - isolator - bumpers - change:g} of {through:g} J are missing")
    return wrong


@pytest.mark.parametrize("seed", range(sample(20, 1)))
def test_random_rigs_of_all_laws(seed: int) -> None:
    outcomes, wrong = survey(sample(1000, 15), seed)
    assert not wrong, "\n".join(wrong)
    assert outcomes["done"] > 0.99 * sum(outcomes.values())


def test_random_rigs_of_all_laws_under_any_shaking() -> None:
    """Harmonics that are not odd have no mirror image of their own, as one sine has."""
    outcomes, wrong = survey(sample(1000, 12), 2, shakings=True)
    assert not wrong, "\n".join(wrong)
    assert outcomes["done"] > 0.99 * sum(outcomes.values())


@pytest.mark.parametrize(
    ("seed", "which"),
    [
        *((1, i) for i in (42, 91, 240, 309, 396)),
        # These take longer.
        *((1, i) for i in sample((44, 97, 156, 231, 303, 383, 769, 1138, 1505, 3223), ())),
        (11, 6),
    ],
)
def test_rigs_on_which_it_once_failed(seed: int, which: int) -> None:
    rng = np.random.default_rng(seed)
    rigs = [random_rig(rng) for _ in range(which + 1)]
    status, wrong = looked_at(*rigs[-1])
    assert status == "done"
    assert not wrong, wrong


@pytest.mark.parametrize(
    ("rig", "shaken"),
    [
        pytest.param(
            vi.Oscillator(
                1.0,
                vi.BoucWenIsolator(
                    27.9671,
                    0.0662,
                    0.67983,
                    0.9965,
                    beta=0.69521,
                    gamma=-0.42564,
                    damping_exponent=0.38179,
                ),
                vi.PowerBumper(7753.61, 0.1145, 2.8786, dissipation=1.0533),
                vi.Bumper(11.6223, 0.0, 0.0),
            ),
            vi.Harmonic(0.304125, 0.24798, phase=1.41992),
            id="drag that is infinitely stiff where forces change their sign",
        ),
        pytest.param(
            vi.Oscillator(
                1.0,
                vi.FrictionIsolator(
                    1.0, 2.9474373332371724, 0.09169911355787265, damping_exponent=0.5
                ),
                vi.PowerBumper(
                    0.4547570824748289,
                    0.0,
                    restitution=0.6126384735293243,
                    relation="lankarani-nikravesh",
                ),
                vi.PowerBumper(
                    4384.459350720129, 0.0, restitution=0.646102211427594, relation="gonthier"
                ),
            ),
            vi.Harmonic(0.7450148451445732, 0.4363343660061145, phase=2.8506304431622063),
            id="friction while a stop does not push",
        ),
        pytest.param(
            vi.Oscillator(
                1.0,
                vi.PolynomialIsolator(1.0, 0.01, 0.16593, 5.47543),
                vi.Bumper(33469.2, 0.0, 0.0),
                vi.RigidStop(0.93764, 0.0),
            ),
            vi.Harmonic(0.058792, 0.107772, phase=2.05548),
            id="chatters beside which little else happens",
        ),
    ],
)
def test_rigs_whose_energies_once_did_not_balance(rig, shaken) -> None:
    status, wrong = looked_at(rig, shaken)
    assert status == "done"
    assert not wrong, wrong


if __name__ == "__main__":
    totals, bad = survey(
        int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1, "shakings" in sys.argv
    )
    print(dict(totals))
    print("\n".join(bad) or "no faults")
