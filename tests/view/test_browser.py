"""The live page in a real browser; skipped where none is installed."""

import time

import pytest
from tests.bench_process import wait_until
from tests.report.browser import BROWSER, browser
from tests.view.frames import written

pytest.importorskip("websockets")
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium or chrome on the PATH")

from contact_sim_pkg.bag.reader import open_bag  # noqa: E402
from contact_sim_pkg.view.recorded import RecordedSource  # noqa: E402
from contact_sim_pkg.view.scope import Scope  # noqa: E402
from contact_sim_pkg.view.server import ViewServer  # noqa: E402


@pytest.mark.parametrize("width", [1400, 400])
def test_curves_and_maps_are_drawn_and_the_console_is_empty(tmp_path, width):
    scope = Scope()
    source = RecordedSource(open_bag(written(tmp_path)), scope)
    with ViewServer(scope, "a run") as server, browser(tmp_path) as tab:
        tab.open(server.address, width, 900)
        source.go(time.monotonic())
        source.advance(time.monotonic() + 10.0)
        wait_until(lambda: tab.value("counts.drawn > 0 && document.querySelectorAll('#maps canvas').length") == 1)
        wait_until(lambda: "seat_ride" in tab.value("document.getElementById('state').textContent"))
        assert tab.value("[...document.querySelectorAll('#view .u-label')].map(each => each.textContent)")
        assert tab.value("document.querySelectorAll('#view .uplot').length") == 2
        # a map has its canvas as soon as the run is known, its picture and then its caption with a later frame
        wait_until(lambda: tab.value("document.querySelector('#maps output').textContent") != "")
        pixel = "[...c.getContext('2d').getImageData(c.width / 2, c.height / 2, 1, 1).data]"
        assert tab.value(f"(c => {pixel})(document.querySelector('#maps canvas'))")[3] == 255, (
            "the middle of a Hertz contact is loaded"
        )
        assert tab.value("document.documentElement.scrollWidth") <= width
        tab.value("document.getElementById('pause').click()")
        wait_until(lambda: not server.wishes.empty())
        assert server.wishes.get()["do"] in ("go", "pause")
        assert tab.said() == []
