"""Tables for the terminal and for README.md."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table as RichTable

README = Path(__file__).with_name("README.md")
_BEGIN = "<!-- results: written by `make bench ARGS=--write` -->"
_END = "<!-- end of results -->"


@dataclass(slots=True)
class Table:
    """A table of texts with notes below it."""

    title: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def add(self, *cells: str) -> None:
        """Append a row."""
        if len(cells) != len(self.columns):
            raise ValueError(f"{len(cells)} cells for {len(self.columns)} columns")
        self.rows.append(cells)


def targets(title: str) -> Table:
    """Return an empty table of measurements with their targets."""
    return Table(title, ("Measured", "Value", "Target", "Met"))


def met(holds: bool) -> str:
    """Word of a verdict."""
    return "met" if holds else "NOT MET"


def show(table: Table, console: Console) -> None:
    """Print a table."""
    drawn = RichTable(title=escape(table.title), title_justify="left", title_style="bold")
    for i, column in enumerate(table.columns):
        drawn.add_column(escape(column), justify="left" if i == 0 else "right")
    for row in table.rows:
        style = "bold red" if "NOT MET" in row else ""
        drawn.add_row(*map(escape, row), style=style)
    console.print(drawn)
    for note in table.notes:
        console.print(escape(note), highlight=False)
    console.print()


def markdown(tables: Iterable[Table]) -> str:
    """Return the tables as text for README.md."""
    parts = []
    for table in tables:
        lines = [f"### {table.title}", "", _line(table.columns)]
        lines.append(_line(["---"] + ["---:"] * (len(table.columns) - 1)))
        lines += [
            _line("**not met**" if cell == "NOT MET" else cell for cell in row)
            for row in table.rows
        ]
        lines += [f"\n{note}" for note in table.notes]
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


def write(tables: Iterable[Table], path: Path = README, whole: bool = True) -> None:
    """Write the results between the markers of README.md, all anew or each over its namesake."""
    text = path.read_text(encoding="utf-8")
    before, begin, rest = text.partition(_BEGIN)
    old, end, after = rest.partition(_END)
    if not (begin and end):
        raise SystemExit(f"{path} has no lines {_BEGIN} and {_END}")
    parts = {} if whole else {part.partition("\n")[0]: part for part in _parts(old)}
    parts |= {part.partition("\n")[0]: part for part in _parts(markdown(tables))}
    results = "\n\n".join(f"### {part}" for part in parts.values())
    path.write_text(f"{before}{begin}\n\n{results}\n\n{end}{after}", encoding="utf-8")


def _parts(text: str) -> list[str]:
    return [part.strip() for part in text.split("### ") if part.strip()]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
