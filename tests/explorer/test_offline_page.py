"""The page without a server, opened from a file in Chromium."""

from __future__ import annotations

import json
import re
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from itertools import combinations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.engine import native
from vibroimpact.errors import InputError
from vibroimpact.explorer.change import moved
from vibroimpact.explorer.offline_page import page
from vibroimpact.explorer.pictures import curves
from vibroimpact.explorer.presets import FIRST, names, preset
from vibroimpact.explorer.share import address, from_address
from vibroimpact.explorer.state import begin

MOST = 1_000_000
CHANGES = (
    ("stops-gap", "stops.gap", "12 mm"),
    ("mass", "mass", "700 kg"),
    ("amplitude", "amplitude", "5 mm"),
    ("stops-stiffness_ratio", "stops.stiffness_ratio", "40"),
    ("isolator-damping", "isolator.damping", "0.9 kN s/m"),
    ("isolator_period", "isolator_period", "1200 ms"),
    ("stops-gap", "stops.gap", "1.2 cm"),
)

pytestmark = pytest.mark.skipif(
    (native.FOLDER / native.DIGEST).read_text() != native.digest(), reason="run make kernels"
)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "explorer.html"
    assert main(["explore", FIRST, "--save", str(path)]) == 0
    return path


@pytest.fixture
def shown(browser, file):
    """The page in a window of its own, and all that it asked for or complained of."""
    context = browser.new_context(
        viewport={"width": 1280, "height": 720}, reduced_motion="reduce", offline=True
    )
    context.set_default_timeout(60_000)
    opened = context.new_page()
    said: list[str] = []
    opened.on("console", lambda one: one.type == "error" and said.append(one.text))
    opened.on("pageerror", lambda one: said.append(str(one)))
    opened.on(
        "request", lambda one: one.url.split(":")[0] in ("file", "blob") or said.append(one.url)
    )
    opened.goto(file.as_uri())
    opened.wait_for_selector("body[data-settled]")
    yield opened
    context.close()
    assert said == []


def settled(shown) -> None:
    shown.wait_for_function("document.body.dataset.settled === document.body.dataset.asked")


def drawn(shown) -> list[str]:
    return [
        shown.get_attribute(f"#panels [data-name='{name}'] >> nth=0", "d")
        for name in ("forward", "backward")
    ]


def heights(path: str) -> np.ndarray:
    return np.array([float(point.split(" ")[1]) for point in path[1:].split("L")])


def test_it_is_small_and_asks_for_nothing(file, shown):
    assert file.stat().st_size < MOST
    assert shown.inner_text("#status") == ""
    assert shown.is_hidden("#scenario")
    assert shown.is_visible(".alone")


def test_knobs_are_turned_and_the_curves_are_those_of_python(shown):
    state = preset(FIRST)
    for field, path, value in CHANGES:
        state = moved(state, path, value)
        shown.fill(f"#text-{field}", value)
        shown.press(f"#text-{field}", "Enter")
        settled(shown)
        there = from_address(shown.url.partition("#")[2])
        assert there.oscillator == state.oscillator
        assert there.shaking == state.shaking
        expected = curves.curves(state, curves.swept(state, fine=True), fine=True)
        for direction, path_drawn in zip(("forward", "backward"), drawn(shown), strict=True):
            y = heights(path_drawn)
            values = np.array(expected["panels"][0]["curves"][direction])
            # A pixel has one digit: two values of the curve tell the scale of the others.
            low, high = values.argmin(), values.argmax()
            scale = (y[high] - y[low]) / (values[high] - values[low])
            assert np.abs(y - y[low] - scale * (values - values[low])).max() < 0.2


def test_laws_motions_and_basins(shown):
    shown.select_option("#law-stops", "rigid")
    shown.fill("#frequency", "1.1 Hz")
    shown.press("#frequency", "Enter")
    settled(shown)
    assert "periodic" in shown.inner_text("#verdict")
    assert shown.input_value("#text-stops-restitution") == "0.6"
    shown.click("#tab-basins")
    shown.wait_for_selector("#basins li")
    assert shown.text_content("#basins li >> nth=0").startswith("A periodic, period 1")
    settled(shown)
    shown.select_option("#presets", "building with moat")
    settled(shown)
    assert shown.input_value("#text-mass") == "5000 t"


def test_addresses_are_those_of_the_server(shown):
    state = moved(preset("B3-10mm-A3" if "B3-10mm-A3" in names()[1][1] else FIRST), "mass", 600.0)
    shown.evaluate("text => { location.hash = text; }", address(state))
    shown.wait_for_function("document.getElementById('text-mass').value === '600 kg'")
    settled(shown)
    assert from_address(shown.url.partition("#")[2]) == state
    shown.evaluate("text => { location.hash = text; }", "nothing")
    shown.wait_for_selector("#status.lost")
    assert "address" in shown.inner_text("#status")


def apart(one, other) -> bool:
    return (
        one["x"] + one["width"] <= other["x"]
        or other["x"] + other["width"] <= one["x"]
        or one["y"] + one["height"] <= other["y"]
        or other["y"] + other["height"] <= one["y"]
    )


def inside(one, other) -> bool:
    return all(
        other[at] <= one[at] and one[at] + one[size] <= other[at] + other[size] + 0.5
        for at, size in (("x", "width"), ("y", "height"))
    )


@pytest.mark.parametrize(("width", "height"), [(390, 844), (390, 664), (360, 640), (844, 390)])
def test_a_telephone(browser, file, width, height):
    opened = browser.new_page(viewport={"width": width, "height": height}, has_touch=True)
    opened.goto(file.as_uri())
    opened.wait_for_selector("body[data-settled]", timeout=60_000)
    assert opened.evaluate("document.documentElement.scrollWidth") <= width
    # The curves stay in sight where a knob is turned.
    slider = opened.locator("#knob-stops-relaxation_time")
    slider.scroll_into_view_if_needed()
    curve = opened.locator("#panels [data-name='forward']").first
    before = curve.get_attribute("d")
    opened.fill("#text-stops-gap", "12 mm")
    opened.press("#text-stops-gap", "Enter")
    settled(opened)
    assert curve.get_attribute("d") != before
    assert slider.bounding_box()["height"] >= 24
    assert slider.evaluate("one => getComputedStyle(one).touchAction") == "pan-y"
    for physical, count in ((False, 2), (True, 3)):
        opened.set_checked("#physical", physical)
        settled(opened)
        slider.scroll_into_view_if_needed()
        opened.wait_for_timeout(300)  # it is laid out anew
        charts, labels, (legend,) = (
            [one.bounding_box() for one in opened.locator(f"{at} >> visible=true").all()]
            for at in ("#panels .chart", "#panels svg text.soft", ".legend")
        )
        screen = {"x": 0, "y": 0, "width": width, "height": height}
        assert len(charts) == count
        assert all(inside(chart, screen) and chart["height"] > 85 for chart in charts)
        assert all(any(inside(label, chart) for chart in charts) for label in labels)
        assert len(labels) == count + 1  # frequency
        words = [legend, *labels]
        assert all(apart(*pair) for pair in combinations(words, 2))
        assert slider.bounding_box()["y"] + 24 <= height
    opened.close()


BROKEN = (
    ("delete window.DecompressionStream", "cannot start here (ReferenceError: DecompressionStream"),
    ("window.Worker = function () { throw new Error('no workers'); }", "cannot start here (Error"),
    (
        "const post = Worker.prototype.postMessage; Worker.prototype.postMessage = "
        "function (data) { post.call(this, data.module ? { ...data, module: new ArrayBuffer(8) } "
        ": data); }",
        "computation failed (CompileError",
    ),
)


@pytest.mark.parametrize(("script", "why"), BROKEN)
def test_a_start_that_fails_says_why(browser, file, script, why):
    opened = browser.new_page()
    opened.add_init_script(script)
    opened.goto(file.as_uri())
    opened.wait_for_selector("#status.lost", timeout=10_000)
    assert why in opened.inner_text("#status")
    opened.close()


def test_what_the_page_waits_for_is_written(browser, file):
    opened = browser.new_page()
    opened.add_init_script("Response.prototype.arrayBuffer = () => new Promise(() => {})")
    opened.goto(file.as_uri())
    assert opened.inner_text("#status") == "loading …"
    opened.close()
    context = browser.new_context(java_script_enabled=False)
    opened = context.new_page()
    opened.goto(file.as_uri())
    assert "needs JavaScript" in opened.inner_text("header")
    context.close()


def test_rigs_that_only_python_computes_are_refused(tmp_path, capsys):
    friction = vi.FrictionIsolator("1 kN/m", "10 N s/m", "20 N")
    curved = vi.Rig(vi.Oscillator("100 kg", friction, vi.Bumper("9 kN/m", 10.0, "5 mm")), "0.05 g")
    with pytest.raises(InputError, match="isolator: its law, friction, is not linear"):
        page(begin(curved))
    assert main(["explore", FIRST, "--save", str(tmp_path / "no" / "page.html")]) != 0
    assert "--save" in capsys.readouterr().err


def test_a_saved_notebook_shows_the_page_or_a_picture(browser, tmp_path):
    explored = vi.explore(FIRST)
    path = tmp_path / "saved.html"
    path.write_text(f"<!doctype html><meta charset=utf-8>{explored._repr_html_()}")
    opened = browser.new_page()
    opened.goto(path.as_uri())
    frame = opened.frame_locator("iframe")
    frame.locator("body[data-settled]").wait_for(timeout=60_000)
    assert frame.locator("#text-mass").input_value() == "550 kg"
    assert opened.is_hidden("img")
    opened.close()
    friction = vi.FrictionIsolator("1 kN/m", "10 N s/m", "20 N")
    curved = vi.Rig(vi.Oscillator("100 kg", friction, vi.Bumper("9 kN/m", 10.0, "5 mm")), "0.05 g")
    assert "data:image/png" in vi.explore(curved)._repr_html_()


def test_a_notebook_without_frames_and_scripts_shows_a_picture(browser):
    explored = vi.explore(FIRST)
    text = re.sub(r"<(iframe|script)\b.*?</\1>", "", explored._repr_html_(), flags=re.DOTALL)
    opened = browser.new_page()
    opened.set_content(text)
    size = opened.locator("img").evaluate("one => [one.naturalWidth, one.naturalHeight]")
    assert min(size) > 200
    assert opened.is_visible("img")
    opened.close()
    assert explored._repr_png_().startswith(b"\x89PNG")


def test_a_notebook_of_this_machine_shows_the_page_of_its_server(browser, tmp_path):
    explored = vi.explore(FIRST)
    text = f"<!doctype html><meta charset=utf-8>{explored._repr_html_()}"
    (tmp_path / "notebook.html").write_text(text, encoding="utf-8")

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *args):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=tmp_path)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        opened = browser.new_page()
        opened.goto(f"http://127.0.0.1:{server.server_port}/notebook.html")
        frame = opened.frame_locator("iframe")
        frame.locator("body[data-settled] #scenario-name:visible").wait_for(timeout=60_000)
        assert opened.locator("iframe").get_attribute("src") == explored.address
        opened.close()
        server.shutdown()


def test_the_facts_are_json():
    text = page(preset(FIRST))
    held = text.partition('id="facts">')[2].partition("</script>")[0]
    assert json.loads(held)["first"]["name"] == FIRST
