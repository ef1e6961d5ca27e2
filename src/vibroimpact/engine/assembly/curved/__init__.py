"""Several masses with curved laws, by Taylor series of all masses jointly, link by link.

Rows
    The stops, then the curved parts of the links (`laws`): what has branches of its own is a row of
    its own, so that a link may be several. A row has the two ends of its link. The number that a
    Kelvin–Voigt stop has for its deformation is the memory z of a hysteretic row, with the sign of
    s = u_right − u_left, and of a pushing stop the speed at which it was met, while it is touched.
Mode
    A bit for each row, as of linear stops: a stop that is touched, a link that friction holds. Then
    two for each row with branches: whether s′ < 0, and the side: whether z (of a formula: s) < 0,
    or whether a bilinear spring yields.
Tape
    A law is the formula of `engine.series.laws`. Run once with symbols (`tape`), it leaves a list
    of operations on series; `terms` goes through it for each order. All laws are compiled once. Of
    few masses with polynomial links code without loops is made (`emitted`), four times as fast.
Step
    A series of order 24, by code 27, in a fixed unit of time; its length by the last two
    coefficients, certified by the equation of motion at its end, as in the flow of one mass
    (`step`).
Events
    What is watched of each row are series that may only fall to zero (`watch`, `happen`), found by
    `assembly.roots`. A turn of a law's branch is an event that nothing else sees.
Sticking
    Held ends are a constraint beside those of resting stops. Where several would be held, the one
    that is overloaded most, by its share of F_c, slides first (`decide`).
Powers
    A power of a deformation or of a velocity has no series where it begins. Where its work is a
    share of 2⁻⁶⁰ of the motion's it is left out; beside that steps are short.
"""
