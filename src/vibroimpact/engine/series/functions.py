"""Functions of series: exponentials, real powers, sines and hyperbolic tangents."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine.series.algebra import Series, scaled
from vibroimpact.engine.series.summation import summed


class Exponential(Series):
    """E raised to a series."""

    def __init__(self, one: Series) -> None:
        super().__init__(one.machine)
        self.one = one

    def first(self) -> Any:
        """Return coefficient 0."""
        return self.machine.exponential(self.one[0])

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.one.slopes, self[0])

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        order = sorted(range(1, n), key=lambda j: max(j, n - j))
        pairs = [(self[n - j], self.one[j] * (j / n)) for j in order]
        return self.one.add_older(n, summed(self.machine, pairs), self[0])


class Power(Series):
    """A real power of a series that does not begin with 0."""

    def __init__(self, one: Series, exponent: Any) -> None:
        super().__init__(one.machine)
        self.one, self.exponent = one, exponent

    def first(self) -> Any:
        """Return coefficient 0."""
        self.inverse = 1.0 / self.one[0]
        value = self.machine.power(self.one[0], self.exponent)
        self.by = self.exponent * value * self.inverse
        return value

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        self[0]
        return scaled(self.one.slopes, self.by)

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        self[0]
        more = (self.exponent + 1.0) * (1.0 / n)
        order = sorted(range(1, n), key=lambda j: max(j, n - j))
        pairs = [(self.one[j] * (more * float(j) - 1.0), self[n - j]) for j in order]
        total = summed(self.machine, pairs) * self.inverse if pairs else 0.0
        return self.one.add_older(n, total, self.by)


class Turned(Series):
    """The sine of a series, or its cosine; each is made with the other."""

    def __init__(self, one: Series, is_sine: bool) -> None:
        super().__init__(one.machine)
        self.one, self.is_sine = one, is_sine
        self.other: Turned = self

    def first(self) -> Any:
        """Return coefficient 0."""
        value = self.machine.sine if self.is_sine else self.machine.cosine
        return value(self.one[0])

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.one.slopes, self.other[0] if self.is_sine else -self.other[0])

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        order = sorted(range(1, n), key=lambda j: max(j, n - j))
        way = 1.0 if self.is_sine else -1.0
        pairs = [(self.other[n - j], self.one[j] * (way * j / n)) for j in order]
        first = self.other[0] if self.is_sine else -self.other[0]
        return self.one.add_older(n, summed(self.machine, pairs), first)


def turned(one: Series) -> tuple[Series, Series]:
    """Return the sine and the cosine of a series."""
    both = Turned(one, True), Turned(one, False)
    both[0].other, both[1].other = both[1], both[0]
    return both


def sine(machine: Any, one: Any) -> Any:
    """Return the sine of a number or a series."""
    return turned(one)[0] if isinstance(one, Series) else machine.sine(one)


def cosine(machine: Any, one: Any) -> Any:
    """Return the cosine of a number or a series."""
    return turned(one)[1] if isinstance(one, Series) else machine.cosine(one)


class Tanh(Series):
    """The hyperbolic tangent of a series."""

    def __init__(self, one: Series) -> None:
        super().__init__(one.machine)
        self.one, self.flat = one, Flat(self)

    def first(self) -> Any:
        """Return coefficient 0."""
        return tanh_and_slope(self.machine, self.one[0])[0]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.one.slopes, self.flat[0])

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        order = sorted(range(1, n), key=lambda j: max(j, n - j))
        pairs = [(self.flat[n - j], self.one[j] * (j / n)) for j in order]
        return self.one.add_older(n, summed(self.machine, pairs), self.flat[0])


class Flat(Series):
    """The derivative of a hyperbolic tangent, 1 − tanh² without the difference."""

    def __init__(self, tanh: Tanh) -> None:
        super().__init__(tanh.machine)
        self.tanh = tanh

    def first(self) -> Any:
        """Return coefficient 0."""
        return tanh_and_slope(self.machine, self.tanh.one[0])[1]

    def slope(self) -> dict[Series, Any]:
        """Return the slopes."""
        return scaled(self.tanh.slopes, self.tanh[0] * -2.0)

    def rest(self, n: int) -> Any:
        """Return what is older of coefficient n."""
        tanh = self.tanh
        order = sorted(range(1, n), key=lambda j: max(j, n - j))
        total = summed(self.machine, [(tanh[j], tanh[n - j] * -1.0) for j in order])
        return tanh.add_older(n, total, tanh[0] * -2.0)


def tanh_and_slope(machine: Any, one: Any) -> tuple[Any, Any]:
    """Return the hyperbolic tangent of a number, and 1/cosh² of it."""
    small = machine.exponential(machine.absolute(one) * -2.0)
    inverse = 1.0 / (small + 1.0)
    value = machine.signed((1.0 - small) * inverse, one)
    return value, small * 4.0 * (inverse * inverse)


def tanh(machine: Any, one: Any) -> tuple[Any, Any]:
    """Return the hyperbolic tangent of a number or a series, and its derivative."""
    if not isinstance(one, Series):
        return tanh_and_slope(machine, one)
    tanh_series = Tanh(one)
    return tanh_series, tanh_series.flat


def exponential(machine: Any, one: Any) -> Any:
    """Raise e to a number or a series."""
    return Exponential(one) if isinstance(one, Series) else machine.exponential(one)


def power(machine: Any, one: Any, exponent: Any) -> Any:
    """Raise a number or a series that is not 0 to a real power."""
    return Power(one, exponent) if isinstance(one, Series) else machine.power(one, exponent)
