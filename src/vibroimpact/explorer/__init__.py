"""The explorer: a page on which knobs are turned and resonance curves bend.

One page, one session, one immutable state::

    state.py      what is shown, and what was shown before
    controls.py   the knobs that a state has, with their ranges
    change.py     from a state to the next one
    presets.py    where to begin
    pictures/     from a state to what is drawn; a picture a file
    session.py    what a page asks for, and the newest request only
    server.py     pages and sessions on this machine
    share.py      a state as an address, a study file and a program

The page itself (HTML, CSS, JavaScript) is in ``page/``: it draws what it is
sent and computes nothing.
"""

from __future__ import annotations

from importlib.util import find_spec

from vibroimpact.errors import InputError


def require_websockets() -> None:
    """Refuse to serve a page without the websocket library, before anything is computed.

    Raises
    ------
    InputError
        If it is missing.
    """
    if find_spec("websockets") is None:
        raise InputError(
            "explore: the package websockets is not installed; pip install 'vibroimpact[explore]' "
            "installs it"
        )
