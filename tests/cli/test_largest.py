"""The largest of each that a sweep meets, as its summary tells it."""

from __future__ import annotations

import json

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.datasets.stops import quantity
from vibroimpact.facts import largest
from vibroimpact.model import GRAVITY

COMMAND = "sweep"
BUILDING = """
[oscillator]
mass = "5000 t"
isolator = { period = "2.5 s", damping_ratio = 0.15 }
right = { stiffness = "500 MN/m", damping = "5 MN s/m", gap = "300 mm" }
[excitation]
amplitude = "0.12 g"
[sweep]
frequencies = [0.3, 0.4, 0.5]
"""
WALL = BUILDING.replace(
    'stiffness = "500 MN/m", damping = "5 MN s/m"', 'kind = "rigid", restitution = 0.5'
)


@pytest.mark.full
def test_a_building_in_millimetres_g_and_meganewtons(run, tmp_path):
    (tmp_path / "building.toml").write_text(BUILDING)
    code, out, errors = run("building.toml", "--physical")
    assert (code, errors) == (0, "")
    data = vi.load(tmp_path / "out/building-sweep.nc")
    rows = {line.rsplit("  at ")[0].strip() for line in out.splitlines() if " Hz, " in line}
    for words, name, unit, symbol in (
        ("displacement to the right", "displacement_max", 1e-3, "mm"),
        ("displacement to the left", "displacement_min", -1e-3, "mm"),
        ("absolute acceleration", "peak_acceleration", GRAVITY, "g"),
        ("force of the right stop", "peak_force.right", 1e6, "MN"),
    ):
        values = quantity(data, name).values / unit
        line = next(row for row in rows if row.startswith(words))
        number, suffix = line.removeprefix(words).split()
        assert suffix == symbol
        assert float(number) == pytest.approx(values.max(), rel=5e-4)
    assert not [row for row in rows if row.startswith(("force of the left", "impulse"))]
    assert "e+" not in out


def test_the_width_of_a_column(run, tmp_path):
    frequencies = ("B2-G1-A3", "--frequencies", "1Hz,2Hz")
    assert run(*frequencies, "--figure", "pdf", "--figure-width", "86mm")[0] == 0
    page = (tmp_path / "out/B2-G1-A3-sweep.pdf").read_bytes()
    box = page.split(b"/MediaBox [ ")[1].split(b" ]")[0].split()
    assert float(box[2]) == pytest.approx(86.0 / 25.4 * 72.0, abs=0.01)
    for width, error in (("86", "--figure-width: 86 m"), ("3s", "--figure-width: '3s'")):
        code, _, errors = run(*frequencies, "--figure-width", width)
        assert code != 0
        assert error in errors
        assert errors.count("\n") == 1


def test_as_json_in_si_units(run, tmp_path):
    (tmp_path / "wall.toml").write_text(WALL)
    code, out, _ = run("wall.toml", "--json")
    assert code == 0
    facts = json.loads(out)["largest"]
    data = vi.load(tmp_path / "out/wall-sweep.nc")
    assert "peak_force.right" not in facts  # an impact has no finite one
    one = facts["peak_impulse.right"]
    assert one["value"] == pytest.approx(
        float(data["peak_impulse"].sel(stop="right").max()), rel=1e-9
    )
    at = (
        data["peak_impulse"]
        .sel(stop="right")
        .sel(frequency=one["frequency"], direction=one["direction"])
    )
    assert float(at) == one["value"]
    assert np.isinf(data["peak_force"].sel(stop="right").max())


def test_of_what_is_the_same_to_rounding_the_forward_sweep_is_named():
    rig = vi.Oscillator(550, vi.Isolator(26.8e3, 1.1e3))
    data = vi.sweep(vi.Rig(rig, 0.5), [0.9, 1.1, 1.5])
    more = xr.where(data["direction"] == "backward", 1.0 + 1e-12, 1.0)
    for name in ("displacement_max", "peak_acceleration"):
        data[name] = data[name] * more
    facts = largest.facts(data)
    assert [facts[name]["direction"] for name in ("displacement_max", "peak_acceleration")] == [
        "forward",
        "forward",
    ]
    assert set(facts) == {"displacement_max", "displacement_min", "peak_acceleration"}
