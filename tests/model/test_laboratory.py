"""The published rig: Table 1, Section 5, case codes."""

import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Isolator, Oscillator, laboratory
from vibroimpact.model.quantities import GRAVITY
from vibroimpact.model.rig import Rig

# The paper's Table 1, as printed.
PRINTED_GAP = {
    "A1": {"G1": "0.47", "G2": "0.62", "G3": "0.78", "G4": "0.93"},
    "A2": {"G1": "0.30", "G2": "0.40", "G3": "0.49", "G4": "0.59"},
    "A3": {"G1": "0.22", "G2": "0.29", "G3": "0.36", "G4": "0.43"},
}
PRINTED_RATIO = {
    "A1": {"B1": "2.9", "B2": "15.0", "B3": "20.0", "B4": "67.8"},
    "A2": {"B1": "3.5", "B2": "17.8", "B3": "23.7", "B4": "80.1"},
    "A3": {"B1": "3.8", "B2": "19.4", "B3": "25.9", "B4": "87.5"},
}


class TestTable1:
    def test_the_24_printed_numbers_come_out(self):
        table = laboratory.table_1()
        gap = {a: {g: f"{x:.2f}" for g, x in row.items()} for a, row in table.gap.items()}
        ratio = {
            a: {b: f"{x:.1f}" for b, x in row.items()} for a, row in table.stiffness_ratio.items()
        }
        assert gap == PRINTED_GAP
        assert ratio == PRINTED_RATIO

    def test_it_prints_as_a_table(self):
        lines = str(laboratory.table_1()).splitlines()
        assert lines[0].split() == [*laboratory.GAPS, *laboratory.BUMPERS]
        for line, a in zip(lines[1:], PRINTED_GAP, strict=True):
            assert line.split() == [a, *PRINTED_GAP[a].values(), *PRINTED_RATIO[a].values()]

    def test_the_cases_have_its_parameters(self):
        from vibroimpact.model import to_dimensionless

        for case in laboratory.campaign():
            b, g, a = case.code.split("-")
            group = to_dimensionless(Rig(case.oscillator, case.amplitude))
            assert group.damping_ratio == pytest.approx(0.15, rel=1e-15)
            assert group.right == group.left
            assert f"{group.right.gap:.2f}" == PRINTED_GAP[a][g]
            assert f"{group.right.stiffness_ratio:.1f}" == PRINTED_RATIO[a][b]
            assert group.right.relaxation_time == pytest.approx(0.01, rel=1e-15)


class TestCase:
    @pytest.mark.parametrize(
        ("code", "stiffness", "gap"), [("B2-G1-A3", 26.8e3, 0.0075), ("B2-G2-A2", 31.9e3, 0.010)]
    )
    def test_identified_parameters(self, code, stiffness, gap):
        case = laboratory.case(code, parameters="identified")
        bumper = Bumper(510e3, 900.0, gap)
        assert case.oscillator == Oscillator(550.0, Isolator(stiffness, 1100.0), bumper, bumper)
        assert case.parameters == "identified"

    def test_accelerations_are_fractions_of_gravity(self):
        for name, share in (("A1", 0.03), ("A2", 0.04), ("A3", 0.05)):
            assert laboratory.ACCELERATIONS[name] == pytest.approx(share * GRAVITY, rel=1e-15)

    def test_frequencies(self):
        frequencies = laboratory.case("B2-G1-A3").frequencies
        assert frequencies == tuple(round(0.1 * k, 10) for k in range(5, 51))
        assert len(frequencies) == 46
        assert frequencies[0] == 0.5
        assert frequencies[7] == 1.2
        assert frequencies[-1] == 5.0

    def test_it_prints(self):
        text = str(laboratory.case("B2-G1-A3", "identified"))
        assert text.startswith("Case(B2-G1-A3, oscillator=Oscillator(mass=550 kg, ")
        assert text.endswith("amplitude=0.05 g, frequencies=0.5 to 5 Hz, parameters=identified)")


class TestCode:
    @pytest.mark.parametrize(
        ("code", "canonical"),
        [
            ("b2-g1-a3", "B2-G1-A3"),
            (" B2 - G1 - A3 ", "B2-G1-A3"),
            ("B2–G1–A3", "B2-G1-A3"),  # dashes as the paper's typesetting has them
            ("B2-Ginf-A3", "B2-Ginf-A3"),
            ("b2-INF-a3", "B2-Ginf-A3"),
            ("B2-G∞-A3", "B2-Ginf-A3"),
            ("B2-free-A3", "B2-Ginf-A3"),
            ("b3-10mm-a3", "B3-10mm-A3"),
            ("B3-10 mm-A3", "B3-10 mm-A3"),
            ("510kN/m-G1-0.05g", "510kN/m-G1-0.05g"),
        ],
    )
    def test_is_made_canonical(self, code, canonical):
        assert laboratory.case(code).code == canonical

    @pytest.mark.parametrize(
        "code",
        [
            "510kN/m-G1-0.05g",
            "B2-15mm-A3",
            "B2-1.5e-2m-A3",
            "B2-15 mm-0.4903325 m/s^2",
            "B2-G1-490.3325 mm s^-2",
        ],
    )
    def test_a_value_equal_to_a_name_gives_the_same_rig(self, code):
        named = laboratory.case("B2-G1-A3")
        case = laboratory.case(code)
        assert (case.oscillator, case.amplitude) == (named.oscillator, named.amplitude)

    @pytest.mark.parametrize("gap", ["0mm", "0", "0 m"])
    def test_a_gap_of_zero(self, gap):
        rig = laboratory.case(f"B3-{gap}-A3").oscillator
        assert rig.right.gap == rig.left.gap == 0.0

    def test_an_infinite_gap_is_free_flight(self):
        rig = laboratory.case("B2-Ginf-A3").oscillator
        assert rig == laboratory.case("B2-G1-A3").oscillator.without_bumpers()

    def test_another_bumper_keeps_the_relaxation_time(self):
        rig = laboratory.case("1 MN/m-G1-A3").oscillator
        assert rig.right.stiffness == 1e6
        assert rig.right.damping * rig.angular_frequency / 1e6 == pytest.approx(0.01, rel=1e-15)

    def test_the_isolator_is_interpolated_between_tested_accelerations(self):
        def stiffness(code):
            return laboratory.case(code).oscillator.isolator.stiffness

        assert stiffness("B2-G1-0.045g") == pytest.approx((28732.0 + 26290.0) / 2, rel=1e-12)
        assert stiffness("B2-G1-0.035g") == pytest.approx((33920.0 + 28732.0) / 2, rel=1e-12)
        assert stiffness("B2-G1-0.03g") == 33920.0
        assert stiffness("B2-G1-0.04g") == 28732.0
        assert laboratory.case("B2-G1-0.045g").amplitude == pytest.approx(0.045 * GRAVITY)

    def test_a_slug_can_be_a_file_name(self):
        assert laboratory.case("B2-G1-A3").slug == "B2-G1-A3"
        assert laboratory.case("510kN/m-10 mm-0.05g").slug == "510kN_m-10_mm-0.05g"

    @pytest.mark.parametrize(
        ("code", "words"),
        [
            ("", "B1 to B4"),
            ("B2", "use bumper-gap-acceleration, such as B2-G1-A3"),
            ("B2-G1", "G1 to G4"),
            ("B2-G1-A3-A3", "A1 to A3"),
            ("B2-G1-", "is not a case code"),
            ("B2--G1-A3", "gap: '-G1'"),
            (
                "B5-G1-A3",
                "bumper 'B5' is unknown; use B1, B2, B3, B4 or a stiffness such as 510kN/m",
            ),
            ("B2-G9-A3", "gap 'G9' is unknown; use G1, G2, G3, G4, Ginf or a length such as 15mm"),
            ("B2-G1-A4", "acceleration 'A4' is unknown; use A1, A2, A3 or an acceleration such as"),
            ("G1-B2-A3", "bumper 'G1' is unknown"),
            ("B2-10-A3", "gap '10' has no unit"),
            ("510000-G1-A3", "bumper '510000' has no unit"),
            ("B2-15kg-A3", "gap: '15kg' is a mass; use a length"),
            ("B2--10mm-A3", "gap: '-10mm' is less than 0"),
            ("0N/m-G1-A3", "bumper: '0N/m' is not greater than 0"),
            ("B2-G1-0g", "acceleration: '0g' is not greater than 0"),
            ("B2-G1-0.06g", "acceleration '0.06g' is outside the tested range"),
            ("B2-G1-0.02g", "use an acceleration from 0.03g to 0.05g"),
            ("B2-G1\n-A9", "acceleration 'A9' is unknown"),
        ],
    )
    def test_an_unknown_code_is_refused_with_what_is_accepted(self, code, words):
        with pytest.raises(InputError) as caught:
            laboratory.case(code)
        message = str(caught.value)
        assert message.startswith(f"case{':' if ' is not a case' in message else ''} {code!r}")
        assert words in message
        assert "\n" not in message

    @pytest.mark.parametrize("code", [None, 3, ("B2", "G1", "A3")])
    def test_a_code_is_text(self, code):
        with pytest.raises(InputError, match="is not a case code"):
            laboratory.case(code)


class TestParameters:
    @pytest.mark.parametrize("code", ["B2-G1-A2", "B1-G1-A3", "B2-10mm-A3", "B2-Ginf-A3"])
    def test_identified_ones_exist_for_two_cases(self, code):
        with pytest.raises(InputError, match="B2-G1-A3 and B2-G2-A2") as caught:
            laboratory.case(code, "identified")
        assert code in str(caught.value)

    @pytest.mark.parametrize("parameters", ["fitted", "", None, "TABLE"])
    def test_an_unknown_set_is_refused(self, parameters):
        with pytest.raises(
            InputError, match=r"^parameters: .* use 'table', 'identified' or 'refined'"
        ):
            laboratory.case("B2-G1-A3", parameters)


class TestCampaign:
    def test_it_has_48_cases_in_order(self):
        codes = [case.code for case in laboratory.campaign()]
        assert len(codes) == len(set(codes)) == 48
        assert codes[:5] == ["B1-G1-A1", "B1-G2-A1", "B1-G3-A1", "B1-G4-A1", "B2-G1-A1"]
        assert codes[16] == "B1-G1-A2"
        assert codes[-1] == "B4-G4-A3"

    def test_identified_parameters_do_not_cover_it(self):
        with pytest.raises(InputError, match="'identified' exists only for"):
            laboratory.campaign("identified")


def test_a_case_shows_how_it_is_made():
    assert repr(laboratory.case("B2-G1-A3")) == "case('B2-G1-A3', parameters='table')"
