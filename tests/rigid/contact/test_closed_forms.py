"""Closed forms of active points (a face, an edge in the plane, one point): against conditions,
enumeration, the general solvers.
"""

import math

import numpy
import pytest
from tests.rigid.contact.contact_case import PLANE, SPACE, contact_rows, random_case, solve

from contact_sim_lab.twins.rigid_contact import coulomb_residual, planar_velocity_by_enumeration
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.rigid.contact.single import single_impulses
from contact_sim_pkg.rigid.contact.solver import NEWTON
from contact_sim_pkg.rigid.geometry.face import face_impulses, make_face_workspace
from contact_sim_pkg.rigid.impact.planar_pair import make_pair_workspace, pair_impulses
from contact_sim_pkg.rigid.problem import INACTIVE

BOX = numpy.array([[x, y, -0.05] for x in (-0.1, 0.1) for y in (-0.15, 0.15)])


@entry
def closed_forms(kind, J, W, velocity, q, friction, face, pair, c):
    if kind == 0:
        return face_impulses(J, W, velocity, friction, face, c)
    if kind == 1:
        return pair_impulses(J, W, q, friction, 0, 1, pair, c)
    return single_impulses(J, W, q, friction[0], 0, c)


def closed(kind, J, W, v, friction):
    contacts = len(friction)
    c = numpy.zeros(len(J))
    residual = closed_forms(kind, J, W, v, J @ v, friction, make_face_workspace(contacts), make_pair_workspace(), c)
    return c, residual


def box_case(generator, slip, spin):
    inertia = numpy.diag(generator.uniform(100.0, 300.0, 3))
    turn = numpy.linalg.qr(generator.normal(size=(3, 3)))[0]
    W = numpy.diag([0.5] * 6)
    W[3:, 3:] = turn @ inertia @ turn.T
    v = numpy.array([*generator.uniform(-slip, slip, 2), -9.81e-3, *generator.uniform(-spin, spin, 3)])
    return contact_rows(BOX, SPACE), W, v


@pytest.mark.parametrize(("slip", "spin"), [(2e-3, 1e-3), (0.05, 0.0), (0.5, 1e-3)])
def test_a_face_that_rests_or_slides_meets_the_contact_conditions_and_pushes_with_the_least_norm(slip, spin):
    generator, found = numpy.random.default_rng(1), 0
    for _ in range(60):
        J, W, v = box_case(generator, slip, spin)
        c, residual = closed(0, J, W, v, numpy.full(4, 0.5))
        if math.isinf(residual):
            continue
        found += 1
        assert coulomb_residual(J @ W @ J.T, J @ v, c, 0.5, SPACE, 0) <= 1e-12
        assert residual <= 1e-12
        after = J @ (v + W @ J.T @ c)
        if numpy.abs(after).max() <= 1e-12:
            expected = J @ numpy.linalg.solve(J.T @ J, J.T @ c)  # least norm without bounds
            assert c == pytest.approx(expected, abs=1e-12 * numpy.abs(c).max())
    assert found >= 30


def test_a_face_that_slides_without_turning_gets_what_the_general_solver_finds():
    generator, found = numpy.random.default_rng(2), 0
    for _ in range(40):
        speed, angle = generator.uniform(0.02, 1.0), generator.uniform(0.0, 2.0 * math.pi)
        J, W = contact_rows(BOX, SPACE), numpy.diag([0.5, 0.5, 0.5, 120.0, 200.0, 150.0])
        v = numpy.array([speed * math.cos(angle), speed * math.sin(angle), -9.81e-3, 0.0, 0.0, 0.0])
        c, residual = closed(0, J, W, v, numpy.full(4, 0.5))
        general, _solution = solve(J, W, J @ v, 0.5, SPACE, method=NEWTON)
        # along an axis of the box the body does not turn
        if residual <= 1e-12 and abs(math.sin(2.0 * angle)) < 1e-3:
            assert numpy.abs(c - general).max() <= 1e-9 * numpy.abs(general).max()
        found += residual <= 1e-12
        assert numpy.abs((J @ (v + W @ J.T @ c))[::3]).max() <= 1e-13
    assert found >= 35


def test_points_that_take_no_part_get_nothing_and_points_on_a_line_are_no_face():
    J, W = (
        contact_rows(numpy.vstack([BOX, BOX + numpy.array([0.0, 0.0, 0.1])]), SPACE),
        numpy.diag([1.0] * 3 + [200.0] * 3),
    )
    friction = numpy.array([0.5] * 4 + [INACTIVE] * 4)
    v = numpy.array([0.0, 0.0, -1.0, 0.0, 0.0, 0.0])
    c, residual = closed(0, J, W, v, friction)
    assert residual <= 1e-15
    assert c[::3] == pytest.approx([0.25] * 4 + [0.0] * 4, rel=1e-14)
    line = contact_rows([[x, 0.0, -0.05] for x in (-0.1, 0.0, 0.2)], SPACE)
    assert math.isinf(closed(0, line, W, v, numpy.full(3, 0.5))[1])


def test_two_planar_contacts_of_order_8_give_the_velocity_of_the_index_sets_and_the_general_split():
    generator = numpy.random.default_rng(3)
    for _ in range(200):
        J, W, v = random_case(generator, 2, PLANE)
        v[[0, 2]] *= generator.uniform()
        friction = generator.uniform(0.05, 0.9, 2)
        c, residual = closed(1, J, W, v, friction)
        expected = planar_velocity_by_enumeration(J, W, v, friction)
        assert residual <= 1e-12
        assert coulomb_residual(J @ W @ J.T, J @ v, c, friction, PLANE, 0) <= 1e-12
        assert numpy.abs(v + W @ J.T @ c - expected).max() <= 1e-11
        general, _solution = solve(J, W, J @ v, friction, PLANE)
        assert numpy.abs(c - general).max() <= 1e-9 * max(numpy.abs(general).max(), 1e-3)


def test_one_point_in_space_meets_the_contact_conditions_whether_it_sticks_or_slides():
    generator, modes = numpy.random.default_rng(4), {True: 0, False: 0}
    for _ in range(200):
        J = contact_rows([generator.uniform([-0.2, -0.2, -0.5], [0.2, 0.2, -0.2])], SPACE)
        W = numpy.diag([1.0, 1.0, 1.0, 3.0, 4.0, 5.0])
        v = numpy.array([*generator.uniform(-1.2, 1.2, 2), -0.5, 0.0, 0.0, 0.0])
        friction = generator.uniform(0.05, 1.5, 1)
        c, residual = closed(2, J, W, v, friction)
        if math.isinf(residual):
            continue
        modes[bool(numpy.linalg.norm((J @ (v + W @ J.T @ c))[1:]) < 1e-12)] += 1
        assert residual <= 1e-12
        assert coulomb_residual(J @ W @ J.T, J @ v, c, friction, SPACE, 0) <= 1e-12
    assert min(modes.values()) >= 10
