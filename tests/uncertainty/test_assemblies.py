"""Random assemblies: draws by path, and the sensitivity of a response."""

from __future__ import annotations

import functools

import numpy as np
import pytest

import vibroimpact as vi
from response.test_assembly_motion import QUAKE
from stability.test_assembly_orbits import STOPS, alone, frame
from vibroimpact import figures


def test_an_ensemble_of_one_mass_is_the_oscillators() -> None:
    paths = ({"gap": "normal:5%", "isolator.stiffness": "uniform:10%"},
             {"gap": "normal:5%", "links.isolator.stiffness": "uniform:10%"})  # fmt: skip

    def response(rigs: list[vi.Rig]) -> object:
        return vi.lyapunov_exponents(rigs, [1.3], 40, transient=20)

    one, several = (
        vi.ensemble(alone(STOPS["bumpers"], assembled=assembled), drawn, response, 8)
        for assembled, drawn in zip((False, True), paths, strict=True)
    )
    np.testing.assert_array_equal(several["gap"], one["gap"])
    np.testing.assert_array_equal(several["links.isolator.stiffness"], one["isolator.stiffness"])
    np.testing.assert_allclose(several["effective_damping"], one["effective_damping"], rtol=1e-9)
    assert several["links.isolator.stiffness"].attrs["units"] == "N m-1"


def test_demands_of_random_frames_and_their_sensitivity() -> None:
    response = functools.partial(
        vi.demands, records=vi.Record(QUAKE.acceleration[:80], 0.02), tail=0
    )
    paths = {"masses.roof": "normal:5%", "links.isolator.stiffness": "lognormal:0.1"}
    drawn = vi.ensemble(frame(), paths, response, 8)
    assert set(drawn["peak_drift"].dims) == {"sample", "record", "scale", "link"}
    at = drawn.isel(sample=3)
    roof, stiffness = float(at["masses.roof"]), float(at["links.isolator.stiffness"])
    assembly = frame()
    isolator = vi.Link("ground", "base", vi.Isolator(stiffness, 900.0))
    again = response(
        assembly.replace(
            masses={"base": 300.0, "roof": roof}, links={**assembly.links, "isolator": isolator}
        )
    )
    np.testing.assert_allclose(at["peak_drift"], again["peak_drift"], rtol=1e-12)
    indices = vi.sensitivity(frame(), paths, response, "peak_drift", 8)
    assert indices["total_order"].sizes["uncertain_parameter"] == 2
    assert indices["total_order"].sizes["link"] == 2
    with pytest.raises(vi.InputError, match="'damping_ratio' is not a parameter of this rig"):
        vi.ensemble(frame(), {"damping_ratio": "normal:5%"}, response, 8)
    with pytest.raises(vi.InputError, match="amplitude requires sinusoidal shaking"):
        vi.ensemble(frame(), {"amplitude": "normal:5%"}, response, 8)


def test_one_mass_or_one_stop_of_a_response() -> None:
    rig = vi.Rig(frame(vi.Bumper(4e4, 200.0, 0.012)), vi.Harmonic("1 m/s2", 0.9))
    response = functools.partial(vi.sweeps, frequencies=[0.8, 0.9], directions="forward")
    paths = {"masses.roof": "normal:5%", "gap": "normal:5%"}
    arguments = (rig, paths, response)
    whole = vi.sensitivity(*arguments, "peak_displacement", 8)["total_order"]
    roof = vi.sensitivity(*arguments, "peak_displacement.roof", 8)
    np.testing.assert_array_equal(roof["total_order"], whole.sel(mass="roof"))
    assert vi.sensitivity(*arguments, "peak_force.right", 8)["mean"].attrs["units"] == "N"
    assert "mass" not in roof.dims
    with pytest.raises(vi.InputError, match=r"quantity: 'peak_displacement\.attic'"):
        vi.sensitivity(*arguments, "peak_displacement.attic", 8)
    drawn = figures.sensitivity_bars(roof.isel(direction=0, frequency=0))
    labels = [text.get_text() for text in drawn.get_xticklabels()]
    assert any("roof" in label for label in labels), labels
    bands = figures.resonance_bands(vi.ensemble(*arguments, 8), quantities=["peak_displacement"])
    assert [ax.get_ylabel().replace("\n", " ") for ax in bands] == [
        f"{mass}: largest displacement (mm)" for mass in ("base", "roof")
    ]
