"""Raw memory: what is written is read, and no two rooms are one."""

from __future__ import annotations

import numpy as np

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import pointer, stack

buffer = stack(5)


@kernel
def filled(memory: Vector, first: float) -> None:
    for i in range(5):
        memory[i] = first + i


@kernel
def two_rooms() -> tuple[float, float, float]:
    one, other = buffer(), buffer()
    filled(one, 10.0)
    filled(other, 20.0)
    return one[0], one[4], other[4]


@kernel
def through_a_pointer(array: Vector) -> float:
    memory = pointer(array)
    memory[2] += 1.0
    read: float = memory[2]
    return read + 0.0 * array[0]  # which keeps the array alive


def test_two_rooms_of_one_kernel_are_apart() -> None:
    assert two_rooms() == (10.0, 14.0, 24.0)


def test_a_pointer_reads_and_writes_the_array() -> None:
    array = np.arange(4.0)
    assert through_a_pointer(array) == 3.0
    np.testing.assert_array_equal(array, [0.0, 1.0, 3.0, 3.0])


def test_without_the_compiler_a_square_array_is_one_row_as_well() -> None:
    square = np.arange(4.0).reshape(2, 2)
    memory = pointer(square)
    memory[3] = 7.0
    assert square[1, 1] == 7.0
