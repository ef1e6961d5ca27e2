"""``vibroimpact cache``: list or remove the folders of compiled code."""

from __future__ import annotations

from typing import Literal

from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls


@calls(None, "Cache")
def cache(*, clean: Literal["others", "all"] | None = None, json: opt.Json = False) -> int:
    """List the folders of compiled code with their sizes and ages, or remove them.

    vibroimpact contains its numerical code as machine code for some systems and processors; the
    first line says whether it is used. If not, the code is compiled on first use and stored in the
    cache folder of the user, or in the folder that the environment variable VIBROIMPACT_CACHE_DIR
    names. Each version of vibroimpact has its own subfolder. You can remove the code at any time.
    Code that another process is compiling or loading is not removed.

    For example:

        vibroimpact cache
        vibroimpact cache --clean others
        vibroimpact cache --clean all

    Parameters
    ----------
    clean
        Remove the code of other versions and installations (others), or all code (all). Removed
        code is compiled again when it is needed. Default: nothing is removed.
    """
    from json import dumps

    from vibroimpact.engine import native
    from vibroimpact.engine.cache import own_folder
    from vibroimpact.engine.compiled_code import list_compiled_code, remove
    from vibroimpact.facts.compiled_code import text
    from vibroimpact.facts.tables import as_text

    own = own_folder()
    before = list_compiled_code(own)
    in_use = [one.folder.name for one in before if clean and not remove(one, clean)]
    after = list_compiled_code(own) if clean else before
    facts = {
        "engine": native.described(),
        "folder": str(own.parent),
        "kept": [one._asdict() | {"folder": one.folder.name} for one in after],
        "size": sum(one.size for one in after),
        "removed": sum(one.size for one in before) - sum(one.size for one in after),
        "in_use": in_use,
    }
    print(f"{dumps(facts, indent=2)}\n" if json else as_text(text(facts, bool(clean))), end="")
    return 0
