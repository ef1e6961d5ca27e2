"""Run the benchmarks: `make bench`, or `python -m benchmarks`."""

import argparse
from collections.abc import Callable, Iterable

from rich.console import Console

from benchmarks.assemblies import assemblies, first_use, masses, moat
from benchmarks.basins import basins
from benchmarks.branches import branches
from benchmarks.earthquakes import earthquakes
from benchmarks.fixed import fixed
from benchmarks.laws import laws, sampling, yielding
from benchmarks.machine import load, machine
from benchmarks.page import page
from benchmarks.records import records
from benchmarks.report import Table, show, write
from benchmarks.smooth import smooth
from benchmarks.startup import compiling, first_figure, startup
from benchmarks.trajectory import many, peers, short_runs, trajectory


def groups() -> dict[str, Callable[[], Iterable[Table | None]]]:
    """What is measured, in order, by name."""
    return {
        "trajectory": lambda: (*trajectory(peers(), compiling().text()), many(peers())),
        "short": lambda: (short_runs(peers()),),
        "laws": lambda: (laws(), yielding(), sampling(), *smooth()),
        "assemblies": lambda: (*assemblies(), masses(), moat(), first_use()),
        "records": lambda: (records(),),
        "earthquakes": lambda: (earthquakes(),),
        "branches": lambda: (branches(),),
        "basins": lambda: (basins(),),
        "page": lambda: (page(),),
        "fixed": fixed,
        "figure": lambda: (first_figure(),),
        "startup": lambda: (startup(compiling()),),
    }


def main() -> None:
    """Measure, print, and write if told to."""
    every = groups()
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--write", action="store_true", help="put the results into benchmarks/README.md"
    )
    parser.add_argument("--only", choices=every, nargs="+", help="measure no more than these")
    arguments = parser.parse_args()
    console = Console()
    if not console.is_terminal:
        console = Console(width=120)
    tables = [machine()]
    show(tables[0], console)
    for name in arguments.only or every:
        with console.status(f"{name} ..."):
            group = [table for table in every[name]() if table is not None]
        for table in group:
            show(table, console)
        tables += group
    tables[0].add("load when it ended", f"{load():.1f}")
    missed = [row[0] for table in tables for row in table.rows if "NOT MET" in row]
    console.print(f"Not met: {'; '.join(missed)}." if missed else "All targets are met.")
    if arguments.write:
        write(tables, whole=not arguments.only)


if __name__ == "__main__":
    main()
