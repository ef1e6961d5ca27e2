"""Start the explorer: in the foreground for the command line, in the background for a notebook."""

from __future__ import annotations

import asyncio
import secrets
import threading
from collections.abc import Callable

from vibroimpact.errors import InputError
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.share import address
from vibroimpact.explorer.state import PageState, begin
from vibroimpact.model.read_rig import AnyRig

LOOPBACK = ("127.0.0.1", "::1", "localhost")


def serve(
    first: PageState, ready: Callable[[str], None], host: str = LOOPBACK[0], port: int = 0
) -> None:
    """Serve pages until the program is interrupted.

    Parameters
    ----------
    first
        Initial state of a page.
    ready
        Function that is called with the address as soon as the server is ready.
    host
        Host name or address to listen on. If it is reachable from other machines, the address
        contains a token.
    port
        Port number. 0 selects a free port.

    Raises
    ------
    InputError
        If the websocket library is not installed, or if the host or the port is invalid or in use.
    """
    asyncio.run(serving(first, host, port, ready))


async def serving(
    first: PageState,
    host: str,
    port: int,
    ready: Callable[[str], None],
    stop: asyncio.Event | None = None,
) -> None:
    """Serve pages, as `serve` does, until `stop` is set."""
    from vibroimpact.explorer.server import start

    token = "" if host in LOOPBACK else secrets.token_urlsafe(24)
    try:
        server, where = await start(first, host, port, token)
    except OSError as error:
        raise InputError(
            f"host, port: {host} {port} cannot be used ({error.strerror or error}); pass an "
            "address of this machine, and a free port or 0 for any free port"
        ) from None
    async with server:
        ready(where)
        await (stop or asyncio.Event()).wait()


class Explored:
    """A page in a notebook. You can also open its `address` in a browser."""

    def __init__(self, where: str, height: int) -> None:
        self.address = where
        self._height = height

    def __repr__(self) -> str:
        return f"explorer at {self.address}"

    def _repr_html_(self) -> str:
        # The address is made of letters, digits and signs that HTML leaves alone.
        return (
            f'<iframe src="{self.address}" title="vibroimpact explorer" width="100%" '
            f'height="{self._height}" style="border: 0" allow="clipboard-write"></iframe>'
        )


def explore(rig: AnyRig = FIRST, *, height: int = 720) -> Explored:
    """Show the interactive explorer of a rig in a notebook.

    In the explorer you change a parameter of the rig and see how the resonance curves change.

    A server in the background computes the curves. There is one server per process, and only this
    machine can connect to it.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    height
        Height of the explorer in the notebook (pixels).

    Returns
    -------
    Explored
        Object that a notebook displays as the explorer. You can also open its ``address`` in a
        browser.

    Raises
    ------
    InputError
        If the rig is not shaken by one sine, or if the websocket library is not installed.
    """
    if isinstance(height, bool) or not isinstance(height, int) or height < 1:
        raise InputError(
            f"height: {height!r} is not valid; pass a whole number of pixels, such as 700"
        )
    try:
        state = preset(rig) if isinstance(rig, str) else begin(rig)
    except InputError:
        state = begin(rig)  # which says what is wrong with it
    return Explored(f"{_background()}#{address(state)}", height)


_RUNNING: list[str] = []
_STARTING = threading.Lock()


def _background() -> str:
    """Return the address of this process's server; the first call starts it."""
    with _STARTING:
        if not _RUNNING:
            ready = threading.Event()
            failed: list[BaseException] = []

            def started(where: str) -> None:
                _RUNNING.append(where)
                ready.set()

            def run() -> None:
                try:
                    serve(preset(FIRST), started)
                except BaseException as error:
                    failed.append(error)
                    ready.set()

            threading.Thread(target=run, name="explorer", daemon=True).start()
            ready.wait()
            if failed:
                raise failed[0]
        return _RUNNING[0]
