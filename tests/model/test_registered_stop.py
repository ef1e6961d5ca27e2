"""A stop that a formula gives is a class and its entry in `STOPS`; the rest follows."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest

SCRIPT = """
import importlib.util, json, sys, types
from pathlib import Path
from typing import Annotated, ClassVar

# The registry must have the stop before the other modules of the model read it.
(folder,) = importlib.util.find_spec("vibroimpact").submodule_search_locations
bare = types.ModuleType("vibroimpact.model")
bare.__path__ = [str(Path(folder, "model"))]
sys.modules["vibroimpact.model"] = bare
from vibroimpact.model import stops
from vibroimpact.model.law_registry import Kinds
from vibroimpact.model.quantities import LENGTH, STIFFNESS, quantity
from vibroimpact.model.validation import Accepts


class DragBumper(stops.FormulaStop):
    kind: ClassVar[str] = "drag"
    formula: ClassVar[str] = "stiffness*d + drag*d**2*v"

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    drag: Annotated[float, Accepts(quantity("N s/m^3"), minimum=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]


stops.STOPS = Kinds(*stops.STOPS.classes.values(), DragBumper)
del sys.modules["vibroimpact.model"]

import numpy as np
import vibroimpact as vi
from vibroimpact.explorer import change, state
from vibroimpact.explorer.controls import controls
from vibroimpact.model.parameters import parameter

isolator = vi.Isolator("26.8 kN/m", "1.1 kN s/m")
table = {"kind": "drag", "stiffness": "400 kN/m", "drag": "500 MN s/m^3", "gap": "7.5 mm"}
rig = vi.Rig(vi.Oscillator("550 kg", isolator, table, table), "0.05 g", 1.3)
law = vi.Law("max(k*d + c*d**2*v, 0)", "7.5 mm", k="400 kN/m", c="500 MN s/m^3")
by_user = vi.Rig(vi.Oscillator("550 kg", isolator, law, law), "0.05 g", 1.3)
data, same = vi.steady(rig), vi.steady(by_user)
first = state.begin("B2-G1-A3")
knobs = controls(change.with_law(first, "stops", "drag"), first)
try:
    parameter("proportional_stiffness", rig).vary(rig, 1e5)
except vi.InputError as error:
    refused = str(error)
print(json.dumps({
    "differs": [
        str(name) for name, one in data.data_vars.items()
        if one.dtype.kind in "fiub" and not np.array_equal(one, same[name], equal_nan=True)
    ],
    "impacts": data["impacts"].values.tolist(),
    "units": parameter("stops.drag", rig).units,
    "varied": str(parameter("right.drag", rig).vary(rig, 0.0).oscillator.right),
    "knob": [one.text for one in knobs if one.path == "stops.drag"],
    "refused": refused,
}))
"""


@pytest.fixture(scope="module")
def answers() -> dict[str, Any]:
    command = [sys.executable, "-c", SCRIPT]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def test_its_motion_is_that_of_the_formula_to_the_bit(answers: dict[str, Any]) -> None:
    assert answers["impacts"] == [1.0, 1.0]
    assert answers["differs"] == []


def test_its_numbers_are_parameters_with_units_and_knobs(answers: dict[str, Any]) -> None:
    assert answers["units"] == "N s m-3"
    assert answers["varied"] == "DragBumper(stiffness=400 kN/m, drag=0 N s/m³, gap=7.5 mm)"
    (text,) = answers["knob"]
    assert text.endswith("N s/m³")


def test_what_belongs_to_bumpers_refuses_it(answers: dict[str, Any]) -> None:
    assert "the right stop has the law 'drag'; use 'stops.right.stiffness'" in answers["refused"]
