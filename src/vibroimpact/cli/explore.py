"""``vibroimpact explore``: an interactive page of a rig in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.garbage_collection import search_as_usual
from vibroimpact.errors import InputError


@calls(None, "Server")
def explore(
    rig: opt.RigName = "B2-G1-A3",
    /,
    *,
    port: int = 0,
    browser: Annotated[bool, Parameter(negative="--no-browser")] = True,
    host: str = "127.0.0.1",
    save: Path | None = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
) -> int:
    """Change parameters in a browser, and see how the resonance curves and the motion change.

    The page also shows the scenario, which is a class of resonance curves (see vibroimpact
    classify). The command starts a server, prints the address of its page, and opens the page in a
    browser. By default, only this machine can open the page. To stop the server, press Ctrl-C.

    For example:

        vibroimpact explore
        vibroimpact explore B3-10mm-A3
        vibroimpact explore building.toml --no-browser --port 8000
        vibroimpact explore B2-G1-A3 --save explorer.html

    Parameters
    ----------
    rig
        The rig with which the page starts: code of a laboratory case, or path of a study file.
        Details: vibroimpact help rigs. Default: B2-G1-A3.
    port
        Port of the server, a whole number. With 0, any free port is used.
    browser
        Open the page in a browser. This is the default.
    host
        Address on which the server listens. If you change the default, other machines can connect
        to the server if they know the token. The token is a secret key, which is part of the
        printed address of the page.
    save
        Name of an HTML file to which the page is written; no server is started then. The file
        contains the compiled engine: in a browser it computes rigs with linear laws by itself,
        without scenarios, unstable orbits and the map. Default: no file.
    """
    import asyncio

    from vibroimpact.cli.output import warn
    from vibroimpact.cli.rig import subject
    from vibroimpact.explorer.run import LOOPBACK, serve
    from vibroimpact.explorer.state import begin

    if not 0 <= port <= 65535:
        raise InputError(f"--port: {port}; pass a whole number from 0 to 65535")
    what = subject(rig, changes)
    table = what.sweep_table
    span = (table.start, table.to) if table.start and table.to else None
    if span is None and what.published:
        span = (0.5, 5.0)  # the range of the published tests
    first = begin(vi.Rig(what.oscillator, what.repeated), what.name, span)

    if save is not None:
        from vibroimpact.explorer.offline_page import page

        whole = page(first)
        try:
            save.write_text(whole, encoding="utf-8")
        except OSError as error:
            raise InputError(
                f"--save: {str(save)!r} cannot be written ({error.strerror}); pass the path of a "
                "file in a folder that exists"
            ) from None
        print(f"The page is in {save}, {len(whole) // 1024} KiB")
        return 0

    def announce(address: str) -> None:
        print(f"The explorer is at {address}\nPress Ctrl-C to stop it.", flush=True)
        if host not in LOOPBACK:
            warn(
                f"anyone who can connect to {host} and knows the token in this address can run "
                "computations on this machine, and the connection is not encrypted; use --host "
                "only in a network that you trust"
            )
        if browser:
            import webbrowser

            webbrowser.open(address)

    try:
        with search_as_usual():
            asyncio.run(serve(first, announce, host, port))
    except KeyboardInterrupt:
        print("The explorer has stopped.")
    return 0
