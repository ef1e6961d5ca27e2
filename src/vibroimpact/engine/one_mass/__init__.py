"""What the flows of one mass between two stops have in common.

A motion of one mass is a value (`engine.motion`) that the compiler keeps in registers. Only these
flows know it: `table` unpacks it from the vector of a state and packs it again, once for a call.
The motion itself is computed by `linear`, `taylor` and `yielding`, with the stops of `stops`; what
they all answer is declared in `forces` and `motions`. Observers that need more than channels are
here, one file each.

Modules: `forces`, `motions`, `advance` (what a flow answers), `table` (functions of `engine.flow`),
`channels` (what is observed), `extremes`, `margin` (distance from grazing), `measure` (phases),
`demand` (of records), `record` and `record_layout` (written down), `tangent` and `disturbed_events`
(disturbances).
"""
