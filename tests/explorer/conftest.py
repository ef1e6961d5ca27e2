"""One browser and one server for all that looks at the page."""

from __future__ import annotations

import asyncio
import threading

import pytest

from benchmarks.page import chromium
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.run import serve


class Served:
    """A server that can be stopped, and started again at the same address."""

    def __init__(self, port: int = 0, host: str = "127.0.0.1") -> None:
        ready = threading.Event()

        def announce(address: str) -> None:
            self.address = address
            ready.set()

        async def run() -> None:
            self._loop, self._stop = asyncio.get_running_loop(), asyncio.Event()
            await serve(preset(FIRST), announce, host, port, self._stop)

        self._thread = threading.Thread(target=lambda: asyncio.run(run()), daemon=True)
        self._thread.start()
        assert ready.wait(30)
        self.port = int(self.address.split(":")[2].split("/")[0])

    def stop(self) -> None:
        """End it, and wait until it has ended."""
        self._loop.call_soon_threadsafe(self._stop.set)
        self._thread.join(30)


@pytest.fixture(scope="session")
def served():
    server = Served()
    yield server
    server.stop()


@pytest.fixture(scope="session")
def browser():
    system = chromium()
    if system is None:
        pytest.skip("no Chromium is installed, which the page is looked at with")
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright drives the browser")
    with playwright.sync_playwright() as driver:
        shown = driver.chromium.launch(executable_path=system, args=["--no-sandbox"])
        yield shown
        shown.close()


@pytest.fixture
def opened(browser, served):
    """Open the page, in a window of its own; what its console says is no error."""
    said: list[str] = []
    contexts = []

    def opened(hash: str = "", **options):
        context = browser.new_context(
            **{"viewport": {"width": 1280, "height": 720}, "reduced_motion": "reduce", **options}
        )
        contexts.append(context)
        context.set_default_timeout(60_000)  # the engine may have to be compiled
        page = context.new_page()
        page.said = said
        page.on("console", lambda one: one.type == "error" and said.append(one.text))
        page.on("pageerror", lambda one: said.append(str(one)))
        page.goto(served.address + hash)
        page.wait_for_selector("body[data-settled]")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert said == []
