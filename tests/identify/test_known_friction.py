"""A known friction coefficient: what a slide under a known force then tells of the mass, and what it does not.

Expected motions are closed forms of bodies that slide with Coulomb friction; masses and moments are those put in.
"""

import json

import numpy
import pytest
from tests.identify import foreign_bag, motions

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.identify.contact.balance import Side
from contact_sim_pkg.identify.contact.coulomb import friction_balance
from contact_sim_pkg.identify.contact.stacked import estimate
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.flight import FlightModel, FlightState, moved
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.motion.states import BodyStates, SampleNoise
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem, planar_basis, spatial_basis

MASS, RADIUS, FRICTION, GRAVITY = 1.3, 0.05, 0.3, 9.81
SPHERE, BLOCK = geometry.sphere(RADIUS), geometry.box([0.1, 0.14, 0.2])
EXACT = SampleNoise(1e-12, 1e-12, 1e-12, 1e-12)


def sliding_ball(force, torque=0.0, samples=200):
    """A ball slides along x under a force and a torque about y: v' = (F_x - mu N)/m, w' = (mu N R + tau)/J, N = m g - F_z."""
    time = 1e-3 * numpy.arange(samples)
    normal = MASS * GRAVITY - force[2]
    pull, spin = (force[0] - FRICTION * normal) / MASS, (FRICTION * normal * RADIUS + torque) / (0.4 * MASS * RADIUS**2)
    assert (2.0 + pull * time[-1]) > spin * time[-1] * RADIUS  # it slides to the end
    zero = 0.0 * time
    place = numpy.stack([2.0 * time + 0.5 * pull * time**2, zero, zero + RADIUS], axis=1)
    turned = exponential(numpy.stack([zero, 0.5 * spin * time**2, zero], axis=1))
    speed, rate = (numpy.stack(rows, axis=1) for rows in ((2.0 + pull * time, zero, zero), (zero, spin * time, zero)))
    return BodyStates(time, place, turned, speed, rate)


def sliding_block(force, start=(1.0, 0.4), slope=0.0, samples=300):
    """A block slides on its face without turning, down a slope about y: the slip turns where the force lies across it."""
    normal = numpy.array([numpy.sin(slope), 0.0, numpy.cos(slope)])
    ahead, left = numpy.array([numpy.cos(slope), 0.0, -numpy.sin(slope)]), numpy.array([0.0, 1.0, 0.0])
    weight = numpy.array(force) - MASS * GRAVITY * geometry.UP
    pressed = -float(weight @ normal)
    drive = numpy.array([weight @ ahead, weight @ left]) / MASS

    def rate(_, state):
        slip = state[2:] / numpy.hypot(*state[2:])
        return [*state[2:], *(drive - FRICTION * pressed / MASS * slip)]

    from scipy.integrate import solve_ivp

    time = 1e-3 * numpy.arange(samples)
    found = solve_ivp(rate, (0, time[-1]), [0.0, 0.0, *start], "DOP853", t_eval=time, rtol=1e-13, atol=1e-14)
    axes = numpy.stack([ahead, left, normal], axis=1)
    frame = numpy.stack([ahead, left])
    place = found.y[:2].T @ frame + 0.1 * normal
    count = len(time)
    return BodyStates(
        time, place, numpy.repeat(axes[None], count, axis=0), found.y[2:].T @ frame, numpy.zeros((count, 3))
    )


def reported(found):
    return {parameter.name: parameter for parameter in found.parameters}


def test_a_ball_that_slides_under_a_known_force_tells_mass_and_inertia_if_friction_is_known():
    known = Setup(SPHERE, wrench=wrench.constant((2.0, 0.0, 1.0)), friction=FRICTION)
    found = identify(sliding_ball((2.0, 0.0, 1.0)), known)
    assert (found.rank, found.unobservable) == (2, [])
    assert reported(found)["1/m"].value == pytest.approx(1.0 / MASS, rel=1e-9)
    assert reported(found)["J/m"].value == pytest.approx(0.4 * RADIUS**2, rel=1e-9)


def test_with_friction_unknown_the_same_slide_leaves_one_equation_and_says_what_is_lacking():
    found = identify(sliding_ball((2.0, 0.0, 1.0)), Setup(SPHERE, wrench=wrench.constant((2.0, 0.0, 1.0))))
    assert found.rank == 1
    assert "only where the friction coefficient is known too" in found.unobservable[0]
    assert not reported(found)["1/m"].identified


@pytest.mark.parametrize("friction", [None, FRICTION])
def test_a_force_along_the_edge_of_the_friction_cone_looks_like_contact(friction):
    """F_x = -mu F_z while it slides along x: every force balance is that of a contact with another load."""
    force = (-FRICTION * 2.0, 0.0, 2.0)
    found = identify(sliding_ball(force), Setup(SPHERE, wrench=wrench.constant(force), friction=friction))
    assert (found.rank, found.flights) == (1, 0)  # no flight of a light body either
    assert not reported(found)["1/m"].identified
    if friction is not None:
        assert "the known force lies along the edge of the friction cone" in found.unobservable[0]


def test_a_torque_alone_does_not_tell_mass_and_inertia_of_a_slide_apart():
    known = Setup(SPHERE, wrench=wrench.constant(None, (0.0, -0.01, 0.0)), friction=FRICTION)
    found = identify(sliding_ball((0.0, 0.0, 0.0), -0.01), known)
    assert found.rank == 1
    assert "one equation for two unknowns" in found.unobservable[0]


@pytest.mark.parametrize(
    ("force", "slope", "start", "error"),
    [
        ((3.0, 0.0, 0.0), 0.0, (1.0, 0.0), 1e-9),
        ((1.0, 4.0, -2.0), 0.0, (1.0, 0.4), 1e-5),  # the slip turns: a step takes it by its mean
        ((0.5, -2.0, 1.0), 0.2, (0.5, 0.5), 1e-5),
    ],
)
def test_a_block_that_slides_on_its_face_tells_the_mass_and_nothing_of_the_inertia(force, slope, start, error):
    states = sliding_block(force, start, slope)
    normal = (numpy.sin(slope), 0.0, numpy.cos(slope))
    known = Setup(BLOCK, geometry.plane(normal), wrench.constant(force), friction=FRICTION)
    found = identify(states, known)
    mass = reported(found)["1/m"]
    assert mass.value == pytest.approx(1.0 / MASS, rel=error)
    assert abs(mass.value - 1.0 / MASS) < 4.0 * mass.deviation
    assert found.rank == 1
    assert found.unobservable == [
        "I0/m is not identifiable: no impact changed the spin by a moment about the centre of mass"
    ]


@pytest.mark.parametrize("seed", range(3))
def test_noise_leaves_the_mass_within_what_is_reported(seed):
    force = (1.0, 4.0, -2.0)
    states = motions.noisy(sliding_block(force), seed, 1e-4, 1e-3)
    found = reported(identify(states, Setup(BLOCK, wrench=wrench.constant(force), friction=FRICTION)))["1/m"]
    assert abs(found.value - 1.0 / MASS) < 4.0 * found.deviation < 0.05


def test_derivatives_of_the_balance_of_friction_match_finite_differences():
    random = numpy.random.default_rng(5)
    before = FlightState(0.0, *random.normal(size=(2, 3)), exponential(random.normal(size=3)), random.normal(size=3))
    change = numpy.concatenate([random.normal(size=6), 1e-9 * random.normal(size=3), random.normal(size=3)])
    after = moved(before, change)._replace(time=0.1)
    model = FlightModel(spatial_basis(), True, wrench.constant((1.0, 2.0, 0.3), (0.01, -0.005, 0.002)), GRAVITY)
    ground = geometry.plane((0.1, -0.2, 1.0))
    parameters, flat = numpy.array([4e-3, 3e-3, 2e-3, 3e-4, -2e-4, 1e-4, 0.8]), numpy.zeros((12, 7))
    states = BodyStates(*(numpy.zeros((2, *shape)) for shape in ((), (3,), (3, 3), (3,), (3,))))
    problem = IdentificationProblem(states, [], [], BLOCK, ground, model, EXACT, None, friction=FRICTION)
    contact = ContactSpan(0, 1, 0.0, 0.1, 3, turns=False, slides=True)

    def value(change_before, change_after, point):
        ends = [moved(before, change_before), moved(after, change_after)]
        return friction_balance(problem, contact, tuple(Side(end, numpy.eye(12), flat) for end in ends), point)

    zero = numpy.zeros(12)
    found = value(zero, zero, parameters)
    for column in range(12):
        step = 1e-6 * numpy.eye(12)[column]
        for derivative, slots in ((found.by_before, (1, 0)), (found.by_after, (0, 1))):
            ahead, behind = (value(s * slots[0] * step, s * slots[1] * step, parameters).value for s in (1, -1))
            assert derivative[:, column] == pytest.approx((ahead - behind) / 2e-6, rel=1e-6, abs=1e-8)
    step = 1e-6 * numpy.eye(7)[6]
    ahead, behind = (value(zero, zero, parameters + sign * step).value for sign in (1, -1))
    assert found.by_parameters[:, 6] == pytest.approx((ahead - behind) / 2e-6, rel=1e-6)


def one_step(force, torque=None):
    """A single planar step of a corner that slides along +x; sigma = -1. The balances make the motion after."""
    axis, step = numpy.array([0.0, 1.0, 0.0]), 1e-3
    shape = geometry.flattened(geometry.box([0.1] * 3), axis)
    rotation = exponential(0.3 * axis)
    point = int((rotation @ shape.points.T)[2].argmin())
    push = 0.1 * numpy.array([-FRICTION, 0.0, 1.0])
    moment = numpy.cross(rotation @ shape.points[point], push) + step * numpy.array(torque or (0, 0, 0))
    spin = moment / (MASS * 0.1**2 / 6.0)
    known = wrench.constant(force, torque)
    change = (push + step * numpy.array(force or (0, 0, 0))) / MASS - step * GRAVITY * geometry.UP
    half = exponential(0.25 * step * spin)
    turned = numpy.stack([half.T @ rotation, half @ rotation])
    speed = numpy.array([[2.0, 0, 0], [2.0 + change[0], 0.0, change[2]]])
    states = BodyStates(numpy.array([0.0, step]), numpy.zeros((2, 3)), turned, speed, numpy.stack([0.0 * spin, spin]))
    contact = ContactSpan(0, 1, 0.0, step, point, turns=True, slides=True)
    model = FlightModel(planar_basis(), True, known, GRAVITY)
    problem = IdentificationProblem(
        states, [(0, 0), (1, 1)], [contact], shape, geometry.plane(), model, EXACT, axis, friction=FRICTION
    )
    return estimate(problem, numpy.array([2e-3, 0.5]), numpy.array([2e-3, 0.5]))


@pytest.mark.parametrize(
    ("force", "torque", "rank"),
    [
        ((30.0, 0.0, 5.0), None, 2),
        ((30.0, 0.0, 5.0), (0.0, 2.0, 0.0), 2),
        ((-FRICTION * 20.0, 0.0, 20.0), None, 1),  # along the edge of the cone
        ((FRICTION * 20.0, 0.0, 20.0), None, 2),  # along its other edge
        (None, (0.0, 2.0, 0.0), 1),
    ],
)
def test_one_sliding_step_with_known_friction_tells_two_unknowns_unless_the_force_hides_in_the_cone(
    force, torque, rank
):
    found = one_step(force, torque)
    assert found.directions.rank == rank
    if rank == 2:
        assert found.parameters == pytest.approx([0.1**2 / 6.0, 1.0 / MASS], rel=1e-7)


def test_the_command_takes_the_coefficient_and_refuses_a_negative_one(tmp_path, capsys):
    foreign_bag.write_odometry(tmp_path / "bag", sliding_block((3.0, 0.0, 0.0), (1.0, 0.0)))
    call = ["identify", str(tmp_path / "bag"), "--box", "0.1", "0.14", "0.2", "--force", "3", "0", "0", "--json"]
    assert main([*call, "--friction", "0.3"]) == 0
    rows = {row["parameter"]: row["value"] for row in json.loads(capsys.readouterr().out)["parameters"]}
    assert rows["m"] == pytest.approx(MASS, rel=1e-8)
    assert main([*call, "--friction", "-0.3"]) == 2
    assert "a friction coefficient is 0 to 1e+06, not -0.3" in capsys.readouterr().err


def test_the_balance_of_friction_needs_slip():
    still = FlightState(0.0, *numpy.zeros((2, 3)), numpy.eye(3), numpy.zeros(3))
    model = FlightModel(spatial_basis(), True, wrench.constant((1.0, 0.0, 0.0)), GRAVITY)
    states = BodyStates(*(numpy.zeros((2, *shape)) for shape in ((), (3,), (3, 3), (3,), (3,))))
    problem = IdentificationProblem(states, [], [], BLOCK, geometry.plane(), model, EXACT, None, friction=FRICTION)
    side = Side(still, numpy.eye(12), numpy.zeros((12, 7)))
    with pytest.raises(IdentificationError, match="does not slip"):
        friction_balance(problem, ContactSpan(0, 1, 0.0, 0.0, 0), (side, side), numpy.ones(7))
