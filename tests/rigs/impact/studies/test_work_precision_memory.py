"""Work and precision of the sample's memory: expensive levels meet the reference, inexpensive ones err as their idea does."""

import pytest

from contact_sim_lab.accuracy import work_precision
from contact_sim_lab.records import work_precision as records
from contact_sim_lab.rigs.impact import work_precision_memory as memory_studies


@pytest.fixture(scope="module", autouse=True)
def few_samples():
    kept = records.FEWEST, records.BUDGET
    records.FEWEST, records.BUDGET = 1, 0.0
    yield
    records.FEWEST, records.BUDGET = kept


def errors(rows, quantity, case):
    return {row["level"]: row["error"] for row in rows if row["quantity"] == quantity and case in row["case"]}


def test_internal_variables_are_exact_on_the_same_samples_and_a_single_element_is_not_the_solid():
    rows = memory_studies.history_rows()
    for case in ("compliance 0.25", "compliance 1"):
        found = errors(rows, "depth at the turning point", case)
        assert found["internal variables, 400 samples"] < 1e-12
        assert 1e-5 < found["internal variables, 20 samples"] < 1e-3
        assert found["Kelvin-Voigt force"] > 1e-4
    strong = errors(rows, "depth at the turning point", "compliance 1")
    assert strong["Kelvin-Voigt force"] > 30.0 * strong["internal variables, 20 samples"]


def test_harmonic_balance_converges_and_the_linear_answer_fails_with_the_square_of_the_shaking():
    rows = memory_studies.response_rows()
    small, large = (errors(rows, "half range of the depth", f"by {part:g} of") for part in (0.05, 0.3))
    assert large["harmonic balance, 6 harmonics"] < 1e-7
    assert small["time integration over 50 periods"] < 1e-7
    assert large["amplitude and phase"] / small["amplitude and phase"] == pytest.approx(36.0, rel=0.5)
    falling = [large[f"harmonic balance, {n}"] for n in ("1 harmonic", "3 harmonics", "6 harmonics")]
    assert falling == sorted(falling, reverse=True)


def test_both_studies_stand_under_impact():
    parts = {each.part for each in work_precision.studies_of("impact")}
    assert {"viscoelastic history", "complex response"} <= parts
