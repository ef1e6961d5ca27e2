"""Time to the first result: with the library of machine code, and where numba compiles."""

import statistics
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks import fresh
from benchmarks.fresh import Ended
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, digits

_PROCESSES = 7

_IMPORT = "import time; t = time.perf_counter(); import vibroimpact as vi"
_PRINT = "print(time.perf_counter() - t)"
_NAMES = "[getattr(vi, name) for name in vi.__all__]"
_SWEEP = """
import vibroimpact as vi
case = vi.laboratory.case("B2-G1-A3")
vi.sweep(case, case.frequencies)
"""
_RIGID = """
import vibroimpact as vi
case = vi.laboratory.case("B2-G1-A3")
rig = case.oscillator.replace(right={"kind": "rigid", "restitution": 0.6, "gap": "15 mm"})
vi.sweep(vi.Rig(rig, case.amplitude), case.frequencies)
"""
_EVERYTHING = """
import vibroimpact as vi
case = vi.laboratory.case("B2-G1-A3")
amplitude = case.amplitude
shaken = vi.Rig(case.oscillator, vi.Harmonic(amplitude, 1.2))
vi.sweep(case, case.frequencies)
vi.sweeps([case], case.frequencies)
vi.simulate(shaken, 10)
motion = vi.steady(shaken)
vi.contacts(motion), vi.fourier_spectrum(motion)
vi.stroboscopic_section(motion), vi.impact_section(motion)
vi.coexisting_motions(shaken)
vi.lyapunov_exponents([case], [1.2], 100)
vi.orbit(shaken)
vi.branch(shaken, vary={"frequency": (1.1, 1.3)})
followed = vi.resonance_diagram(case, {"frequency": (1.0, 4.0)})
(fold, *_) = (followed["bifurcation_kind"].values == "fold").nonzero()[0]
vi.bifurcation_curve(
    shaken,
    followed.isel(bifurcation=fold),
    vary={"frequency": (1.0, 4.0), "amplitude": (0.5 * amplitude, amplitude)},
)
vi.classify_scenario(case)
vi.scenario_map(None, {"stiffness_ratio": [5.0, 10.0], "gap_ratio": [0.2, 0.4]})
"""
_UNIT = "import numpy, xarray, matplotlib.pyplot"
_PREPARE = """
import time
from vibroimpact.engine import batch
t = time.perf_counter()
batch.{entry}.prepare()
print(time.perf_counter() - t)
"""


@dataclass(frozen=True, slots=True)
class Compiling:
    """Seconds that the engine's two entries take before their first call."""

    cold: dict[str, float]
    cached: dict[str, float]

    def text(self) -> str:
        """Return that of the entry behind `vi.simulate`, in words."""
        cold, cached = self.cold["trajectory"], self.cached["trajectory"]
        return f"{cold:.1f} s once, then {1e3 * cached:.0f} ms"


def compiling() -> Compiling:
    """Compile the engine into an empty cache, then load it."""
    cold: dict[str, float] = {}
    cached: dict[str, float] = {}
    with fresh.empty_cache() as environment:
        for entry in ("sweep", "trajectory"):
            for times in (cold, cached):
                code = _PREPARE.format(entry=entry)
                times[entry] = float(fresh.python(code, environment).output)
    return Compiling(cold, cached)


def first_figure() -> Table:
    """Measure with the library of machine code, in units of the imports that a figure needs."""
    table = targets("First figure, engine as machine code")
    with tempfile.TemporaryDirectory() as out, fresh.nothing_kept() as kept:
        sweep = ("sweep", "B2-G1-A3", "--output", out)

        def first() -> Ended:
            with fresh.nothing_kept() as environment:
                return fresh.vibroimpact(*sweep, environment=environment)

        contestants: dict[str, tuple[Callable[[], Ended], float]] = {
            "the unit": (lambda: fresh.python(_UNIT, kept), 1.0),
            "vibroimpact sweep B2-G1-A3, first run": (first, 4.0),
            "the same, later runs": (lambda: fresh.vibroimpact(*sweep, environment=kept), 2.0),
            "import and every public name": (
                lambda: fresh.python(f"{_IMPORT}; {_NAMES}", kept),
                1.3,
            ),
            "vibroimpact --help": (lambda: fresh.vibroimpact("--help", environment=kept), 0.4),
            "vibroimpact sweep --help": (
                lambda: fresh.vibroimpact("sweep", "--help", environment=kept),
                0.4,
            ),
        }
        for call, _ in contestants.values():
            call()
        rounds = [
            {name: call().work for name, (call, _) in contestants.items()}
            for _ in range(_PROCESSES)
        ]
    (unit, *others) = contestants
    for name in others:
        _, limit = contestants[name]
        spread = Spread.of([one[name] / one[unit] for one in rounds])
        table.add(f"{name}, units", spread.text(), f"at most {limit}", met(spread.median <= limit))
    table.notes.append(
        f"Processor time. The unit, {digits(statistics.median(one[unit] for one in rounds))} s, is "
        f"that of `{_UNIT}` in the same round. Before a first run, matplotlib has no list of fonts."
    )
    return table


def startup(compiled: Compiling) -> Table:
    """Measure in new processes."""
    table = targets("Start, compiled by numba")
    spread = _repeat(f"{_IMPORT}; {_PRINT}")
    table.add("import vibroimpact, s", spread.text(), "under 0.5 s", met(spread.median < 0.5))

    with fresh.empty_cache() as environment, tempfile.TemporaryDirectory() as out:
        first = fresh.python(_SWEEP, environment)
        table.add(
            "first vi.sweep after installing, whole process, s",
            _once(first),
            "under 15 s",
            met(first.seconds < 15.0),
        )
        parts = fresh.compiled(environment)
        said = "compiling" in first.errors
        table.add("it says that it compiles", "yes" if said else "no", "yes", met(said))
        again = [fresh.python(_SWEEP, environment) for _ in range(_PROCESSES)]
        spread, value = _often(again)
        table.add(
            "vi.sweep from the second process on, whole process, s",
            value,
            "under 2 s",
            met(spread.median < 2.0),
        )
        quiet = not any(process.errors for process in again)
        table.add("it says nothing any more", "yes" if quiet else "no", "yes", met(quiet))
        words = ("sweep", "B2-G1-A3", "--output", out)
        spread, value = _often(
            [fresh.vibroimpact(*words, environment=environment) for _ in range(_PROCESSES)]
        )
        table.add(
            "vibroimpact sweep B2-G1-A3, cached, whole process, s",
            value,
            "under 2 s",
            met(spread.median < 2.0),
        )
    with fresh.empty_cache() as environment, tempfile.TemporaryDirectory() as out:
        words = ("sweep", "B2-G1-A3", "--output", out)
        installed = fresh.vibroimpact(*words, environment=environment)
        table.add(
            "the same as the first after installing, s",
            _once(installed),
            "under 15 s",
            met(installed.seconds < 15.0),
        )
    with fresh.empty_cache() as environment:
        rigid = fresh.python(_RIGID, environment)
        before = fresh.compiled(environment)
        second = fresh.python(_SWEEP, environment)
        more = fresh.compiled(environment) - before
    table.add("first vi.sweep of a rig with a rigid stop, whole process, s", _once(rigid), "", "")
    table.add(
        "first vi.sweep of a rig with bumpers after it, s, and functions compiled",
        f"{_once(second)}; {more}",
        f"{parts} compiled, as without",
        met(more == parts),
    )
    with fresh.empty_cache() as environment:
        everything = fresh.python(_EVERYTHING, environment)
        warm = fresh.python(_EVERYTHING, environment)
    table.add(
        "every public function in one process, after installing, s",
        _once(everything),
        "under 45 s",
        met(everything.seconds < 45.0),
    )
    messages = everything.errors.count("compiling")
    table.add("messages that it compiles, in that process", str(messages), "1", met(messages == 1))
    table.add("the same process, cached, s", _once(warm), "", "")
    for entry, public in (("sweep", "vi.sweep"), ("trajectory", "vi.simulate")):
        value = f"{compiled.cold[entry]:.1f}, then {compiled.cached[entry]:.2f}"
        table.add(f"compiling for {public}, then loading, s", value, "", "")
    table.notes.append(
        "B2-G1-A3 at the 46 published frequencies, both ways; the command in steps of 0.01 Hz, "
        "with a figure, a NetCDF file and a summary. Targets are for wall-clock time, which on a "
        "quiet machine is near the processor time."
    )
    return table


def _once(process: Ended) -> str:
    return f"{process.seconds:.1f}; processor {process.work:.1f}"


def _often(processes: list[Ended]) -> tuple[Spread, str]:
    spread = Spread.of([process.seconds for process in processes])
    work = Spread.of([process.work for process in processes])
    return spread, f"{spread.text()}; processor {digits(work.median)}"


def _repeat(code: str) -> Spread:
    fresh.python(code)  # the disk's cache
    return Spread.of([float(fresh.python(code).output) for _ in range(_PROCESSES)])
