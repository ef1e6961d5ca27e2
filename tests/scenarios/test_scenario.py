"""The scenarios by name."""

from __future__ import annotations

from vibroimpact.scenarios.scenario import Scenario


def test_every_scenario_has_a_meaning_and_a_label():
    assert [s.label for s in Scenario] == [*(f"S{k}" for k in range(7)), "unclassified"]
    assert len({s.meaning for s in Scenario}) == 8
