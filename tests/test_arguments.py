"""Nonsense in every argument of every public function ends in one line, or is of use after all."""

from __future__ import annotations

import random
import warnings
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import arguments
import vibroimpact as vi
from formula_stops import FORMULA_STOPS
from samples import sample

LONGEST = 320
"""Letters of a message; no path stands in one here."""

QUICK = [
    "Assembly",
    "Assembly.from_matrices",
    "BilinearIsolator",
    "BoucWenIsolator",
    "Bumper",
    *sorted({law.__name__ for law in FORMULA_STOPS.values()} & set(vi.__all__)),
    "Dimensionless",
    "ExponentialIsolator",
    "FrictionIsolator",
    "Harmonic",
    "Isolator",
    "JankowskiBumper",
    "Law",
    "Link",
    "ModalDamping",
    "Oscillator",
    "Periodic",
    "PolynomialIsolator",
    "PowerBumper",
    "RayleighDamping",
    "Record",
    "Record.read",
    "Rig",
    "RigidStop",
    "State",
    "Thresholds",
    "ZenerBumper",
    "chain",
    "compare_fits",
    "contacts",
    "exceedance",
    "fitted_rig",
    "floor_record",
    "fractiles",
    "from_dimensionless",
    "impact_section",
    "laboratory.case",
    "load",
    "modes",
    "next_test",
    "for_each_rig",
    "orbit",
    "progress_bar",
    "read_measurement",
    "response_spectrum",
    "save",
    "seismic_response",
    "simulate",
    "fourier_spectrum",
    "steady",
    "stroboscopic_section",
    "sweep",
    "to_dimensionless",
    "to_table",
    "totals",
]
"""Calls so short that each argument is tried with everything."""


RUNS = ("orbit", "seismic_response", "simulate", "steady", "sweep")
ENDLESS = ("large whole number", "tiny", "huge")
"""As a number of cycles or as a frequency: such a run is possible, and as long as it says."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("arguments")
    arguments.write_files(path)
    return path


def test_every_public_function_has_a_valid_call(folder: Path) -> None:
    made = arguments.calls(folder)
    assert set(arguments.public()) - {"explore"} <= set(made)
    for name, (_, keywords) in made.items():
        if "." not in name and name != "Law":  # whose numbers have any names
            assert set(keywords) == set(arguments.parameters(name)), name


@pytest.mark.parametrize("name", QUICK)
def test_nonsense_is_one_line(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    function, keywords = arguments.calls(folder)[name]
    labels = [label for label in arguments.NONSENSE if name not in RUNS or label not in ENDLESS]
    tried = [(field, label) for field in keywords for label in labels]
    for field, label in random.Random(name).sample(tried, min(len(tried), sample(10_000, 25))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                function(**{**keywords, field: arguments.NONSENSE[label]})
            except vi.InputError as error:
                message = str(error)
                assert message.isprintable(), (field, label)
                assert len(message) <= LONGEST, (field, label)
                assert "x" * 200 not in message, (field, label)
            except Exception as error:
                pytest.fail(f"{name}({field}={label}): {type(error).__name__}: {error}")


@pytest.mark.parametrize("wrong", [5, "x", int, [print]])
def test_a_progress_that_is_not_a_function_is_one_line(wrong, folder, monkeypatch):
    monkeypatch.chdir(folder)
    for function, keywords in arguments.calls(folder).values():
        if "progress" in keywords:
            with pytest.raises(vi.InputError, match=r"^progress: "):
                function(**{**keywords, "progress": wrong})


COUNTS = ("seed", "random", "samples", "window", "max_cycles", "max_events", "exponent_cycles")


@pytest.mark.parametrize("wrong", [0.5, "x", -1, None, [1], 10**400])
@pytest.mark.parametrize("name", ["bifurcation_diagram", "coexisting_motions", "steady"])
def test_a_count_that_is_not_one_is_one_line(name, wrong, folder):
    function, keywords = arguments.calls(folder)[name]
    for field in set(COUNTS) & set(keywords):
        with pytest.raises(vi.InputError, match=rf"^{field}: .* whole number"):
            function(**{**keywords, field: wrong})


WRONG = [
    ("directions", 5),
    ("directions", Path("up")),
    ("section", {"a": 1}),
    ("log", np.array(["a", "b"])),
    ("log", None),
    ("vary", {1.4, 1.6}),
    ("vary", {"frequency": {1.4, 1.6}}),
    ("vary", {"frequency": range(10**9)}),
    ("random", 10**12),
]


@pytest.mark.parametrize(("field", "wrong"), WRONG)
def test_what_a_diagram_cannot_use_is_one_line(field, wrong, folder):
    function, keywords = arguments.calls(folder)["bifurcation_diagram"]
    with pytest.raises(vi.InputError, match=rf"^{field}"):
        function(**{**keywords, field: wrong})


@pytest.mark.parametrize(
    ("name", "field", "wrong"),
    [
        ("Record.from_displacement", "step", 1e-320),
        ("demands", "vary", {"gap": range(10**9)}),
        ("demands", "vary", {"gap": np.array(5.0)}),
        ("demands", "scales", range(1, 10**9)),
        ("design_chart", "records", np.array(5.0)),
        ("design_chart", "tail", 10**12),
        ("bifurcation_diagram", "steps", 10**12),
        ("fit_report", "comparison", [1.0]),
        ("fit_report", "folder", 5),
        ("fit_report", "figure", np.eye(30)),
        ("fit_report", "folder", "nowhere"),
        ("identify", "robust", np.eye(2)),
        ("identify", "profiles", "no"),
        ("least_acceleration", "seed", 0.5),
        ("lyapunov_exponents", "rigs", range(10**9)),
        ("lyapunov_exponents", "rigs", np.array(5.0)),
        ("required_gap", "records", range(10**9)),
        ("resonance_diagram", "basins", 5),
        ("resonance_diagram", "vary", np.eye(2)),
        ("scenario_map", "spacing", "log"),
        ("resonance_diagram", "starts", 10**12),
        ("scenario_map", "step", 1e-300),
        ("ensemble", "method", xr.Dataset({"a": 1})),
        ("ensemble", "response", int),
        ("sensitivity", "quantity", [1.0]),
        ("sensitivity", "resamples", 10**12),
        ("sensitivity", "draws", 2**40),
    ],
)
def test_what_cannot_be_used_is_one_line(name, field, wrong, folder, monkeypatch):
    monkeypatch.chdir(folder)
    function, keywords = arguments.calls(folder)[name]
    with pytest.raises(vi.InputError, match=rf"^{field}"):
        function(**{**keywords, field: wrong})


def test_a_value_without_a_text_of_its_own_is_named_by_its_type():
    class Odd:
        def __repr__(self):
            raise RuntimeError

    with pytest.raises(vi.InputError, match="mass: a Odd"):
        vi.Oscillator(Odd(), vi.Isolator(1.0, 1.0))


OSCILLATOR = vi.Oscillator(1.0, vi.Isolator(100.0, 1.0), right=vi.Bumper(1e4, 5.0, 0.01))
SHAKING = vi.Harmonic(1.0, 1.0)


@pytest.mark.parametrize("wrong", [5, "x", np.ones((3, 3)), [1.0]])
@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("vary", lambda v: vi.lyapunov_exponents(vi.Rig(OSCILLATOR, 1.0), [1.0], vary=v)),
        ("vary", lambda v: vi.demands(OSCILLATOR, [vi.Record([0.0, 1.0], 0.01)], vary=v)),
        (
            "limits",
            lambda v: vi.least_acceleration(
                vi.Rig(OSCILLATOR, SHAKING), {"gap": (0.01, 0.05)}, limits=v
            ),
        ),
        ("starts", lambda v: vi.coexisting_motions(vi.Rig(OSCILLATOR, SHAKING), starts=v)),
        (
            "starts",
            lambda v: vi.bifurcation_diagram(
                vi.Rig(OSCILLATOR, SHAKING), vary={"frequency": (1.0, 1.1)}, steps=2, starts=v
            ),
        ),
    ],
)
def test_what_is_no_mapping_is_one_line(field, call, wrong):
    with pytest.raises(
        vi.InputError, match=rf"^{field}: .*; pass a dict of .* by .*, such as {{.*}}$"
    ):
        call(wrong)


def test_what_is_no_list_of_saddles_and_no_fit_is_one_line(tmp_path):
    with pytest.raises(vi.InputError, match=r"^saddles: 5 is not a list"):
        vi.manifolds(vi.Rig(OSCILLATOR, SHAKING), saddles=5, displacement=(-1, 1), velocity=(-1, 1))
    with pytest.raises(vi.InputError, match=r"^result: this is not a fit"):
        vi.fit_report(5, tmp_path)
