"""How much code there is to read."""

from pathlib import Path

from benchmarks.report import Table, met, targets

_PACKAGE = Path(__file__).parents[1] / "src" / "vibroimpact"
_LINES = 7_000


def size() -> Table:
    """Count the lines, comments and empty ones included."""
    table = targets("Size")
    counts = {folder: _lines(_PACKAGE / folder) for folder in ("engine", "stability")}
    total = sum(counts.values())
    table.add(
        "lines of engine/ and stability/",
        f"{' + '.join(f'{n:,}' for n in counts.values())} = {total:,}",
        f"at most {_LINES:,}",
        met(total <= _LINES),
    )
    return table


def _lines(folder: Path) -> int:
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in folder.rglob("*.py"))
