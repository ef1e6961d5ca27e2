"""Draw the figures of the theory pages: docs/images/theory-*.png.

python theory.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

import vibroimpact as vi
from vibroimpact.figures import branch_diagram, save_figure, time_history

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)
RED, BLUE = "#c8102e", "#1f4fbf"


def spring(ax, start, end, y, turns=5):
    """Draw a zigzag from start to end."""
    x = np.concatenate([[start], np.linspace(start + 0.12, end - 0.12, 2 * turns + 1), [end]])
    up = np.concatenate([[0.0, 0.0], np.tile([0.09, -0.09], turns)[:-1], [0.0, 0.0]])
    ax.plot(x, y + up, color="black", linewidth=1.1)


def dashpot(ax, start, end, y):
    """Draw a piston in its cylinder."""
    middle = 0.5 * (start + end)
    ax.plot([start, middle], [y, y], color="black", linewidth=1.1)
    ax.plot([middle, middle], [y - 0.07, y + 0.07], color="black", linewidth=1.1)
    ax.plot(
        [middle - 0.08, middle + 0.1, middle + 0.1, middle - 0.08],
        [y + 0.11, y + 0.11, y - 0.11, y - 0.11],
        color="black",
        linewidth=1.1,
    )
    ax.plot([middle + 0.1, end], [y, y], color="black", linewidth=1.1)


def model():
    """Draw the mass, its isolator and its bumpers."""
    figure = Figure(figsize=(8.0, 3.0), layout="constrained")
    ax = figure.subplots()
    ax.add_patch(Rectangle((-0.6, 0.85), 1.2, 0.75, facecolor="0.88", edgecolor="black"))
    ax.text(0.0, 1.22, "$M$", ha="center", va="center", fontsize="large")
    for side, name in ((1, "R"), (-1, "L")):
        wall, face = side * 2.9, side * 1.5
        ax.add_patch(
            Rectangle((min(wall, wall + side * 0.15), 0.0), 0.15, 1.8, facecolor="0.7", hatch="///")
        )
        ax.plot([face, face], [0.85, 1.6], color="black", linewidth=3.0)
        spring(ax, *sorted((face, wall)), 1.42)
        dashpot(ax, *sorted((face, wall)), 1.02)
        ax.text(side * 2.2, 1.58, f"$K_{name}$", ha="center")
        ax.text(side * 2.2, 0.68, f"$C_{name}$", ha="center")
        ax.annotate(
            "", (face, 1.78), (side * 0.6, 1.78), arrowprops={"arrowstyle": "<->", "linewidth": 0.9}
        )
        ax.text(side * 1.05, 1.84, f"$G_{name}$", ha="center")
    ax.plot([-2.9, 2.9], [0.0, 0.0], color="black", linewidth=1.5)
    spring(ax, -1.6, -0.45, 0.58)
    dashpot(ax, -1.6, -0.45, 0.24)
    ax.plot([-0.45, -0.45], [0.24, 0.85], color="black", linewidth=1.1)
    ax.plot([-1.6, -1.6], [0.0, 0.58], color="black", linewidth=1.1)
    ax.text(-1.68, 0.35, "$K,\\ C$", ha="right", va="center")
    arrow = {"arrowstyle": "->", "linewidth": 1.2}
    ax.annotate("", (0.55, 2.1), (0.0, 2.1), arrowprops={**arrow, "color": RED})
    ax.plot([0.0, 0.0], [2.04, 2.16], color=RED)
    ax.text(0.6, 2.1, "$u$", color=RED, va="center")
    ax.annotate("", (1.2, -0.22), (0.2, -0.22), arrowprops={**arrow, "color": BLUE})
    ax.text(1.26, -0.22, "$A_t$, acceleration of the base", color=BLUE, va="center")
    ax.set_xlim(-3.3, 3.3)
    ax.set_ylim(-0.4, 2.25)
    ax.set_aspect("equal")
    ax.axis("off")
    return figure


def first_contact():
    """Draw the node test that excludes a contact, and how a clearance opens after a detachment."""
    figure = Figure(figsize=(9.0, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    nodes = np.linspace(0.0, 4.0, 5)
    time = np.linspace(0.0, 4.0, 801)
    value = 0.62 - 0.45 * np.sin(1.15 * time) - 0.06 * time + 0.07 * np.cos(2.3 * time)
    band = abs(np.gradient(np.gradient(value, time), time)).max() / 8.0  # S h²/8, h = 1
    left.plot(time, value, color="black", label="clearance")
    at = np.interp(nodes, time, value)
    left.plot(nodes, at, "o", color="black", label="nodes")
    for k in range(4):
        low = min(at[k], at[k + 1]) - band
        sure = low > 0.0
        left.plot(
            nodes[k : k + 2],
            [low, low],
            "-" if sure else ":",
            color=BLUE if sure else RED,
            linewidth=2.5,
            label="lower bound, positive" if sure else "lower bound, negative: refine",
        )
    left.axhline(0.0, color="0.5", linewidth=0.8)
    left.set_xlabel("time (steps $h$)")
    left.set_ylabel("clearance")
    named = dict(zip(*reversed(left.get_legend_handles_labels()), strict=True))
    left.legend(named.values(), named.keys(), fontsize="small", frameon=False)
    left.set_ylim(-0.1, 1.15)

    time = np.linspace(0.0, 3.0, 300)
    for share, dashes in ((0.2, "-"), (0.45, "--"), (0.7, ":")):
        opened = np.exp(-time) - 1.0 + time - 0.5 * share * time**2
        right.plot(time, opened, dashes, color="black", label=f"$q$ = {share}")
    right.axhline(0.0, color="0.5", linewidth=0.8)
    right.set_ylim(-0.25, 1.2)
    right.set_xlabel("time after the detachment, $\\gamma t$")
    right.set_ylabel("lower bound of the clearance, over $r_0$")
    right.legend(fontsize="small", frameon=False)
    return figure


def growth():
    """Draw how two motions diverge that start very close, for a periodic and a chaotic motion."""
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    ax = figure.subplots()
    case = vi.laboratory.case("B3-10mm-A3")
    for hertz, colour, dashes in ((1.12, BLUE, "--"), (1.06, RED, "-")):
        rig = vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, hertz, phase=0.3 * np.pi))
        settled = vi.simulate(rig, 1000, samples=0)["final_state"]
        pushed = settled.copy()
        pushed.loc[{"component": "displacement"}] += 1e-11
        one, other = (
            vi.simulate(rig, 60, start=start, samples=1)["displacement"]
            for start in (settled, pushed)
        )
        apart = np.maximum(abs((one - other).values), 1e-16)
        kind = "chaotic" if hertz == 1.06 else "periodic"
        label = f"{hertz} Hz, {kind}"
        ax.semilogy(np.arange(len(apart)), 1e3 * apart, dashes, color=colour, label=label)
    ax.set_xlabel("forcing cycles")
    ax.set_ylabel("distance of two motions (mm)")
    ax.legend(frameon=False)
    return figure


def branches():
    """Draw the orbits along a branch, through both folds."""
    case = vi.laboratory.case("B2-G1-A3")
    branch = vi.branch(case, frequency="4 Hz", vary={"frequency": ("1 Hz", "4 Hz")})
    ax = branch_diagram(branch, quantity="eta_a")
    inside = branch["frequency"] < 4.0
    ax.plot(branch["frequency"][inside], branch["eta_a"][inside], "|", color=BLUE, markersize=9)
    ax.set_xlim(1.0, 3.2)
    return ax


def chatter():
    """Draw a mass that bounces on a wall with decreasing height, and rests on it."""
    wall = vi.RigidStop(restitution=0.6, gap=0.0)
    ball = vi.Oscillator(1.0, vi.Isolator(stiffness=1.0, damping=0.05), right=wall, left=None)
    motion = vi.steady(vi.Rig(ball, 1.0, 0.05), samples=2048)
    return time_history(motion, cycles=1.0)


def record():
    """Draw a record with straight lines between samples, and a response maximum between them."""
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    samples = np.array([0.0, 1.0, -0.6, -1.2, 0.8, 1.1, -0.3, 0.0])
    step = 0.2
    time = step * np.arange(len(samples))
    above.plot(time, samples, "o-", color="black")
    above.set_ylabel("$A_t$ (m/s²)")
    linear = vi.Oscillator(1.0, vi.Isolator((2 * np.pi / 0.6) ** 2, 1.0), None, None)
    motion = vi.simulate(vi.Rig(linear, vi.Record(samples, step)), samples=64, tail=0.0)
    at = motion["time"].values
    swing = 1e3 * motion["displacement"].values
    below.plot(at, swing, color="black")
    below.plot(time, np.interp(time, at, swing), "o", color="black", label="at samples")
    most = int(abs(swing).argmax())
    below.plot(at[most], swing[most], "*", color=RED, markersize=11, label="largest")
    below.set_ylabel("$u$ (mm)")
    below.set_xlabel("time (s)")
    below.legend(fontsize="small", frameon=False)
    return figure


for draw in (model, first_contact, growth, branches, chatter, record):
    print(save_figure(draw(), folder / f"theory-{draw.__name__.replace('_', '-')}.png"))
