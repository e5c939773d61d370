"""The study of the restitution: published formulas give what they are known to give, exact ones what is requested."""

import pytest

from contact_sim_lab.laws import work_precision_restitution as restitution_study
from contact_sim_lab.laws.restitution_formulas import FORMULAS
from contact_sim_lab.records import work_precision as study_row

PUBLISHED = {  # e obtained, Driver and Seat's law, by requested e: in the order of FORMULAS
    0.95: (0.9524, 0.9535, 0.9468, 0.9359, 0.9500),
    0.90: (0.9090, 0.9132, 0.8939, 0.8764, 0.8999),
    0.80: (0.8329, 0.8471, 0.7885, 0.7680, 0.7992),
    0.70: (0.7680, 0.7960, 0.6832, 0.6696, 0.6973),
    0.50: (0.6630, 0.7252, 0.4704, 0.4877, 0.4877),
    0.30: (0.5813, 0.6842, 0.2562, 0.3042, 0.2707),
    0.10: (0.5158, 0.6653, 0.0694, 0.1010, 0.0741),
}


@pytest.fixture(scope="module")
def rows():
    kept = study_row.FEWEST, study_row.BUDGET
    study_row.FEWEST, study_row.BUDGET = 1, 0.0
    yield restitution_study.rows()
    study_row.FEWEST, study_row.BUDGET = kept


@pytest.mark.parametrize("requested", PUBLISHED)
def test_each_published_formula_gives_what_is_known_of_it(rows, requested):
    found = {row["level"]: row["value"] for row in rows if row["case"] == f"Hunt-Crossley, e = {requested:g}"}
    for name, value in zip(FORMULAS, PUBLISHED[requested], strict=True):
        assert found[name] == pytest.approx(value, abs=6e-5)


@pytest.mark.parametrize("level", ["exact relation", "closed form at F = 0", "root search of e(Z)"])
def test_the_exact_level_of_every_law_delivers_the_requested_restitution(rows, level):
    chosen = [row for row in rows if row["level"] == level]
    assert [row["expected"] for row in chosen] == list(restitution_study.REQUESTED)
    assert max(row["error"] for row in chosen) < 1e-9


def test_half_a_period_without_its_tensile_end_gives_more_than_it_promises(rows):
    chosen = [row for row in rows if row["level"].startswith("half a period")]
    assert all(row["value"] > row["expected"] for row in chosen)
    assert max(row["error"] for row in chosen) > 3.0
