"""What a notebook shows of a rig: a table of values with units."""

from __future__ import annotations

import re

import vibroimpact as vi

CASE = vi.laboratory.case("B2-G1-A3")


def cells(part: object) -> dict[str, str]:
    html = part._repr_html_()
    assert html.count("<table") == html.count("</table>") == 1
    return dict(re.findall(r"<th[^>]*>([^<]*)</th><td[^>]*>([^<]*)</td>", html))


def test_an_oscillator_is_a_table_of_values_with_units():
    assert cells(CASE.oscillator.replace(left=None)) == {
        "mass": "550 kg",
        "isolator.stiffness": "26.29 kN/m",
        "isolator.damping": "1.14077 kN s/m",
        "right.stiffness": "510 kN/m",
        "right.damping": "0.73766 kN s/m",
        "right.gap": "7.5 mm",
        "right.memory": "1.44639 ms",
        "left": "None",
    }
    assert "Oscillator" in CASE.oscillator._repr_html_()
    assert cells(vi.Harmonic("0.05 g", "2 Hz"))["frequency"] == "2 Hz"


def test_rigs_and_cases_show_their_oscillator_and_what_shakes_it():
    rig = vi.Rig(CASE.oscillator, CASE.amplitude)
    whole = cells(CASE.oscillator)
    assert cells(rig) == {**whole, "shaking": "0.05 g"}
    assert cells(CASE) == {
        **whole,
        "amplitude": "0.05 g",
        "frequencies": "0.5 to 5 Hz",
        "parameters": "table",
    }
    assert "B2-G1-A3" in CASE._repr_html_()
    unit = vi.from_dimensionless(20.0, 0.5, 0.01, 0.15)
    assert cells(unit)["right.stiffness"] == "20"
    groups = cells(vi.to_dimensionless(vi.Rig(CASE.oscillator, CASE.amplitude)))
    assert groups["right.stiffness_ratio"] == "19.399"


def test_an_unusual_part_names_its_kind():
    rigid = CASE.oscillator.replace(right=vi.RigidStop(0.8, "7.5 mm"))
    assert cells(rigid)["right.kind"] == "rigid"
    assert "left.kind" not in cells(rigid)


def test_text_is_escaped():
    from vibroimpact.model.html_table import table

    assert "<i>" not in table("<i>", [("<i>", "<i>")])
