"""Impacts of several contacts at once, and of one contact in space."""

import numpy
import pytest
from scipy.integrate import solve_ivp
from tests.rigid.contact.contact_case import COORDINATES, PLANE, SPACE, contact_rows, problem_of, random_case

from contact_sim_pkg.rigid.contact.planar_impact import planar_impact
from contact_sim_pkg.rigid.impact.law import impact_impulses, make_impact_workspace
from contact_sim_pkg.rigid.parameters import ENERGETIC, NEWTON, POISSON, PlanarContact
from contact_sim_pkg.rigid.results import SOLVED


def impact(J, W, v, friction, restitution, rule, width, work=None):
    contacts = len(J) // width
    work = work or make_impact_workspace(contacts, COORDINATES[width], width)
    c = numpy.zeros(len(J))
    problem = problem_of(J, W, J @ v, friction, width)
    solution = impact_impulses(problem, J, W, J @ v, numpy.full(contacts, float(restitution)), rule, work, c)
    return c, solution


@pytest.mark.parametrize("width", [PLANE, SPACE])
@pytest.mark.parametrize("contacts", [2, 4])
def test_several_contacts_neither_penetrate_nor_gain_kinetic_energy(contacts, width):
    generator = numpy.random.default_rng(contacts)
    work = make_impact_workspace(contacts, COORDINATES[width], width)
    for rule, gains in ((ENERGETIC, False), (POISSON, True), (NEWTON, True)):
        for _ in range(25):
            J, W, v = random_case(generator, contacts, width)
            friction = generator.uniform(0.0, 1.0, contacts)
            c, solution = impact(J, W, v, friction, generator.uniform(), rule, width, work)
            after = v + W @ J.T @ c
            assert solution.status == SOLVED
            assert (J @ after)[::width].min() >= -1e-12
            if not gains:
                assert after @ numpy.linalg.solve(W, after) <= v @ numpy.linalg.solve(W, v) * (1.0 + 1e-12)


def test_one_contact_in_space_with_planar_data_gets_the_planar_impulse():
    generator = numpy.random.default_rng(3)
    work = make_impact_workspace(1, 6, SPACE)
    W = numpy.diag([1.0, 1.0, 1.0, 3.0, 14.0, 5.0])
    for _ in range(100):
        J = contact_rows([[generator.uniform(-1.0, 1.0), 0.0, -generator.uniform(0.1, 1.0)]], SPACE)
        v = numpy.zeros(6)
        v[[0, 2, 4]] = generator.uniform([-1.0, -2.0, -3.0], [1.0, -1.0, 3.0])
        u, A = J @ v, J @ W @ J.T
        if u[0] >= 0.0:
            continue
        friction, restitution = generator.uniform(0.0, 1.5), generator.uniform()
        c, _solution = impact(J, W, v, friction, restitution, ENERGETIC, SPACE, work)
        contact = PlanarContact(A[0, 0], A[0, 1], A[1, 1], friction, restitution)
        expected = planar_impact(contact, ENERGETIC, u[0], u[1])
        assert numpy.abs(A[:2, :2] @ (c[:2] - expected[:2])).max() <= 1e-11 * numpy.abs(u).max()
        assert abs(c[2]) <= 1e-14


def path_by_scipy(A, friction, restitution, u):
    """Impulse of the energetic rule in space while the slip does not stop: the plain path over the
    normal impulse.
    """

    def rate(_p, y):
        s = y[1:3] / numpy.linalg.norm(y[1:3])
        push = numpy.array([1.0, -friction * s[0], -friction * s[1]])
        return numpy.concatenate([A @ push, push, [y[0]]])

    def compressed(_p, y):
        return y[0]

    compressed.terminal = True
    start = numpy.concatenate([u, numpy.zeros(4)])
    options = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15}
    first = solve_ivp(rate, (0.0, 100.0), start, events=compressed, **options)
    wanted = (1.0 - restitution**2) * first.y[6, -1]

    def returned(_p, y):
        return y[6] - wanted

    returned.terminal = True
    second = solve_ivp(rate, (0.0, 100.0), first.y[:, -1], events=returned, **options)
    return second.y[3:6, -1]


def test_one_contact_in_space_follows_its_path_while_the_slip_turns():
    generator = numpy.random.default_rng(4)
    W = numpy.diag([1.0, 1.0, 1.0, 3.0, 4.0, 5.0])
    work = make_impact_workspace(1, 6, SPACE)
    for _ in range(20):
        J = contact_rows([generator.uniform([-0.5, -0.5, -1.0], [0.5, 0.5, -0.5])], SPACE)
        v = numpy.array([6.0, 5.0, -1.0, 0.0, 0.0, 0.0])
        v[3:] = generator.uniform(-0.5, 0.5, 3)
        c, _solution = impact(J, W, v, 0.3, 0.6, ENERGETIC, SPACE, work)
        expected = path_by_scipy(J @ W @ J.T, 0.3, 0.6, J @ v)
        assert numpy.abs(c - expected).max() <= 1e-10 * numpy.abs(c).max()


def test_one_contact_in_space_never_gains_kinetic_energy():
    generator = numpy.random.default_rng(5)
    work = make_impact_workspace(1, 6, SPACE)
    worst = 0.0
    for _ in range(400):
        J = contact_rows([generator.uniform([-1.0, -1.0, -1.0], [1.0, 1.0, -0.1])], SPACE)
        W = numpy.diag([1.0, 1.0, 1.0, *generator.uniform(1.0, 20.0, 3)])
        v = generator.uniform(-2.0, 2.0, 6)
        if (J @ v)[0] >= 0.0:
            continue
        c, solution = impact(J, W, v, generator.uniform(0.0, 2.0), generator.uniform(), ENERGETIC, SPACE, work)
        after = v + W @ J.T @ c
        assert solution.status == SOLVED
        worst = max(worst, after @ numpy.linalg.solve(W, after) / (v @ numpy.linalg.solve(W, v)))
    assert 0.9 < worst <= 1.0 + 1e-12


@pytest.mark.parametrize("width", [PLANE, SPACE])
def test_several_contacts_give_back_no_more_than_the_square_of_restitution_of_the_work_they_took(width):
    """Energetic rule: the normal work of both phases, from the impulses of an impact with e and of
    one without.
    """
    generator = numpy.random.default_rng(6)
    work = make_impact_workspace(2, COORDINATES[width], width)
    shares = []
    for _ in range(200):
        J, W, v = random_case(generator, 2, width)
        friction, restitution = generator.uniform(0.0, 2.0, 2), generator.uniform(0.3, 0.9)
        first, _solution = impact(J, W, v, friction, 0.0, ENERGETIC, width, work)
        if not first.any():  # both contacts part
            continue
        both, _solution = impact(J, W, v, friction, restitution, ENERGETIC, width, work)
        before, between, after = (J @ (v + W @ J.T @ c) for c in (numpy.zeros(len(J)), first, both))
        normal = slice(None, None, width)
        taken = -0.5 * first[normal] * (before + between)[normal]
        returned = 0.5 * (both - first)[normal] @ (between + after)[normal]
        shares.append(returned / (restitution**2 * numpy.maximum(taken, 0.0).sum()))
    assert max(shares) <= 1.0 + 1e-9
    assert sum(share > 1.0 - 1e-9 for share in shares) >= 10, "the bound acts in some of the impacts"


def test_a_block_on_two_corners_falls_flat_and_rebounds_without_turning():
    """Symmetric: both corners give back e of their share, so the block rises straight with e times
    its speed.
    """
    J, W = contact_rows([[-0.1, -0.1], [0.1, -0.1]], PLANE), numpy.diag([1.0, 1.0, 600.0])
    for rule in (NEWTON, POISSON, ENERGETIC):
        c, _solution = impact(J, W, numpy.array([0.0, -2.0, 0.0]), 0.3, 0.5, rule, PLANE)
        assert W @ J.T @ c + [0.0, -2.0, 0.0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-11)
