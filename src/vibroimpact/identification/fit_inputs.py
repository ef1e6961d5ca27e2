"""What a fit is given: tests with their rigs, whatever form they come in."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from vibroimpact.errors import InputError, in_one_line, shown
from vibroimpact.identification.curve_residuals import CurveTest
from vibroimpact.identification.history_residuals import HistoryTest
from vibroimpact.identification.least_squares import Test
from vibroimpact.measurements.read import as_measured
from vibroimpact.model.excitation import Harmonic, Periodic, Repeated
from vibroimpact.model.names import check_name
from vibroimpact.model.parameters import parameter
from vibroimpact.model.periodic_shaking import ANY_FREQUENCY, as_periodic
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.model.read_rig import as_rig
from vibroimpact.model.record import Record
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty, to_si

BASE = "the measured base"
"""Where the amplitude of a history is from whose base was measured."""
RIG = "the rig"
"""Where the amplitude is from if the data do not state it."""
_STATED = 1e-3
"""Share by which an amplitude that a file states may differ from that of the rig: it is rounded."""
_MEASURED = 0.02
"""The same share for an amplitude or a frequency that was measured."""


def tests_of(rig: Any, data: Any, noise: Any, window: int | None, steady: bool) -> list[Test]:
    """Read the tests, each with the rig and shaking that it begins from.

    Raises
    ------
    InputError
        If one of them cannot be used, or its amplitude is not known.
    """
    named = _named(data)
    tests: list[Test] = []
    for name, one in named.items():
        where = f"data[{name!r}]" if len(named) > 1 else "data"
        measured = as_measured(one, where)
        tested = as_rig(_of(rig, name, list(named), "rig"), oscillator_alone=True)
        share = _of(noise, name, list(named), "noise")
        share = None if share is None else to_si(share, DIMENSIONLESS, "noise", above=0.0)
        shaken, source = _shaken_rig(tested, measured, where)
        measured = measured.assign_attrs(amplitude_source=source)
        test: Test
        if measured.attrs["kind"] == "curves":
            test = CurveTest(name, measured, shaken, share)
        else:
            test = HistoryTest(name, measured, shaken, share, window, steady)
        test.data = test.data.assign_attrs(unused_shaking="\n".join(_unused(tested, test, source)))
        tests.append(test)
    return tests


def _named(data: Any) -> dict[str, Any]:
    """Tests by name: a file's is that of the file."""
    if isinstance(data, Mapping) and not isinstance(data, xr.Dataset):
        named = {check_name(name, "data"): one for name, one in data.items()}
    else:
        alone = isinstance(data, xr.Dataset | str | Path) or not isinstance(data, Sequence)
        items = [data] if alone else list(data)
        named = {}
        for i, one in enumerate(items, 1):
            source = one.attrs.get("source") if isinstance(one, xr.Dataset) else str(one)
            name = Path(source).stem if source and isinstance(one, xr.Dataset | str | Path) else ""
            name = in_one_line(name) or f"test {i}"
            named[name if name not in named else f"{name} {i}"] = one
    if not named:
        raise InputError("data: missing; pass at least one test, as a file or a dataset")
    return named


def _of(setting: Any, name: str, names: list[str], field: str) -> Any:
    """What belongs to one test: the same for all, one by name, or one by position."""
    if isinstance(setting, Mapping):
        if name not in setting:
            raise InputError(
                f"{field}: missing for the test {name!r}; pass a value for each test: "
                f"{', '.join(names)}"
            )
        return setting[name]
    if isinstance(setting, list):
        if len(setting) != len(names):
            raise InputError(
                f"{field}: {len(setting)} values for {len(names)} tests; pass one value per test"
            )
        return setting[names.index(name)]
    return setting


def _shaken_rig(rig: Rig, data: xr.Dataset, where: str) -> tuple[Rig, str]:
    """The rig with its shaking, and where that is from: the data, or else the rig."""
    chosen: Any = data.attrs.get("amplitude", _of_sweep(data))
    source = str(data.attrs.get("amplitude_source", "the data"))
    if chosen is None:
        chosen, source = rig.shaking, RIG
        if rig.amplitudes is not None:
            chosen = rig.amplitudes
    base = data.attrs["kind"] == "history" and "base_acceleration" in data
    if base:
        source = BASE
    if chosen is None and base:
        return Rig(rig.oscillator, Harmonic(1.0, 1.0)), source
    if chosen is None:
        raise InputError(
            f"rig: this is an Oscillator alone, and {where} does not state the excitation; pass "
            'the peak base acceleration, such as Rig(oscillator, "0.05 g")'
        )
    shaken, sizes = as_periodic(chosen, "shaking")
    if sizes is not None or not isinstance(shaken, Harmonic | Periodic):
        raise InputError(
            "shaking: a list of amplitudes is not accepted; pass one rig per test, such as "
            'rig={"test 1": rig_1, "test 2": rig_2}'
        )
    return Rig(rig.oscillator, shaken), source


def _of_sweep(data: xr.Dataset) -> Harmonic | None:
    """The sine of a computed sweep, which its dataset states; None of other data.

    Raises
    ------
    InputError
        If the sweep has one amplitude per frequency.
    """
    if data.attrs.get("created_by") != "vibroimpact.sweep":
        return None
    (rig,) = json.loads(data.attrs["parameters"])["rigs"]
    size = rig.get("amplitude")
    if isinstance(size, list):
        raise InputError(
            f"data: {len(size)} amplitudes, one per frequency of the sweep, but a fit needs a "
            "sweep of one amplitude; sweep the frequencies of each amplitude separately"
        )
    return (
        Harmonic(size, ANY_FREQUENCY, of=rig.get("of", "acceleration"))
        if isinstance(size, float)
        else None
    )


def _unused(rig: Rig, test: Test, source: str) -> list[str]:
    """Lines about the shaking of the rig that differs from that of the data, which is used."""
    own, used = rig.shaking, test.rig.periodic
    if own is None or not _is_sine(test):
        return []
    lines = []
    share = _MEASURED if source == BASE else _STATED
    sine = own if isinstance(own, Harmonic) and rig.amplitudes is None else None
    if source != RIG and not (sine and _agree(sine, used, share)):
        instead = f"the amplitude of the rig, {_size(sine)}," if sine else "the shaking of the rig"
        lines.append(
            f"the amplitude is {_size(used)}, from {in_one_line(source)}; {instead} is not used"
        )
    if test.kind == "history" and rig.frequency is not None:
        measured = used.frequency
        if abs(measured - rig.frequency) > _MEASURED * rig.frequency:
            lines.append(
                f"the frequency is {measured:.4g} Hz, from the data; the frequency of the rig, "
                f"{rig.frequency:.4g} Hz, is not used"
            )
    return lines


def _is_sine(test: Test) -> bool:
    return not isinstance(getattr(test, "shaking", None), Record)


def _agree(one: Repeated, other: Repeated, share: float) -> bool:
    return one.of == other.of and abs(one.amplitude - other.amplitude) <= share * other.amplitude


def _size(shaking: Repeated) -> str:
    return pretty(shaking.amplitude, shaking.quantity, 4)


def ties_of(ties: Mapping[str, str] | None, rig: Rig) -> dict[str, str]:
    """Read which parameters of a rig follow which.

    Raises
    ------
    InputError
        If a name is no parameter of a rig.
    """
    if not isinstance(ties, Mapping | None):
        raise InputError(f"ties: {shown(ties)}; pass a mapping such as {{'left.gap': 'right.gap'}}")
    names = {}
    for tied, to in (ties or {}).items():
        names[parameter(tied, rig, "ties").name] = parameter(to, rig, "ties").name
    return names
