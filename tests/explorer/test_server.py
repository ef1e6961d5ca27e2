"""Who is served, and who is refused."""

from __future__ import annotations

import contextlib
import json
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import vibroimpact as vi
from explorer.conftest import Served
from vibroimpact.engine import native
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.server import MOST_MESSAGE, MOST_SESSIONS
from vibroimpact.explorer.session import Session
from vibroimpact.tasks.threads import Stopped


def live(served, **options):
    url = served.address.replace("http", "ws") + "live"
    return connect(url, **{"origin": served.address.rstrip("/"), "proxy": None, **options})


def asked(address, **headers):
    request = urllib.request.Request(address, headers=headers)
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    try:
        with opener.open(request) as answer:
            return answer.status, dict(answer.headers), answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, dict(error.headers), error.read()


def test_a_page_of_this_server_is_served(served):
    with live(served) as socket:
        hello = json.loads(socket.recv())
        assert hello["hello"]
        assert hello["state"]["name"] == FIRST
        assert hello["compiles"] is (native.find_library() is None)


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "http://127.0.0.1:1", "null", None, "https://127.0.0.1.evil"]
)
def test_a_foreign_origin_is_refused(served, origin):
    with pytest.raises(InvalidStatus) as refused:
        live(served, origin=origin)
    assert refused.value.response.status_code == 403


def test_another_host_is_refused(served):
    status, _, _ = asked(served.address, Host=f"evil.example:{served.port}")
    assert status == 421


@pytest.mark.parametrize(
    "path",
    [
        "../run.py",
        "%2e%2e/run.py",
        "page/main.js",
        "etc/passwd",
        "state.py",
        "?x=/etc/passwd",
        "\\",
    ],
)
def test_nothing_but_the_page_is_served(served, path):
    status, _, body = asked(served.address + path)
    assert (status, body) == (404, b"vibroimpact: this page does not exist\n") or (
        path.startswith("?") and b"<!doctype html>" in body
    )


def test_a_page_may_run_its_own_files_only(served):
    _, headers, body = asked(served.address)
    policy = headers["Content-Security-Policy"]
    assert "script-src 'self';" in policy
    assert "unsafe" not in policy
    assert b"<script>" not in body
    assert b"http" not in body  # nothing is loaded from elsewhere


@pytest.mark.parametrize(
    "raw",
    [
        *("", "{", "[1]", "null", '{"do": 1}', "[" * 5000, b"\x80\x04."),
        '{"do": "look", "what": "state", "on": true}',
        '{"do": "change", "path": NaN, "value": 1}',
        '{"do": "change", "path": "\\ud800", "value": 1}',
    ],
)
def test_what_is_not_understood_is_refused(served, raw):
    with live(served) as socket:
        socket.recv()
        socket.send(raw)
        while True:
            message = json.loads(socket.recv(timeout=30))
            if "refused" in message:
                break
        socket.send('{"do": "change", "path": "mass", "value": "600 kg"}')
        while "state" not in (message := json.loads(socket.recv(timeout=30))):
            pass
        assert message["state"]["undo"] == 1


def test_messages_are_bounded(served):
    with live(served) as socket:
        socket.recv()
        socket.send("x" * (MOST_MESSAGE + 1))
        with contextlib.suppress(ConnectionClosed):
            for _ in range(100):
                socket.recv(timeout=30)
        assert socket.close_code == 1009


def until(socket, key):
    """The next message with this key."""
    while key not in (message := json.loads(socket.recv(timeout=30))):
        pass
    return message


def test_a_knob_does_not_wait_for_a_file(served, monkeypatch):
    ready = threading.Event()

    def slow(session, kind, state):
        assert ready.wait(30)
        return {"file": f"{state.oscillator.mass:g} kg", "mime": "", "bytes": ""}

    monkeypatch.setattr("vibroimpact.explorer.server.Session.file", slow)
    with live(served) as socket:
        socket.recv()
        socket.send('{"do": "file", "kind": "csv"}')
        for k in range(40):  # more than wait in line
            socket.send(json.dumps({"do": "change", "path": "mass", "value": 600 + k, "n": k}))
        while until(socket, "state")["n"] != 39:
            pass
        socket.send('{"do": "file", "kind": "csv"}')
        assert "another file is being written" in until(socket, "refused")["refused"]
        ready.set()
        assert until(socket, "file")["file"] == "550 kg"  # the rig at the time of the request


def test_who_has_left_takes_no_place(served, monkeypatch):
    begun, left = threading.Event(), threading.Event()
    real = Session.file

    def until_left(session, kind, state):
        if kind != "wait":
            return real(session, kind, state)
        begun.set()
        while not session.ended:
            time.sleep(0.01)
        left.set()
        raise Stopped

    monkeypatch.setattr("vibroimpact.explorer.server.Session.file", until_left)
    with live(served) as socket:
        socket.recv()
        socket.send('{"do": "file", "kind": "wait"}')
        assert begun.wait(30)
    assert left.wait(30)
    with live(served) as socket:
        socket.recv()
        socket.send('{"do": "file", "kind": "study"}')
        assert until(socket, "file")["file"] == f"{FIRST}.toml"


@pytest.mark.parametrize(
    "head",
    [
        "GET http://[/ HTTP/1.1\r\nHost: {host}",
        "GET / HTTP/1.1\r\nHost: {host}\r\nHost: evil.example",
        "GET /live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://[",
        "GET /live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nOrigin: http://{host}",
    ],
)
def test_a_request_that_is_none_is_told_so(served, head):
    with contextlib.closing(socket.create_connection(("127.0.0.1", served.port))) as plain:
        host = f"127.0.0.1:{served.port}"
        plain.sendall(head.format(host=host).encode() + b"\r\n\r\n")
        plain.settimeout(30)
        assert plain.recv(100).startswith(b"HTTP/1.1 400 ")


def test_sessions_are_bounded(served):
    with contextlib.ExitStack() as many:
        for _ in range(MOST_SESSIONS):
            many.enter_context(live(served)).recv()
        with live(served) as one_more:
            with pytest.raises(ConnectionClosed) as closed:
                one_more.recv(timeout=30)
            assert "pages are open" in closed.value.rcvd.reason


def test_beyond_this_machine_a_token_is_asked_for():
    server = Served(host="0.0.0.0")
    token = server.address.split("=")[1]
    here = f"http://127.0.0.1:{server.port}/"
    try:
        assert len(token) >= 32
        for text, status in ((token, 200), ("", 403), (token[:-1], 403), (token + "x", 403)):
            assert asked(f"{here}?token={text}")[0] == status
        assert asked(here)[0] == asked(here + "live")[0] == 403
        at = {"origin": here.rstrip("/"), "proxy": None}
        with connect(f"ws://127.0.0.1:{server.port}/live?token={token}", **at) as socket:
            assert json.loads(socket.recv())["hello"]
        for wrong in ({**at, "origin": "http://evil.example"}, at):
            asks = f"?token={token}" if wrong != at else ""
            with pytest.raises(InvalidStatus):
                connect(f"ws://127.0.0.1:{server.port}/live{asks}", **wrong).__enter__()
    finally:
        server.stop()


# Where tests run in the background, Ctrl-C is ignored by all that they start.
COMMAND = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from vibroimpact.cli import main
sys.exit(main(["explore", "B3-G2-A1", "--no-browser"]))
"""


def test_the_command_says_where_and_ends_with_ctrl_c():
    words = [sys.executable, "-c", COMMAND]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        try:
            first = process.stdout.readline()
            assert first.startswith("The explorer is at http://127.0.0.1:")
            assert asked(first.split()[-1])[0] == 200
            process.send_signal(signal.SIGINT)
            said, _ = process.communicate(timeout=60)
        finally:
            process.kill()  # if it has not ended
    assert process.returncode == 0
    assert said.endswith("The explorer has stopped.\n")


def test_in_a_notebook():
    shown = vi.explore("B2-G1-A3", height=500)
    assert "<iframe" in shown._repr_html_()
    assert 'height="500"' in shown._repr_html_()
    assert asked(shown.address.split("#")[0])[0] == 200
    again = vi.explore(vi.Rig(preset(FIRST).oscillator.replace(mass=600.0), "0.04 g"))
    assert again.address.split("#")[0] == shown.address.split("#")[0]
    assert again.address != shown.address
    with pytest.raises(vi.InputError, match="height"):
        vi.explore("B2-G1-A3", height="tall")
    with pytest.raises(vi.InputError, match="rig"):
        vi.explore("B9")
