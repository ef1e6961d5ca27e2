"""Tables in one style, whose columns are declared, and printed summaries as plain text."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import xarray as xr
from rich.console import Console, RenderableType
from rich.table import Table

from vibroimpact.datasets.stops import of_stop, plain_values
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.errors import printable
from vibroimpact.facts.number_format import heading, written
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.quantities import Scale
from vibroimpact.model.units import plain


class Column(NamedTuple):
    """A column of a table: its heading, its values, and how they are written."""

    name: str
    """Heading, without the unit."""
    value: str | tuple[str, str] | Callable[[Any], Any]
    """Name of a value of each row, names of both ends of a range, or a function of a row. None, and
    what a row lacks, is written as nothing."""
    form: int | str = 4
    """Significant digits of a number, or a format such as ``"{:.1%}"``."""
    units: str | None = None
    """Unit of the values. Default: that of the variable with their name, if there is one."""
    like: tuple[str, ...] = ()
    """Names of the values that choose the size of the unit. Default: those of the column."""
    left: bool = False
    """Whether the column is aligned to the left."""

    def texts(self, rows: Sequence[Any]) -> list[str]:
        """Return the heading, and the text of each row."""
        value, units = self.value, self.units
        if isinstance(value, str) and units is None and value in VARIABLES:
            units = VARIABLES[value].units
        values = [self._of(row, value) for row in rows]
        sizes = [self._of(row, self.like) for row in rows] if self.like else values
        numbers = [one for ends in sizes for one in ends if isinstance(one, float)]
        scale, words = heading(self.name, units or "1", numbers)
        return [
            words,
            *(
                " to ".join(dict.fromkeys(self._text(end, scale) for end in ends))
                for ends in values
            ),
        ]

    @staticmethod
    def _of(row: Any, value: Any) -> tuple[Any, ...]:
        if callable(value):
            return (value(row),)
        return tuple(row.get(name) for name in ((value,) if isinstance(value, str) else value))

    def _text(self, value: Any, scale: Scale) -> str:
        if not isinstance(value, float):
            return "" if value is None else str(value)
        number = value / scale.size
        return plain(number, self.form) if isinstance(self.form, int) else self.form.format(number)


def table_of(
    rows: Sequence[Any], columns: Iterable[Column], title: str | None = None, padding: int = 2
) -> Table:
    """Return a table of these columns with a row for each mapping from names to values."""
    columns = list(columns)
    table = Table(
        title=title,
        title_justify="left",
        title_style="",
        box=None,
        show_header=any(one.name for one in columns),
        pad_edge=False,
        padding=(0, padding, 0, padding),
        header_style="dim",
    )
    texts = []
    for one in columns:
        words, *mine = one.texts(rows)
        table.add_column(words, justify="left" if one.left else "right")
        texts.append(mine)
    for row in zip(*texts, strict=True):
        table.add_row(*row)
    return table


class Row(NamedTuple):
    """A row of a sheet about a dataset: its name, its values, and a remark."""

    name: str
    value: str | tuple[str, str] | Callable[[Any], str]
    """Name of a variable, names of both ends of a range, or a function of the dataset. A variable
    with the dim ``stop`` is written for both sides, 0 without a stop."""
    digits: int = 4
    """Significant digits of a number."""
    like: tuple[str, ...] = ()
    """Variables that choose the size of the unit. Default: those of the row."""
    words: str = "{}"
    """Words around the values."""
    remark: Callable[[Any], str] = lambda _: ""
    """Remark, in a column of its own."""
    applies: Callable[[Any], Any] = lambda _: True
    """Whether there is such a row."""
    of: tuple[str, ...] = ()
    """Variables that functions of the row write."""

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables of the row."""
        if callable(self.value):
            return self.of
        return (*((self.value,) if isinstance(self.value, str) else self.value), *self.of)

    def texts(self, data: xr.Dataset, whole: Any) -> tuple[str, ...]:
        """Return the name, the values and the remark. `whole` is what functions get."""
        text = (
            self.value(whole)
            if callable(self.value)
            else values_text(data, self.value, digits=self.digits, like=self.like)
        )
        remark = self.remark(whole)
        return self.name, self.words.format(text), *([remark] if remark else [])


def values_text(
    data: xr.Dataset,
    names: str | tuple[str, str],
    *,
    digits: int = 4,
    like: Iterable[str] = (),
) -> str:
    """Return a value of a dataset, that of both sides, or both ends of a range, with the unit."""
    if isinstance(names, str) and "stop" in data[names].dims:
        values = [of_stop(data, names, side).item() for side in SIDES]
        parts = (written(names, one, digits=digits, like=values) for one in values)
        return ", ".join(f"{part} {side}" for part, side in zip(parts, SIDES, strict=True))
    ends = (names,) if isinstance(names, str) else names
    sizes = [data[one].item() for one in like]
    return written(ends[0], *(data[one].item() for one in ends), digits=digits, like=sizes)


def sheet_of(data: xr.Dataset, rows: Iterable[Row], whole: Any = None) -> Table:
    """Return the sheet of declared rows, whose functions get `whole`; default: the dataset."""
    whole = data if whole is None else whole
    return sheet(one.texts(data, whole) for one in rows if one.applies(whole))


def sheet(rows: Iterable[tuple[str, ...]]) -> Table:
    """Return a table of names, values and remarks, without lines."""
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2))
    lines = list(rows)
    for style in ("bold", "", "dim")[: max(map(len, lines), default=0)]:
        table.add_column(style=style)
    for line in lines:
        table.add_row(*line)
    return table


def values_along(
    data: xr.Dataset, dim: str, names: Iterable[str] | None = None, prefix: str = ""
) -> list[dict[str, Any]]:
    """Return values of a dataset at each place along a dimension, by their names.

    The names are without the prefix. Default: those of all variables along this dimension alone.
    """
    if names is None:
        names = [str(name).removeprefix(prefix) for name in data if data[name].dims == (dim,)]
    columns = {name: data[prefix + name] for name in names}
    values = [
        one.values.tolist()
        if one.dims == (dim,)
        else [plain_values(one.isel({dim: i})) for i in range(one.sizes[dim])]
        for one in columns.values()
    ]
    return [dict(zip(columns, row, strict=True)) for row in zip(*values, strict=True)]


def as_text(summary: RenderableType, width: int = 100) -> str:
    """Return a printed summary as plain text of so many columns."""
    console = Console(record=True, file=io.StringIO(), width=width, highlight=False)
    console.print(summary)
    lines = printable(console.export_text(styles=False)).splitlines()
    return "".join(f"{line.rstrip()}\n" for line in lines)
