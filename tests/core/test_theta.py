"""Theta functions against mpmath's and against a plain sum written out here; the split of eq A4."""

import itertools
import math

import mpmath
import numpy
import pytest

from contact_sim_pkg.core import theta

PHASES = numpy.linspace(-4.0, 4.0, 17)


def exact_log(eta, entry):
    with mpmath.workdps(120):
        value = mpmath.jtheta(3, mpmath.mpf(float(eta)) / 2, mpmath.exp(mpmath.mpf(entry) / 2))
        return float(mpmath.log(mpmath.re(value)))


def exact_sum(eta, matrix, digits=60):
    """The definition, in many digits."""
    with mpmath.workdps(digits):
        total = mpmath.mpf(0)
        for point in itertools.product(range(-14, 15), repeat=len(eta)):
            form = sum(
                mpmath.mpf(float(matrix[i][j])) * a * b for i, a in enumerate(point) for j, b in enumerate(point)
            )
            total += mpmath.exp(form / 2) * mpmath.cos(
                sum(a * mpmath.mpf(float(e)) for a, e in zip(point, eta, strict=True))
            )
        return float(mpmath.log(total))


@pytest.mark.parametrize("entry", [-0.1, -0.2, -0.7, -0.999, -1.0, -2.2, -6.0, -15.0])
def test_one_phase_is_the_third_theta_function_of_mpmath(entry):
    found = theta.log_theta(PHASES[:, None], [[entry]])
    expected = [exact_log(eta, entry) for eta in PHASES]
    numpy.testing.assert_allclose(found, expected, rtol=1e-13, atol=2e-14)
    numpy.testing.assert_allclose(theta.theta(PHASES[:, None], [[entry]]), numpy.exp(expected), rtol=2e-12)


@pytest.mark.parametrize(
    "matrix", [[[-2.2, -1.0], [-1.0, -3.1]], [[-0.9, 0.5], [0.5, -1.4]], [[-0.6, -0.2], [-0.2, -4.0]]]
)
def test_two_phases_are_their_sum_in_sixty_digits(matrix):
    for eta in ((0.0, 0.0), (1.0, -2.0), (3.1, 3.0), (7.0, -9.5)):
        assert float(theta.log_theta(eta, matrix)) == pytest.approx(exact_sum(eta, matrix), abs=1e-12)


def test_three_phases_with_zero_coupling_are_a_product():
    eta = numpy.array([0.4, -1.3, 2.9])
    entries = (-0.4, -1.7, -5.0)
    product = sum(float(theta.log_theta([e], [[b]])) for e, b in zip(eta, entries, strict=True))
    assert float(theta.log_theta(eta, numpy.diag(entries))) == pytest.approx(product, abs=1e-12)


@pytest.mark.parametrize("entry", [-0.2, -0.999, -1.0, -2.2, -6.0, -6.5, -12.0, -30.0])
def test_the_wave_of_one_phase_is_its_cn_squared_with_the_constant(entry):
    wave = theta.theta_wave(PHASES[:, None], [[entry]], [1.3])
    plain = theta.plain_sum(PHASES[:, None], [[entry]], [1.3])
    numpy.testing.assert_allclose(plain, wave, rtol=0.0, atol=2e-10 * float(numpy.abs(wave).max()) + 1e-15)


def test_the_wave_is_the_second_derivative_of_the_logarithm():
    matrix, along, eta, h = (
        numpy.array([[-2.2, -0.5], [-0.5, -3.1]]),
        numpy.array([1.0, 1.6]),
        numpy.array([0.7, -1.9]),
        1e-3,
    )
    low, middle, high = (float(theta.log_theta(eta + i * h * along, matrix)) for i in (-1, 0, 1))
    assert float(theta.theta_wave(eta, matrix, along)) == pytest.approx(
        2.0 * (high - 2.0 * middle + low) / h**2, abs=1e-6
    )


def test_the_printed_sum_leaves_out_the_constant_that_makes_its_mean_zero():
    turn = 2.0 * math.pi * numpy.arange(64)[:, None] / 64
    corrected = theta.plain_sum(turn, [[-2.2]], [1.0])
    printed = theta.plain_sum(turn, [[-2.2]], [1.0], printed=True)
    assert corrected.mean() == pytest.approx(0.0, abs=1e-14)
    assert printed.mean() > 0.1
    numpy.testing.assert_allclose(printed - corrected, printed.mean(), atol=1e-14)


@pytest.mark.parametrize(("coupling", "ratio"), [(-0.2, 0.178), (-0.5, 0.365), (-1.0, 0.540)])
def test_the_interaction_of_two_phases_is_no_small_correction(coupling, ratio):
    turn = 2.0 * math.pi * numpy.arange(64) / 64
    phases = numpy.stack(numpy.meshgrid(turn, turn, indexing="ij"), axis=-1)
    matrix, along = [[-2.2, coupling], [coupling, -3.1]], [1.0, 1.6]
    rest = numpy.sqrt(numpy.mean(theta.interaction(phases, matrix, along) ** 2))
    assert rest / numpy.sqrt(numpy.mean(theta.plain_sum(phases, matrix, along) ** 2)) == pytest.approx(ratio, abs=6e-4)


def test_without_coupling_there_is_no_interaction():
    phases = numpy.random.default_rng(2).uniform(-9.0, 9.0, (50, 2))
    rest = theta.interaction(phases, numpy.diag([-2.2, -0.7]), [1.0, 1.6])
    assert float(numpy.abs(rest).max()) < 1e-12


def test_frequencies_in_place_of_wave_numbers_scale_one_phase_by_their_ratio_squared():
    in_space = theta.theta_wave(PHASES[:, None], [[-2.2]], [1.6])
    in_time = theta.theta_wave(PHASES[:, None], [[-2.2]], [4.0])
    numpy.testing.assert_allclose(in_time, in_space * (4.0 / 1.6) ** 2, rtol=1e-12)


@pytest.mark.parametrize(
    ("matrix", "why"),
    [
        ([[0.0]], "negative definite"),
        ([[-1.0, 2.0], [2.0, -1.0]], "negative definite"),
        ([[-1.0, 0.1], [0.2, -1.0]], "symmetric"),
        ([[math.nan]], "finite"),
        ([[-1e-9, 0.0], [0.0, -1e14]], "terms"),
        ([[-1.0, 0.0]], "do not fit"),
    ],
)
def test_a_matrix_without_a_theta_function_is_refused_with_the_reason(matrix, why):
    with pytest.raises(theta.ThetaError, match=why):
        theta.log_theta(numpy.zeros(len(matrix[0])), matrix)


@pytest.mark.parametrize("entry", [0.0, 1.0, math.nan, -math.inf])
def test_one_phase_needs_an_entry_below_zero(entry):
    with pytest.raises(theta.ThetaError, match="below 0"):
        theta.one_phase(entry, 1.0)


def test_a_direction_that_does_not_fit_is_refused():
    with pytest.raises(theta.ThetaError, match="direction"):
        theta.theta_wave([0.0], [[-1.0]], [1.0, 2.0])
