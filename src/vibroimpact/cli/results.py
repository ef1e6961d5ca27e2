"""The files that a command writes into its folder, and the summary that it prints at the end."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import vibroimpact as vi
from vibroimpact.cli.options import OutputOptions
from vibroimpact.cli.output import Folder, output_folder, progress_bar, tell

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import RenderableType

    from vibroimpact.cli.rig import Subject


@dataclass
class Results:
    """The files of a command about one rig, its progress, and the summary that lists the files."""

    what: Subject
    output: OutputOptions
    folder: Folder
    frequency: float | None
    files: dict[str, Path] = field(default_factory=dict)

    progress = staticmethod(progress_bar)

    def path(self, ending: str, suffix: str) -> Path:
        """Return the path of the file NAME-ENDING.SUFFIX, or NAME-FREQUENCY-ENDING.SUFFIX."""
        from vibroimpact.model.frequency_text import forcing_slug

        at = "" if self.frequency is None else f"-{forcing_slug(self.frequency)}"
        return self.folder / f"{self.what.slug}{at}-{ending}.{suffix}"

    @property
    def title(self) -> str:
        """Title of a figure: that of the rig, and the frequency if all results are at one."""
        from vibroimpact.model.frequency_text import forcing

        at = "" if self.frequency is None else f", {forcing(self.frequency, 10)}"
        return f"{self.what.title}{at}"

    def write(
        self,
        data: xr.Dataset | dict[str, xr.Dataset],
        ending: str,
        draw: Callable[..., Any],
        title: str | None = None,
        *,
        drawn: Any = None,
        **options: Any,
    ) -> None:
        """Save data as NAME-ENDING.nc, and save their figure.

        Parameters
        ----------
        data
            One dataset, or several datasets that become the groups of one file. Their title is set
            to the name of the rig.
        ending
            Text after the name of the rig in the file names.
        draw
            Function that draws the figure. It is called with the data, the title and the options.
        title
            Title of the figure. Default: the title of the results.
        drawn
            Data of the figure, if they differ from the saved data. Default: the saved data.
        """
        for one in data.values() if isinstance(data, dict) else [data]:
            one.attrs["title"] = self.what.name
        self.files["data"] = vi.save(data, self.path(ending, "nc"))
        shown = data if drawn is None else drawn
        self.draw("figure", ending, draw(shown, title=title or self.title, **options))

    def draw(self, name: str, ending: str, figure: Any) -> None:
        """Save a figure as NAME-ENDING in the chosen format. `name` appears in the summary."""
        from vibroimpact.figures import save_figure

        self.files[name] = save_figure(figure, self.path(ending, self.output.figure))

    def tell(
        self,
        facts: Mapping[str, Any],
        *text: RenderableType,
        about: RenderableType | None = None,
        shaking: bool = True,
    ) -> int:
        """Print the rig, the text and the files, or print all facts as JSON. Return exit code 0.

        Parameters
        ----------
        facts
            Contents of the JSON, in addition to the rig and the files.
        text
            Text after the rig in the printed summary.
        about
            Description of the rig. Default: all its parameters.
        shaking
            Whether the shaking of the rig is part of its description.
        """
        from rich.console import Group

        from vibroimpact.facts import rig

        own = rig.facts(self.what.rig)
        if self.frequency is not None:
            facts = {"frequency": self.frequency, **facts}
        if not shaking:
            own.pop("record", None)
        described = about or rig.text(self.what.rig, shaking, facts.get("frequency"))
        summary = Group(described, *text)
        tell(summary, {**own, **facts}, self.folder, self.files, self.output.json)
        return 0


def draws_physical(data: xr.Dataset, physical: bool | None) -> bool:
    """Return whether a figure has physical units instead of η_a and η_d.

    The default is that of the figures. η_a and η_d require a bounded motion without stops.
    """
    from vibroimpact.figures.resonance_panels import draws_eta, has_eta

    return not draws_eta(data) if physical is None else physical or not has_eta(data)


@contextmanager
def results(
    what: Subject, output: OutputOptions, frequency: float | None = None
) -> Iterator[Results]:
    """Make the folder of the results before anything is computed.

    If all results are at one forcing frequency (Hz), pass it: it stands in the names of the files,
    in the titles and in the summary. Warnings do not end a command.

    Raises
    ------
    InputError
        If the folder cannot be written to.
    """
    with (
        width_of_figures(output),
        output_folder(output.output) as folder,
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("always", RuntimeWarning)
        yield Results(what, output, folder, frequency)


@contextmanager
def width_of_figures(output: OutputOptions) -> Iterator[None]:
    """Set the width of the figures that are drawn, if an option states it.

    Raises
    ------
    InputError
        If the width is invalid.
    """
    if output.figure_width is None:
        yield
        return
    from vibroimpact.figures import figure_size
    from vibroimpact.figures.figure_dimensions import INCH, inches

    with figure_size(INCH * inches(output.figure_width, "--figure-width")):
        yield
