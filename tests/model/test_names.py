"""Names of users: what is refused, and what they are in files and in figures."""

import pytest

from vibroimpact.errors import InputError, printable
from vibroimpact.model.names import check_name, file_stem, file_stems, literal


@pytest.mark.parametrize("name", ["防撞", "隔震", "éé", "Стенд-2", "wall"])
def test_letters_of_all_scripts_stay(name):
    assert check_name(name, "name") == name
    assert file_stem(name) == name


def test_no_two_names_without_a_letter_share_a_file():
    names = ["..", " ", "...", "//", "?", "*"]
    assert len({file_stem(name) for name in names}) == len(names)
    assert all(file_stem(name).startswith("rig-") for name in names)


def test_what_is_left_out_of_a_name_is_in_its_hash():
    names = ["a b", "a/b", "a: b", ".a b", "a b.", "a\u200db", "(a) b"]
    stems = [file_stem(name) for name in names]
    assert len(set(stems)) == len(names)
    assert stems[0] == file_stem("a_b") == "a_b"


def test_names_that_would_share_a_file_are_told_apart():
    stems = file_stems(["a b", "a/b", "A b", "c"])
    assert len({stem.lower() for stem in stems.values()}) == 4
    assert stems["c"] == "c"
    assert stems["a b"].startswith("a_b-")


@pytest.mark.parametrize("name", ["a/b", "../x", "a\\b", "a\x00b", "~", "C:", "\ud800"])
def test_nothing_leads_out_of_a_folder(name):
    assert not set(file_stem(name)) & set("/\\\x00~:")
    assert not file_stem(name).startswith(".")


def test_a_long_name_ends_with_a_hash():
    one, other = file_stem("撞" * 100 + "a"), file_stem("撞" * 100 + "b")
    assert one != other
    assert len(one.encode()) < 160


@pytest.mark.parametrize("sign", ["\x1b", "\0", "\n", "\r", "\x07", "\x9b", "\u202e", "\ud800"])
def test_control_characters_are_refused_and_printed_as_escapes(sign):
    with pytest.raises(InputError, match=r"^name: .* has the control character ") as error:
        check_name(f"a{sign}b", "name")
    assert str(error.value).isascii()
    assert "\n" not in str(error.value)
    if sign != "\n":
        assert printable(f"a{sign}b").isascii()


@pytest.mark.parametrize("name", [3, None, "n" * 201])
def test_what_is_no_name_is_refused(name):
    with pytest.raises(InputError, match=r"^name: .*; use a"):
        check_name(name, "name")


def test_a_dollar_is_no_mathematics():
    assert literal(r"5 $ or $\frac$") == r"5 \$ or \$\frac\$"
