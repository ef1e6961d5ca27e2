"""Run the benchmarks: `make bench`, or `python -m benchmarks`."""

import argparse

from rich.console import Console

from benchmarks.branches import branches
from benchmarks.campaign import campaign
from benchmarks.laws import laws, sampling, yielding
from benchmarks.machine import load, machine
from benchmarks.memory import memory
from benchmarks.motions import motions
from benchmarks.records import records
from benchmarks.report import Table, show, write
from benchmarks.scenarios import scenarios
from benchmarks.size import size
from benchmarks.smooth import smooth
from benchmarks.spectra import spectra
from benchmarks.startup import compiling, startup
from benchmarks.trajectory import many, peers, short_runs, trajectory


def main() -> None:
    """Measure, print, and write if told to."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--write", action="store_true", help="put the results into benchmarks/README.md"
    )
    arguments = parser.parse_args()
    console = Console()
    if not console.is_terminal:
        console = Console(width=120)
    tables: list[Table] = []

    def add(*more: Table | None) -> None:
        for table in more:
            if table is not None:
                tables.append(table)
                show(table, console)

    with console.status("compiling ..."):
        about = machine()
        compiled = compiling()
        others = peers()
    add(about)
    with console.status("trajectories ..."):
        add(*trajectory(others, compiled.text()))
        add(short_runs(others), many())
        add(laws(), yielding(), sampling(), records(), spectra())
        add(*smooth())
    with console.status("the campaign ..."):
        add(campaign())
    with console.status("motions ..."):
        add(motions())
    with console.status("branches ..."):
        add(branches())
    with console.status("scenarios ..."):
        add(scenarios())
    with console.status("starting and memory ..."):
        add(startup(compiled), memory(), size())
    about.add("load when it ended", f"{load():.1f}")
    missed = [row[0] for table in tables for row in table.rows if "NOT MET" in row]
    console.print(f"Not met: {'; '.join(missed)}." if missed else "All targets are met.")
    if arguments.write:
        write(tables)


if __name__ == "__main__":
    main()
