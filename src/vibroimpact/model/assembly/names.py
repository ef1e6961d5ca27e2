"""Names of masses, links and stops: identifiers, which the paths of parameters contain."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Final

from vibroimpact.errors import InputError, advised, alternatives, meant, shown
from vibroimpact.model.unknown_keys import LIKENESS

GROUND: Final = "ground"
"""Name of the base in links and stops."""
_NAME = re.compile(r"[^\W_][\w-]*|_[\w-]*")
_LONGEST = 60


def check_part_name(name: object, where: str) -> str:
    """Check the name of a mass, a link or a stop, and return it.

    Raises
    ------
    InputError
        If the name is not an identifier, is longer than 60 characters, or is ``"ground"``.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name) or len(name) > _LONGEST:
        raise InputError(
            f"{where}: {shown(name)} is not an identifier; use a name such as 'roof', of letters, "
            f"digits, _ and -, that begins with a letter or a digit and has at most {_LONGEST} "
            "characters"
        )
    if name == GROUND:
        raise InputError(
            f"{where}: 'ground' is reserved for the base; use another name, such as 'base'"
        )
    return name


def check_body(name: object, masses: Collection[str], where: str) -> str:
    """Check that a link or a stop ends at a mass or at the ground, and return its name."""
    return check_known(name, (*masses, GROUND), "mass", where)


def check_known(name: object, names: Collection[str], what: str, where: str) -> str:
    """Check that a part of an assembly exists, and return its name.

    `what` is the kind of the part, such as "mass". The message begins with `where`, the path of the
    name, and suggests the nearest one.
    """
    if isinstance(name, str) and name in names:
        return name
    if not names:
        raise InputError(f"{where}: {shown(name)} is not a {what}; the assembly has no {what}s")
    use = advised(meant(name, names, LIKENESS), alternatives(names))
    raise InputError(f"{where}: {shown(name)} is not a {what}; {use}")
