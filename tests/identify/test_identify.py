"""Identification of whole motions against the parameters and impulses that made them."""

import numpy
import pytest
from tests.identify import motions

from contact_sim_lab.identify.twins.falling_body import FallingBody, fall
from contact_sim_pkg.identify.contact.instant import REVERSED
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.identify import Setup, identify
from contact_sim_pkg.identify.motion import geometry, wrench
from contact_sim_pkg.identify.motion.states import BodyStates

SQUARE = Setup(geometry.box([motions.SIDE] * 3))
BOX = Setup(geometry.box(motions.LENGTHS))
FORCE, TORQUE = (1.3, 0.0, 0.7), (0.0, 0.004, 0.0)


def values(found):
    return {parameter.name: parameter for parameter in found.parameters}


def used(found):
    return [contact for contact in found.contacts if contact.mode is not None]


def check_impacts(found, record):
    """Instants, impulses over mass and modes of all impacts."""
    assert len(used(found)) == len(found.contacts) == len(record.bounces) >= 3
    for contact, bounce in zip(found.contacts, record.bounces, strict=True):
        assert contact.begin == pytest.approx(bounce.time, abs=1e-12)
        push = bounce.impulse / motions.MASS
        assert contact.mode.normal == pytest.approx(push[2], rel=1e-9)
        assert contact.mode.tangential == pytest.approx(numpy.hypot(*push[:2]), rel=1e-9, abs=1e-12)
        assert (contact.mode.mode == "stick") == bounce.sticks
        if not bounce.sticks:
            assert contact.mode.friction_at_least == pytest.approx(0.3, rel=1e-9)
            assert (contact.mode.friction is None) == (contact.mode.mode == REVERSED)
        assert contact.arm == pytest.approx(bounce.arm, abs=1e-12)


def test_planar_inertia_and_impulses_come_back_to_1e_9():
    record = motions.planar()
    found = identify(motions.states_of(record), SQUARE)
    assert 1.0 / values(found)["J/m"].value == pytest.approx(6.0 / motions.SIDE**2, rel=1e-9)
    assert found.rank == found.unknowns == 1
    assert found.axis == pytest.approx([0.0, 1.0, 0.0])
    check_impacts(found, record)


def test_spatial_inertia_and_impulses_come_back_to_1e_9():
    record = motions.spatial()
    found = identify(motions.states_of(record), BOX)
    inertia = found.problem.model.inertia(found.estimate.parameters)
    assert inertia == pytest.approx(motions.SPATIAL_INERTIA, rel=1e-9, abs=1e-9 * numpy.trace(motions.SPATIAL_INERTIA))
    assert found.rank == found.unknowns == 6
    assert found.axis is None
    check_impacts(found, record)


@pytest.mark.parametrize("record", [motions.planar(), motions.spatial()], ids=["plane", "space"])
def test_without_a_known_wrench_mass_is_named_as_not_identifiable(record):
    found = identify(motions.states_of(record), SQUARE if record is motions.planar() else BOX)
    assert any(line.startswith("mass is not identifiable without an external force") for line in found.unobservable)
    assert "1/m" not in values(found)


@pytest.mark.parametrize(("force", "torque"), [(FORCE, None), (None, TORQUE), (FORCE, TORQUE)])
def test_a_known_force_or_torque_tells_the_mass(force, torque):
    zero = (0.0, 0.0, 0.0)
    record = motions.planar(0.6, force or zero, torque or zero)
    found = identify(motions.states_of(record), SQUARE._replace(wrench=wrench.constant(force, torque)))
    assert 1.0 / values(found)["1/m"].value == pytest.approx(motions.MASS, rel=1e-9)
    assert values(found)["J/m"].value == pytest.approx(motions.SIDE**2 / 6.0, rel=1e-9)
    assert found.unobservable == []


def test_force_and_torque_in_space_tell_mass_and_all_six_moments():
    force, torque = (1.0, 2.0, 0.3), (0.01, -0.005, 0.002)
    record = motions.spatial(0.52, force, torque)
    found = identify(motions.states_of(record), BOX._replace(wrench=wrench.constant(force, torque)))
    assert 1.0 / values(found)["1/m"].value == pytest.approx(motions.MASS, rel=1e-9)
    inertia = found.problem.model.inertia(found.estimate.parameters)
    assert inertia == pytest.approx(motions.SPATIAL_INERTIA, rel=1e-9, abs=1e-11)
    assert found.rank == 7


def test_a_force_that_is_sampled_over_time_tells_the_mass_too():
    record = motions.planar(0.6, FORCE)
    time = numpy.linspace(0.0, 1.0, 11)
    known = wrench.sampled(time, numpy.tile(FORCE, (11, 1)), None)
    found = identify(motions.states_of(record), SQUARE._replace(wrench=known))
    assert 1.0 / values(found)["1/m"].value == pytest.approx(motions.MASS, rel=1e-9)


def test_one_spatial_impact_with_tumbling_flights_tells_all_six_moments():
    record = motions.spatial()
    end = 0.5 * (record.bounces[0].time + record.bounces[1].time)
    found = identify(motions.states_of(record, end), BOX)
    assert found.rank == 6
    inertia = found.problem.model.inertia(found.estimate.parameters)
    assert inertia == pytest.approx(motions.SPATIAL_INERTIA, rel=1e-7, abs=1e-9)


def test_a_tumbling_flight_alone_tells_the_moments_up_to_their_size():
    record = motions.spatial()
    found = identify(motions.states_of(record, 0.9 * record.bounces[0].time), BOX)
    assert found.rank == 5
    assert any(line.startswith("the size of I0/m is not identifiable") for line in found.unobservable)
    assert not any(parameter.identified for parameter in found.parameters[:3])


def test_a_planar_flight_alone_tells_nothing_of_the_inertia():
    record = motions.planar()
    found = identify(motions.states_of(record, 0.2), SQUARE)
    assert found.rank == 0
    assert any(line.startswith("the moment of inertia is not identifiable") for line in found.unobservable)


@pytest.mark.parametrize("seed", range(4))
def test_noise_on_all_channels_leaves_the_truth_within_its_standard_deviations(seed):
    states = motions.noisy(motions.states_of(motions.planar()), seed, 1e-4, 1e-3)
    found = identify(states, SQUARE)
    inertia = values(found)["J/m"]
    assert abs(inertia.value - motions.SIDE**2 / 6.0) < 4.0 * inertia.deviation < 0.01 * inertia.value
    assert found.noise == pytest.approx((1e-4, 1e-3, 1e-3, 1e-2), rel=0.1)
    for contact, bounce in zip(found.contacts, motions.planar().bounces, strict=True):
        if contact.mode is not None:
            assert abs(contact.mode.normal - bounce.impulse[2] / motions.MASS) < 5.0 * contact.normal_deviation


def test_noise_in_space_leaves_the_truth_within_its_standard_deviations():
    found = identify(motions.noisy(motions.states_of(motions.spatial()), 3, 1e-4, 1e-3), BOX)
    truth = [*numpy.diag(motions.SPATIAL_INERTIA), 0.0, 0.0, 0.0]
    for parameter, expected in zip(found.parameters, truth, strict=True):
        if parameter.identified:
            assert abs(parameter.value - expected) < 4.5 * parameter.deviation


def test_a_tilted_frame_changes_neither_inertia_nor_impulses():
    """The whole scene turned about the vertical: the plane of motion is no longer x-z."""
    record = motions.planar()
    turn = numpy.array([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]])
    states = BodyStates(
        record.time,
        record.position @ turn.T,
        turn @ record.rotation,
        record.velocity @ turn.T,
        record.angular_velocity @ turn.T,
    )
    found = identify(states, SQUARE)
    assert found.axis == pytest.approx([-0.8, 0.6, 0.0]) or found.axis == pytest.approx([0.8, -0.6, 0.0])
    assert values(found)["J/m"].value == pytest.approx(motions.SIDE**2 / 6.0, rel=1e-9)


def test_contacts_with_something_unknown_are_listed_and_not_used():
    states = motions.states_of(motions.planar())
    found = identify(states._replace(position=states.position + numpy.array([0.0, 0.0, 5.0])), SQUARE)
    assert found.rank == 0
    assert len(found.contacts) == len(motions.planar().bounces)
    assert all("m above the ground" in contact.note for contact in found.contacts)


def test_times_that_start_late_change_nothing():
    record = motions.planar()
    states = motions.states_of(record)
    found = identify(states._replace(time=states.time + 512.0), SQUARE)
    assert values(found)["J/m"].value == pytest.approx(motions.SIDE**2 / 6.0, rel=1e-7)


def sliding_ball(noise=0.0):
    """A ball slides on level ground and is spun up: v' = -mu g, w' = mu g R m/J; it never leaves the ground."""
    radius, friction, time = 0.05, 0.3, 1e-3 * numpy.arange(190)  # it rolls from 2/(3.5 mu g) = 0.194 s on
    zero, speed, rate = 0.0 * time, 2.0 - friction * 9.81 * time, friction * 9.81 / (0.4 * radius) * time
    place, turned = 2.0 * time - 0.5 * friction * 9.81 * time**2, 0.5 * rate * time
    vectors = [numpy.stack(rows, axis=1) for rows in ((place, zero, zero + radius), (zero, turned, zero))]
    rates = [numpy.stack(rows, axis=1) for rows in ((speed, zero, zero), (zero, rate, zero))]
    states = BodyStates(time, vectors[0], motions.exponential(vectors[1]), *rates)
    return motions.noisy(states, 0, 0.1 * noise, noise, noise, 10.0 * noise) if noise else states


@pytest.mark.parametrize(("noise", "allowed"), [(0.0, 1e-9), (1e-4, 0.05)])
def test_a_lasting_contact_tells_the_inertia_step_by_step(noise, allowed):
    found = identify(sliding_ball(noise), Setup(geometry.sphere(0.05)))
    assert values(found)["J/m"].value == pytest.approx(0.4 * 0.05**2, rel=allowed)
    assert found.contacts[0].note.startswith("lasting contact, slides with friction 0.3 ±")


def test_refusals_are_sentences():
    states = motions.states_of(motions.planar())
    broken = states._replace(
        velocity=states.velocity * numpy.where(numpy.arange(len(states.time)) == 7, numpy.nan, 1.0)[:, None]
    )
    with pytest.raises(IdentificationError, match="velocity of sample 7 is not finite"):
        identify(broken, SQUARE)
    with pytest.raises(IdentificationError, match="3 samples"):
        identify(BodyStates(*(field[:3] for field in states)), SQUARE)
    with pytest.raises(IdentificationError, match="time does not grow from sample"):
        identify(states._replace(time=states.time[::-1]), SQUARE)
    known = wrench.sampled(numpy.array([0.0, 0.1]), numpy.ones((2, 3)), None)
    with pytest.raises(IdentificationError, match="wrench is known from"):
        identify(states, SQUARE._replace(wrench=known))
    still = states._replace(velocity=0.0 * states.velocity, position=0.0 * states.position + [0.0, 0.0, 0.05])
    still = still._replace(angular_velocity=0.0 * states.velocity, rotation=0.0 * states.rotation + numpy.eye(3))
    push = wrench.constant(FORCE)
    for setup, cure in (
        (SQUARE, "give the friction coefficient and the known force of a slide"),
        (SQUARE._replace(friction=0.3), "give the known force of a slide"),
        (SQUARE._replace(wrench=push), "give the friction coefficient of a slide"),
        (SQUARE._replace(friction=0.3, wrench=push), "no slide of the body on the given ground was found"),
    ):
        with pytest.raises(IdentificationError, match=f"no flight of 3 samples.*{cure}"):
            identify(still, setup)
    with pytest.raises(IdentificationError, match="not planar"):
        identify(motions.states_of(motions.spatial()), BOX._replace(planar=True))


def test_a_drop_on_an_edge_tells_its_impulses_though_not_where_they_act():
    """Without spin no corner of the two is the one: c_n/m is the change of speed, (1 + e) sqrt(2 g h), all the same."""
    rate, height, restitution = 1000, 0.3, 0.6
    side = motions.SIDE / numpy.sqrt(2.0)
    fallen = numpy.sqrt(2.0 * (height - side) / 9.81)
    time = numpy.arange(400) / rate
    after, back = time - fallen, restitution * 9.81 * fallen
    down = time < fallen
    z = numpy.where(down, height - 0.5 * 9.81 * time**2, side + back * after - 0.5 * 9.81 * after**2)
    speed = numpy.where(down, -9.81 * time, back - 9.81 * after)
    zero = numpy.zeros_like(time)
    turned = numpy.tile(motions.exponential(numpy.array([0.0, numpy.pi / 4, 0.0])), (len(time), 1, 1))
    vectors = [numpy.stack(rows, axis=1) for rows in ((zero, zero, z), (zero, zero, speed))]
    found = identify(BodyStates(time, vectors[0], turned, vectors[1], 0.0 * vectors[1]), SQUARE)
    (contact,) = found.contacts
    assert contact.mode is None
    assert contact.normal == pytest.approx((1.0 + restitution) * 9.81 * fallen, rel=1e-9)
    assert contact.tangential == pytest.approx(0.0, abs=1e-9)
    assert contact.normal_deviation < 1e-9


@pytest.mark.parametrize("rotation", [2e-3, 5e-3])
def test_the_edges_of_a_thin_plate_are_two_under_noise_of_the_rotation(rotation):
    """0.3 x 0.002 m: noise of 3 mrad times its length is more than its thickness, but its axis is a mean over all samples."""
    sides = numpy.array([0.3, 0.2, 0.002])
    corners = 0.5 * numpy.array([[x, 0.0, z] for x in (-0.3, 0.3) for z in (-0.002, 0.002)])
    inertia = (sides[0] ** 2 + sides[2] ** 2) / 12.0
    body = FallingBody(1.0, inertia * numpy.eye(3), corners, 0.3, 0.6)
    record = fall(body, numpy.array([0, 0, 0.3]), motions.exponential(numpy.array([0, 2.8, 0])), numpy.array([0.5, 0, 0]),
                  numpy.array([0, 2.0, 0]), 0.6)  # fmt: skip
    for seed in range(3):
        states = motions.noisy(motions.states_of(record), seed, 1e-4, rotation)
        found = identify(states, Setup(geometry.box(sides)))
        assert found.warnings == []
        assert abs(found.parameters[0].value - inertia) < 4.5 * found.parameters[0].deviation


def test_points_behind_each_other_are_one_and_those_beside_each_other_are_not():
    plate = geometry.box([0.3, 0.2, 0.002])
    flat = geometry.flattened(plate, numpy.array([0.0, 1.0, 0.0]), 1e-4)
    assert sorted(map(tuple, flat.points.round(12).tolist())) == sorted(
        (x, 0.0, z) for x in (-0.15, 0.15) for z in (-0.001, 0.001)
    )
    leaning = numpy.array([0.0, 1.0, 1e-5])
    assert len(geometry.flattened(plate, leaning / numpy.linalg.norm(leaning), 1e-4).points) == 4
