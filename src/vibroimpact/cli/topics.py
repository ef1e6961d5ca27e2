"""Help topics: what many commands share, explained once.

The help of a command has one line for each of these options, and refers to the topic.
"""

from __future__ import annotations

from typing import NamedTuple


class Topic(NamedTuple):
    """A page of the help."""

    summary: str
    text: str
    """The page, in Markdown."""


_RIGS = """
A rig is a mass on an isolator between two bumpers (deformable stops), with its shaking. Most
commands take one of these:

- A **laboratory case**, by its code: a rig of the published tests.
- A **study file** (TOML), by its path: your own rig, of one mass or several. `vibroimpact init`
  writes one to start from.

A code is BUMPER-GAP-ACCELERATION, such as `B2-G1-A3`, `B3-10mm-A3` or `510kN/m-G1-0.05g`:

- BUMPER: B1, B2, B3 or B4 (100, 510, 680 or 2300 kN/m), or a stiffness.
- GAP: the sum of the two equal gaps, G1, G2, G3 or G4 (15, 20, 25 or 30 mm), or a length. Ginf
  means no bumpers.
- ACCELERATION: the peak acceleration of the base, A1, A2 or A3 (0.03, 0.04 or 0.05 g), or a value
  between 0.03g and 0.05g.

## Options that change the rig

Each replaces a value of the case or of the study file. A value without a unit is in SI units.

- `--amplitude`: amplitude of the shaking. Its unit selects the quantity: peak acceleration of the
  base (0.05g or 0.49m/s^2), peak displacement of the base (5mm), peak force on the mass (120N), or
  rotating unbalance (0.4kg\\*m). With 0, nothing shakes the rig; only `vibroimpact simulate`
  accepts it.
- `--gap`: gap on each side, such as 7.5mm. It is half of GAP, the total gap in a case code.
- `--set PATH=VALUE`: any other value, and may be repeated. Of one mass: `mass=550kg`,
  `isolator.stiffness=30kN/m`, `stops.stiffness=1MN/m` (both stops), `right.gap=9mm`,
  `isolator_period=2.5s`, `damping_ratio=0.15`. Of several: `stops.pounding.gap=1cm`,
  `masses.roof=200t`. `left=none` removes the left stop, and `isolator=none` the isolator.
  `vibroimpact show` lists the paths of a rig.
- `--parameters`: parameter set of a laboratory case. Default: the set in the study file, or table.
  - table (all cases): Table 1 and Section 7 of the paper by Stefani, De Angelis and Andreaus.
  - identified (only B2-G1-A3 and B2-G2-A2): what Section 5 of this paper identifies from single
    tests.
  - refined (all cases): table, with an isolator that softens as the displacement grows.

For example:

    vibroimpact sweep B2-G1-A3 --gap 12mm --set mass=600kg
    vibroimpact motion 510kN/m-20mm-0.04g --frequency 2.6Hz
    vibroimpact simulate study.toml --amplitude 5mm --set left=none
"""

_OUTPUT = """
A command prints a summary, and writes its data (NetCDF) and figures to a folder. The file names
begin with NAME, the name of the rig.

- `--output`, `-o`: folder (default: out). A missing folder is created.
- `--name`: another text for NAME; titles keep the name of the rig. Default: the name of the rig, or
  of the record for `vibroimpact record`.
- `--figure`: file format of the figures, png, pdf or svg (default: png).
- `--figure-width`: width of the figures for print, such as 86mm for one column of a journal. Text
  is 8 points high, and png has 600 pixels per inch. Default: a size for the screen.
- `--json`: print the summary as JSON, for other programs, and nothing else.
- `--physical`, `--normalised` (sweep, branch, ensemble): draw accelerations in g, displacements in
  mm and contact forces, or the normalised excursions η_a (acceleration) and η_d (displacement). An
  excursion is the maximum minus the minimum, divided by the largest excursion of the same rig
  without stops; if that is unbounded, figures are physical. Default: `--physical` for a study
  file, and `--normalised` for a laboratory case.

For example:

    vibroimpact sweep B2-G1-A3 --output results --figure pdf --figure-width 86mm
    vibroimpact motion B2-G1-A3 --frequency 2.6Hz --json
"""

TOPICS = {
    "rigs": Topic("laboratory cases, study files, and the options that change a rig", _RIGS),
    "output": Topic("written files, figures and the printed summary", _OUTPUT),
}
"""All topics by name."""
