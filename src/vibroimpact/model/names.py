"""Names that users give: what they may hold, and what they are in files and in figures."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable
from typing import Any

from vibroimpact.errors import UNPRINTABLE, InputError, printable, shown

_LONGEST = 200
"""Letters of a name."""
_LONGEST_STEM = 140
"""Bytes of a file name's first part: file systems take 255 in all."""


def check_name(name: Any, field: str) -> str:
    """Read a name that is printed, drawn and written into files.

    Raises
    ------
    InputError
        If it is not a text, is longer than 200 characters, or has control characters or line
        breaks.
    """
    if not isinstance(name, str):
        raise InputError(f"{field}: {shown(name)}; a text is accepted")
    if len(name) > _LONGEST:
        raise InputError(f"{field}: {len(name)} characters; at most {_LONGEST} are accepted")
    if found := UNPRINTABLE.search(name):
        raise InputError(
            f"{field}: {shown(name)} has the control character {found[0]!a}; printable text in one "
            "line is accepted"
        )
    return name


def literal(name: str) -> str:
    """Return a name for a figure, in which a dollar sign does not start mathematics."""
    return printable(name).replace("$", r"\$")


def file_stems(names: Iterable[str]) -> dict[str, str]:
    """File names of several names, by name: those that would share one end with a hash."""
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
    """What of a text may stand in a file's name, with ``_`` for the rest: texts may share it."""
    signs = [sign if _kept(sign) else " " for sign in text]
    return re.sub("[ _]+", "_", "".join(signs)).strip("_.")


def file_stem(name: str) -> str:
    """A name as the first part of a file's name: letters and digits of any script, ``.+-_``.

    Blanks become ``_``. If more is left out, or the name is long, a hash distinguishes it from
    others.
    """
    whole = unicodedata.normalize("NFC", name)
    stem = kept_letters(whole)
    if not stem:
        return f"rig-{_digest(name)}" if name else "rig"
    if len(stem.encode()) <= _LONGEST_STEM:
        is_whole = stem.split("_") == whole.replace("_", " ").split()
        return stem if is_whole else f"{stem}-{_digest(name)}"
    return f"{stem.encode()[:_LONGEST_STEM].decode(errors='ignore')}-{_digest(name)}"
