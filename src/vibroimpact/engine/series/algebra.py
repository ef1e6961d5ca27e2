"""Series with operators: each coefficient is known as soon as those that it is made of.

A law is a formula over these, `k*u + cubic*u**3`. The newest coefficient of the state comes last:
it enters coefficient n of any formula by a factor that is known from the start, its slope there. So
coefficient n is what is `older`, from coefficients below n alone, and slopes times the newest.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.series.summation import summed

_TOGETHER = 4
"""From which order on two coefficients of a product are summed side by side."""


class Series:
    """Coefficients that are found one by one and kept."""

    depth = 1
    """How many products lie between its coefficients and those of the state."""

    def __init__(self, machine: Any) -> None:
        self.machine = machine
        self.coefficients: list[Any] = []
        self._older: dict[int, Any] = {}
        self._powers: dict[int, Series] = {1: self}
        self._twice: dict[int, Any] = {}
        self._pairs: dict[int, Any] = {}
        self._begun: dict[int, Any] = {}
        self._slopes: dict[Series, Any] | None = None

    def __getitem__(self, n: int) -> Any:
        while len(self.coefficients) <= n:
            m = len(self.coefficients)
            self.coefficients.append(self.first() if m == 0 else self._completed(m))
        return self.coefficients[n]

    def _completed(self, n: int) -> Any:
        total = self.older(n)
        for newest, slope in self.slopes.items():
            total = self.machine.fma(slope, newest[n], total)
        return total

    def first(self) -> Any:
        """Return coefficient 0."""
        raise NotImplementedError

    def slope(self) -> dict[Series, Any]:
        """Return by which factors coefficients of the state enter those of the same order."""
        raise NotImplementedError

    def rest(self, n: int) -> Any:
        """Return coefficient n > 0 but for what the newest of the state brings."""
        raise NotImplementedError

    @property
    def slopes(self) -> dict[Series, Any]:
        """By which factors coefficients of the state enter those of the same order."""
        if self._slopes is None:
            self._slopes = self.slope()
        return self._slopes

    def older(self, n: int) -> Any:
        """Return what older coefficients make of coefficient n."""
        if n not in self._older:
            self._older[n] = self.rest(n)
        return self._older[n]

    def doubled(self, n: int) -> Any:
        """Return twice a coefficient."""
        if n not in self._twice:
            one = self[n]
            self._twice[n] = one + one
        return self._twice[n]

    def pair(self, n: int) -> Any:
        """Return coefficients n and n + 1 side by side."""
        if n not in self._pairs:
            self._pairs[n] = self.machine.lanes([self[n], self[n + 1]])
        return self._pairs[n]

    def together(self, n: int, factors: Any, other: Series) -> tuple[Any, Any]:
        """Sum factor j times coefficients n − j and n + 1 − j of a series, side by side."""
        if not factors:
            return 0.0, 0.0
        pairs = ((other.pair(n - j), factor) for j, factor in factors)
        total = summed(self.machine, pairs, width=2)
        return total.lane(0), total.lane(1)

    def add_older(self, n: int, total: Any, factor: Any) -> Any:
        """Return `total` plus what is older of coefficient n, times a factor."""
        return self.machine.fma(self.older(n), factor, total)

    def __add__(self, other: Any) -> Series:
        return Sum(self, other)

    def __sub__(self, other: Any) -> Series:
        return Sum(self, -other)

    def __rsub__(self, other: Any) -> Series:
        return Sum(-self, other)

    def __neg__(self) -> Series:
        return Scaled(self, -1.0)

    def __mul__(self, other: Any) -> Series:
        if not isinstance(other, Series):
            return Scaled(self, other)
        if isinstance(other, Scaled):
            return Scaled(self * other.series, other.factor)
        return Square(self) if other is self else Product(self, other)

    def __truediv__(self, other: Any) -> Series:
        if not isinstance(other, Series):
            return Scaled(self, 1.0 / other)
        return self * (1.0 / other)

    def __rtruediv__(self, other: Any) -> Series:
        from vibroimpact.engine.series.functions import Power

        return Scaled(Power(self, -1.0), other)

    def __pow__(self, exponent: int) -> Any:
        if exponent == 0:
            return 1.0
        if exponent not in self._powers:
            half = self ** (exponent // 2)
            self._powers[exponent] = (
                half * half if exponent % 2 == 0 else self ** (exponent - 1) * self
            )
        return self._powers[exponent]

    __radd__, __rmul__ = __add__, __mul__


def later(orders: Any, n: int) -> list[int]:
    """Sort factors j of coefficients n − j by when the later of both is known."""
    return sorted(orders, key=lambda j: max(j, n - j))


def scaled(slopes: dict[Series, Any], factor: Any) -> dict[Series, Any]:
    """Multiply slopes."""
    return {newest: slope * factor for newest, slope in slopes.items()}


def joined(one: dict[Series, Any], other: dict[Series, Any]) -> dict[Series, Any]:
    """Add slopes."""
    both = dict(one)
    for newest, slope in other.items():
        both[newest] = both[newest] + slope if newest in both else slope
    return both


class StateSeries(Series):
    """A series of the state, whose coefficients are written as they are found."""

    depth = 0

    def __init__(self, machine: Any, coefficients: Any) -> None:
        super().__init__(machine)
        self.coefficients = list(coefficients)

    def __getitem__(self, n: int) -> Any:
        return self.coefficients[n]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return {self: 1.0}

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        return 0.0


class Shifted(Series):
    """A series but for its first coefficient."""

    def __init__(self, series: Series, first: Any) -> None:
        super().__init__(series.machine)
        self.series, self.begins = series, first
        self.depth = series.depth

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.begins

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return self.series.slopes

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        return self.series.older(n)


class Rate(StateSeries):
    """The derivative of a series of the state."""

    def __init__(self, series: StateSeries) -> None:
        super().__init__(series.machine, ())
        self.series = series

    def __getitem__(self, n: int) -> Any:
        while len(self.coefficients) <= n:
            m = len(self.coefficients)
            self.coefficients.append(self.series[m + 1] * float(m + 1))
        return self.coefficients[n]


class Sum(Series):
    """Of a series and a series or number."""

    def __init__(self, one: Series, other: Any) -> None:
        super().__init__(one.machine)
        self.one, self.other = one, other
        self.depth = max(one.depth, other.depth if isinstance(other, Series) else 0)

    def first(self) -> Any:
        """Return coefficient 0."""
        other = self.other
        return self.one[0] + (other[0] if isinstance(other, Series) else other)

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        if isinstance(self.other, Series):
            return joined(self.one.slopes, self.other.slopes)
        return self.one.slopes

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        one = self.one.older(n)
        return self.other.add_older(n, one, 1.0) if isinstance(self.other, Series) else one

    def add_older(self, n: int, total: Any, factor: Any) -> Any:
        """Return `total` plus what is older of coefficient n, times a factor."""
        total = self.one.add_older(n, total, factor)
        if isinstance(self.other, Series):
            return self.other.add_older(n, total, factor)
        return total


class Scaled(Series):
    """A series times a number."""

    def __init__(self, series: Series, factor: Any) -> None:
        super().__init__(series.machine)
        self.series, self.factor = series, factor
        self.depth = series.depth

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.series[0] * self.factor

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.series.slopes, self.factor)

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        return self.series.older(n) * self.factor

    def add_older(self, n: int, total: Any, factor: Any) -> Any:
        """Return `total` plus what is older of coefficient n, times a factor."""
        return self.series.add_older(n, total, self.factor * factor)

    def __neg__(self) -> Series:
        return Scaled(self.series, -self.factor)

    def __mul__(self, other: Any) -> Series:
        if isinstance(other, Series):
            return Scaled(self.series * other, self.factor)
        return Scaled(self.series, self.factor * other)

    __rmul__ = __mul__


class Product(Series):
    """Of two series."""

    def __init__(self, one: Series, other: Series) -> None:
        super().__init__(one.machine)
        self.one, self.other = one, other
        self.depth = 1 + max(one.depth, other.depth)

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.one[0] * self.other[0]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return joined(
            scaled(self.one.slopes, self.other[0]), scaled(self.other.slopes, self.one[0])
        )

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        one, other = self.one, self.other
        if n % 2 == 0 and n >= _TOGETHER:
            # Coefficient n + 1 is summed beside it. What is known last enters last, by itself.
            order = later(range(3, n - 1), n + 1)
            total, self._begun[n + 1] = self.together(n, [(j, one[j]) for j in order], other)
            orders = [2, 1, n - 1]
        elif n in self._begun:
            total, orders = self._begun[n], [2, n - 2, 1, n - 1]
        else:
            total = summed(self.machine, [(one[j], other[n - j]) for j in later(range(1, n), n)])
            orders = []
        early, late = (one, other) if one.depth < other.depth else (other, one)
        total = early.add_older(n, total, late[0])
        for j in orders:
            total = self.machine.fma(one[j], other[n - j], total)
        return late.add_older(n, total, early[0])


class Square(Series):
    """A series times itself."""

    def __init__(self, one: Series) -> None:
        super().__init__(one.machine)
        self.one = one
        self.depth = 1 + one.depth

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.one[0] * self.one[0]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.one.slopes, self.one.doubled(0))

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        one, half = self.one, n // 2
        if n % 2 == 0 and half - 2 >= 2:
            order = [(j, one.doubled(j)) for j in range(half - 1, 2, -1)]
            total, self._begun[n + 1] = self.together(n, order, one)
            total = self.machine.fma(one[half], one[half], total)
            total = self.machine.fma(one.doubled(2), one[n - 2], total)
            total = self.machine.fma(one.doubled(1), one[n - 1], total)
        elif n in self._begun:
            total = self.machine.fma(one.doubled(half), one[half + 1], self._begun[n])
            total = self.machine.fma(one.doubled(2), one[n - 2], total)
            total = self.machine.fma(one.doubled(1), one[n - 1], total)
        else:
            pairs = [(one[half], one[half])] if n % 2 == 0 else []
            pairs += [(one.doubled(j), one[n - j]) for j in range((n + 1) // 2 - 1, 0, -1)]
            total = summed(self.machine, pairs)
        return one.add_older(n, total, one.doubled(0))
