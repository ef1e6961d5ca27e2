"""What a command writes into its folder, and what it prints at the end."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vibroimpact.cli.options import OutputOptions
from vibroimpact.cli.output import Folder, output_folder, tell

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import RenderableType

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model.rig import Rig


class Results:
    """The files of a command about one rig, and the summary that names them."""

    def __init__(self, what: Subject, output: OutputOptions, folder: Folder) -> None:
        self.what = what
        self.output = output
        self.folder = folder
        self.files: dict[str, Path] = {}

    def path(self, ending: str, suffix: str) -> Path:
        """Return the path of the file NAME-ENDING.SUFFIX."""
        return self.folder / f"{self.what.slug}-{ending}.{suffix}"

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
        """Save data as NAME-ENDING.nc, and their figure beside it.

        Parameters
        ----------
        data
            A dataset, or datasets that become the groups of one file. They get the rig's name as
            a title.
        ending
            What follows the rig's name in the names of the files.
        draw
            Function of the figure; it is called with what is drawn, the title and the options.
        title
            Title of the figure. None for that of the rig.
        drawn
            What is drawn. None for the data.
        """
        from vibroimpact.datasets.files import save

        for one in data.values() if isinstance(data, dict) else [data]:
            one.attrs["title"] = self.what.name
        self.files["data"] = save(data, self.path(ending, "nc"))
        shown = data if drawn is None else drawn
        self.draw("figure", ending, draw(shown, title=title or self.what.title, **options))

    def draw(self, name: str, ending: str, figure: Any) -> None:
        """Write a figure as NAME-ENDING in the format of the options; `name` is for the summary."""
        from vibroimpact.figures import save_figure

        self.files[name] = save_figure(figure, self.path(ending, self.output.figure))

    def tell(
        self,
        facts: Mapping[str, Any],
        *text: RenderableType,
        about: RenderableType | None = None,
        shaking: bool = True,
    ) -> int:
        """Print the rig, the text and the files, or all facts as JSON; return exit code 0.

        Parameters
        ----------
        facts
            What the JSON holds besides the rig and the files.
        text
            What follows the rig in the printed summary.
        about
            Description of the rig. None for all its parameters.
        shaking
            Whether the shaking of the rig is part of its description.
        """
        from rich.console import Group

        from vibroimpact.facts import rig

        own = rig.facts(self.what.rig)
        if not shaking:
            own.pop("record", None)
        described = about or rig.text(self.what.rig, shaking=shaking)
        summary = Group(described, *text)
        tell(summary, {**own, **facts}, self.folder, self.files, self.output.json)
        return 0


def has_normalised_curves(data: xr.Dataset, rig: Rig) -> bool:
    """Whether η_a and η_d exist; they need the largest free motion, which must be bounded."""
    from vibroimpact.model.unbounded import has_no_bound

    return bool(data["eta_d"].notnull().any()) and not has_no_bound(rig)


@contextmanager
def results(what: Subject, output: OutputOptions) -> Iterator[Results]:
    """Make the folder of the results before anything is computed; warnings do not end a command.

    Raises
    ------
    InputError
        If it cannot be written to.
    """
    with output_folder(output.output) as folder, warnings.catch_warnings():
        warnings.simplefilter("always", RuntimeWarning)
        yield Results(what, output, folder)
