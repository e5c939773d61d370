"""Periodic motion and interaction of modes: known errors of the levels, and the residual of the fitted ansatz."""

import numpy
import pytest

from contact_sim_lab.papers.cnoidal import work_precision_modes as study_modes
from contact_sim_lab.papers.cnoidal import work_precision_periodic as study_periodic
from contact_sim_lab.papers.cnoidal.fit import ansatz, fit_ansatz, fit_harmonics, harmonics_of_period
from contact_sim_lab.papers.cnoidal.periodic_contact import steady_response
from contact_sim_lab.records import work_precision as study_row


@pytest.fixture(scope="module", autouse=True)
def few_samples():
    kept = study_row.FEWEST, study_row.BUDGET
    study_row.FEWEST, study_row.BUDGET = 1, 0.0
    yield
    study_row.FEWEST, study_row.BUDGET = kept


def test_every_rung_of_the_periodic_motion_is_better_than_the_one_before():
    rows = study_periodic.rows()
    for case in dict.fromkeys(row["case"] for row in rows):
        for quantity in (study_periodic.PERIOD, study_periodic.MOTION):
            errors = [row["error"] for row in rows if (row["case"], row["quantity"]) == (case, quantity)]
            assert errors[0] > 1.9 * errors[1] > 1e3 * errors[2]
            assert errors[2] < 1e-9


def test_the_rungs_of_the_interaction_are_known():
    rows = study_modes.rows()
    plain = [row["error"] for row in rows if row["level"].startswith("sum")]
    fitted = [row["error"] for row in rows if row["level"].startswith("fitted")]
    lattice = [row["error"] for row in rows if row["level"].startswith("theta")]
    assert plain == pytest.approx([0.178, 0.365, 0.540], abs=6e-4)
    assert all(0.5 * one < other < one for one, other in zip(plain, fitted, strict=True)), "the ansatz helps little"
    assert max(lattice) < 1e-13


def test_the_ansatz_is_exact_for_one_cnoidal_wave():
    phases = harmonics_of_period(128, 1)
    true = fit_ansatz(numpy.cos(phases[0]), phases)._replace(
        constant=0.3, linear=numpy.array([0.7]), numerator=numpy.zeros(1), denominator=numpy.zeros(1),
        parameters=numpy.array([0.8]), shifts=numpy.array([0.4]),
    )  # fmt: skip
    found = fit_ansatz(ansatz(true, phases), phases, nonlinear=False)
    assert found.residual < 1e-6
    assert found.parameters[0] == pytest.approx(0.8, abs=1e-4)


def test_harmonics_leave_what_parseval_says():
    phase = harmonics_of_period(64, 1)[0]
    samples = 2.0 + numpy.cos(phase) + 0.1 * numpy.sin(4.0 * phase)
    assert fit_harmonics(samples, 3) == pytest.approx(0.1 / numpy.sqrt(1.01), rel=1e-12)
    assert fit_harmonics(samples, 4) < 1e-14


def test_the_ansatz_follows_a_slapping_response_to_a_hundredth():
    approach = steady_response(4.75, 1.5).approach
    assert approach.min() < 0.0, "the back does not leave the rest"
    fit = fit_ansatz(approach, harmonics_of_period(len(approach)))
    assert fit.unknowns == 11
    assert 1e-4 < fit.residual < 2e-2
    again = ansatz(fit, harmonics_of_period(len(approach)))
    assert numpy.std(again - approach) / approach.std() == pytest.approx(fit.residual, rel=1e-2)


def test_too_few_samples_or_none_that_differ_are_refused():
    with pytest.raises(ValueError, match="unknowns"):
        fit_ansatz(numpy.arange(5.0), harmonics_of_period(5))
    with pytest.raises(ValueError, match="unknowns"):
        fit_ansatz(numpy.ones(64), harmonics_of_period(64))
