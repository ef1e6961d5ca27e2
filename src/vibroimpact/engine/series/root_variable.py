"""A step while a stop is pressed by a power of its deformation, as a formula in a root of that.

δ^1.5 has no series where contact begins. With m δ = wᵐ and a variable τ in which dt = wᵐ⁻¹ dτ,
w′ = δ̇, and all else has a series in τ, at both ends of the contact, too, if m times the exponent is
a whole number; Jankowski's c δ^¼ δ̇ wants m = 4. The time is one more unknown.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series import program
from vibroimpact.engine.series.algebra import Series, StateSeries, later
from vibroimpact.engine.series.code_generation import LANES
from vibroimpact.engine.series.laws import hysteresis, own
from vibroimpact.engine.series.step import (
    LAST,
    LAWS,
    TOLERANCE,
    LawNumbers,
    isolator,
    memory,
    memory_off,
    overbent,
    points_of,
    reach,
)
from vibroimpact.engine.series.step_ends import (
    Along,
    along_of,
    end_of,
    memory_end,
    sums,
)
from vibroimpact.engine.series.summation import summed, tree

EARLY = 4


class Rooted(NamedTuple):
    """What a kernel in the root is made for.

    Of each of `step.LAWS` what it has; m; m times the exponent; whether there is a viscous part;
    and whether what shakes the mass is one sine or line, else a polynomial of the time.
    """

    laws: tuple[tuple[Any, ...], ...]
    root: int
    power: int
    viscous: bool
    single: bool


class DepthRate(Series):
    """δ′, from the series of y = m δ, which is wᵐ: coefficient n needs w up to n + 1 only."""

    def __init__(self, y: Series, w: StateSeries, v: StateSeries, pace: Any, share: float) -> None:
        super().__init__(w.machine)
        self.y, self.w, self.v, self.pace, self.share = y, w, v, pace, share

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.pace[0] * self.v[0]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return {self.v: self.pace[0]}

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        return self.y.older(n + 1) * (float(n + 1) * self.share)


def pull(
    law: LawNumbers, shape: Rooted, w: Any, v: Any, z: Any, y: Any, moved: Any, pace: Any
) -> Any:
    """What all forces but the shaking and the dashpot pull back with, times dt/dτ.

    `y` is m δ, and `moved` is dδ/dτ.
    """
    share = 1.0 / shape.root
    push = law.push * share ** (shape.power * share)
    deep = w ** (shape.power - 1)
    inner = law.stiffness * share * pace + push * deep
    terms = [(inner + push * law.push_dissipation * (v * deep)) * y]
    if shape.viscous:
        terms.append(law.push_viscous * share**0.25 * (w * moved))
    x = y * share + law.offset
    terms += [force * pace for force in isolator(law, shape, x, v, z)]
    return tree(terms)


def grown(series: Series, n: int) -> Any:
    """Coefficient n + 1 of a state from the coefficients of its rate."""
    if n == 0:
        return series[0]
    total = series.add_older(n, 0.0, 1.0)
    for newest, slope in series.slopes.items():
        total = series.machine.fma(slope, newest[n], total)
    return total * (1.0 / (n + 1))


def faster(
    machine: Any, gain: Series, turning: Turning | None, damping: Any, parts: Any, n: int
) -> Any:
    """Coefficient n + 1 of the velocity; that of order n, known last, enters last.

    `damping` is −c / m: the dashpot's part of the velocity is −c δ exactly.
    """
    w, v, y = parts
    share = 1.0 / (n + 1)
    pushed = turning.push(n) if turning is not None else 0.0
    if n == 0:
        return machine.fma(damping, y[1], gain[0] + pushed)
    total = pushed
    for newest, slope in gain.slopes.items():
        if newest is not v:
            total = machine.fma(slope, newest[n], total)
    total = gain.add_older(n, total, 1.0)
    total = machine.fma(total, share, damping * y.older(n + 1))
    brake = damping * y.slopes[w]
    if v in gain.slopes:
        brake = brake + gain.slopes[v]
    return machine.fma(brake * share, v[n], total)


class Turning:
    """What one sine shakes with, times dt/dτ: its even terms and its odd ones, side by side."""

    def __init__(self, machine: Any, even: Any, odd: Any, pace: Series, law: LawNumbers) -> None:
        self.machine, self.pace = machine, pace
        self.both = [machine.lanes([even, odd])]
        self.rates = machine.lanes([law.rate, law.closing])

    def push(self, n: int) -> Any:
        """Coefficient n of what shakes; it needs those of dt/dτ up to n."""
        pairs = ((self.both[j], self.pace[n - j]) for j in later(range(n + 1), n))
        total = summed(self.machine, pairs)
        share = 1.0 / (n + 1)
        self.both.append(total.swapped() * (self.rates * [share, share]))
        return total.lane(0)


def write_root_series(machine: Any, shape: Rooted) -> None:
    """Write the series of a step from (w, δ̇, z), and the values at its end."""
    first, speed, kept, size, longest, now, after = machine.arguments
    law, degree = LawNumbers(machine), at.DEGREE
    w, v, z, t = (StateSeries(machine, [one]) for one in (first, speed, kept, 0.0))
    y, pace = w**shape.root, w ** (shape.root - 1)
    moved = DepthRate(y, w, v, pace, 1.0 / shape.root)
    turning, shaken = None, None
    if shape.single:
        squared = machine.load(at.SHAKES)  # of the unit of time
        turning = Turning(machine, now * squared, after * squared, pace, law)
    else:
        series = t * machine.load(at.SHAKES + degree - 2)
        for n in range(degree - 3, 0, -1):
            series = (series + machine.load(at.SHAKES + n)) * t
        shaken = (series + machine.load(at.SHAKES)) * pace
    gain = law.load * pace - pull(law, shape, w, v, z, y, moved, pace)
    if shaken is not None:
        gain = gain + shaken
    damping = law.damping * (-1.0 / shape.root)
    flow = memory(law, shape, None, moved, z)
    h, last = None, degree - EARLY
    for n in range(degree):
        w.coefficients.append(v[n] * (1.0 / (n + 1)))
        if n + 1 == last:
            h = machine.least(reach(machine, w, None, size, last), longest)
        new = [(t, grown(pace, n))]
        if flow is not None:
            new.append((z, grown(flow, n)))
        if n + 1 < degree:
            new.append((v, faster(machine, gain, turning, damping, (w, v, y), n)))
        for one, coefficient in new:
            one.coefficients.append(coefficient)
    written = [(at.X, w), (at.T, t), *([(at.Z, z)] if flow is not None else [])]
    for place, one in written:
        for n in range(degree + 1):
            machine.store(place + n, one[n])
    ended(machine, shape, law, w, t, z if flow is not None else None, h, size)


def total(machine: Any, series: Series, reached: list[Any]) -> tuple[Any, Any]:
    """Sum a series from its first coefficient on, and the sizes of its terms."""
    value: Any = None
    sizes: Any = None
    for i, one in enumerate(reached):
        term = machine.lanes([series[LANES * i + j + 1] for j in range(LANES)]) * one
        size = term.absolute()
        value, sizes = (term, size) if value is None else (value + term, sizes + size)
    return value.total(), sizes.total()


def again(machine: Any, shape: Rooted) -> None:
    """Find the end of the series in hand at another value of τ."""
    size, h = machine.arguments[3:5]

    def loaded(place: int) -> StateSeries:
        return StateSeries(machine, [machine.load(place + n) for n in range(at.DEGREE + 1)])

    z = loaded(at.Z) if shape.laws[LAWS.index(hysteresis)] else None
    ended(machine, shape, LawNumbers(machine), loaded(at.X), loaded(at.T), z, h, size)


def ended(
    machine: Any, shape: Rooted, law: LawNumbers, w: Series, t: Series, z: Any, h: Any, size: Any
) -> None:
    """Write the values at the end of a step."""
    degree = at.DEGREE
    step = along_of(machine, h)
    totals, times = sums(machine, w, step.reached), total(machine, t, step.reached)
    end, v = end_of(machine, totals, w[0], step)
    machine.store(at.FOUND + at.F_T, times[0])
    highest = h
    for _ in range(4):
        highest = highest * highest
    highest = highest * (h * h) * (h * h)  # h²⁰
    whole = machine.most(size, machine.absolute(end))
    last = machine.absolute(w[degree]) * highest / whole
    last = machine.most(last, machine.absolute(t[degree]) * highest / (times[1] + 1e-300))
    excess = last * (1.0 / (LAST * TOLERANCE))
    pace = end ** (shape.root - 1)
    kept = 0.0
    if z is not None:
        more = sums(machine, z, step.reached)
        kept = memory_end(machine, more, z[0], step)
        off = more.rate - memory(law, shape, None, v * pace, kept) * h
        missing, extent = memory_off(machine, shape, off, v * (pace * h), (z[0], kept))
        extreme = machine.absolute(z[degree]) * highest
        last = extreme / (extent + 1e-300) * (1.0 / (LAST * TOLERANCE))
        excess = machine.most(machine.most(missing, last), excess)
    bent = bends_of(machine, shape, law, w, step)
    if bent is not None:
        excess = machine.most(overbent(bent), excess)
    machine.store(at.FOUND + at.F_EXCESS, excess)
    weight = pace * (h * h)
    moved = v * pace
    pulled = pull(law, shape, end, v, kept, end**shape.root, moved, pace)
    owes = machine.fma(machine.fma(law.damping, moved, pulled), h * h, totals.gain)
    machine.store(at.FOUND + at.F_OWES, owes)
    machine.store(at.FOUND + at.F_WEIGHT, weight)


def bends_of(machine: Any, shape: Rooted, law: LawNumbers, w: Series, step: Along) -> Any:
    """By how much a formula of the isolator may bend on a step; None if there is none to bend."""
    own_law = shape.laws[LAWS.index(own)]
    if not own_law:
        return None
    points = [
        (machine.most(one, 0.0) ** shape.root * (1.0 / shape.root) + law.offset, v * law.per_unit)
        for one, v in points_of(machine, w, step)
    ]
    return program.bends(machine, law, own_law, 0, points)
