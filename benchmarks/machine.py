"""What the benchmark ran on."""

import math
import os
import platform
import sys
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from benchmarks.report import Table

_PACKAGES = ("vibroimpact", "numpy", "numba", "llvmlite", "xarray", "heyoka", "scipy")


def machine() -> Table:
    """Return processor, system, versions, and how busy the machine is."""
    table = Table("Machine and versions", ("What", "Value"))
    table.add("date", f"{datetime.now(UTC):%Y-%m-%d}")
    table.add("processor", _processor())
    table.add("processors that may be used", str(processors()))
    table.add("system", f"{platform.system()} {platform.release()}, {platform.machine()}")
    table.add("Python", f"{platform.python_implementation()} {platform.python_version()}")
    table.add("packages", ", ".join(f"{name} {installed(name)}" for name in _PACKAGES))
    busy = load()
    table.add("load when it began", f"{busy:.1f}")
    if busy > 0.5:
        table.notes.append(
            "The machine was not idle. Wall-clock times are therefore too long, and a second "
            "thread must share its processor."
        )
    return table


def installed(package: str) -> str:
    """Version of a package, or that it is not there."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "(not installed)"


def processors() -> int:
    """How many processors this process may use."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def load() -> float:
    """Average number of running processes over the last minute; NaN where it is unknown."""
    try:
        return os.getloadavg()[0]
    except (AttributeError, OSError):
        return math.nan


def _processor() -> str:
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.processor() or "unknown"
    fields: dict[str, str] = {}
    for line in text.splitlines():
        key, _, value = line.partition(":")
        fields.setdefault(key.strip(), value.strip())
    name = fields.get("model name", platform.processor())
    family, model = fields.get("cpu family"), fields.get("model")
    return f"{name} (family {family}, model {model})" if family else name
