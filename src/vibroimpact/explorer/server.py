"""The server of the explorer: pages and their sessions, by default for this machine only.

The files of the page are read when the server starts. The server opens no other file for a page.
Messages of a page are read as JSON, and contain only numbers and names. A session is a websocket.
The server refuses requests that do not come from one of its own pages. It checks the header
``Host``, because another name may resolve to this machine, and the header ``Origin`` of a
websocket. If other machines can connect, it also checks a token.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
import logging
import mimetypes
import socket
import time
import traceback
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from http import HTTPStatus
from importlib import resources
from typing import Any, NamedTuple
from urllib.parse import parse_qs, urlsplit

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers, MultipleValuesError
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from vibroimpact.errors import InputError
from vibroimpact.explorer.session import Message, Session, Stage, shown_as
from vibroimpact.explorer.state import PageState
from vibroimpact.tasks.threads import Stopped

MOST_SESSIONS = 16
"""Largest number of open pages."""
MOST_MESSAGE = 16_384
"""Largest size of a message from a page (bytes)."""
MOST_COMPUTING = 4
"""Number of pictures that are computed at once. A sweep has its own threads, and so have files."""
_MOMENT = 0.1
"""Seconds that a picture which is overtaken is waited for."""
_SELDOM = 0.3
"""Seconds between two tellings of progress."""
_ONE_FILE = "file: another file is being written; try again when its download has started"
_ANY = ("0.0.0.0", "::")
_LIVE = "/live"
_PAGES = {"/": "index.html"}
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self' http://localhost:* http://127.0.0.1:* vscode-webview:"
)
"""A page runs its own files only; a notebook of this machine may show it in a frame."""


class Limits(NamedTuple):
    """The requests that are served."""

    hosts: frozenset[str]
    """Accepted values of the header ``Host``: names of this machine. Empty if there is a token."""
    token: str
    """Token that the address must contain. Empty if only this machine can connect."""


def _files() -> dict[str, tuple[bytes, str]]:
    """The files of the page, by their path in an address."""
    files = {}
    for item in (resources.files(__package__) / "page").iterdir():
        kind = mimetypes.guess_type(item.name)[0] or "application/octet-stream"
        if kind.startswith("text/") or item.name.endswith(".js"):
            kind += "; charset=utf-8"
        files[f"/{item.name}"] = (item.read_bytes(), kind)
    for path, name in _PAGES.items():
        files[path] = files[f"/{name}"]
    return files


class Explorer:
    """Server of pages that start with a given state."""

    def __init__(self, first: PageState, limits: Callable[[], Limits]) -> None:
        self._first, self._limits, self._files = first, limits, _files()
        self._sessions = 0
        self._telling: set[asyncio.Future[None]] = set()
        # A place is taken until its thread is free again, whoever has left meanwhile; files have
        # one of their own, so that no picture waits for them.
        self._pictures_in = ThreadPoolExecutor(MOST_COMPUTING, "explorer-picture")
        self._files_in = ThreadPoolExecutor(1, "explorer-file")

    def answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the response to an HTTP request, or None if a websocket is to be opened."""
        try:
            return self._answered(request)
        except (ValueError, MultipleValuesError):
            return _refused(HTTPStatus.BAD_REQUEST, "the address or a header is invalid")

    def _answered(self, request: Request) -> Response | None:
        asked, limits = urlsplit(request.path), self._limits()
        host = request.headers.get("Host", "").lower()
        if not limits.token and host not in limits.hosts:
            return _refused(HTTPStatus.MISDIRECTED_REQUEST, "the request is for another host")
        if asked.path in self._files and asked.path not in _PAGES:
            return _whole(*self._files[asked.path])  # the program itself is no secret
        token = parse_qs(asked.query).get("token", [""])[0]
        if not hmac.compare_digest(token.encode(), limits.token.encode()):
            return _refused(HTTPStatus.FORBIDDEN, "the token of the address is missing or wrong")
        if asked.path == _LIVE:
            origin = request.headers.get("Origin", "")
            if urlsplit(origin).netloc.lower() != host:
                return _refused(
                    HTTPStatus.FORBIDDEN, "the request comes from a page of another origin"
                )
            return None
        if asked.path in _PAGES:
            return _whole(*self._files[asked.path])
        return _refused(HTTPStatus.NOT_FOUND, "this page does not exist")

    async def live(self, connection: ServerConnection) -> None:
        """Serve one page as long as it is open."""
        if self._sessions >= MOST_SESSIONS:
            await connection.close(1013, f"{MOST_SESSIONS} pages are open; close one of them")
            return
        self._sessions += 1
        session, awake = Session(self._first), asyncio.Event()
        pictures = asyncio.create_task(self._pictures(session, awake, connection.send))
        saving: asyncio.Task[None] | None = None
        try:
            await connection.send(_text({**session.hello(), **shown_as(session.history)}))
            awake.set()
            async for raw in connection:
                message = _read(raw)
                if isinstance(message, dict) and message.get("do") == "file":
                    if saving is not None and not saving.done():
                        await connection.send(_text({"refused": _ONE_FILE}))
                        continue
                    # Beside the messages: what is turned meanwhile is answered at once.
                    kind = str(message.get("kind"))
                    saving = asyncio.create_task(
                        self._save(session, session.state, kind, connection.send)
                    )
                    continue
                await connection.send(_text(session.take(message)))
                awake.set()
        except ConnectionClosed:
            pass
        finally:
            session.end()  # what is being computed is not wanted any more
            pictures.cancel()
            if saving is not None:
                saving.cancel()
            self._sessions -= 1

    async def _pictures(
        self, session: Session, awake: asyncio.Event, send: Callable[[str], Awaitable[None]]
    ) -> None:
        """Make the pictures of the newest state whenever it changes.

        What is overtaken is not waited for, so that a knob answers at once; but no second long
        picture is begun while one that was left goes on.
        """
        making: set[asyncio.Task[str]] = set()
        try:
            while True:
                await awake.wait()
                awake.clear()
                asked = session.asked
                for stage in session.stages():
                    if not session.wants(stage):
                        continue
                    if making and stage.long:
                        await asyncio.wait(making)
                    if session.asked != asked:
                        break
                    task = asyncio.create_task(self._made(session, stage, asked, send))
                    making.add(task)
                    task.add_done_callback(making.discard)
                    task.add_done_callback(lambda done: done.cancelled() or done.exception())
                    if not await _ready(task, awake if stage.long else None):
                        break
                    if isinstance(task.exception(), Stopped):
                        break
                    await send(task.result())
                    session.sent(stage)
                else:
                    await send(_text({"settled": True, "n": session.number}))
        finally:
            for task in making:
                task.cancel()

    async def _made(
        self, session: Session, stage: Stage, asked: int, send: Callable[[str], Awaitable[None]]
    ) -> str:
        """Return one picture as it is sent, or the reason why it is missing."""
        loop, last_report = asyncio.get_running_loop(), time.monotonic()

        def progress(done: int, total: int | None) -> None:
            nonlocal last_report
            if total and time.monotonic() - last_report > _SELDOM:
                last_report = time.monotonic()
                share = _text({"progress": stage.kind, "share": round(done / total, 3)})
                try:
                    loop.call_soon_threadsafe(self._tell, send, share)
                except RuntimeError:  # the server has ended
                    raise Stopped from None

        number = session.number
        try:
            made = await loop.run_in_executor(
                self._pictures_in, session.make, stage, asked, progress
            )
            return _text({**made, "n": number})
        except InputError as error:
            return _text({"picture": stage.kind, "none": str(error)})
        except Stopped:
            raise
        except Exception as error:  # a fault of ours must not leave the page waiting for ever
            traceback.print_exc()
            return _text(
                {"picture": stage.kind, "none": f"{stage.kind}: the computation failed ({error!r})"}
            )

    def _tell(self, send: Callable[[str], Awaitable[None]], share: str) -> None:
        """Send how far a picture is, beside all else."""
        task = asyncio.ensure_future(_sent(send, share))
        self._telling.add(task)  # or it might be collected before it is done
        task.add_done_callback(self._telling.discard)

    async def _save(
        self,
        session: Session,
        state: PageState,
        kind: str,
        send: Callable[[str], Awaitable[None]],
    ) -> None:
        """Make a file of a state, and send it."""
        loop = asyncio.get_running_loop()
        try:
            message = await loop.run_in_executor(self._files_in, session.file, kind, state)
        except InputError as error:
            message = {"refused": str(error)}
        except Stopped:
            return
        except Exception as error:
            traceback.print_exc()
            message = {"refused": f"file: the file could not be written ({error!r})"}
        await _sent(send, _text(message))


async def _ready(task: asyncio.Task[str], awake: asyncio.Event | None) -> bool:
    """Wait for a picture; only briefly once another is requested."""
    if awake is None:
        await asyncio.wait({task})
        return True
    woken = asyncio.create_task(awake.wait())
    try:
        await asyncio.wait({task, woken}, return_when=asyncio.FIRST_COMPLETED)
    finally:
        woken.cancel()
    if not task.done():
        await asyncio.wait({task}, timeout=_MOMENT)  # most stop at once
    return task.done()


async def _sent(send: Callable[[str], Awaitable[None]], text: str) -> None:
    with contextlib.suppress(ConnectionClosed):  # who has left wants no progress
        await send(text)


def _read(raw: str | bytes) -> Any:
    try:
        return json.loads(raw, parse_constant=_no_number)
    except (ValueError, RecursionError):
        return None


def _no_number(word: str) -> None:
    raise ValueError(f"{word} is not valid JSON")


def _text(message: Message) -> str:
    # ASCII: what a page has sent may hold half a letter, which no encoding has.
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def _whole(body: bytes, kind: str) -> Response:
    headers = Headers(
        {
            "Content-Type": kind,
            "Content-Length": str(len(body)),
            "Content-Security-Policy": _POLICY,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cache-Control": "no-store",
            "Connection": "close",
        }
    )
    return Response(HTTPStatus.OK.value, "OK", headers, body)


def _refused(status: HTTPStatus, why: str) -> Response:
    response = _whole(f"vibroimpact: {why}\n".encode(), "text/plain; charset=utf-8")
    response.status_code, response.reason_phrase = status.value, status.phrase
    return response


async def start(first: PageState, host: str, port: int, token: str = "") -> tuple[Server, str]:
    """Start the server; return it and the address of its page.

    It runs until it is closed. Port 0 selects a free port. An address contains the token, if any.

    Raises
    ------
    OSError
        If the port is in use, or if the host is not an address of this machine.
    """
    # It reports every visitor that is refused; who is refused reads why.
    quiet = logging.getLogger("vibroimpact.explorer")
    quiet.addHandler(logging.NullHandler())
    quiet.propagate = False
    hosts: set[str] = set()
    explorer = Explorer(first, lambda: Limits(frozenset(hosts), token))
    server = await serve(
        explorer.live,
        host,
        port,
        process_request=explorer.answer,
        max_size=MOST_MESSAGE,
        max_queue=32,
        compression=None,  # on one machine it only takes time
        logger=quiet,
        server_header=None,
    )
    bound = server.sockets[0].getsockname()[1]
    if not token:
        hosts |= {f"{name}:{bound}" for name in ("localhost", "127.0.0.1", "[::1]")}
    shown = socket.gethostname() if host in _ANY else f"[{host}]" if ":" in host else host
    return server, f"http://{shown}:{bound}/" + (f"?token={token}" if token else "")
