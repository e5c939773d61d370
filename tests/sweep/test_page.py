"""The page of a sweep and of a plan, and what it says of the cases."""

import math

import numpy
import pytest
from scipy import stats
from tests.report.page import Page

from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.metric import EVENT, NO_BAND, Metric
from contact_sim_pkg.report.metrics.views import rows_of
from contact_sim_pkg.sweep.correlations import column_of, correlation, outliers, varying_metrics
from contact_sim_pkg.sweep.page import Swept, page_of, write_page, write_plan_page
from contact_sim_pkg.sweep.plan import judge, read_plan
from contact_sim_pkg.sweep.table import SweepTable

KEYS = [(a, b, c) for a in (1.0, 2.0, 3.0, 4.0) for b in (10.0, 20.0, 30.0) for c in ("soft", "hard")]
PLAN = "sweeps: {ride: {scene: seat_ride, vary: ['a=1,2,3,4'], require: {m.force: {max: %s, unit: N}}}}"


def force(a, b, c):
    return 5.0 * a**2 - b + 7.0 * (c == "hard")


def row(number, value):
    metrics = [Metric(key, key, found, unit, NO_BAND, None, basis=EVENT)
               for key, found, unit in (("m.force", value, "N"), ("m.same", 1.0, ""), ("m.nothing", math.nan, "m"))]  # fmt: skip
    return {
        "number": number, "outcome": "finished", "sentence": "", "metrics": rows_of(metrics), "wall": 1.0, "cpu": 1.0,
        "case": f"hash{number}", "machine": "m",
    }  # fmt: skip


def swept(change=None, keys=KEYS):
    values = [{"x.a": str(a), "x.b": str(b), "x.c": c} for a, b, c in keys]
    found = [force(*each) for each in keys]
    if change is not None:
        found[change] += 40.0
    return SweepTable(values, [row(number, each) for number, each in enumerate(found)])


def test_the_correlation_is_that_of_scipy():
    table = swept()
    values = [force(*each) for each in KEYS]
    expected = stats.spearmanr([each[0] for each in KEYS], values)
    found = correlation(column_of(table, "x.a"), column_of(table, "m.force"))
    assert found == pytest.approx((expected.statistic, expected.pvalue))


def test_what_does_not_vary_has_no_correlation():
    table = swept()
    assert math.isnan(correlation(column_of(table, "x.a"), column_of(table, "m.same"))[0])
    assert varying_metrics(table) == ["m.force"]


def test_a_case_off_the_others_is_found_and_none_where_the_model_holds():
    """Squares in numbers and constants of texts are in the model, so only what was moved by 40 N is left."""
    rng = numpy.random.default_rng(1)
    noisy = [force(*each) + 0.1 * float(rng.standard_normal()) for each in KEYS]
    values = [{"x.a": str(a), "x.b": str(b), "x.c": c} for a, b, c in KEYS]
    assert outliers(SweepTable(values, [row(number, each) for number, each in enumerate(noisy)]), ["m.force"]) == []
    noisy[9] += 40.0
    found = outliers(SweepTable(values, [row(number, each) for number, each in enumerate(noisy)]), ["m.force"])
    assert found[0].number == 9
    assert found[0].value == pytest.approx(noisy[9])


def test_too_few_cases_for_the_model_have_no_outlier():
    assert outliers(swept(1, KEYS[:6]), ["m.force"]) == []


def test_the_page_has_pictures_tables_and_the_command_of_each_case_to_run_again(tmp_path):
    table = swept(9)
    text = page_of("sweep", "tire_bump", [Swept("tire_bump", "tire_bump", table, tmp_path)])
    page = Page(text)
    assert page.tags.count("figure") == 3
    assert (
        "bench run tire_bump --set x.a=2.0 --set x.b=20.0 --set x.c=hard --offline --out tire_bump_case_9" in page.texts
    )
    assert "script" not in page.tags
    loaded = [value for _, name, value in page.attributes if name in ("src", "href", "xlink:href") and value[:1] != "#"]
    assert [each for each in loaded if not each.startswith("data:")] == []


def test_a_failed_case_is_on_the_page_with_its_sentence(tmp_path):
    values = [{"x.a": "1"}, {"x.a": "<b>"}]
    failed = {"number": 1, "case": "", "outcome": "failed", "sentence": "lost <the> road", "metrics": []}
    text = page_of("sweep", "s", [Swept("s", "s", SweepTable(values, [row(0, 1.0), failed]), tmp_path)])
    assert "failed: lost &lt;the&gt; road" in text
    assert "Failed cases" in text
    assert "<b>&lt;" not in text


def test_a_kept_bag_is_reported_not_run_again(tmp_path):
    (tmp_path / "bags" / "hash19").mkdir(parents=True)
    text = page_of("sweep", "s", [Swept("s", "s", swept(), tmp_path)])
    assert f"bench report {tmp_path / 'bags' / 'hash19'}" in text


@pytest.mark.parametrize(("limit", "word"), [("200", "Pass."), ("70", "Missed.")])
def test_the_page_of_a_plan_has_verdict_margin_and_worst_case(tmp_path, limit, word):
    """The largest of 5 a**2 is 80, at a = 4."""
    path = tmp_path / "own.yaml"
    path.write_text(PLAN % limit)
    plan = read_plan(str(path))
    values = [{"a": each} for each in "1234"]
    table = SweepTable(values, [row(number, 5.0 * (number + 1) ** 2) for number in range(4)])
    page = Page(write_plan_page(tmp_path / "plan.html", plan, judge(plan.sweeps[0], table.cases), [table]).read_text())
    assert word in page.texts
    assert {"80 N", "a=4", f"{float(limit) - 80.0:.3g}"} <= set(page.texts)
    assert "bench run seat_ride --set a=4 --offline --out seat_ride_case_3" in page.texts


def test_a_page_is_made_again_but_no_other_file(tmp_path):
    sweeps = [Swept("s", "s", swept(), tmp_path)]
    path = write_page(tmp_path / "sweep.html", "sweep", "s", sweeps)
    assert write_page(path, "sweep", "s", sweeps) == path
    path.write_text("mine")
    with pytest.raises(FileRefusedError):
        write_page(path, "sweep", "s", sweeps)
