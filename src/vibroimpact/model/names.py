"""Names that users choose: accepted characters, and their form in file names and figures."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable
from typing import Any

from vibroimpact.errors import UNPRINTABLE, InputError, printable, shown

_LONGEST = 200
"""Largest number of characters of a name."""
_LONGEST_STEM = 140
"""Largest number of bytes of the first part of a file name. File systems allow 255 in total."""


def check_name(name: Any, field: str) -> str:
    """Check a name that is printed, drawn and written into files, and return it.

    Raises
    ------
    InputError
        If the name is not a string, is longer than 200 characters, or contains control characters
        or line breaks.
    """
    if not isinstance(name, str):
        raise InputError(f"{field}: {shown(name)}; use a string")
    if len(name) > _LONGEST:
        raise InputError(f"{field}: {len(name)} characters; use at most {_LONGEST}")
    if match := UNPRINTABLE.search(name):
        raise InputError(
            f"{field}: {shown(name)} has the control character {match[0]!a}; remove this character"
        )
    return name


def literal(name: str) -> str:
    """Return a name for a figure, in which a dollar sign does not start mathematics."""
    return printable(name).replace("$", r"\$")


def file_stems(names: Iterable[str]) -> dict[str, str]:
    """Return file names for several names. Equal file names are distinguished by a hash."""
    stems = {name: file_stem(name) for name in names}
    many = Counter(stem.lower() for stem in stems.values())
    return {
        name: stem if many[stem.lower()] == 1 else f"{stem}-{_digest(name)}"
        for name, stem in stems.items()
    }


def _digest(name: str) -> str:
    return hashlib.sha256(name.encode(errors="surrogatepass")).hexdigest()[:8]


def _kept(sign: str) -> bool:
    """Whether a sign may stand in a file's name; marks of accents belong to the letter before."""
    accent = unicodedata.category(sign) == "Mn"
    return sign.isalpha() or sign.isdecimal() or sign in ".+-_" or accent


def kept_letters(text: str) -> str:
    """Return a text with ``_`` in place of characters that a file name should not contain.

    Different texts may give the same result.
    """
    signs = [sign if _kept(sign) else " " for sign in text]
    return re.sub("[ _]+", "_", "".join(signs)).strip("_.")


def file_stem(name: str) -> str:
    """Return the first part of a file name: letters and digits of any script, and ``.+-_``.

    Blanks become ``_``. If other characters are left out, or if the name is long, a hash is
    appended, so that different names give different file names.
    """
    whole = unicodedata.normalize("NFC", name)
    stem = kept_letters(whole)
    if not stem:
        return f"rig-{_digest(name)}" if name else "rig"
    if len(stem.encode()) <= _LONGEST_STEM:
        is_whole = stem.split("_") == whole.replace("_", " ").split()
        return stem if is_whole else f"{stem}-{_digest(name)}"
    return f"{stem.encode()[:_LONGEST_STEM].decode(errors='ignore')}-{_digest(name)}"
