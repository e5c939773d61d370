"""The page in a real browser; skipped where none is installed."""

import pytest
from tests.report.browser import BROWSER, browser

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report import report
from contact_sim_pkg.report.comparison.runs import write_comparison
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.report import write_report
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.resolve import load_resolved

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium or chrome on the PATH")
WIDE, NARROW = 1400, 400
"""[px] of the two windows"""
RUNS = {
    "impact": ("impact_rubber_drop", "duration=0.3"), "roller": ("roller_corrugation", "duration=0.5"),
    "block": ("block_fall", "duration=0.01"), "occupant": ("seat_ride_full", "duration=0.05"),
}  # fmt: skip
"""Runs of the rigs that no bag of a closed form has, as short as their pages have all their pictures."""


@pytest.fixture(scope="module")
def tab(tmp_path_factory):
    with browser(tmp_path_factory.mktemp("browser")) as found:
        yield found


@pytest.fixture(scope="module", params=[
    "car", "seat", "rolling", "backrest", *RUNS, "car-car", "backrest-backrest-backrest",
])  # fmt: skip
def page(request, tmp_path_factory):
    """The page of one run, or of several."""
    if request.param in RUNS:
        folder = tmp_path_factory.mktemp("run") / request.param
        assert run_offline(load_resolved(*RUNS[request.param]), folder).failure == ""
        bags = [open_bag(folder)]
    else:
        bags = [request.getfixturevalue(name) for name in request.param.split("-")]
    out = tmp_path_factory.mktemp("page") / "page.html"
    return request.param, write_report(*bags, out) if len(bags) == 1 else write_comparison(bags, out)


@pytest.fixture(scope="module", params=[WIDE, NARROW])
def shown(request, page, tab):
    return page[0], tab.measured(page[1], request.param)


def test_every_picture_is_drawn(shown):
    name, found = shown
    pictures = {
        "car": 13,
        "seat": 6,
        "rolling": 11,
        "backrest": 11,
        "impact": 10,
        "roller": 9,
        "block": 7,
        "occupant": 14,
        "car-car": 7,
        "backrest-backrest-backrest": 6,
    }
    assert found["pictures"] == pictures[name]
    assert found["texts"] > 100


def test_the_page_is_short_as_first_opened(shown):
    _, found = shown
    assert found["height"] <= 6000
    assert found["height"] < found["unfolded"]


def test_the_first_screen_has_a_tile_and_a_picture(shown):
    _, found = shown
    assert found["first_tile"] <= 900
    assert found["first_picture"] <= 900


def test_no_text_is_too_small_cut_or_over_another(shown):
    _, found = shown
    assert found["smallest"] == []
    assert found["cut"] == []
    assert found["overlap"] == []


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_a_tile_holds_both_its_errors(tmp_path, monkeypatch, seat, tab, width):
    """Numerical and random, of several digits each."""
    recording = read_recording(seat)
    metrics = [each._replace(error=0.00123, spread=0.0456) for each in metrics_of(recording)]
    monkeypatch.setattr(report, "metrics_of", lambda _recording: metrics)
    out = tmp_path / "page.html"
    out.write_text(report.render(recording))
    found = tab.measured(out, width)
    assert found["cut"] == []


def test_nothing_runs_over_the_side(shown):
    _, found = shown
    assert found["content"] <= found["window"]


def test_the_contents_list_every_fold_and_lead_somewhere(shown):
    _, found = shown
    assert found["unlisted"] == []
    assert found["broken"] == []
    assert found["headless"] == 0


def test_the_scripts_run_under_the_policy_and_ask_for_nothing(shown):
    _, found = shown
    assert found["console"] == []
    assert found["requests"] == []
    assert found["ready"] > 0


def test_the_slider_moves_the_map_and_the_cursor(page, tab):
    name, file = page
    tab.open(file, WIDE, 900)
    if tab.value("document.querySelector('.slider') === null"):
        assert name in {"seat", *RUNS}
        pytest.skip("the bag has no map")
    seen = "document.querySelector('.film output').textContent"
    before = tab.value(seen)
    tab.value("{ const slider = document.querySelector('.slider input'); slider.value = slider.max;"
              " slider.dispatchEvent(new Event('input')); }")  # fmt: skip
    assert tab.value(seen) != before
    assert float(tab.value("document.querySelector('.u-legend .u-value').textContent")) > 0.0


def test_the_keyboard_reaches_every_control(page, tab):
    """By the tabulator key: folds, links, slider, choices, and what scrolls."""
    tab.open(page[1], WIDE, 900)
    wanted = tab.value("""(() => {
      const all = [...document.querySelectorAll("a[href], summary, input:not([disabled]), .picture, .frame")];
      const shown = all.filter(each => each.checkVisibility({contentVisibilityAuto: true}) && each.getClientRects().length);
      shown.forEach((each, number) => { each.dataset.control = number; });
      // of a group of choices the one that is chosen
      return shown.filter(each => each.type !== "radio" || each.checked).map(each => each.dataset.control);
    })()""")
    reached = set()
    for _ in range(len(wanted) + 5):
        for kind in ("rawKeyDown", "keyUp"):
            tab.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.add(tab.value("document.activeElement.dataset.control"))
    assert len(wanted) > 8
    assert {*wanted} - reached == set()


def test_print_shows_every_number(page, tab):
    """Folds are open: each cell of each table, each tile and each caption has a place on the paper."""
    tab.open(page[1], 794, 1123, media="print")
    shown = tab.value("""(() => {
      const all = [...document.querySelectorAll("main table.grid :is(td, th), main .facts tbody :is(td, th), .tile, figcaption")]
        .filter(each => each.textContent.trim());
      const drawn = each => each.checkVisibility({contentVisibilityAuto: true}) && each.getBoundingClientRect().height;
      const hidden = all.filter(each => !drawn(each));
      return {all: all.length, hidden: hidden.map(each => each.textContent.trim().slice(0, 40))};
    })()""")
    assert shown["all"] > 50
    assert shown["hidden"] == []


def test_every_table_has_header_cells_of_rows_and_columns(page, tab):
    tab.open(page[1], WIDE, 900)
    bare = tab.value("""[...document.querySelectorAll("main table:not(.u-legend)")].filter(table =>
        !table.querySelector("thead th[scope=col]") || [...table.tBodies].some(body =>
          [...body.rows].some(row => !row.querySelector("th[scope=row]")))).map(table => table.textContent.trim().slice(0, 40))""")
    assert bare == []


def test_tables_scroll_in_their_frame_and_break_no_number(page, tab):
    """At 400 px no table runs over the page, and each number stands on one line."""
    tab.open(page[1], NARROW, 900)
    broken = tab.value(r"""(() => {
      for (const fold of document.querySelectorAll("main details")) fold.open = true;
      const found = [];
      if (document.documentElement.scrollWidth > document.documentElement.clientWidth) found.push("the page scrolls");
      const cells = [...document.querySelectorAll("table.grid td, .tile b, .tile small, .tile p")];
      for (const node of cells.flatMap(cell => [...cell.childNodes])) {
        for (const word of node.nodeType === 3 ? node.textContent.matchAll(/[-+]?\d[\d.·e⁻⁰¹²³⁴-⁹]*/g) : []) {
          const range = document.createRange();
          range.setStart(node, word.index);
          range.setEnd(node, word.index + word[0].length);
          if (new Set([...range.getClientRects()].map(each => Math.round(each.top))).size > 1) found.push(node.textContent);
        }
      }
      return found;
    })()""")
    assert broken == []


@pytest.mark.parametrize("dark", [False, True])
def test_texts_stand_out_from_their_ground(page, tab, dark):
    """Contrast of at least 4.5 of each text, as it is painted, to the ground behind it (WCAG 2.2, 1.4.3)."""
    tab.open(page[1], WIDE, 900, dark=dark)
    found = tab.value(CONTRAST)
    assert found["texts"] > 100
    assert found["faint"] == []


CONTRAST = r"""(() => {
  for (const fold of document.querySelectorAll("main details")) fold.open = true;
  const parts = text => (text.match(/[\d.]+/g) || []).map(Number);
  const light = colour => {
    const [r, g, b] = colour.map(each => each / 255)
      .map(each => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
  };
  const ground = element => {
    for (let each = element; each; each = each.parentElement) {
      const colour = parts(getComputedStyle(each).backgroundColor);
      if (colour.length === 3 || colour[3] > 0) return colour;
    }
    return [255, 255, 255];
  };
  const onMap = text => text.ownerSVGElement && [...text.ownerSVGElement.querySelectorAll("image")].some(image => {
    const [on, own] = [image, text].map(each => each.getBoundingClientRect());
    return own.left > on.left && own.right < on.right && own.top > on.top && own.bottom < on.bottom;
  });
  const walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT), faint = new Set();
  let texts = 0;
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.textContent.trim() || /^(SCRIPT|STYLE|NOSCRIPT)$/.test(parent.tagName) || parent.closest(".unseen")) continue;
    if (!parent.checkVisibility() || onMap(parent)) continue;
    const style = getComputedStyle(parent), ink = parts(parent.ownerSVGElement ? style.fill : style.color);
    const [a, b] = [light(ink.slice(0, 3)), light(ground(parent).slice(0, 3))], ratio = Math.max(a, b) / Math.min(a, b);
    texts += 1;
    if (ratio < 4.5) faint.add(`${ratio.toFixed(2)} ${node.textContent.trim().slice(0, 30)}`);
  }
  return {texts, faint: [...faint]};
})()"""
"""Texts whose colour, as computed, stands out too little from the first ground behind them that is not transparent;
those on a map are left out."""
