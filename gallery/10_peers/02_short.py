"""
Short runs, where this package is slower
========================================

``vi.simulate`` checks its input and labels its result. The checks and labels take some tenths of a
millisecond, even for a short run. For a run of only a few periods, an integrator without checks and
labels is therefore faster. If you need many short sweeps, compute them in one call of
``vi.sweeps``.
"""

from matplotlib.figure import Figure

from benchmarks.results import number, rows

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
ax.set_xlabel("forcing periods per run (–)")
ax.set_ylabel("time per run, including setup (µs)")
ax.legend(fontsize="small", frameon=False)
figure
