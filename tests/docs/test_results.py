"""What the pictures of the benchmarks read from their page."""

from __future__ import annotations

from benchmarks import results


def test_a_cell_is_its_first_number():
    for text, value in (("1,353 (1,342 to 1,373)", 1353.0), ("8.9e-16", 8.9e-16), ("30, peak", 30)):
        assert results.number(text) == value


def test_comparisons_and_targets_are_those_of_the_page(tmp_path, monkeypatch):
    page = tmp_path / "README.md"
    page.write_text(
        "### Short runs of P\n\n| Solver | 1 period | 10 periods |\n| --- | ---: | ---: |\n"
        "| vibroimpact, vi.simulate | 287 | 278 |\n| heyoka, general | 9.3 (9 to 10) | 135 |\n\n"
        "### Branches, warm\n\n| Measured | Value | Target | Met |\n| --- | --- | --- | --- |\n"
        "| all of them, ms | 14.6 (14 to 15) | under 20 ms | met |\n"
        "| lines | 11 + 4 = 15 | at most 7 | **not met** |\n"
        "| by AUTO, ms | 59.2 |  |  |\n| the same, times ours | 4.1 |  |  |\n"
    )
    monkeypatch.setattr(results, "README", page)
    assert dict(results.margins()) == {
        "Branches: all of them, ms": 20 / 14.6,
        "Branches: lines": 7 / 15,
    }
    assert dict(results.against_others()) == {
        "Branches: by AUTO": 4.1,
        "a run of 1 period by vi.simulate: heyoka, general": 9.3 / 287,
        "a run of 10 periods by vi.simulate: heyoka, general": 135 / 278,
    }
