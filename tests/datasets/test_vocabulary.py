"""Every output variable has dims, units and a meaning."""

from __future__ import annotations

import pytest

from vibroimpact.datasets.variable import PARTS, along, each, integer
from vibroimpact.datasets.vocabulary import NAMED_DIMS, VARIABLES


def test_dims_units_and_meaning_of_each():
    for name, known in VARIABLES.items():
        assert known.units, name
        assert known.long_name, name
        assert known.dims, name
        assert known.part in ("", *PARTS), name


@pytest.mark.parametrize(
    ("name", "may", "may_not"),
    [
        ("displacement", ["time", "time mass", "mass time"], ["", "time stop", "event", "gap"]),
        ("event_deformation", ["event stop", "event"], ["event mass", "stop", "event time"]),
        (
            "impacts",
            ["stop", "direction frequency stop", "start gap stops.stiffness stop", "gap attractor"],
            ["record scale stop", "frequency direction stop", "start time stop", "point point"],
        ),
        ("eta_d", ["sample direction frequency"], ["direction sample frequency"]),
        ("peak_force", ["gap stops.stiffness stop", "record scale rig gap", "fractile scale"], []),
        ("fitted_probability", ["scale", "scale gap", "scale gap link"], ["scale link mass", ""]),
        ("first_order", ["record scale link uncertain_parameter"], ["uncertain_parameter record"]),
        ("monodromy", ["component_after component_before"], ["component_before component_after"]),
        ("free_displacement_excursion", ["frequency", "rig frequency"], ["direction frequency"]),
    ],
)
def test_which_dims_a_variable_may_have(name: str, may: list[str], may_not: list[str]):
    for dims in may:
        assert VARIABLES[name].has_dims(dims.split(), NAMED_DIMS), dims
    for dims in may_not:
        assert not VARIABLES[name].has_dims(dims.split(), NAMED_DIMS), dims


def test_dims_are_declared_for_several_variables_at_once():
    by_name = along(each(("", "point"), "exponent"), one=integer("a"), other=integer("b"))
    assert [variable.dims for variable in by_name.values()] == [("exponent", "point exponent")] * 2
