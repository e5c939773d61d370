"""Hard cases of the cnoidal method: limits of the parameter, the homoclinic motion, theta functions
near a singular matrix.
"""

from __future__ import annotations

import math

import mpmath
import numpy

from contact_sim_lab.papers.cnoidal import theta
from contact_sim_lab.papers.cnoidal.cnoidal import CnoidalError, QuadraticOscillator, position, released_at
from contact_sim_lab.papers.cnoidal.work_precision_modes import COUPLINGS, WAVE_NUMBERS, matrix_of, phases_of
from contact_sim_lab.records import guard
from contact_sim_lab.records.hard_case import Finding, HardCase, at_most, exactly
from contact_sim_pkg.pressure.closed_form.jacobi import jacobi_cn, quarter_period

CNOIDAL, THETA = "cnoidal", "theta"
OSCILLATOR = QuadraticOscillator(3.0, 5.0)
SADDLE_RELEASE = 0.9  # w0^2 / (2 k)
ARGUMENTS = numpy.linspace(-12.0, 12.0, 49)
COMPLEMENTS = (1.0, 1.0 - 1e-12, 0.9, 0.5, 0.1, 1e-4, 1e-12, 1e-100, 0.0)
BEYOND_THE_TABLE = {-0.2: 0.178, -0.5: 0.365, -1.0: 0.540}


def limits_of_cn() -> Finding:
    """Largest error of cn from the cosine (m = 0) to the hyperbolic secant (m = 1), against 140
    digits.
    """
    worst = 0.0
    with mpmath.workdps(140):
        for complement in COMPLEMENTS:
            m = 1 - mpmath.mpf(complement)
            exact = numpy.array([float(mpmath.ellipfun("cn", mpmath.mpf(u), m=m)) for u in ARGUMENTS])
            worst = max(worst, float(numpy.abs(jacobi_cn(ARGUMENTS, complement) - exact).max()))
    return at_most(worst, 1e-14, hard=min(COMPLEMENTS))


def quarter_at_one() -> Finding:
    """K at m = 1 and at m = 1 - 1e-300: infinite, and 1/2 ln(16/m1) = 346.77."""
    complement = 1e-300
    nearly = quarter_period(complement)[0]
    exact = 0.5 * math.log(16.0) + 150.0 * math.log(10.0)
    return at_most(
        abs(nearly / exact - 1.0) if math.isinf(quarter_period(0.0)[0]) else math.inf, 1e-14, hard=complement
    )


def small_motion() -> Finding:
    """Period of a motion of 1e-12 m over that of the linear oscillator, less 1."""
    size = 1e-12
    return at_most(
        abs(released_at(OSCILLATOR, size).period * OSCILLATOR.frequency / (2.0 * math.pi) - 1.0),
        1e-12,
        hard=size / SADDLE_RELEASE,
    )


def linear_limit() -> Finding:
    """A quadratic term of 1e-300: largest difference from the cosine."""
    quadratic = 1e-300
    times = numpy.linspace(0.0, 10.0, 101)
    found = position(released_at(QuadraticOscillator(3.0, quadratic), 0.5), times)
    return at_most(float(numpy.abs(found - 0.5 * numpy.cos(3.0 * times)).max()), 1e-13, hard=quadratic * 0.5 / 3.0**2)


def homoclinic() -> Finding:
    """Released exactly at the saddle's level: y = 3 a sech^2(w0 t/2) - 2 a with a = w0^2/(2 k),
    reported as homoclinic.
    """
    motion = released_at(OSCILLATOR, SADDLE_RELEASE)
    times = numpy.linspace(0.0, 8.0, 81)
    exact = 3.0 * SADDLE_RELEASE / numpy.cosh(0.5 * OSCILLATOR.frequency * times) ** 2 - 2.0 * SADDLE_RELEASE
    error = float(numpy.abs(position(motion, times) - exact).max())
    return at_most(error if motion.homoclinic else math.inf, 1e-13, hard=motion.complement)


def beyond_the_saddle() -> Finding:
    """Releases from which the motion runs away, of four: all are refused with a sentence."""
    refused, beyond = 0, []
    for k, start in ((5.0, 0.9 + 1e-12), (5.0, -1.8 - 1e-9), (-5.0, -0.91), (-5.0, 1e3)):
        away = start / math.copysign(SADDLE_RELEASE, k)
        beyond.append(max(away - 1.0, -2.0 - away))
        try:
            released_at(QuadraticOscillator(3.0, k), start)
        except CnoidalError:
            refused += 1
    return exactly(refused, 4, hard=min(beyond))


def cancelling_sum() -> Finding:
    """Theta of one phase at B = -0.2, where the lattice sum cancels to 1e-9: largest relative
    error, against 60 digits.
    """
    phases = numpy.linspace(-math.pi, math.pi, 25)[:, None]
    worst, values = 0.0, theta.theta(phases, [[-0.2]])
    with mpmath.workdps(60):
        q = mpmath.exp(-mpmath.mpf(2) / 20)
        for eta, value in zip(phases[:, 0], values, strict=True):
            exact = mpmath.re(mpmath.jtheta(3, mpmath.mpf(float(eta)) / 2, q))
            worst = max(worst, abs(float(value / exact - 1)))
    return at_most(worst, 1e-12, hard=values.max() / values.min())


def nearly_singular() -> Finding:
    """ln Theta at B = -1e-6, where Theta itself underflows: relative error against the one Gaussian
    that counts.
    """
    eta = 2.0
    exact = 0.5 * math.log(2.0 * math.pi / 1e-6) - eta**2 / 2e-6
    return at_most(abs(float(theta.log_theta([eta], [[-1e-6]])) / exact - 1.0), 1e-14, hard=exact)


def both_sums() -> Finding:
    """Lattice and Poisson's sum of three coupled phases on both sides of the switch: largest
    difference of the wave.
    """
    generator = numpy.random.default_rng(4)
    phases, along = generator.uniform(-4.0, 4.0, (40, 3)), numpy.array([1.0, -0.7, 2.2])
    worst = 0.0
    for size in (1.001, 1.5, 3.0):
        matrix = -size * (numpy.eye(3) + 0.4 * numpy.ones((3, 3)))
        one, other = theta.theta_wave(phases, matrix, along), theta.poisson_wave(phases, matrix, along)
        worst = max(worst, float(numpy.abs(one - other).max()))
    return at_most(worst, 1e-11, hard=matrix[0, 1] / matrix[0, 0])


def one_phase() -> Finding:
    """The wave of one phase against its cn^2 and constant, B from -0.05 to -30: largest error over
    its rms.
    """
    phases, worst = numpy.linspace(-4.0, 4.0, 41)[:, None], 0.0
    entries = (-0.05, -0.3, -0.999, -1.0, -2.2, -6.0, -6.3, -12.0, -30.0)
    for entry in entries:
        wave = theta.theta_wave(phases, [[entry]], [1.3])
        plain = theta.plain_sum(phases, [[entry]], [1.3])
        worst = max(worst, float(numpy.abs(wave - plain).max() / numpy.sqrt(numpy.mean(wave**2))))
    return at_most(worst, 1e-9, hard=min(entries) / max(entries))


def interaction() -> Finding:
    """Interaction of two phases over the plain sum at three couplings, against 17.8, 36.5 and 54.0
    %: largest difference.
    """
    phases, worst, coupled = phases_of(64), 0.0, 0.0
    for coupling in COUPLINGS:
        matrix = numpy.asarray(matrix_of(coupling))
        coupled = max(coupled, abs(float(matrix[0, 1] / matrix[0, 0])))
        plain = theta.plain_sum(phases, matrix_of(coupling), WAVE_NUMBERS)
        rest = theta.interaction(phases, matrix_of(coupling), WAVE_NUMBERS)
        ratio = math.sqrt(float(numpy.mean(rest**2) / numpy.mean(plain**2)))
        worst = max(worst, abs(ratio - BEYOND_THE_TABLE[coupling]))
    return at_most(worst, 5.5e-4, hard=coupled)


def _has_theta(matrix: object) -> bool:
    entries = numpy.asarray(matrix, dtype=numpy.float64)
    if len(entries) > 5 or not numpy.isfinite(entries).all() or (entries != entries.T).any():
        return False
    return bool(numpy.linalg.eigvalsh(entries).max() < -1e-8)


def bad_matrices() -> Finding:
    """Matrices that have no theta function, or one beyond the lattice bound, of seven: all are
    refused with a sentence.
    """
    cases = (
        [[0.0]], [[1.0]], [[math.nan]], [[-1.0, 2.0], [2.0, -1.0]], [[-1.0, 0.1], [0.2, -1.0]], [[-1e-9, 0.0], [0.0, -1e14]],
        numpy.diag([-1.0] * 6),
    )  # fmt: skip
    refused = 0
    for matrix in cases:
        try:
            theta.log_theta(numpy.zeros(len(matrix)), matrix)
        except theta.ThetaError:
            refused += 1
    return exactly(refused, len(cases), hard=sum(map(_has_theta, cases)))


CASES = (
    HardCase(CNOIDAL, "cn from m = 0 to m = 1: largest error", limits_of_cn, guard.zero("least 1 - m")),
    HardCase(CNOIDAL, "K at m = 1 and 1e-300 below", quarter_at_one, guard.at_most("1 - m", 1e-300)),
    HardCase(CNOIDAL, "m → 0: period of a motion of 1e-12 m", small_motion,
        guard.at_most("motion over the saddle's distance", 1.2e-12)),
    HardCase(CNOIDAL, "no quadratic term: the cosine", linear_limit,
        guard.at_most("quadratic over linear force", 1e-300)),
    HardCase(CNOIDAL, "m = 1: homoclinic, sech²", homoclinic, guard.zero("1 - m")),
    HardCase(CNOIDAL, "released beyond the saddle: refused", beyond_the_saddle,
        guard.above("least distance beyond the saddle, over its own", 0.0)),
    HardCase(THETA, "B = -0.2, cancelling sum: relative error", cancelling_sum,
        guard.scales("largest and smallest sum over the phases", 1e8)),
    HardCase(THETA, "B = -1e-6, nearly singular: ln Θ", nearly_singular, guard.below("ln Θ", math.log(5e-324))),
    HardCase(THETA, "lattice and Poisson's sum, three phases", both_sums,
        guard.at_least("coupling over the diagonal", 0.25)),
    HardCase(THETA, "one phase is its cn²", one_phase, guard.scales("entries B", 500.0)),
    HardCase(THETA, "interaction of two phases: tabled ratios", interaction,
        guard.at_least("largest coupling over the diagonal", 0.1)),
    HardCase(THETA, "not negative definite, not symmetric, too large: refused", bad_matrices,
        guard.zero("symmetric, negative definite matrices of up to five phases")),
)  # fmt: skip
