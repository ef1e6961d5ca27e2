"""Warnings about input, as a command prints them."""

from __future__ import annotations

import warnings

import pytest

import vibroimpact as vi
from vibroimpact.cli.output import warnings_in_lines
from vibroimpact.errors import warn_of_input


def test_each_is_one_line_and_none_is_printed_twice(capsys):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # as of a user who sets PYTHONWARNINGS
        with warnings_in_lines():
            for _ in range(2):
                warn_of_input("record 'a.csv'", ["unit m/s²", "two\nlines"])
            warn_of_input("record 'b.csv'", [])
            with pytest.raises(RuntimeWarning):
                warnings.warn("another", RuntimeWarning, stacklevel=1)
    assert capsys.readouterr().err == "vibroimpact: warning: record 'a.csv': unit m/s²; two lines\n"


def test_warnings_of_a_computation_are_lines_too(capsys):
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        with warnings_in_lines():
            for _ in range(2):
                warnings.warn("steady: it may not\nhave settled", RuntimeWarning, stacklevel=1)
    assert capsys.readouterr().err == "vibroimpact: warning: steady: it may not have settled\n"


def test_python_sees_a_warning_of_its_own_kind():
    with pytest.warns(vi.InputWarning, match="^gap: 250 m") as caught:
        warn_of_input("gap", ["250 m"])
    assert issubclass(vi.InputWarning, UserWarning)
    assert len(caught) == 1
