"""Closed forms of the impact: the published table of their errors, limits, named ends of their range."""

import math

import mpmath
import pytest

from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.closed_form import scalings as closed_forms
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.motion import solve_impact

SPHERE = Sphere(0.02, 0.01)
MODULUS = 8.0e6
EQUAL_WORK = 8.0 * float(mpmath.beta(0.75, 1.5)) / math.pi

# tan(beta): k eq 66, k eqs 56 and 58 printed, the same with B corrected, x_m eq 67/ref, tau eq 71/ref printed, with 15/16
TABLE = {
    0.01: (0.9811, 0.9540, 0.9647, 1.006, 0.582, 0.685),
    0.02: (0.9625, 0.9100, 0.9306, 1.012, 0.587, 0.690),
    0.05: (0.9089, 0.7890, 0.8350, 1.028, 0.600, 0.706),
    0.10: (0.8257, 0.6173, 0.6947, 1.047, 0.622, 0.732),
    0.20: (0.6793, 0.3509, 0.4672, 1.067, 0.665, 0.782),
    0.30: (0.5546, 0.1396, 0.2869, 1.065, 0.709, 0.834),
    0.40: (0.4472, None, 0.1287, 1.045, 0.756, 0.889),
    0.60: (0.2715, None, None, 0.957, 0.869, 1.022),
    0.80: (0.1338, None, None, 0.790, 1.046, 1.231),
    1.00: (0.0231, None, None, 0.421, 1.583, 1.862),
}


@pytest.mark.parametrize("loss_tangent", TABLE)
def test_the_published_errors_of_the_closed_forms_come_out(loss_tangent):
    of_66, printed, corrected, depth_ratio, time_printed, time_corrected = TABLE[loss_tangent]
    material = Material(MODULUS, loss_tangent)
    exact = solve_impact(SPHERE, material, 1.0)
    k = closed_forms.closed_restitution(loss_tangent)
    assert k == pytest.approx(of_66, abs=5.1e-5)
    for form, expected in (("printed", printed), ("corrected", corrected)):
        if expected is None:
            with pytest.raises(ImpactError, match="integrate the equation of motion"):
                closed_forms.damped_sine(SPHERE, material, 1.0, form)
        else:
            found = closed_forms.damped_sine(SPHERE, material, 1.0, form).restitution
            assert found == pytest.approx(expected, abs=5.1e-5)
    depth = closed_forms.depth_of_restitution(SPHERE, MODULUS, 1.0, k)
    assert depth / exact.depth == pytest.approx(depth_ratio, abs=5.1e-4)
    for form, ratio in (("printed", time_printed), ("corrected", time_corrected)):
        found = closed_forms.closed_duration(SPHERE, MODULUS, 1.0, k, form)
        assert found / exact.duration == pytest.approx(ratio, abs=5.1e-4)


def test_the_constant_of_equal_viscous_work_is_that_of_its_integrals():
    with mpmath.workdps(30):
        above = mpmath.quad(lambda s: mpmath.sqrt(s) * mpmath.sqrt(1 - s * s), [0, 1])
        below = mpmath.quad(lambda s: mpmath.sqrt(1 - s * s), [0, 1])
        expected = float(4 * above / below)
    assert closed_forms.BETA["corrected"] == pytest.approx(expected, rel=1e-12)
    assert expected == pytest.approx(2.4408, abs=5e-5)


@pytest.mark.parametrize("form", ["printed", "corrected"])
@pytest.mark.parametrize("loss_tangent", [0.0, 0.02, 0.2, 0.33])
def test_the_damped_sine_solves_its_own_equation(form, loss_tangent):
    found = closed_forms.damped_sine(SPHERE, Material(MODULUS, loss_tangent), 1.0, form)
    common = math.sqrt(2.0) * math.sqrt(SPHERE.radius * found.depth)
    spring = 16.0 / 15.0 * common * MODULUS
    damper = (3.2 if form == "printed" else EQUAL_WORK) * common * MODULUS * loss_tangent / found.frequency
    assert found.damping == pytest.approx(damper / (2 * SPHERE.mass), rel=1e-12)
    assert found.frequency**2 + found.damping**2 == pytest.approx(spring / SPHERE.mass, rel=1e-12)

    def x(t):
        return math.exp(-found.damping * t) * math.sin(found.frequency * t) / found.frequency

    times = [found.duration * i / 20000 for i in range(20001)]
    assert found.depth == pytest.approx(max(map(x, times)), rel=1e-7)
    assert found.compression_time == pytest.approx(max(times, key=x), abs=found.duration / 20000)
    assert found.duration == pytest.approx(math.pi / found.frequency, rel=1e-15)
    step = found.duration * 1e-4
    force = [spring * x(t) + damper * (x(t + step) - x(t - step)) / (2 * step) for t in times[::10]]
    assert found.peak_force == pytest.approx(max(force), rel=1e-6)


def test_the_elastic_limits_of_the_duration_disagree_as_published():
    unit = (SPHERE.mass / (math.sqrt(2.0) * MODULUS * math.sqrt(SPHERE.radius))) ** 0.4
    elastic = Material(MODULUS, 0.0)
    assert solve_impact(SPHERE, elastic, 1.0).duration / unit == pytest.approx(2.868, abs=5e-4)
    assert closed_forms.damped_sine(SPHERE, elastic, 1.0).duration / unit == pytest.approx(3.062, abs=5e-4)
    assert closed_forms.closed_duration(SPHERE, MODULUS, 1.0, 1.0) / unit == pytest.approx(1.949, abs=5e-4)
    assert closed_forms.closed_duration(SPHERE, MODULUS, 1.0, 1.0, "printed") / unit == pytest.approx(1.657, abs=5e-4)
    depth = closed_forms.depth_of_restitution(SPHERE, MODULUS, 1.0, 1.0)
    assert 4.0 * depth / unit == pytest.approx(3.898, abs=5e-4)


@pytest.mark.parametrize("loss", [1e-17, 1e-12, 1e-6, 1e-3])
def test_the_duration_is_smooth_where_the_restitution_tends_to_one(loss):
    with mpmath.workdps(50):
        k = mpmath.mpf(1.0 - loss)
        ratio = 2 if k == 1 else -mpmath.log(k) * (1 + k) / (1 - k)
        mass = mpmath.mpf(15) / 16 * SPHERE.mass / (mpmath.sqrt(2) * MODULUS * mpmath.sqrt(mpmath.mpf(SPHERE.radius)))
        expected = float(mpmath.sqrt(2 * ratio * mass ** mpmath.mpf("0.8") / (k ** mpmath.mpf("0.2"))))
    assert closed_forms.closed_duration(SPHERE, MODULUS, 1.0, 1.0 - loss) == pytest.approx(expected, rel=1e-14)


def test_equation_66_ends_at_a_third_of_pi_with_a_note_before():
    assert closed_forms.loss_factor_limit() == pytest.approx(math.pi / 3.0)
    assert closed_forms.restitution_note(0.94) is None
    assert "0.9" in str(closed_forms.restitution_note(0.95))
    assert closed_forms.closed_restitution(math.pi / 3.0 - 1e-9) == pytest.approx(0.0, abs=1e-9)
    for beyond in (math.pi / 3.0, 1.2, math.pi / 2.0):
        with pytest.raises(ImpactError, match=r"1\.0472"):
            closed_forms.closed_restitution(beyond)


@pytest.mark.parametrize(
    ("form", "slope"), [("printed", 6 / math.pi), ("mean_speed", 12 / math.pi), ("sine", 3 * math.pi / 2)]
)
def test_small_losses_cost_what_each_form_says(form, slope):
    assert (1.0 - closed_forms.closed_restitution(1e-7, form)) / 1e-7 == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize(("form", "limit"), [("printed", 1 / 3), ("corrected", 16 / 15 / EQUAL_WORK)])
def test_the_damped_sine_ends_where_its_root_turns_complex(form, limit):
    assert closed_forms.damping_ratio(limit - 1e-5, form) < 1.0
    with pytest.raises(ImpactError, match="real root up to"):
        closed_forms.damping_ratio(limit + 1e-5, form)


def test_another_form_is_refused_by_its_name():
    with pytest.raises(ValueError, match="form 'exact'"):
        closed_forms.damping_ratio(0.1, "exact")
