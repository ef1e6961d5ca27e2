"""Start the explorer: in the foreground for the command line, in the background for a notebook."""

from __future__ import annotations

import asyncio
import base64
import html
import io
import secrets
import threading
from collections.abc import Callable
from pathlib import Path

from vibroimpact.errors import InputError
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.state import PageState, begin
from vibroimpact.model.argument_types import PositiveInt
from vibroimpact.model.laboratory import Case
from vibroimpact.model.public import public
from vibroimpact.model.rig import Rig

LOOPBACK = ("127.0.0.1", "::1", "localhost")


async def serve(
    first: PageState,
    ready: Callable[[str], None],
    host: str = LOOPBACK[0],
    port: int = 0,
    stop: asyncio.Event | None = None,
) -> None:
    """Serve pages until `stop` is set, or until the program is interrupted.

    `ready` is called with the address as soon as the server is ready. If the host is reachable from
    other machines, the address contains a token. Port 0 selects a free port.

    Raises
    ------
    InputError
        If the websocket library is not installed, or if the host or the port is invalid or in use.
    """
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


_LIVE = """<script>
{
  const [frame, live] = [document.getElementById("NAME"), "ADDRESS"];
  if (frame) document.getElementById("NAME-still").hidden = true;
  const near = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
  if (frame && (near || location.protocol === "vscode-webview:"))
    fetch(live, { mode: "no-cors" }).then(() => {
      frame.removeAttribute("srcdoc");
      frame.src = live;
    }, () => {});
}
</script>"""
"""Hides the picture beside the frame, and shows the server's page in it where the notebook is on
this machine and the server answers."""


class Explored:
    """A page in a notebook. You can also open its `address` in a browser.

    A notebook that is saved shows the page without a server, or a picture of the resonance curves
    if only Python computes the rig, or if frames or scripts are removed.
    """

    def __init__(self, where: str, height: int, state: PageState) -> None:
        self.address = where
        self._height, self._state = height, state
        self._png: bytes | None = None

    def __repr__(self) -> str:
        return f"explorer at {self.address}"

    def _repr_html_(self) -> str:
        name = f"explorer-{secrets.token_hex(8)}"
        # The address is made of letters, digits and signs that HTML leaves alone.
        live = _LIVE.replace("NAME", name).replace("ADDRESS", self.address)
        return (
            f'<div id="{name}-still">{_image(self._repr_png_())}</div>'
            f'<iframe id="{name}" srcdoc="{html.escape(self._alone())}" '
            f'title="vibroimpact explorer" width="100%" height="{self._height}" '
            f'style="border: 0" allow="clipboard-write"></iframe>{live}'
        )

    def _repr_png_(self) -> bytes:
        if self._png is None:
            self._png = _picture(self._state)
        return self._png

    def _alone(self) -> str:
        """What is shown without the server."""
        from vibroimpact.explorer.offline_page import page

        try:
            return page(self._state)
        except InputError as error:
            return f"<p>{html.escape(str(error))}</p>{_image(self._repr_png_())}"


def _picture(state: PageState) -> bytes:
    """The resonance curves as a PNG image."""
    from matplotlib import pyplot

    from vibroimpact.explorer.pictures.curves import swept
    from vibroimpact.figures import resonance_curves

    figure = resonance_curves(swept(state, fine=False))[0].get_figure(root=True)
    assert figure is not None
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=110)
    pyplot.close(figure)
    return file.getvalue()


def _image(png: bytes) -> str:
    data = base64.b64encode(png).decode()
    return f'<img src="data:image/png;base64,{data}" alt="Resonance curves" style="width: 100%">'


@public
def explore(rig: Rig | Case | str | Path = FIRST, *, height: PositiveInt = 720) -> Explored:
    """Show the interactive explorer of a rig in a notebook.

    In the explorer you change a parameter of the rig and see how the resonance curves change.

    A server in the background computes the curves. There is one server per process, and only this
    machine can connect to it. A saved notebook shows a page that needs no server; if a law of the
    rig is not linear, it shows a picture.

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
    from vibroimpact.explorer.share import address

    try:
        state = preset(rig) if isinstance(rig, str) else begin(rig)
    except InputError:
        state = begin(rig)  # which says what is wrong with it
    return Explored(f"{_background()}#{address(state)}", height, state)


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
                    asyncio.run(serve(preset(FIRST), started))
                except BaseException as error:
                    failed.append(error)
                    ready.set()

            threading.Thread(target=run, name="explorer", daemon=True).start()
            ready.wait()
            if failed:
                raise failed[0]
        return _RUNNING[0]
