"""What the scenes of a rigid body expect: that it jams, sticks, rests, bounces, tumbles."""

from __future__ import annotations

import math

import numpy as np

from contact_sim_pkg.records.regime import Figure
from contact_sim_pkg.report.series import Recording
from contact_sim_pkg.rigs.body.report.numbers import BLOCK, bursts, rest_from
from contact_sim_pkg.rigs.body.report.pose import BlockPoses, points_of, poses_of


def jam(recording: Recording) -> Figure:
    """Slip of the lowest corner behind its first contact over that before it, where the sliding mode has no solution:
    1/m + g_n (g_n - mu s g_t) / I <= 0 with the levers g of normal and friction and the direction s of the slip. No
    value where it has one, and for other motion than in the plane.
    """
    contact, motion = recording.contacts.get(BLOCK), recording.motion
    touched = np.flatnonzero(contact.normal > 0.0) if contact is not None else np.zeros(0, np.int64)
    if motion is None or len(touched) == 0 or touched[0] + 1 >= len(motion.time):
        return Figure(math.nan, "nothing is touched")
    poses, first = poses_of(recording.scene, motion), int(touched[0])
    if poses.model.body.width != 2:
        return Figure(math.nan, "the body does not move in the plane")
    before, least = _slip(poses, first)
    after, _ = _slip(poses, first + 1)
    where = (
        f"at {motion.time[first]:.4g} s from {abs(before):.4g} to {abs(after):.2g} m/s, denominator {least:.3g} 1/kg"
    )
    if least > 0.0:
        return Figure(math.nan, f"it can slide on: {where}")
    return Figure(abs(after / before), where)


def _slip(poses: BlockPoses, sample: int) -> tuple[float, float]:
    """Slip [m/s] of the corner nearest to the ground, and the denominator [1/kg] of its sliding on."""
    body, normal = poses.model.body, poses.model.ground.normal[:2]
    corners = points_of(poses, sample)
    across = corners @ normal
    lever = corners[int(across.argmin())] - body.radius * normal
    along = np.array([normal[1], -normal[0]])
    # velocity of a point by the pitch rate: (r_z, -r_x)
    turn = np.array([lever[1], -lever[0]])
    slip = float((poses.velocity[sample, [0, 2]] + poses.spin[sample, 1] * turn) @ along)
    by_normal, by_friction = float(turn @ normal), float(turn @ along)
    friction = math.copysign(body.friction, slip)
    return slip, 1.0 / body.mass + by_normal * (by_normal - friction * by_friction) / float(np.ravel(body.inertia)[0])


def rest(recording: Recording) -> Figure:
    """Instant [s] from which the body does not move any more; no value where it moves at the end."""
    found = None if recording.motion is None else rest_from(recording.motion)
    return Figure(math.nan, "it moves at the end of the run") if found is None else Figure(found)


def sticking(recording: Recording) -> Figure:
    """Instant [s] from which the body rests, held by friction; no value where it moves or nothing pulls at it."""
    found, contact = rest(recording), recording.contacts.get(BLOCK)
    if contact is None or math.isnan(found.value):
        return found
    if not contact.normal[-1] > 0.0 or not abs(contact.tangential[-1]) > 0.0:
        return Figure(math.nan, "no friction holds it")
    return Figure(found.value, f"friction over load {abs(contact.tangential[-1]) / contact.normal[-1]:.4g}")


def bounces(recording: Recording) -> Figure:
    """Number of contacts, each behind a flight."""
    contact = recording.contacts.get(BLOCK)
    return Figure(math.nan, "no contact was recorded") if contact is None else Figure(float(len(bursts(contact))))


def tumbling(recording: Recording) -> Figure:
    """Angle [rad] that the body turns through between its first contact and its rest; no value where it does not rest."""
    found, contact, motion = rest(recording), recording.contacts.get(BLOCK), recording.motion
    if contact is None or motion is None or math.isnan(found.value) or not contact.normal.any():
        return Figure(math.nan, found.remark or "nothing is touched")
    spin = np.linalg.norm(poses_of(recording.scene, motion).spin, axis=1)
    first = int(np.flatnonzero(contact.normal > 0.0)[0])
    return Figure(float(spin[first:].sum()) * motion.sample_period, f"at rest from {found.value:.4g} s")
