"""The page in a real browser: what is turned, clicked, typed and dragged, and what is seen."""

from __future__ import annotations

import re

from benchmarks.page import TURNED
from explorer.conftest import Served
from samples import sample

FORWARD = "#panels [data-name='forward']"
UNNAMED = """() => [...document.querySelectorAll("input, select, button, [role='img'], [tabindex]")]
    .filter((one) => !one.closest("[hidden]") && !one.labels?.length && !one.textContent.trim()
        && !one.getAttribute("aria-label") && !one.getAttribute("aria-labelledby"))
    .map((one) => one.outerHTML.slice(0, 80))"""


def curve(page):
    return page.locator(FORWARD).first.get_attribute("d")


def drag(page, selector, across):
    """Drag from the middle of a slider's handle, with the mouse."""
    box = page.locator(selector).bounding_box()
    value = float(page.locator(selector).input_value()) / 1000.0
    x, y = box["x"] + 8 + value * (box["width"] - 16), box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    seen = set()
    for k in range(1, 9):
        page.mouse.move(x + across * k / 8, y)
        page.wait_for_timeout(40)
        seen.add(curve(page))
    page.mouse.up()
    return seen


def until(page, condition, pair=None):
    """Wait; as a function, for the page allows no text to be run as a program."""
    page.wait_for_function(f"(pair) => {condition}", arg=pair)


def settle(page):
    """Wait until what was last asked for is drawn finely; a field shows it at once."""
    until(
        page,
        "Number(document.body.dataset.settled) >= Number(document.body.dataset.asked ?? 0)"
        " && document.body.dataset.fine === 'true'"
        " && !document.getElementById('status').textContent",
    )


def until_bent(page, before, selector=FORWARD):
    until(page, "document.querySelector(pair[0]).getAttribute('d') !== pair[1]", [selector, before])


def test_the_page_loads_and_everything_has_a_name(opened):
    page = opened()
    assert page.title() == "B2-G1-A3 – vibroimpact explorer"
    assert page.inner_text("#scenario-name") == "S3"
    assert "right hysteresis" in page.inner_text("#evidence")
    assert "periodic, period 1, stable" in page.inner_text("#verdict")
    assert page.evaluate(UNNAMED) == []
    for size in ((1280, 720), (1024, 768), (768, 1024)):
        page.set_viewport_size({"width": size[0], "height": size[1]})
        wide = page.evaluate("document.documentElement.scrollWidth")
        assert wide <= size[0]
        box = page.locator("#panels svg").first.bounding_box()
        assert box["width"] > 300
        assert box["height"] > 100


def test_a_drag_of_a_knob_bends_the_curves_and_undo_takes_it_back(opened):
    page = opened()
    before = curve(page)
    gap = page.input_value("#text-stops-gap")
    assert len(drag(page, "#knob-stops-gap", 60)) > 2
    settle(page)
    assert curve(page) != before
    assert page.input_value("#text-stops-gap") != gap
    assert page.input_value("#text-stops-gap_ratio") != "0.2169"
    page.keyboard.press("Control+z")
    until(page, "document.getElementById('undo').disabled")  # a drag is one step
    assert page.input_value("#text-stops-gap") == gap
    until(page, "document.querySelector(pair[0]).getAttribute('d') === pair[1]", [FORWARD, before])
    page.click("#redo")
    until(page, "!document.getElementById('undo').disabled")


def test_from_slider_to_paint_and_nothing_grows(opened):
    page = opened()
    page.evaluate(TURNED, {"id": "knob-stops-gap", "moves": 3})
    settle(page)
    count = page.evaluate("document.querySelectorAll('*').length")
    took = page.evaluate(TURNED, {"id": "knob-stops-gap", "moves": sample(200, 8)})
    settle(page)
    # Loosely, for machines that do much else; `make bench` measures.
    assert took["median"] < 300
    assert took["fine"] < 3000
    assert page.evaluate("document.querySelectorAll('*').length") < count + 40  # other ticks


def test_a_wrong_value_is_told_beside_the_field(opened):
    page = opened()
    page.fill("#text-stops-gap", "12 kg")
    page.keyboard.press("Enter")
    page.wait_for_selector("#why-stops-gap:not(:empty)")
    assert "mass" in page.inner_text("#why-stops-gap")
    assert page.get_attribute("#text-stops-gap", "aria-invalid") == "true"
    assert page.input_value("#text-stops-gap") == "12 kg"
    page.fill("#text-stops-gap", "1.2 cm")
    page.keyboard.press("Enter")
    page.wait_for_selector("#why-stops-gap:empty", state="attached")
    assert page.input_value("#text-stops-gap") == "12 mm"
    page.fill("#frequency", "99 Hz")
    page.keyboard.press("Enter")
    page.wait_for_selector("#frequency-why:not(:empty)")


def test_a_value_that_changes_the_set_of_knobs_stays_in_its_field(opened):
    page = opened()
    for value, shown in (("0", "0 N s/m"), ("1.2 kN s/m", "1.2 kN s/m")):
        page.fill("#text-isolator-damping", value)
        page.keyboard.press("Enter")
        # A gap over free flight's peak, which has no bound without damping.
        there = "attached" if value != "0" else "detached"
        page.wait_for_selector("#text-stops-gap_ratio", state=there)
        assert page.input_value("#text-isolator-damping") == shown
        focused = page.evaluate("document.activeElement.id")
        assert focused == "text-isolator-damping"


def test_a_click_on_a_curve_shows_the_motion_there(opened):
    page = opened()
    orbit = page.locator("#views [data-name='orbit']")
    before = orbit.get_attribute("d")
    box = page.locator("#panels .chart").first.bounding_box()
    # In the hysteresis, beside the lower curve: there the sweep comes down.
    page.mouse.click(box["x"] + 0.45 * box["width"], box["y"] + box["height"] - 40)
    until(page, "document.getElementById('direction').value === 'backward'")
    until_bent(page, before, "#views [data-name='orbit']")
    page.focus("#panels")
    page.keyboard.press("ArrowUp")
    until(page, "document.getElementById('direction').value === 'forward'")


def test_branches_that_are_unstable(opened):
    page = opened()
    page.check("#branch")
    page.wait_for_selector("#panels .unstable", state="attached")


def test_the_point_of_the_map_is_dragged(opened):
    page = opened()
    page.click("#tab-map")
    point = page.locator("#map .rig")
    point.wait_for(state="attached")
    box, before = point.bounding_box(), curve(page)
    page.mouse.move(box["x"] + 7, box["y"] + 7)
    page.mouse.down()
    page.mouse.move(box["x"] - 50, box["y"] - 60, steps=4)
    page.mouse.up()
    until(page, "document.getElementById('text-stops-gap').value !== '7.5 mm'")
    until_bent(page, before)
    assert float(page.input_value("#text-stops-stiffness_ratio")) < 15.0
    page.click("#undo")
    until(page, "document.getElementById('text-stops-gap').value === '7.5 mm'")


CLIPPED = """() => [...document.querySelectorAll("#words pre, #words")]
    .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.id)"""


def test_the_words_are_read_in_full(opened):
    page = opened()
    page.set_viewport_size({"width": 1280, "height": 720})
    page.click("#tab-words")
    until(page, "document.getElementById('words-curves').textContent.includes('Resonances')")
    assert "depth (mm)" in page.inner_text("#words-motion")
    assert page.evaluate(CLIPPED) == []
    assert page.locator("#panels svg").first.bounding_box()["width"] > 200
    page.click("#tab-motion")
    until(page, "document.querySelector('#panels svg').clientWidth > 300")


def test_symbols_have_real_subscripts(opened):
    page = opened()
    page.click("#tab-words")
    until(page, "document.getElementById('words-curves').textContent.includes('Resonances')")
    for box in ("#groups", "#panels", "#words", "#map"):
        text = page.text_content(box)
        assert not re.search(r"[A-Za-zα-ω]_[a-z]", text), box
    symbol = "#groups label[for='text-stops-stiffness'] i"
    assert page.inner_html(symbol) == "K<sub>j</sub>"
    assert page.inner_html("#groups label[for='text-stops-gap_ratio'] i") == "δ<sub>0</sub>"
    assert "η" in page.locator("#panels text:has(tspan)").first.text_content()
    rows = "[...document.querySelectorAll('#words-curves .cell')].map((one) => one.offsetWidth)"
    widths = page.evaluate(rows)
    assert len(set(widths)) == 1, "tables keep their columns"


def test_scenarios_have_their_meanings_at_the_map(opened):
    page = opened()
    page.click("#tab-map")
    page.locator("#map .rig").wait_for(state="attached")
    lines = page.locator("#map .basins li").all_inner_texts()
    assert [line.replace("\n", " ")[:2] for line in lines][:7] == [f"S{k}" for k in range(7)]
    assert "left hysteresis or non-regular resonances" in lines[4]
    assert page.get_attribute("#evidence abbr", "title") is not None


def test_laws_and_presets(opened):
    page = opened()
    page.uncheck("#together")
    page.select_option("#law-left", "none")
    page.wait_for_selector("#knob-left-gap", state="detached")
    page.select_option("#presets", "building with moat")
    until(page, "document.getElementById('text-mass').value === '5000 t'")
    page.check("#physical")
    until(page, "document.querySelectorAll('#panels svg').length === 3")


def test_an_address_gives_it_back_and_sessions_do_not_mix(opened):
    first, second = opened(), opened()
    first.fill("#text-mass", "700 kg")
    first.keyboard.press("Enter")
    until(first, "document.getElementById('text-mass').value === '700 kg'")
    settle(first)
    assert second.input_value("#text-mass") == "550 kg"
    shared = opened(first.evaluate("location.hash"))
    until(shared, "document.getElementById('text-mass').value === '700 kg'")
    settle(shared)
    assert curve(shared) == curve(first)


def test_files_are_offered(opened):
    page = opened()
    page.click("#share summary")
    for button, name in (("[data-file=study]", "B2-G1-A3.toml"), ("#svg", "B2-G1-A3.svg")):
        with page.expect_download() as download:
            page.click(button)
        assert download.value.suggested_filename == name
        text = download.value.path().read_text(encoding="utf-8")
        assert ("[oscillator]" in text) or text.startswith("<svg")


def test_light_and_dark(opened):
    grey = {}
    for scheme in ("light", "dark"):
        page = opened(color_scheme=scheme)
        colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
        grey[scheme] = int(re.findall(r"\d+", colour)[0])
    assert grey["light"] > 200
    assert grey["dark"] < 60


def test_a_server_that_ends_and_comes_back(browser):
    server = Served()
    page = browser.new_page()
    page.set_default_timeout(120_000)
    page.goto(server.address)
    page.wait_for_selector("body[data-settled]")
    page.fill("#text-mass", "700 kg")
    page.keyboard.press("Enter")
    until(page, "document.getElementById('text-mass').value === '700 kg'")
    server.stop()
    page.wait_for_selector("#status.lost")
    assert "Connection lost" in page.inner_text("#status")
    again = Served(server.port)
    page.wait_for_selector("body[data-link=connected]")
    until(page, "document.getElementById('text-mass').value === '700 kg'")
    drag(page, "#knob-stops-gap", 40)
    until(page, "document.getElementById('text-stops-gap').value !== '7.5 mm'")
    page.close()
    again.stop()
