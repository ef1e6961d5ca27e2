"""
Short runs, where this package is slower
========================================

``vi.simulate`` checks its input and labels its result, which takes some tenths of a millisecond
even for a short run. For a few periods alone, a bare integrator is faster. Combine many sweeps in
one ``vi.sweeps``.
"""

from benchmarks.results import number, rows
from matplotlib.figure import Figure

figure = Figure(figsize=(7.0, 4.2), layout="constrained")
ax = figure.subplots()
looks = zip("os^vD", ("-", "--", "-.", ":", "-"), strict=True)
for row, (marker, dashes) in zip(rows("Short runs of problem P"), looks, strict=False):
    runs = {float(key.split()[0]): value for key, value in row.items() if "period" in key}
    known = [(periods, number(value)) for periods, value in runs.items() if value]
    colour = "#1f4fbf" if "vibroimpact" in row["Solver"] else "0.45"
    ax.plot(*zip(*known, strict=True), dashes, marker=marker, color=colour, label=row["Solver"])
ax.set_xscale("log")
ax.set_yscale("log")
ax.set_xlabel("forcing periods in a run (–)")
ax.set_ylabel("time for a run, setting up included (µs)")
ax.legend(fontsize="small", frameon=False)
figure
