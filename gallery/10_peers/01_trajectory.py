"""
One trajectory
==============

The problem is a mass that hits each of two bumpers once per forcing period. This package is
compared with general integrators that were tuned for an error of at most 10⁻¹¹. The bars show the
computing time on a logarithmic scale. The error of each program is printed after its bar.
"""

from matplotlib.figure import Figure

from benchmarks.results import number, rows

table = rows("One trajectory of problem P")
names = [row["Solver"] for row in table]
took = [number(row["µs a period"]) for row in table]

figure = Figure(figsize=(8.0, 3.2), layout="constrained")
ax = figure.subplots()
colours = ["#1f4fbf" if "vibroimpact" in name else "0.65" for name in names]
ax.barh(names, took, color=colours)
for place, row in enumerate(table):
    digits = 0 if took[place] > 100.0 else 2
    text = f" {took[place]:,.{digits}f} µs, error {row['State error']}"
    ax.text(took[place], place, text, va="center", fontsize="small")
ax.set_xscale("log")
ax.set_xlim(0.1, 60.0 * max(took))
ax.invert_yaxis()
ax.set_xlabel("time per forcing period (µs)")
figure
