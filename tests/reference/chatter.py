"""Where the impacts of a chatter accumulate.

A mass that is pressed on a rigid stop with restitution e < 1 hits it infinitely often in a finite
time. Let w be the velocity of return after an impact at the time t, and a > 0 the acceleration that
presses. The time of flight, 2 w/a + ..., and the next velocity of return, e w + ..., are analytic
functions of t and w about w = 0, since the impact is the zero of (distance)/(time), whose slope is
-a/2. So the map of one impact to the next is analytic about the line w = 0, leaves each of its
points where it is, and shrinks across it by exactly e: by Koenigs' theorem on each curve of points
with one limit,

    t_n = T - c_1 e^n - c_2 e^(2n) - c_3 e^(3n) - ...

Richardson's extrapolation with the known ratios e, e², e³, ... takes one power away after the
other. What is left after n impacts falls like e^(n²/2): the digits grow with the square of the
number of impacts, while without extrapolation each impact adds the same log10 1/e.
"""

from collections.abc import Iterator

from mpmath import mpf

MOST_IMPACTS = 300


def accumulation(times: Iterator[mpf], restitution: mpf, tolerance: mpf) -> mpf:
    """Limit of the times of impacts, as soon as two extrapolations agree to the tolerance."""
    row: list[mpf] = []
    for count, time in enumerate(times):
        power, newer = mpf(1), [time]
        for older in row:
            power *= restitution
            newer.append((newer[-1] - power * older) / (1 - power))
        if count > 2 and abs(newer[-1] - row[-1]) <= tolerance:
            return newer[-1]
        if count > MOST_IMPACTS:
            break
        row = newer
    raise ArithmeticError(f"a chatter has no limit after {MOST_IMPACTS} impacts")
