"""Where a motion starts."""

import math

import numpy as np
import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import State


def test_everything_has_a_default():
    state = State()
    assert (state.displacement, state.velocity) == (0.0, 0.0)
    assert state.deformation == {}
    assert state.phase is None
    assert state.contact is None


def test_positions_and_text():
    state = State("2 mm", "-0.1 m/s", {"left": "3 mm", "right": "1 mm"}, "90 deg", 1)
    assert state == State(0.002, -0.1, {"right": 0.001, "left": 0.003}, math.pi / 2, 1)


def test_deformations_are_positive_on_both_sides():
    for side in ("right", "left"):
        with pytest.raises(InputError, match=rf"^deformation\.{side}: '-1 mm' is less than 0"):
            State(deformation={side: "-1 mm"})
    with pytest.raises(InputError, match=r"^deformation\.top: this is not a stop of an Osc"):
        State(0.0, 0.0, {"top": 0.0})
    with pytest.raises(InputError, match=r"^deformation: 0.1 is not a mapping from stops; pass "):
        State(deformation=0.1)
    assert State(deformation={"right": 1.0, "left": None}) == State(0.0, 0.0, {"right": 1.0})
    assert State(deformation={"moat": 1.0}).deformation == {"moat": 1.0}  # of an assembly


@pytest.mark.parametrize(
    "contact", [-1, 0, 1, 2, np.int8(-1), np.int64(1), 1.0, np.float64(0.0), np.array(1)]
)
def test_a_contact_from_a_dataset_is_taken(contact):
    state = State(contact=contact)
    assert state.contact == contact
    assert type(state.contact) is int


@pytest.mark.parametrize("contact", [3, -2, 0.5, True, False, np.True_, "1", math.nan, [1]])
def test_a_contact_is_a_side(contact):
    with pytest.raises(InputError, match=r"^contact: .* 1 \(right stop\) or 2 \(both stops\)$"):
        State(contact=contact)


@pytest.mark.parametrize("name", ["displacement", "velocity", "deformation", "phase"])
@pytest.mark.parametrize("bad", [math.nan, math.inf, True, "1 kg", ""])
def test_nothing_else_is_taken(name, bad):
    with pytest.raises(InputError, match=f"^{name}: "):
        State(**{name: bad})


@pytest.mark.parametrize("name", ["displacement", "velocity"])
def test_displacement_and_velocity_are_known(name):
    with pytest.raises(InputError, match=f"^{name}: None is not a number"):
        State(**{name: None})


def test_str():
    assert str(State("2 mm", 0.1, contact=1)) == (
        "State(displacement=2 mm, velocity=100 mm/s, phase=None, contact=1)"
    )
