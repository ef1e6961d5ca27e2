"""The summary of a fit: parameters, findings and the next test, as plain values and as text."""

from __future__ import annotations

from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from vibroimpact.datasets.description import noted
from vibroimpact.identification.model_selection import OWN_MODEL, ModelFits
from vibroimpact.identification.next_test import next_test
from vibroimpact.reports.identification import amplitude_of, parameter_rows


def fit_summary(fits: ModelFits, tests: list[xr.Dataset]) -> tuple[RenderableType, dict[str, Any]]:
    """Return the summary of fits as text, and the same facts as plain values."""
    own_fit, comparison = fits.own_fit, fits.comparison
    notes = [line for test in tests for line in _notes(test, many=len(tests) > 1)]
    names = [str(test) for test in own_fit["test"].values]
    amplitudes = {name: amplitude_of(own_fit, name) for name in names}
    findings = own_fit.attrs["findings"].splitlines()
    advice = next_test(own_fit).attrs["findings"].splitlines()
    compared = [] if comparison is None else comparison.attrs["findings"].splitlines()
    lines = [*findings, *compared, *advice]
    parts: list[Any] = [Text(f"amplitude of {name}: {size}") for name, size in amplitudes.items()]
    parts += [Text(), _table(own_fit), Text(), *(Text(f"- {line}") for line in lines)]
    facts = {
        "parameters": _values(own_fit),
        "amplitudes": amplitudes,
        "findings": findings,
        "comparison": compared,
        "next": advice,
        "reading": notes,
    }
    if fits.best_name != OWN_MODEL:
        name, fit = fits.best_name, fits.best
        of_best = fit.attrs["findings"].splitlines()
        parts += [Text(), Text(f"The model that fits best, {name}:"), _table(fit), Text()]
        parts += [Text(f"- {line}") for line in of_best]
        facts["best_model"] = {"model": name, "parameters": _values(fit), "findings": of_best}
    if notes:
        parts += [Text(), Text("Reading"), *(Text(f"- {line}") for line in notes)]
    return Group(*parts), facts


def _table(fit: xr.Dataset) -> Table:
    """Return a table of the parameters of a fit, with one parameter per row."""
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    share = f"{100.0 * float(fit.attrs['confidence']):g} % interval"
    for head in ("parameter", "value", "standard error", share):
        table.add_column(head)
    for row in parameter_rows(fit):
        table.add_row(*row[:4])
    return table


def _values(fit: xr.Dataset) -> dict[str, Any]:
    return {
        str(key): {
            "value": float(fit["fitted_value"].sel(parameter=key)),
            "standard_error": float(fit["standard_error"].sel(parameter=key)),
            "interval": fit["interval"].sel(parameter=key).values.tolist(),
        }
        for key in fit["parameter"].values
    }


def _notes(test: xr.Dataset, *, many: bool) -> list[str]:
    """Return the notes on reading a test, with the name of the file if there are several tests."""
    source = test.attrs.get("source", "")
    lines = noted(test)
    return [
        line if not many or line.startswith(f"{source}: ") else f"{source}: {line}"
        for line in lines
    ]
