"""The report of a fit: parameters, uncertainty, adequacy of the model, and best next test."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple
from urllib.parse import quote

import numpy as np
import xarray as xr

from vibroimpact import figures as draw
from vibroimpact._version import __version__
from vibroimpact.arguments import check_path, check_variables
from vibroimpact.datasets.files import write_whole
from vibroimpact.errors import InputError, in_one_line, shown
from vibroimpact.identification.finding_texts import amplitude_words
from vibroimpact.identification.free_parameters import SENSORS
from vibroimpact.identification.identify import fitted_rig
from vibroimpact.identification.next_test import next_test
from vibroimpact.identification.results import rig_of
from vibroimpact.measurements.read import as_measured
from vibroimpact.model.names import check_name, file_stems
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.public import public
from vibroimpact.model.quantities import DIMENSIONLESS, Quantity
from vibroimpact.model.rig import Rig
from vibroimpact.model.study import study_text
from vibroimpact.model.units import pretty
from vibroimpact.response.sweep import sweep

if TYPE_CHECKING:
    from jinja2 import Environment

_DENSE = 4
"""Smallest number of computed frequencies per measured frequency."""

_MARKS = re.compile(r"[\\|<>`*]|\](?=[(\[:])")
"""Characters that start a table cell, a tag, code, emphasis or the address of a link in
Markdown."""

Format = Literal["png", "pdf", "svg"]


class Figure(NamedTuple):
    """A figure of the report."""

    file: str
    caption: str


@public
def fit_report(
    result: xr.Dataset,
    folder: Path | str,
    name: str = "fit",
    *,
    comparison: xr.Dataset | None = None,
    figure: Format = "png",
) -> dict[str, Path]:
    """Write the report of a fit, its figures, and one study file for each fitted rig.

    Parameters
    ----------
    result
        Dataset of `identify`.
    folder
        Folder for the files. It must exist.
    name
        Beginning of the file names.
    comparison
        Dataset of `compare_fits`, if other models were also fitted.
    figure
        File format of the figures, such as ``"png"``.

    Returns
    -------
    dict
        The paths of the files by name: ``report`` (HTML), ``markdown``, ``study`` (one for each
        different rig) and the figures.

    Raises
    ------
    InputError
        If the dataset is not a fit, if the name contains control characters, or if a file cannot be
        written.
    """
    if not isinstance(result, xr.Dataset) or "fitted_value" not in result:
        raise InputError("result: this is not a fit; pass the result of identify")
    where = check_path(folder, "folder")
    if not where.is_dir():
        raise InputError(f"folder: {shown(folder)} is not a folder; create it, or pass another one")
    check_name(name, "name")
    if comparison is not None:
        check_variables(comparison, ["akaike"], "comparison", "the result of compare_fits")
    files: dict[str, Path] = {}
    figures: list[Figure] = []

    def drawn(key: str, axes: Any, caption: str) -> None:
        path = draw.save_figure(axes[0], where / f"{name}-{key}.{figure}")
        files[f"figure {key}"] = path
        figures.append(Figure(path.name, caption))

    stems = file_stems(str(test) for test in result["test"].values)
    for test, kind in zip(result["test"].values, result["test_kind"].values, strict=True):
        key = "curves" if kind == "curves" else "history"
        key = key if result.sizes["test"] == 1 else f"{key}-{stems[str(test)]}"
        if kind == "curves":
            measured = measured_of(result, str(test))
            rig = fitted_rig(result, str(test))
            curves = sweep(Rig(rig.oscillator, rig.amplitude), _dense(measured["frequency"].values))
            si = not any(str(name).startswith("eta_") for name in measured)
            drawn(key, draw.resonance_curves(curves, measured=measured, physical=si),
                  f"{test}: measured points and curves of the fitted rig")  # fmt: skip
        else:
            drawn(
                key,
                draw.fit_history(result, str(test)),
                f"{test}: measured motion and fitted motion",
            )
    drawn(
        "residuals",
        draw.fit_residuals(result),
        "Residuals of the fit. The band shows 2 standard deviations.",
    )
    if "profile_rise" in result:
        drawn(
            "profiles",
            draw.fit_profiles(result),
            "Profile of each parameter. The dotted line is the increase of the deviance at the "
            "ends of the confidence interval.",
        )
    for key, text, label in _studies(result, name):
        path = where / f"{key}.toml"
        files[label] = write_whole(path, text)
    advice = next_test(result).attrs["findings"].splitlines()
    context = {
        "name": name,
        "version": __version__,
        "rows": parameter_rows(result),
        "findings": result.attrs["findings"].splitlines(),
        "advice": advice,
        "tests": _tests(result),
        "comparison": [] if comparison is None else comparison.attrs["findings"].splitlines(),
        "models": [] if comparison is None else _models(comparison),
        "figures": figures,
        "studies": [path.name for label, path in files.items() if label.startswith("study")],
        "confidence": f"{100.0 * float(result.attrs['confidence']):g} %",
        "correlations": _correlations(result),
    }
    for label, template in (("markdown", "fit.md.jinja"), ("report", "fit.html.jinja")):
        # Names in it are those of files and columns, which may hold anything.
        written = _each_text(context, _inert if label == "markdown" else in_one_line)
        text = _environment().get_template(template).render(**written)
        files[label] = write_whole(where / f"{name}{Path(template).stem[3:]}", text)
    return files


def _inert(text: str) -> str:
    """Escape characters that Markdown would read as tables, links or tags."""
    return _MARKS.sub(r"\\\g<0>", in_one_line(text))


def _each_text(value: Any, change: Callable[[str], str]) -> Any:
    """Change each text in nested lists and mappings. For a figure, only its caption is changed."""
    if isinstance(value, str):
        return change(value)
    if isinstance(value, dict):
        return {key: _each_text(one, change) for key, one in value.items()}
    if isinstance(value, Figure):
        return Figure(quote(value.file), change(value.caption))
    if isinstance(value, list | tuple):
        return [_each_text(one, change) for one in value]
    return value


def parameter_rows(result: xr.Dataset) -> list[tuple[str, str, str, str, str]]:
    """Return name, value, standard error, interval and meaning of each parameter, as text."""
    rows = []
    for key in result["parameter"].values:
        one = result.sel(parameter=key)
        bare = str(key).partition("[")[0]
        known = PARAMETERS.get(bare)
        quantity = known.quantity if known else _sensor(bare)
        low, high = one["interval"].values.tolist()
        is_open = one["interval_open"].values
        marks = ["" if not o else " (bound)" for o in is_open]
        error = float(one["standard_error"])
        unknown = bool(is_open.any()) and error > high - low
        rows.append(
            (
                str(key),
                pretty(float(one["fitted_value"]), quantity, 5),
                "not known" if unknown else pretty(error, quantity, 2),
                f"{pretty(low, quantity, 4)}{marks[0]} to {pretty(high, quantity, 4)}{marks[1]}",
                known.long_name if known else bare.replace("_", " "),
            )
        )
    return rows


def amplitude_of(result: xr.Dataset, test: str) -> str:
    """Return the peak base acceleration of a test and its source, as text."""
    known = "amplitude_source" in result  # not in fits of older versions
    source = str(result["amplitude_source"].sel(test=test).values) if known else ""
    return amplitude_words(rig_of(json.loads(result.attrs["rigs"])[test]).periodic, source)


def _sensor(name: str) -> Quantity:
    return SENSORS[name][0] if name in SENSORS else DIMENSIONLESS


def measured_of(result: xr.Dataset, test: str) -> xr.Dataset:
    """Return the measured curves of a test, from the points of a fit."""
    mine = result.isel(point=np.flatnonzero(result["point_test"].values == test))
    place, way = mine["point_place"].values, mine["point_direction"].values
    grid = np.unique(place)
    ways = [d for d in ("forward", "backward") if d in way]
    data = xr.Dataset(coords={"direction": ways, "frequency": grid})
    for variable in dict.fromkeys(str(v) for v in mine["point_variable"].values):
        here = np.flatnonzero(mine["point_variable"].values == variable)
        table: dict[tuple[int, int], list[float]] = {}
        for i in here:
            at = ways.index(str(way[i])), int(np.searchsorted(grid, place[i]))
            table.setdefault(at, []).append(float(mine["measured_value"].values[i]))
        most = max(len(values) for values in table.values())
        filled = np.full((len(ways), len(grid), most), np.nan)
        for at, values in table.items():
            filled[at][: len(values)] = values
        dims = ("direction", "frequency", f"repeat_{variable}")
        data[variable] = (dims, filled) if most > 1 else (dims[:2], filled[..., 0])
        if most > 1:
            data = data.rename({f"repeat_{variable}": "repeat"})
    return as_measured(data)


def _dense(frequency: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Return the measured frequencies, and further frequencies between them."""
    if len(frequency) < 2:
        return np.array(frequency)
    count = max(200, _DENSE * len(frequency))
    frequencies: np.ndarray[Any, Any] = np.union1d(
        frequency, np.linspace(frequency[0], frequency[-1], count)
    )
    return frequencies


def _studies(result: xr.Dataset, name: str) -> Iterable[tuple[str, str, str]]:
    """Return key, text and label of the study files, with one file for each different rig."""
    rigs = json.loads(result.attrs["rigs"])
    stems = file_stems(rigs)
    seen: set[str] = set()
    for test in rigs:
        text = json.dumps([rigs[test]["oscillator"], rigs[test]["excitation"]["amplitude"]])
        if text in seen:
            continue
        seen.add(text)
        rig = fitted_rig(result, test)
        key = name if len(rigs) == 1 else f"{name}-{stems[test]}"
        about = f"Fitted by vibroimpact {__version__} to {test}.\n" + "\n".join(
            f"{row[0]} = {row[1]}, standard error {row[2]}" for row in parameter_rows(result)
        )
        named = Rig(rig.oscillator, rig.amplitude, name=key)
        yield key, study_text(named, about), f"study {key}"


def _tests(result: xr.Dataset) -> list[tuple[str, str, str, str, str]]:
    rows = []
    for test in result["test"].values:
        one = result.sel(test=test)
        points = int((result["point_test"].values == test).sum())
        curves = str(one["test_kind"].values) == "curves"
        noise = float(one["noise"])
        noise_text = (
            f"{100.0 * noise:.2g} % of a value"
            if curves
            else f"{noise:.3g} times the noise of each channel"
        )
        shape = "correlated (not only noise)" if float(one["residual_chance"]) < 1e-3 else "noise"
        rows.append((str(test), amplitude_of(result, str(test)), str(points), noise_text, shape))
    return rows


def _models(comparison: xr.Dataset) -> list[tuple[str, str, str, str]]:
    return [
        (
            str(one["model"].values),
            str(int(one["parameter_count"])),
            f"{float(one['akaike'] - comparison['akaike'].min()):.1f}",
            f"{float(one['bayes'] - comparison['bayes'].min()):.1f}",
        )
        for one in (comparison.isel(model=i) for i in range(comparison.sizes["model"]))
    ]


def _correlations(result: xr.Dataset) -> list[tuple[str, ...]]:
    table = result["correlation"].values
    keys = [str(k) for k in result["parameter"].values]
    return [(key, *(f"{v:.2f}" for v in row)) for key, row in zip(keys, table, strict=True)]


def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("vibroimpact.reports", "templates"),
        autoescape=lambda name: name is not None and name.endswith(".html.jinja"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
