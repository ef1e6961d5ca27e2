"""Small matrices, row by row in raw memory."""

from __future__ import annotations

import math

from vibroimpact.engine.jit import Vector, kernel

_SQUARED = 14
"""Times that a matrix is squared: its size to the power of 1/16384 is its radius to 1e-4."""


@kernel
def solve(a: Vector, b: Vector, n: int) -> bool:
    """Solve a x = b by elimination with pivoting; x replaces b. False if a is singular."""
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i * n + k]) > abs(a[best * n + k]):
                best = i
        if not abs(a[best * n + k]) > 1e-300:
            return False
        if best != k:
            for j in range(n):
                a[k * n + j], a[best * n + j] = a[best * n + j], a[k * n + j]
            b[k], b[best] = b[best], b[k]
        for i in range(k + 1, n):
            factor = a[i * n + k] / a[k * n + k]
            if factor != 0.0:
                for j in range(k, n):
                    a[i * n + j] -= factor * a[k * n + j]
                b[i] -= factor * b[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            b[k] -= a[k * n + j] * b[j]
        b[k] /= a[k * n + k]
    return True


@kernel
def radius(matrix: Vector, other: Vector, n: int) -> float:
    """The spectral radius of a matrix of n rows (overwritten, as `other` is), by squaring it."""
    total = 0.0
    power = 1.0
    for _ in range(_SQUARED):
        size = 0.0
        for i in range(n * n):
            size = max(size, abs(matrix[i]))
        if size == 0.0:
            return 0.0
        total += math.log(size) * power
        for i in range(n * n):
            matrix[i] /= size
            other[i] = 0.0
        for i in range(n):
            for k in range(n):
                factor = matrix[n * i + k]
                if factor != 0.0:
                    for j in range(n):
                        other[n * i + j] += factor * matrix[n * k + j]
        for i in range(n * n):
            matrix[i] = other[i]
        power *= 0.5
    return math.exp(total)
