"""The engine and the worker of the page without a server against Python.

They run in node and, where node is not installed, in Chromium; browsers give what node gives.
"""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import pytest

from vibroimpact.engine import native, steady_response
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.explorer.controls import controls
from vibroimpact.explorer.engine_layout import WASM
from vibroimpact.explorer.offline_facts import facts, table
from vibroimpact.explorer.offline_page import worker
from vibroimpact.explorer.pictures import basins, curves, motion
from vibroimpact.explorer.presets import FIRST, preset
from vibroimpact.explorer.state import PageState, begin
from vibroimpact.model import Bumper, Harmonic, Isolator, Oscillator, Rig, RigidStop
from vibroimpact.response.hold_rows import Settling
from vibroimpact.response.simulate import compute_history
from vibroimpact.response.sweep_arrays import plan_sweep, rows

NODE, FIREFOX = shutil.which("node"), shutil.which("firefox") or shutil.which("firefox-esr")
PROGRAM = Path(__file__).with_name("offline.js").read_text(encoding="utf-8").strip()
IN_NODE = f"""
const input = JSON.parse(require("fs").readFileSync(0));
// The worker waits for messages.
({PROGRAM})(input).then((text) => process.stdout.write(text, () => process.exit()));
"""
IN_FIREFOX = f"""<!doctype html><meta charset="utf-8"><script>
const send = (body) => fetch("/", {{ method: "POST", body }});
fetch("/input").then((answer) => answer.json()).then({PROGRAM}).then(send, (why) => send(why));
</script>"""
SETTINGS = 50
EXACT, NEAR = 1e-13, 1e-9
"""Difference over the size of a motion: of its extremes, and at each instant."""
WANDERING = 100
"""Cycles of a transient that may wander."""
ORDER = {"forward": 1, "backward": -1}


def drawn(random: np.random.Generator) -> PageState:
    """A rig of linear laws, shaken in any way, at a frequency of its sweep."""

    def stop() -> Bumper | RigidStop | None:
        gap = random.uniform(0.1, 1.2) * 0.02
        if random.random() < 0.25:
            return RigidStop(random.uniform(0.2, 0.9), gap)
        stiffness = k * 10 ** random.uniform(0.3, 2.0)
        return Bumper(stiffness, stiffness * 10 ** random.uniform(-3.5, -1.5), gap)

    mass = 10 ** random.uniform(1, 3)
    k = mass * (2 * np.pi * random.uniform(0.8, 1.6)) ** 2
    isolator = Isolator(k, 2.0 * random.uniform(0.08, 0.3) * np.sqrt(k * mass))
    right = stop()
    left = right if random.random() < 0.5 else stop() if random.random() < 0.7 else None
    rig = Oscillator(mass, isolator, right, left, force=random.choice([0.0, 0.1 * k * 0.01]))
    amplitude, of = {
        0: (0.4, "acceleration"),
        1: (0.008, "displacement"),
        2: (0.4 * mass, "force"),
        3: (0.008 * mass, "unbalance"),
    }[int(random.integers(4))]
    state = begin(Rig(rig, Harmonic(amplitude, 1.0, of=of)))
    return state._replace(
        direction=str(random.choice(["forward", "backward"])),
        physical=bool(random.random() < 0.5),
        shaking=state.shaking.replace(frequency=float(random.uniform(*state.span))),
    )


def program_input(states: list[PageState]) -> dict:
    module = base64.b64encode((native.FOLDER / WASM).read_bytes()).decode()
    tables = [table(one) for one in states]
    return {
        "program": worker(),
        "module": module,
        "facts": facts(preset(FIRST)),
        "states": tables,
    }


def in_node(states: list[PageState]) -> list[dict]:
    command, text = [str(NODE), "-e", IN_NODE], json.dumps(program_input(states))
    done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def in_chromium(browser, states: list[PageState]) -> list[dict]:
    opened = browser.new_page()
    answers = json.loads(opened.evaluate(PROGRAM, program_input(states)))
    opened.close()
    return answers


def in_firefox(folder: Path, states: list[PageState]) -> list[dict]:
    there, answers, answered = json.dumps(program_input(states)).encode(), [], threading.Event()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.end_headers()
            self.wfile.write(there if self.path == "/input" else IN_FIREFOX.encode())

        def do_POST(self):
            answers.append(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(204)
            self.end_headers()
            answered.set()

        def log_message(self, *args):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"
        command = [str(FIREFOX), "--headless", "--no-remote", "--profile", str(folder), address]
        shown = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            assert answered.wait(120), "Firefox does not answer"
        finally:
            shown.terminate()
            shown.wait(30)
            server.shutdown()
    return json.loads(answers[0])


@pytest.fixture(scope="module")
def run(request):
    if NODE is not None:
        return in_node
    browser = request.getfixturevalue("browser")  # or this is skipped, which says so
    return lambda states: in_chromium(browser, states)


def settings() -> list[PageState]:
    random = np.random.default_rng(1)
    return [drawn(random) for _ in range(SETTINGS)]


def numbers(lists: list[list[float | None]]) -> np.ndarray:
    return np.array(lists, dtype=float)


@pytest.mark.skipif(
    (native.FOLDER / native.DIGEST).read_text() != native.digest(), reason="run make kernels"
)
def test_sweeps_and_motions_are_those_of_python(run):
    states = settings()
    compared = 0
    for state, answer in zip(states, run(states), strict=True):
        grid = np.linspace(*state.span, curves.COARSE)
        plan = plan_sweep(state.rig, grid)
        settling = Settling(max_cycles=curves.PATIENCE, window=curves.WINDOW)
        expected, reached = rows(plan, state.direction, 0.0, settling, np.zeros(2, np.int64))
        here, there = numbers(answer["rows"]), numbers(answer["states"])
        assert (expected[:, steady_response.PERIOD] == here[:, steady_response.PERIOD]).mean() > 0.9
        # Behind what wanders, for ever or for long, rounding decides which of two motions follows.
        calm = (expected[:, steady_response.PERIOD] > 0) & (
            expected[:, steady_response.CYCLES] <= WANDERING
        )
        same = np.logical_and.accumulate(calm[:: ORDER[state.direction]])[:: ORDER[state.direction]]
        for columns in (
            [steady_response.U_LEAST, steady_response.U_MOST],
            [steady_response.A_LEAST, steady_response.A_MOST],
            [steady_response.T_LEAST, steady_response.T_MOST],
            [steady_response.FORCE, steady_response.FORCE + 1],
        ):
            one, other = expected[same][:, columns], here[same][:, columns]
            finite = np.isfinite(one) & np.isfinite(other)
            size = np.abs(np.where(finite, one, 0.0)).max(axis=1, keepdims=True)
            away = np.abs(np.subtract(one, other, where=finite, out=np.zeros_like(one)))
            assert (away <= EXACT * size).all()
        parts = [ONE_MASS.displacement(), ONE_MASS.velocity()]
        size = np.abs(reached[same][:, parts]).max(axis=0, initial=0.0)
        assert (np.abs(reached - there)[same][:, parts] <= NEAR * size).all()
        compared += int(same.sum())

        at = int(np.argmin(np.abs(grid - state.shaking.frequency)))
        if not same[at]:
            continue
        shaken = state.shaking.replace(frequency=float(grid[at]))
        data = curves.swept(state, fine=False)
        section = data["section"].sel(direction=state.direction).isel(frequency=at)
        motion = compute_history(Rig(state.oscillator, shaken), 3, section, 40)
        for name, row in (
            ("displacement", record_layout.DISPLACEMENT),
            ("velocity", record_layout.VELOCITY),
            ("acceleration", record_layout.ACCELERATION),
        ):
            one, other = motion[name].values, numbers(answer["motion"][row : row + 1])[0]
            assert np.abs(one - other).max() <= NEAR * np.abs(one).max()
    assert compared > 0.75 * SETTINGS * curves.COARSE


@pytest.mark.skipif(NODE is None, reason="without node, Chromium is compared with Python")
def test_chromium_gives_what_node_gives(browser):
    states = settings()
    assert in_chromium(browser, states) == in_node(states)


@pytest.mark.full
@pytest.mark.skipif(NODE is None or FIREFOX is None, reason="node or Firefox is not installed")
def test_firefox_gives_what_node_gives(tmp_path):
    states = settings()
    for one, other in zip(in_firefox(tmp_path, states), in_node(states), strict=True):
        # Its sines differ in the last digit.
        ours, theirs = (
            answer["careful"].pop("spectrum")["displacement"] for answer in (one, other)
        )
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=1e-15 * max(theirs))
        assert one == other


def test_pictures_and_knobs_are_those_of_python(run):
    random = np.random.default_rng(2)
    states = [preset(FIRST), *(drawn(random) for _ in range(8))]
    for state, answer in zip(states, run(states), strict=True):
        expected = curves.curves(state, curves.swept(state, fine=False), fine=False)
        for panel in expected["panels"]:
            for level in panel["levels"]:
                del level["label"]  # which no page shows
        assert near(answer["curves"], json.loads(json.dumps(expected)))
        knobs = [one._asdict() for one in controls(state, state)]
        theirs = [one for one in knobs if one["path"] != "isolator.damping_exponent"]
        assert near(answer["controls"], theirs)


def test_pictures_of_motions_are_those_of_python(run):
    random = np.random.default_rng(3)
    states = [preset(FIRST), *(drawn(random) for _ in range(12))]
    periodic = 0
    for state, answer in zip(states, run(states), strict=True):
        data = curves.swept(state, fine=False)
        held = data.sel(direction=state.direction)
        if (held["cycles"] > WANDERING).any():
            continue  # see above
        quick, careful = motion.quick(state, data), motion.careful(state, data)
        assert near(answer["quick"], quick)
        lines, expected = (
            one.pop("spectrum")["displacement"] for one in (answer["careful"], careful)
        )
        # The page's lines are those of samples.
        np.testing.assert_allclose(lines, expected, rtol=1e-3, atol=1e-5 * max(expected))
        assert answer["careful"].pop("table") is None
        del careful["table"]
        words, theirs = answer["careful"].pop("words"), careful.pop("words")
        if "period" in theirs:
            assert words.split("; ")[0] == theirs.split("; ")[0]
            multipliers = [float(one.split()[-3]) for one in (words, theirs)]
            assert multipliers[0] == pytest.approx(multipliers[1], rel=1e-5, abs=1e-9)
            periodic += 1
        assert near(answer["careful"], careful)
    assert periodic > 6


def test_basins_are_those_of_python(run):
    state = preset("B2-G1-A3")._replace(shown=frozenset(["basins"]))
    (answer,) = run([state])
    expected = basins.starts(state, False, lambda done, total: None)
    assert answer["basins"]["motions"] == expected["motions"]
    assert len(expected["motions"]) == 2
    assert answer["basins"]["excursions"] == expected["excursions"]
    cells = np.array(answer["basins"]["cells"]) == np.array(expected["cells"])
    assert cells.all()
    assert near(answer["basins"], expected)


def near(one, other) -> bool:
    """Whether two pictures are the same, but for the last of five digits."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(near(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(near, one, other))
    if isinstance(one, float | int) and isinstance(other, float | int):
        return abs(one - other) <= 1.1e-4 * max(abs(one), abs(other), 1e-12)
    return one == other
