"""Impacts of one planar contact against enumeration of index sets and against the impulse path
integrated by scipy.
"""

import math

import numpy
import pytest

from contact_sim_lab.twins.rigid_impact import energetic_by_path, newton_by_enumeration, poisson_by_enumeration
from contact_sim_pkg.rigid.contact.planar_impact import planar_impact
from contact_sim_pkg.rigid.parameters import ENERGETIC, NEWTON, POISSON, PlanarContact
from contact_sim_pkg.rigid.results import REVERSE, SEPARATE, SLIDE, STICK

SIDE = 0.1
EACH_MODE = 50


def block_corner(theta, mass=1.0, side=SIDE):
    """J_n, J_t of the lowest corner of the block of Identifiability (eqs 41 and 42), and its
    inverse masses.
    """
    radius = side / math.sqrt(2.0)
    j_n = numpy.array([0.0, 1.0, -radius * math.sin(math.pi / 4 - theta)])
    j_t = numpy.array([1.0, 0.0, radius * math.cos(math.pi / 4 - theta)])
    return numpy.array([j_n, j_t]), numpy.array([1.0, 1.0, 6.0 / side**2]) / mass


def random_impacts(count, seed, friction=(0.0, 1.2)):
    """Jacobian, inverse masses, velocity and contact of random impacts of the block."""
    generator = numpy.random.default_rng(seed)
    for _ in range(count):
        J, W = block_corner(generator.uniform(0.0, math.pi / 2))
        v = generator.uniform([-2.0, -3.0, -20.0], [2.0, 1.0, 20.0])
        A = J * W @ J.T
        if (J @ v)[0] >= 0.0:
            continue
        yield J, W, v, contact_of(A, generator.uniform(*friction), generator.uniform())


def contact_of(A, friction, restitution):
    return PlanarContact(float(A[0, 0]), float(A[0, 1]), float(A[1, 1]), float(friction), float(restitution))


def velocity_error(J, W, v, c, expected):
    """As the goals measure it: largest difference over largest velocity, rotations times the
    side.
    """
    scale = numpy.array([1.0, 1.0, SIDE])
    return numpy.abs(scale * W * (J.T @ (c - expected))).max() / numpy.abs(scale * v).max()


def kinetic_energy(W, v):
    return 0.5 * float(v @ (v / W))


@pytest.mark.parametrize(
    ("rule", "reference"),
    [(NEWTON, newton_by_enumeration), (POISSON, poisson_by_enumeration)],
    ids=["newton", "poisson"],
)
def test_the_velocity_after_1000_random_impacts_in_every_mode_is_that_of_the_index_sets(rule, reference):
    modes = {STICK: 0, SLIDE: 0, REVERSE: 0}
    for J, W, v, contact in random_impacts(2200, 1):
        u = J @ v
        impulse = planar_impact(contact, rule, u[0], u[1])
        expected = reference(J * W @ J.T, contact.friction, contact.restitution, u)
        modes[impulse.mode] += 1
        assert velocity_error(J, W, v, numpy.array(impulse[:2]), expected) <= 1e-10
    assert sum(modes.values()) >= 1000
    assert min(modes.values()) >= EACH_MODE, modes


def test_the_energetic_impulse_is_that_of_its_path_in_every_mode():
    modes = {STICK: 0, SLIDE: 0, REVERSE: 0}
    for J, W, v, contact in random_impacts(2200, 2):
        u = J @ v
        impulse = planar_impact(contact, ENERGETIC, u[0], u[1])
        modes[impulse.mode] += 1
        expected = energetic_by_path(J * W @ J.T, contact.friction, contact.restitution, u)
        assert velocity_error(J, W, v, numpy.array(impulse[:2]), expected) <= 1e-10
    assert sum(modes.values()) >= 1000
    assert min(modes.values()) >= EACH_MODE, modes


def test_the_energetic_rule_never_gains_kinetic_energy_over_10000_impacts_and_newtons_does():
    growth = {NEWTON: 0.0, ENERGETIC: 0.0}
    count = 0
    for J, W, v, contact in random_impacts(22000, 3, friction=(0.0, 3.0)):
        count += 1
        u = J @ v
        for rule in growth:
            impulse = planar_impact(contact, rule, u[0], u[1])
            after = v + W * (J.T @ numpy.array(impulse[:2]))
            growth[rule] = max(growth[rule], kinetic_energy(W, after) / kinetic_energy(W, v))
    assert count >= 10_000
    assert growth[ENERGETIC] <= 1.0 + 1e-12
    assert growth[NEWTON] > 1.1


@pytest.mark.parametrize("rule", [NEWTON, POISSON, ENERGETIC])
def test_no_rule_gains_kinetic_energy_without_restitution(rule):
    for J, W, v, contact in random_impacts(2000, 4):
        u = J @ v
        impulse = planar_impact(contact._replace(restitution=0.0), rule, u[0], u[1])
        after = v + W * (J.T @ numpy.array(impulse[:2]))
        assert kinetic_energy(W, after) <= kinetic_energy(W, v) * (1.0 + 1e-12)


def test_the_three_rules_agree_where_slip_goes_through_without_a_stop():
    agreeing = 0
    for J, W, v, contact in random_impacts(2000, 5, friction=(0.0, 0.4)):
        u = J @ v
        energetic = planar_impact(contact, ENERGETIC, u[0], u[1])
        if energetic.mode != SLIDE:
            continue
        agreeing += 1
        for rule in (NEWTON, POISSON):
            other = planar_impact(contact, rule, u[0], u[1])
            assert velocity_error(J, W, v, numpy.array(other[:2]), numpy.array(energetic[:2])) <= 1e-12
    assert agreeing > 100


@pytest.mark.parametrize("rule", [NEWTON, POISSON, ENERGETIC])
def test_a_separating_contact_gets_no_impulse(rule):
    contact = PlanarContact(2.0, 1.9, 2.0, 2.0, 0.5)
    assert planar_impact(contact, rule, 0.0, 1.0) == (0.0, 0.0, SEPARATE)
    assert planar_impact(contact, rule, 0.3, -1.0) == (0.0, 0.0, SEPARATE)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("rule", [NEWTON, POISSON, ENERGETIC])
def test_without_coupling_the_normal_velocity_turns_round_by_the_restitution_under_every_rule(rule, restitution):
    contact = PlanarContact(2.0, 0.0, 3.0, 0.4, restitution)
    impulse = planar_impact(contact, rule, -1.5, 5.0)
    assert impulse.normal * 2.0 - 1.5 == pytest.approx(1.5 * restitution, abs=1e-15)
    assert impulse.tangential == pytest.approx(-0.4 * impulse.normal, rel=1e-15)


@pytest.mark.parametrize("rule", [NEWTON, POISSON, ENERGETIC])
def test_painleve_jams_the_contact_with_a_finite_impulse(rule):
    """A_nn - mu A_nt < 0: sliding on would push the point into the ground; slip stops instead."""
    J, W = block_corner(math.pi / 4 - math.atan(0.5))
    A = J * W @ J.T
    contact = contact_of(A, 1.6, 0.2)
    sliding = contact.normal - contact.friction * abs(contact.coupling)
    assert sliding < 0.0
    v = numpy.array([math.copysign(3.0, contact.coupling), -0.01, 0.0])
    u = J @ v
    impulse = planar_impact(contact, rule, u[0], u[1])
    after = u + A @ numpy.array(impulse[:2])
    assert numpy.isfinite(impulse[:2]).all()
    assert impulse.mode == STICK
    assert abs(after[1]) <= 1e-14
    assert after[0] >= 0.0


def test_without_friction_only_the_normal_velocity_changes():
    impulse = planar_impact(PlanarContact(2.0, 0.7, 3.0, 0.0, 0.6), ENERGETIC, -1.0, 0.5)
    assert impulse.tangential == 0.0
    assert impulse.normal == pytest.approx(1.6 / 2.0, rel=1e-15)
