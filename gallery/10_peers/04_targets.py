"""
Benchmark targets, met and missed
=================================

The benchmarks have targets, for example for the speed. For each target, this figure shows the
measured margin in the last full run of the benchmarks. Crosses to the left of the vertical line are
targets that were not met.
"""

from matplotlib.figure import Figure

from benchmarks.results import margins

found = sorted(margins(), key=lambda one: one[1])
names, room = zip(*found, strict=True)

figure = Figure(figsize=(10.0, 0.27 * len(names) + 1.0), layout="constrained")
ax = figure.subplots()
for place, value in enumerate(room):
    good = value >= 1.0
    ax.plot(value, place, "o" if good else "X", color="#1f4fbf" if good else "#c8102e")
ax.axvline(1.0, color="black", linewidth=0.8)
ax.set_xscale("log")
ax.set_yticks(range(len(names)), names, fontsize="small")
ax.margins(y=0.02)
ax.set_xlabel("margin to the target; 2 is twice as good as required (–)")
figure
