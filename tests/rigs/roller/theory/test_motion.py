"""Tilt and yaw in time."""

import math

import numpy
import pytest
from scipy.integrate import solve_ivp
from tests.rigs.roller.bench import BENDING, CURVATURES, MODULUS, ROLLER

from contact_sim_pkg.rigs.roller.theory.moments import moments
from contact_sim_pkg.rigs.roller.theory.motion import DIVERGED, DONE, energy, gauss_rule, integrate_tilt_yaw
from contact_sim_pkg.rigs.roller.theory.stability import critical_damping, stability

START = (1e-3, -5e-4, 0.1, 0.2)


def run(roller, bending, loads, step, stages=2, start=START, rows=2):
    state, record = numpy.array(start), numpy.empty((rows, 4))
    status = integrate_tilt_yaw(
        roller, CURVATURES, bending, MODULUS, numpy.asarray(loads, float), step, gauss_rule(stages), state, record
    )
    return status, record


@pytest.mark.parametrize("stages", [1, 2, 3])
def test_the_rules_have_their_order(stages):
    """Against scipy at 1e-13; the load moves, the shaft is bent, rubber of angles and damping act."""
    roller = ROLLER._replace(damping_tilt=2e-5, damping_yaw=3e-5, inertia_product=3e-6)
    span, swing = 0.01, (100.0, 40.0, 900.0)

    def load(t):
        return swing[0] + swing[1] * t / span

    def slope(t, y):
        moment = moments(roller, CURVATURES, BENDING, MODULUS, load(t), y[0], y[1])
        gyro = roller.inertia_spin * roller.spin
        torque = numpy.array([
            moment.tilt - 60.0 * y[0] - 2e-5 * y[2] - gyro * y[3], moment.yaw - 50.0 * y[1] - 3e-5 * y[3] + gyro * y[2],
        ])  # fmt: skip
        inertia = numpy.array([[2e-5, 3e-6], [3e-6, 2e-5]])
        return numpy.concatenate([y[2:], numpy.linalg.solve(inertia, torque)])

    exact = solve_ivp(slope, (0.0, span), START, method="DOP853", rtol=1e-12, atol=1e-16).y[:, -1]
    scale = numpy.array([1e-3, 1e-3, 1.0, 1.0])
    steps = (100, 200) if stages < 3 else (40, 80)
    errors = []
    for count in steps:
        times = numpy.linspace(0.0, span, count + 1)
        _status, record = run(roller, BENDING, load(times), span / count, stages)
        errors.append(abs((record[-1] - exact) / scale).max())
    assert errors[0] / errors[1] == pytest.approx(2.0 ** (2 * stages), rel=0.25)


def test_without_friction_the_energy_is_kept_over_ten_thousand_turns():
    """To 1e-6 over 1e4 spin periods; here far better, at 17 steps a period of the faster motion."""
    roller = ROLLER._replace(rolling_friction=0.0)
    steps = 1_000_000
    status, record = run(roller, None, numpy.full(steps + 1, 300.0), 200.0 / steps, 2, rows=201)
    energies = numpy.array([energy(roller, 300.0, state) for state in record])
    assert status == DONE
    assert abs(energies / energies[0] - 1.0).max() < 1e-6


@pytest.mark.parametrize("friction", [0.01, -0.01])
def test_the_flutter_grows_as_the_eigenvalue_says(friction):
    """To 1e-4. The part of a motion in one mode is its product with the left eigenvector, and grows as exp(root t)."""
    roller = ROLLER._replace(rolling_friction=friction)
    found = stability(roller, CURVATURES, None, MODULUS, 300.0)
    inverse = numpy.linalg.inv(found.linear.inertia)
    matrix = numpy.zeros((4, 4))
    matrix[:2, 2:] = numpy.eye(2)
    matrix[2:, :2], matrix[2:, 2:] = -inverse @ found.linear.stiffness, -inverse @ found.linear.damping
    values, vectors = numpy.linalg.eig(matrix.T)
    left = vectors[:, values.real.argmax()]
    steps = 40_000
    _status, record = run(roller, None, numpy.full(steps + 1, 300.0), 5e-5, 3, (1e-7, 2e-7, 0.0, 0.0))
    measured = math.log(abs(left @ record[-1]) / abs(left @ record[0])) / (5e-5 * steps)
    assert measured == pytest.approx(found.growth_rate, rel=1e-4)


def test_the_critical_damping_of_the_simulation_is_the_closed_one():
    """Between a part in a thousand below and above it, growth turns into decay."""
    closed = critical_damping(ROLLER, CURVATURES, None, MODULUS, 300.0)
    for share, grows in ((0.999, True), (1.001, False)):
        roller = ROLLER._replace(damping_tilt=share * closed, damping_yaw=share * closed)
        steps = 400_000
        _status, record = run(roller, None, numpy.full(steps + 1, 300.0), 1e-4, 3, (1e-8, 0.0, 0.0, 0.0), rows=401)
        sizes = [energy(roller, 300.0, state) for state in record]
        assert (sizes[-1] > sizes[200]) is grows


def test_the_other_spin_mirrors_the_yaw():
    forth, back = ROLLER, ROLLER._replace(spin=-ROLLER.spin, rolling_friction=-ROLLER.rolling_friction)
    loads = numpy.full(2001, 300.0)
    _status, one = run(forth, None, loads, 1e-5)
    _status, other = run(back, None, loads, 1e-5, start=(START[0], -START[1], START[2], -START[3]))
    assert other[-1] == pytest.approx(one[-1] * (1.0, -1.0, 1.0, -1.0), rel=1e-12)


def test_a_bent_roller_comes_to_rest_at_its_static_angles():
    """Where the moments cancel, the slopes are their rounding; the step goes on."""
    from contact_sim_pkg.rigs.roller.theory.stability import linearise

    roller = ROLLER._replace(damping_tilt=1e-2, damping_yaw=1e-2)
    rest = linearise(roller, CURVATURES, BENDING, MODULUS, 100.0)
    status, record = run(roller, BENDING, numpy.full(20001, 100.0), 2e-5, start=(rest.tilt + 1e-4, rest.yaw, 0.0, 0.0))
    assert status == DONE
    assert record[-1, :2] == pytest.approx([rest.tilt, rest.yaw], abs=1e-13)


def test_a_roller_that_tips_over_is_reported():
    status, record = run(ROLLER, None, numpy.full(20001, 3500.0), 1e-5, rows=11)
    assert status == DIVERGED
    assert numpy.isfinite(record[0]).all()
    assert numpy.isnan(record[-1]).all()


@pytest.mark.parametrize("stages", [1, 2, 3, 4])
def test_the_weights_of_a_rule(stages):
    """Gauss integrates t^k to 1/(k+1), for k up to 2 s - 1; the rows of A do so to c^(k+1)/(k+1) for k up to s - 1."""
    table = gauss_rule(stages)
    a, c, b = table[:-1, :-1], table[:-1, -1], table[-1, :-1]
    for k in range(2 * stages):
        assert b @ c**k == pytest.approx(1.0 / (k + 1))
    for k in range(stages):
        assert a @ c**k == pytest.approx(c ** (k + 1) / (k + 1))
    with pytest.raises(ValueError, match="at least 1 and at most 4 is needed"):
        gauss_rule(5)
    assert math.isfinite(table.sum())
