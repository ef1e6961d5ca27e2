"""Nonsense in every argument of every public function ends in one line, or is of use after all."""

from __future__ import annotations

import random
import warnings
from pathlib import Path

import pytest

import arguments
import vibroimpact as vi
from samples import sample

LONGEST = 320
"""Letters of a message; no path stands in one here."""

QUICK = [
    "BilinearIsolator",
    "BoucWenIsolator",
    "Bumper",
    "Dimensionless",
    "ExponentialIsolator",
    "FrictionIsolator",
    "Harmonic",
    "Isolator",
    "JankowskiBumper",
    "Oscillator",
    "Periodic",
    "PolynomialIsolator",
    "PowerBumper",
    "Record",
    "Record.read",
    "Rig",
    "RigidStop",
    "State",
    "Thresholds",
    "compare_fits",
    "contacts",
    "exceedance",
    "fitted",
    "floor_record",
    "fractiles",
    "from_dimensionless",
    "impact_section",
    "laboratory.case",
    "load",
    "next_test",
    "one_by_one",
    "orbit",
    "progress_bar",
    "read_measurement",
    "response_spectrum",
    "save",
    "seismic_response",
    "simulate",
    "spectrum",
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
    for name, (_, given) in made.items():
        if "." not in name:
            assert set(given) == set(arguments.parameters(name)), name


@pytest.mark.parametrize("name", QUICK)
def test_nonsense_is_one_line(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    function, given = arguments.calls(folder)[name]
    labels = [label for label in arguments.NONSENSE if name not in RUNS or label not in ENDLESS]
    tried = [(field, label) for field in given for label in labels]
    for field, label in random.Random(name).sample(tried, min(len(tried), sample(10_000, 60))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                function(**{**given, field: arguments.NONSENSE[label]})
            except vi.InputError as error:
                message = str(error)
                assert message.isprintable(), (field, label)
                assert len(message) <= LONGEST, (field, label)
                assert "x" * 200 not in message, (field, label)
            except Exception as error:
                pytest.fail(f"{name}({field}={label}): {type(error).__name__}: {error}")
