"""First sign change of a polynomial on [0, 1], proved to be the first.

Descartes' rule of signs with bisection (Collins and Akritas), in exact integers: a cell without
variation of sign holds no zero, a cell with a single one holds exactly one. Sampling cannot say
that, and a grazing pass is arbitrarily short.
"""

from itertools import pairwise

from mpmath import mp, mpf


def polynomial_value(series: list[mpf], x: mpf) -> mpf:
    total = mpf(0)
    for coefficient in reversed(series):
        total = total * x + coefficient
    return total


def first_zero(series: list[mpf]) -> mpf | None:
    """First x in [0, 1) where a polynomial that starts positive changes sign; 0 if it does not.

    A pair of zeros closer than half the working precision is a tangency and passes as no zero.
    """
    if series[0] <= 0:
        return mpf(0)
    if series[0] > sum(map(abs, series[1:])):
        return None
    scale = mp.prec - mp.mag(max(map(abs, series)))
    cell = _isolate([int(mp.ldexp(value, scale)) for value in series], mp.prec // 2)
    if cell is None:
        return None
    low, high = cell
    if low == high:
        return low
    slopes = [n * value for n, value in enumerate(series)][1:]
    x = (low + high) / 2
    for _ in range(2 * mp.prec):
        value, slope = polynomial_value(series, x), polynomial_value(slopes, x)
        low, high = (x, high) if value > 0 else (low, x)
        newer = (low + high) / 2
        if slope < 0 and low <= x - value / slope <= high:
            newer = x - value / slope
        done = abs(newer - x) <= 8 * mp.eps * x
        x = newer
        if done:
            break
    return x


def _isolate(series: list[int], deepest: int) -> tuple[mpf, mpf] | None:
    """Cell (low, high) of the first sign change on [0, 1); low = high where it is a border.

    Descartes' rule on the cell: no variation of sign proves that there is no zero, a single one
    that there is exactly one. All arithmetic is exact.
    """
    degree = len(series) - 1
    cells = [(series, 0, 0)]
    while cells:
        polynomial, index, level = cells.pop()
        low, high = mp.ldexp(index, -level), mp.ldexp(index + 1, -level)
        # A zero on the border of two cells shows as a cell that starts below zero.
        if next((value < 0 for value in polynomial if value), False):
            return low, low
        variations = _variations(polynomial)
        if variations == 1 or (variations % 2 == 1 and level == deepest):
            return low, high
        if variations > 1 and level < deepest:
            left = [value << (degree - n) for n, value in enumerate(polynomial)]
            cells.append((_shift(left), 2 * index + 1, level + 1))
            cells.append((left, 2 * index, level + 1))
    return None


def _variations(polynomial: list[int]) -> int:
    """Sign variations of (1 + x)**n p(1 / (1 + x)): the Bernstein coefficients' on [0, 1]."""
    signs = [value > 0 for value in _shift(polynomial[::-1]) if value]
    return sum(a != b for a, b in pairwise(signs))


def _shift(polynomial: list[int]) -> list[int]:
    """Coefficients of p(x + 1), by additions only."""
    shifted = list(polynomial)
    for first in range(len(shifted) - 1):
        for n in range(len(shifted) - 2, first - 1, -1):
            shifted[n] += shifted[n + 1]
    return shifted
