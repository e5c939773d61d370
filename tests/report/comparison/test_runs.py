"""One page on several bags."""

import re

import pytest
from click.testing import CliRunner
from tests.report.page import Page
from tests.report.synthetic_bag import seat_bag
from tests.rigs.backrest.report import backrest_bag as known

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.cli.report import command
from contact_sim_pkg.compare.side_by_side import side_by_side
from contact_sim_pkg.report.answer import answer_of
from contact_sim_pkg.report.comparison.curves import compared
from contact_sim_pkg.report.comparison.figures import COLOURS, make_runs
from contact_sim_pkg.report.comparison.runs import distinct_names, render_comparison, write_comparison
from contact_sim_pkg.report.comparison.tables import metric_table
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.metrics.listing import metrics_of
from contact_sim_pkg.report.reading import MOST_RUNS, read_recording
from contact_sim_pkg.rigs.backrest.report.figures_comparison import domain_comparison

FREQUENCIES = (4.75, 5.25, 5.75, 6.25)


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags")
    return [known.backrest_bag(folder / f"run_{each}", each) for each in FREQUENCIES]


@pytest.fixture(scope="module")
def page(bags):
    return Page(render_comparison([read_recording(bag) for bag in bags]))


def test_four_runs_lie_on_one_page_called_by_their_bags(page):
    text = " ".join(page.texts)
    assert "comparison of 4 bags" in text
    assert page.tags.count("figure") == 6 + 7, "pictures; a film of each run and of three differences"
    for letter, each in zip("ABCD", FREQUENCIES, strict=True):
        name = f"{letter}: run_{each}"
        assert page.texts.count(name) >= 1 + 1 + 4, "in both tables and every legend"
        assert page.texts.count(f"{each} Hz") >= 1, "in the table of keys"


def test_the_first_screen_has_the_verdict_of_every_run_beside_its_length(page, bags):
    said = " ".join(page.texts)
    for letter, each, bag in zip("ABCD", FREQUENCIES, bags, strict=True):
        recording = read_recording(bag)
        word = answer_of(recording, metrics_of(recording)).word.lower()
        assert f"{letter}: run_{each} of {recording.duration:.4g} s, {word}" in said


def test_the_first_curve_of_two_cars_is_the_transmissibility_of_their_seats(car):
    """Not the load of the tire over two cycles of 40 ms, which stands below."""
    text = render_comparison([read_recording(car)] * 2)
    drawn = re.findall(r'<figure id="([^"]+)"', text)
    assert drawn[0].endswith("-response")
    assert any(each.endswith("-force") for each in drawn[1:])


def test_the_table_has_the_metrics_of_every_run(bags):
    recordings = [read_recording(bag) for bag in bags]
    names = distinct_names(recordings)
    sides = side_by_side([compared(name, each) for name, each in zip(names, recordings, strict=True)])
    table = metric_table(names, sides)
    rows = {row[0]: row[1:] for row in table.rows}
    assert table.header[1:5] == tuple(names)
    assert table.header[5:7] == ("Δ % of B", "B is")
    assert table.header[-2:] == ("rests on", "verdict")
    assert rows["slaps"][:4] == tuple(str(known.touches(each).size) for each in FREQUENCIES)
    assert rows["restitution e, mean"][:4] == ("0.5 ± 0",) * 4  # all slaps are alike
    assert rows["restitution e, mean"][-2] == "event"
    assert rows["largest area over that at rest"][:4] == ("6",) * 4


def test_runs_without_slaps_are_compared_without_them(tmp_path):
    kept = [known.backrest_bag(tmp_path / f"{each}", each, slaps=False) for each in (4.0, 5.0)]
    page = Page(write_comparison(kept, tmp_path / "page.html").read_text(encoding="utf-8"))
    assert page.tags.count("figure") == 5 + 3, "pictures; two films and their difference"
    assert "Work that the contact takes a cycle, and friction" in " ".join(page.texts)


def test_the_contact_domain_of_every_run_is_told_with_its_axes(page):
    (caption,) = [each for each in page.texts if each.startswith("Above at first touch")]
    assert all(f"run_{each}: " in caption for each in FREQUENCIES)


@pytest.mark.parametrize("count", [2, 5])
def test_any_number_of_domains_is_drawn(bags, count):
    recordings = [read_recording(bag) for bag in (bags * 2)[:count]]
    runs = make_runs([str(number) for number in range(count)], recordings)
    with style():
        drawn = domain_comparison("key", "backrest", runs)
    assert drawn is not None
    assert all(f"{number}: " in drawn.caption for number in range(count))


def test_other_rigs_are_compared_by_force_and_approach(seat, tmp_path):
    page = Page(
        write_comparison([seat, seat_bag(tmp_path / "other")], tmp_path / "page.html").read_text(encoding="utf-8")
    )
    assert page.tags.count("figure") == 3


def test_there_is_a_colour_for_each_of_as_many_runs_as_may_be_compared(seat):
    assert len({*COLOURS}) == MOST_RUNS
    with pytest.raises(BagError, match=f"at most {MOST_RUNS} bags, {MOST_RUNS + 1} given"):
        write_comparison([seat] * (MOST_RUNS + 1))


def test_bags_of_two_rigs_are_refused(bags, seat):
    with pytest.raises(BagError, match=r"run_4\.75 is of rig backrest .*, seat of rig seat .*one by one"):
        write_comparison([bags[0], seat])


def test_one_bag_is_no_comparison(bags):
    with pytest.raises(BagError, match="at least two bags, 1 given"):
        render_comparison([read_recording(bags[0])])


def test_the_command_takes_several_bags(seat, tmp_path):
    folder = str(seat.path.parent)
    several = CliRunner().invoke(command, [folder, folder, "--out", str(tmp_path / "page.html")])
    *lines, last = several.output.splitlines()
    assert last == f"report: {tmp_path / 'page.html'}"
    said = [line for line in lines if line and not line.startswith("report: ")]  # progress, of a slow machine
    assert said
    assert all("package_version (0.0-synthetic and " in line for line in said), "the bags are synthetic, and it is said"
    assert "comparison of 2 bags" in (tmp_path / "page.html").read_text(encoding="utf-8")
    assert CliRunner().invoke(command, []).exit_code == 2
