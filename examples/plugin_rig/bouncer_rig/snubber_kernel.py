"""The snubber as an element of the bench's vehicle: its force, its energy and its event, compiled."""

from typing import NamedTuple

from bouncer_rig.snubber import SnubberSection
from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.rigs.vehicle.acting import Acting, Chassis
from contact_sim_pkg.rigs.vehicle.motion.elements import register_element


class Snubber(NamedTuple):
    """``F = k d`` pushes wheel and body apart, d how far the wheel has come up beyond ``begins``."""

    wheel: int  # places in the state: the height there, the velocity behind it
    body: int
    begins: float  # [m] of the wheel over the body
    stiffness: float  # [N/m]


@borrowing_kernel
def depth(snubber, state):
    """How deep [m] it is pressed in; below 0 where it does not touch."""
    return state[snubber.wheel] - state[snubber.body] - snubber.begins


@borrowing_kernel
def act(snubber, ground, mode, state, out):
    """Add the forces [N]; returns the power lost and brought in [W], the energy held and kept [J]."""
    deep = max(0.0, depth(snubber, state))
    out[snubber.wheel + 1] -= snubber.stiffness * deep
    out[snubber.body + 1] += snubber.stiffness * deep
    return 0.0, 0.0, 0.5 * snubber.stiffness * deep * deep, 0.0


@borrowing_kernel
def events(snubber, ground, state, first, out):
    """No step straddles the touch, where the stiffness jumps."""
    out[first] = depth(snubber, state)


register_element(Snubber, act, events=events, event_count=1)


def snubber_of(keys: SnubberSection, chassis: Chassis) -> Acting:
    """Between the wheel and the body of a scene."""
    assert chassis.wheel is not None
    assert chassis.body is not None
    begins = keys.travel - chassis.hangs
    return Acting((Snubber(chassis.wheel.place, chassis.body.place, begins, keys.stiffness),))
