"""A resultant at one instant."""

from __future__ import annotations

from collections.abc import Sequence

from contact_sim_pkg.records.messages import Vector3, Wrench, WrenchStamped


def wrench_of(force: Sequence[float], torque: Sequence[float]) -> WrenchStamped:
    """Force [N] and torque [N m] about the origin of the frame, each along x (forward), y (left) and z (up)."""
    fx, fy, fz = force
    tx, ty, tz = torque
    return WrenchStamped(wrench=Wrench(force=Vector3(x=fx, y=fy, z=fz), torque=Vector3(x=tx, y=ty, z=tz)))
