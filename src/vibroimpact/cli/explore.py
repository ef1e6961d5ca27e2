"""``vibroimpact explore``: an interactive page of a rig in a browser."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.garbage import search_as_usual


@calls(None, "Server")
def explore(
    rig: opt.RigName = "B2-G1-A3",
    /,
    *,
    port: int = 0,
    browser: Annotated[bool, Parameter(negative="--no-browser")] = True,
    host: str = "127.0.0.1",
    changes: opt.RigOptions = opt.AS_DESCRIBED,
) -> int:
    """Change parameters in a browser, and see resonance curves, motion and scenario change.

    Serves a page for this machine only, prints its address, and opens it. Ctrl-C ends the server.
    The engine is compiled on first use, which takes a minute.

    For example:

        vibroimpact explore
        vibroimpact explore B3-10mm-A3
        vibroimpact explore building.toml --no-browser --port 8000

    Parameters
    ----------
    port
        Port of the page; 0 for any free port.
    browser
        Open a browser. This is the default.
    host
        Address on which the server listens. With any other address than the default, other
        machines can connect if they know the token that is printed.
    """
    from vibroimpact.explorer import require_websockets

    require_websockets()

    from vibroimpact.cli.output import warn
    from vibroimpact.cli.rig import subject
    from vibroimpact.errors import InputError
    from vibroimpact.explorer.run import LOOPBACK, serve
    from vibroimpact.explorer.state import begin
    from vibroimpact.model.rig import Rig

    if not 0 <= port <= 65535:
        raise InputError(f"--port: {port}; a whole number from 0 to 65535 is accepted")
    what = subject(rig, changes)
    table = what.sweep_table
    span = (table.start, table.to) if table.start and table.to else None
    if span is None and what.published:
        span = (0.5, 5.0)  # of the tests
    first = begin(Rig(what.oscillator, what.repeated), what.name, span)

    def announce(address: str) -> None:
        print(f"The explorer is at {address}\nCtrl-C ends it.", flush=True)
        if host not in LOOPBACK:
            warn(
                f"anyone who reaches {host} and knows the token in this address can use this "
                "machine to compute, and the connection is not encrypted"
            )
        if browser:
            import webbrowser

            webbrowser.open(address)

    try:
        with search_as_usual():
            serve(first, announce, host, port)
    except KeyboardInterrupt:
        print("The explorer has ended.")
    return 0
