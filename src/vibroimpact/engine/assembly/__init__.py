"""The flow of several masses with linear links, between any number of stops.

State
    y = (u, v, w, 1) with the displacements u and velocities v of n masses, and the forcing w: the
    sine and cosine of each harmonic, or a record's acceleration and slope. y′ = A y within a
    contact mode, so that resonance, free masses and records need no special case. Besides, each
    Kelvin–Voigt stop has its deformation: while pressed it changes with the closing displacement,
    while free it decays as exp(−κ t), κ = stiffness / damping. It is a state of its own, because as
    a difference of displacements it would lose digits beside a large gap.
Mode
    A bit for each stop: a Kelvin–Voigt stop that is pressed, a rigid one on which the bodies rest.
Watched functions
    One for each stop, which may only fall to zero: the clearance gap − (u_left − u_right) + δ of a
    free stop, the force of a pressed one. Zeros that an event leaves behind are known by
    construction (clearance after an impact: 1; after a release: 2, for its slope is zero, too;
    after rest: 3) and are set exactly.
Step
    h = 2.5 / ρ, where ρ bounds A in a scaled maximum norm, computed from row sums (`mode`).
    The Taylor series of the whole state then has at most 27 terms (`series`); the bound holds for
    its remainder, too. A watched function is made a polynomial of degree 15 in Bernstein form,
    whose signs prove that there is no root, or one (`roots`).
Tables
    Where modes are few and small, the watched functions and the state at any time are products of
    tables with y (`tables`), and leaps of up to 8 steps are proved to be free. Which modes have
    tables depends on the plan alone (those with few stops touched, as many as there is room for),
    and each section begins from the state alone, with the longest leap: a motion may be restarted
    at any section, bit by bit the same.
Events
    The earliest first; within 1e-12 of a step, the stop with the lower number (`events`).
    `ORDERED` counts impacts where this rule, and not the laws, decided: those at the same instant
    as another impact or rest that shares a mass.
Rest
    Newton's impacts; a chatter is completed at once where what is left of it is too short to matter
    (1e-6 of the times in which the state and the pressing force change). Bodies at rest move
    together, w·v′ = 0, until the force between them falls to zero; several rests are solved
    together. An impact on a resting body lets it be hit in turn.

Table of functions
    `table` has the functions of `engine.flow`: entries follow an assembly as they follow one mass.
    The motion between two calls is in the state, the last stretch in the plan, where observers
    (`channels`) read it. A step that ends without an event is `event.PASSED`.

Limits: 52 stops, the bits of a mode in a float. Free masses that fly far away lose the digits of
their links' deformations, which are differences of displacements.

Modules: `layout` (plan and state), `plan` (numpy description to a rig's vector, and to a plan),
`mode`, `acceleration`, `rates` (it as a matrix of the mode), `series`, `vectors`, `roots`,
`tables`, `events`, `advance` (stretch), `channels` (what is observed), `measures` (extremes),
`tangent`, `section` (states at a section), `free_motion` (in closed form), `table`, `stretches`
(measured), `record` (written down).
"""
