"""Theta functions against mpmath's and against a plain sum written out here; the split of eq A4."""

import itertools
import math

import mpmath
import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.papers.cnoidal import theta

QUICK = settings(max_examples=40)
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


def exact_wave(eta, matrix, along, reach=9):
    """``2 d^2 ln Theta/dx^2`` by Poisson's sum in 60 digits, for one or two phases: the variance of its slopes."""
    size = len(eta)
    with mpmath.workdps(60):
        inverse = mpmath.matrix(matrix) ** -1
        k = mpmath.matrix([mpmath.mpf(float(value)) for value in along])
        centre = [-int(mpmath.nint(mpmath.mpf(float(value)) / (2 * mpmath.pi))) for value in eta]
        exponents, slopes = [], []
        for point in itertools.product(range(-reach, reach + 1), repeat=size):
            s = mpmath.matrix(
                [mpmath.mpf(float(e)) + 2 * mpmath.pi * (c + m) for e, c, m in zip(eta, centre, point, strict=True)]
            )
            pulled = inverse * s
            exponents.append(sum(a * b for a, b in zip(pulled, s, strict=True)) / 2)
            slopes.append(sum(a * b for a, b in zip(pulled, k, strict=True)))
        weights = [mpmath.exp(value - max(exponents)) for value in exponents]
        mean = sum(w * t for w, t in zip(weights, slopes, strict=True)) / sum(weights)
        spread = sum(w * (t - mean) ** 2 for w, t in zip(weights, slopes, strict=True)) / sum(weights)
        return float(2 * (spread + (k.T * inverse * k)[0]))


ETA = st.one_of(
    st.floats(-4.0, 4.0), st.sampled_from([math.pi, -math.pi, math.pi - 1e-9, 9.42477796076938, 1e6, -1e15])
)
ENTRY = st.one_of(st.floats(-100.0, -2.0).map(lambda power: -(10.0**power)), st.floats(-2.0, -0.01))


@QUICK
@given(ETA, ENTRY)
def test_the_wave_of_one_phase_keeps_its_digits_down_to_the_smallest_entry(eta, entry):
    """Both sums, B from -2 to -1e-100 and phases next to the crest; absolute to 1e-12 of the crest's height."""
    crest = 2.0 * (math.pi / entry) ** 2
    exact = pytest.approx(exact_wave([eta], [[entry]], [1.0]), rel=1e-12, abs=1e-12 * crest)
    assert float(theta.theta_wave([eta], [[entry]], [1.0])) == exact
    assert float(theta.plain_sum([eta], [[entry]], [1.0])) == exact


@QUICK
@given(ETA, st.floats(-600.0, -1.0))
def test_the_wave_of_one_phase_keeps_its_digits_where_it_is_small(eta, entry):
    """The logarithm of theta_3 as a series, ``-4 sum of (-1)^n n q^n/(1 - q^2n) cos(n eta)``; for -B large its first term."""
    with mpmath.workdps(40):
        q, e = mpmath.exp(mpmath.mpf(entry) / 2), mpmath.mpf(eta)
        terms = [
            (-1) ** n * n * q**n / (1 - q ** (2 * n)) * mpmath.cos(n * e) for n in range(1, 2 + int(80.0 / -entry) + 4)
        ]
        exact = float(4 * sum(terms))
    for found in (theta.theta_wave([eta], [[entry]], [1.0]), theta.plain_sum([eta], [[entry]], [1.0])):
        assert float(found) == pytest.approx(exact, rel=1e-10, abs=1e-12 * 4.0 * math.exp(0.5 * entry))


def test_a_small_entry_gives_the_sum_of_one_phase_waves():
    """B = -0.02 gave -100 at the crest, for want of a representable 1 - m."""
    assert float(theta.plain_sum([math.pi], [[-0.02]], [1.0])) == pytest.approx(
        exact_wave([math.pi], [[-0.02]], [1.0]), rel=1e-13
    )
    phases = numpy.linspace(-4.0, 4.0, 41)[:, None]
    assert float(numpy.abs(theta.interaction(phases, [[-0.02]], [1.0])).max()) < 1e-8


@settings(QUICK, max_examples=8)
@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(0.001, 0.9), st.floats(0.05, 2.0), st.floats(-0.9, 0.9))
def test_the_wave_of_two_phases_keeps_its_digits(first, second, small, other, coupling):
    off = coupling * math.sqrt(small * other)
    matrix, along = [[-small, off], [off, -other]], [1.0, 1.6]
    exact = exact_wave([first, second], matrix, along)
    crest = 2.0 * math.pi**2 * float(numpy.abs(numpy.linalg.inv(matrix) @ along).max()) ** 2
    assert float(theta.theta_wave([first, second], matrix, along)) == pytest.approx(exact, rel=1e-11, abs=1e-12 * crest)


def test_the_nearest_term_of_a_skew_matrix_is_found_however_far():
    """Eigenvalues -1e-6 and -1: the terms that count are far from the origin; a wide lattice in long doubles."""
    c, s = math.cos(0.5), math.sin(0.5)
    matrix = -numpy.array([[c * c * 1e-6 + s * s, c * s * (1e-6 - 1.0)], [c * s * (1e-6 - 1.0), s * s * 1e-6 + c * c]])
    inverse = numpy.linalg.inv(matrix).astype(numpy.longdouble)
    inverse = 0.5 * (inverse + inverse.T)
    eta = numpy.array([2.0, 1.0])
    shifted = eta + 2.0 * numpy.pi * numpy.array(list(itertools.product(range(-80, 81), repeat=2)), numpy.longdouble)
    exponents = 0.5 * numpy.einsum("mi,ij,mj->m", shifted, inverse, shifted)
    total = exponents.max() + numpy.log(numpy.exp(exponents - exponents.max()).sum())
    exact = float(total) + 0.5 * math.log((2.0 * math.pi) ** 2 / 1e-6)
    assert abs(shifted[exponents.argmax()]).max() > 8.0 * math.pi
    assert float(theta.log_theta(eta, matrix)) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize(
    ("phase", "entry", "along", "why"),
    [
        (0.0, -1e-101, 1.0, "eigenvalue"),
        (0.0, -5e-324, 1.0, "eigenvalue"),
        (0.0, 5e-324, 1.0, "negative definite"),
        (0.0, -1e101, 1.0, "entry of B"),
        (1.1e15, -1.0, 1.0, "phase"),
        (math.nan, -1.0, 1.0, "finite"),
        (math.inf, -1.0, 1.0, "finite"),
        (0.0, -1.0, math.nan, "direction"),
        (0.0, -1.0, 1e51, "direction"),
    ],
)
def test_outside_of_its_range_a_wave_is_refused(phase, entry, along, why):
    for function in (theta.theta_wave, theta.poisson_wave, theta.plain_sum, theta.interaction):
        with pytest.raises(theta.ThetaError, match=why):
            function([phase], [[entry]], [along])
    if along == 1.0:
        with pytest.raises(theta.ThetaError, match=why):
            theta.theta([phase], [[entry]])
