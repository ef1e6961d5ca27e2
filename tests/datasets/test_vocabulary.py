"""Every output variable has units and a meaning."""

from __future__ import annotations

from vibroimpact.datasets.vocabulary import VARIABLES


def test_units_and_meaning_of_each():
    for name, known in VARIABLES.items():
        assert known.units, name
        assert known.long_name, name
