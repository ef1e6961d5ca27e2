"""A page that is left open does not grow: many moves, and what is kept after them."""

from __future__ import annotations

import gc

import xarray as xr

from benchmarks.page import TURNED
from samples import sample
from vibroimpact.explorer.session import Session
from vibroimpact.explorer.state import MOST_STEPS, PageState

MOVES = sample(2000, 12)
READINGS = 8


def kept(page, devtools):
    """Bytes of the page's programs and numbers, and its elements, once rubbish is collected.

    The least of some readings: an answer that is on its way, or half collected, passes.
    """
    heaps = []
    for _ in range(READINGS):
        page.wait_for_timeout(100)
        devtools.send("HeapProfiler.collectGarbage")
        metrics = devtools.send("Performance.getMetrics")["metrics"]
        heaps += [one["value"] for one in metrics if one["name"] == "JSHeapUsedSize"]
    return min(heaps), page.evaluate("document.querySelectorAll('*').length")


def living(kind):
    gc.collect()
    # Asked of the type: a weak proxy asks what it stands for, which may be gone.
    return sum(issubclass(type(one), kind) for one in gc.get_objects())


def test_a_page_and_its_session_keep_no_more_after_many_moves(opened):
    page = opened()
    devtools = page.context.new_cdp_session(page)
    devtools.send("Performance.enable")
    turn = {"id": "knob-stops-gap", "moves": MOVES}
    page.evaluate(TURNED, turn)  # as many as fill what is bounded
    begun, elements = kept(page, devtools)
    sweeps = living(xr.Dataset)
    page.evaluate(TURNED, turn)
    ended, after = kept(page, devtools)
    assert ended - begun < 150_000  # every answer that is kept makes 380 kB
    # Ticks come and go with the range.
    assert abs(after - elements) < 60
    assert living(xr.Dataset) <= sweeps + 4
    assert living(Session) <= 3
    assert living(PageState) < 4 * MOST_STEPS
