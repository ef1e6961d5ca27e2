"""
Time of other programs relative to this package
===============================================

This figure shows every comparison of the benchmarks with another program, for problems that both
programs can solve. To the left of the vertical line, the other program is faster than this package.
Loops over scipy represent the code that a user would write without this package.
"""

from matplotlib.figure import Figure

from benchmarks.results import against_others

found = sorted(against_others(), key=lambda one: one[1])
names, ratios = zip(*found, strict=True)

figure = Figure(figsize=(9.0, 0.34 * len(names) + 1.0), layout="constrained")
ax = figure.subplots()
ax.hlines(range(len(names)), 1.0, ratios, color="0.8", linewidth=2.0)
ax.plot(ratios, range(len(names)), "o", color="#1f4fbf")
for place, ratio in enumerate(ratios):
    text = f"{ratio:,.0f}" if ratio > 100.0 else f"{ratio:.2g}"
    side, away = ("left", 7) if ratio > 1.0 else ("right", -7)
    ax.annotate(
        text, (ratio, place), (away, -3), textcoords="offset points", ha=side, fontsize="small"
    )
ax.axvline(1.0, color="black", linewidth=0.8)
ax.set_xscale("log")
ax.set_xlim(0.03 * min(1.0, ratios[0]), 20.0 * ratios[-1])
ax.set_yticks(range(len(names)), names, fontsize="small")
ax.set_xlabel("time of the other program / time of vibroimpact (–)")
figure
