"""A stop whose class gives a formula: its fields and one line."""

from __future__ import annotations

import inspect
from typing import Annotated, Any, ClassVar

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.quantities import LENGTH, STIFFNESS, quantity
from vibroimpact.model.stops import Bumper, FormulaStop, StopLaw
from vibroimpact.model.validation import Accepts, Model


class DraggedBumper(FormulaStop):
    """Force k d + c d² v."""

    kind: ClassVar[str] = "dragged"
    formula: ClassVar[str] = "stiffness*d + drag*d**2*v"

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    drag: Annotated[float, Accepts(quantity("N s/m^3"), minimum=0.0)]
    gap: Annotated[float, Accepts(LENGTH)] = 0.0


class Side(Model):
    stop: Annotated[StopLaw | None, Kinds(Bumper, DraggedBumper)] = None


TABLE: dict[str, Any] = {
    "kind": "dragged",
    "stiffness": "40 kN/m",
    "drag": "5 kN s/m^3",
    "gap": "7.5 mm",
}


def read(**changes: Any) -> StopLaw:
    stop = Side.model_validate({"stop": TABLE | changes}).stop
    assert stop is not None
    return stop


def test_it_is_read_from_a_table_and_written_as_one() -> None:
    stop = read()
    assert dict(stop) == {"stiffness": 4e4, "drag": 5e3, "gap": 7.5e-3}
    assert Side(stop=stop).model_dump()["stop"] == {"kind": "dragged", **dict(stop)}
    assert stop.summary() == "dragged, stiffness 40 kN/m, drag 5 kN s/m³, gap 7.5 mm"
    with pytest.raises(vi.InputError, match=r"stop\.drag: -1\.0 is less than 0"):
        read(drag=-1.0)


def test_the_engine_follows_it_as_the_law_that_a_user_writes() -> None:
    law = vi.Law("max(k*d + c*d**2*v, 0)", "7.5 mm", k="40 kN/m", c="5 kN s/m^3")
    assert read().engine_numbers() == law.engine_numbers()


def test_its_fields_are_arguments_in_their_order() -> None:
    stop = DraggedBumper("40 kN/m", "5 kN s/m³", gap="7.5 mm")
    assert stop == read()
    assert str(inspect.signature(DraggedBumper)) == "(stiffness, drag, gap=0.0)"
    assert "pydantic" not in (inspect.getdoc(DraggedBumper.__init__) or "")
    with pytest.raises(vi.InputError, match=r"^stiffness: passed twice, by position and by name"):
        DraggedBumper(1.0, 2.0, 0.1, stiffness=3.0)
    with pytest.raises(vi.InputError, match=r"4 values .* by position.*stiffness, drag and gap"):
        DraggedBumper(1.0, 2.0, 0.1, 3.0)


@pytest.mark.parametrize("gap", [0.0, 0.01, -0.01])
def test_another_law_of_the_same_force_is_made_of_its_units(gap: float) -> None:
    stop = DraggedBumper.like(1e3, 2e-3, gap, 0.6, 7.0, 550.0)
    assert stop is not None
    assert stop.gap == gap
    assert stop.static_force(2e-3) == pytest.approx(1e3, rel=1e-14)
    # The force of the drag is that of the spring at the speed omega d.
    assert stop.force([2e-3], [7.0 * 2e-3])[0] == pytest.approx(2e3, rel=1e-14)


def test_units_of_its_fields_are_written_and_read() -> None:
    drag = quantity("N s/m^3")
    assert (drag.units, drag.symbol) == ("N s m-3", "N s/m³")
    assert quantity("N/m^1.5").units == "N/m^1.5"
    with pytest.raises(ValueError, match="'lb/s' is not a product of powers of kg, m, s"):
        quantity("lb/s")


def test_it_pushes_and_never_pulls() -> None:
    stop = read()
    assert stop.static_force(2e-3) == pytest.approx(80.0, rel=1e-15)
    assert (stop.linear, stop.rigid, stop.spring_and_dashpot) == (False, False, None)
    d, v = np.array([0.0, 2e-3, 2e-3]), np.array([1.0, 1.0, -1e4])
    assert stop.force(d, v).tolist() == pytest.approx([0.0, 80.02, 0.0], rel=1e-14)


def test_a_power_of_the_deformation_keeps_its_own_numbers() -> None:
    class Cubic(FormulaStop):
        kind: ClassVar[str] = "cubic"
        formula: ClassVar[str] = "stiffness*d**3"
        stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
        gap: Annotated[float, Accepts(LENGTH)]

    made = Cubic(stiffness=9.0, gap=0.1).engine_numbers()
    assert made == vi.PowerBumper(9.0, 0.1, 3.0).engine_numbers()


def test_a_formula_with_a_name_that_is_not_a_field_is_refused() -> None:
    class Misspelt(FormulaStop):
        kind: ClassVar[str] = "misspelt"
        formula: ClassVar[str] = "stifness*d"
        stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
        gap: Annotated[float, Accepts(LENGTH)]

    with pytest.raises(vi.InputError, match="stifness"):
        Misspelt(stiffness=9.0, gap=0.1)


def test_damping_of_a_contact_at_its_begin_is_that_of_the_formula() -> None:
    """Whatever the fields are called."""

    class Damped(FormulaStop):
        kind: ClassVar[str] = "damped"
        formula: ClassVar[str] = "stiffness*d + viscous*v + damping*d**2*v"

        stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
        viscous: Annotated[float, Accepts(quantity("N s/m"), minimum=0.0)]
        damping: Annotated[float, Accepts(quantity("N s/m^3"), minimum=0.0)]
        gap: Annotated[float, Accepts(LENGTH)]

    stops: list[tuple[Any, float]] = [
        (Damped(4e4, 30.0, 5e3, 0.01), 30.0),
        (read(), 0.0),
        (Bumper(4e4, 50.0, 0.01), 50.0),
        (vi.Law("max(k*d + c*v, 0)", 0.01, k=4e4, c=20.0), 20.0),
        (vi.PowerBumper(4e4, 0.01, dissipation=1.0), 0.0),
        (vi.JankowskiBumper(4e4, 0.01, 0.5, 1.0), 0.0),
    ]
    for stop, expected in stops:
        assert stop.initial_damping == pytest.approx(expected), stop
        assert stop.is_stop
    assert not vi.Isolator(1.0, 1.0).is_stop
