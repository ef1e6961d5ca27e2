"""``vibroimpact explore``: a page on which knobs are turned and the resonance bends."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Group, Parameter

from vibroimpact.cli.garbage import search_as_usual
from vibroimpact.cli.options import RigName, RigOptions

_SERVER = Group("Server", sort_key=1)


def explore(
    rig: RigName = "B2-G1-A3",
    /,
    *,
    port: Annotated[
        int, Parameter(group=_SERVER, help="Where the page is served; 0 takes a free port.")
    ] = 0,
    browser: Annotated[
        bool,
        Parameter(group=_SERVER, negative="--no-browser", help="Open a browser."),
    ] = True,
    host: Annotated[
        str,
        Parameter(
            group=_SERVER,
            help=(
                "Address to listen on. Any other than this machine's own lets others in who know "
                "the token that is printed."
            ),
        ),
    ] = "127.0.0.1",
    changes: RigOptions | None = None,
) -> int:
    """Turn knobs in a browser, and see resonance curves, motion and scenario follow.

    Serves a page for this machine only, prints its address, and opens it. Ctrl-C ends it. The
    first time the engine is compiled, which takes a minute.

    For example:

        vibroimpact explore
        vibroimpact explore B3-10mm-A3
        vibroimpact explore building.toml --no-browser --port 8000
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
    what = subject(rig, changes or RigOptions())
    span = None
    if what.study and what.study.sweep.start and what.study.sweep.to:
        span = (what.study.sweep.start, what.study.sweep.to)
    elif what.published:
        span = (0.5, 5.0)  # of the tests
    first = begin(Rig(what.oscillator, what.repeated), what.name, span)

    def told(where: str) -> None:
        print(f"The explorer is at {where}\nCtrl-C ends it.", flush=True)
        if host not in LOOPBACK:
            warn(
                f"whoever reaches {host} and knows the token in this address can use this "
                "machine to compute, and what is sent is not encrypted"
            )
        if browser:
            import webbrowser

            webbrowser.open(where)

    try:
        with search_as_usual():
            serve(first, told, host, port)
    except KeyboardInterrupt:
        print("The explorer has ended.")
    return 0
