"""Work of the rig block, estimated before the run."""

from __future__ import annotations

import math
from collections.abc import Iterator

from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.body.schema import Block, CompliantContact
from contact_sim_pkg.run.integrator_work import Link, integrator_steps, power_law_link, segments
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

SUBSTEP_COST = 6e-6  # [s] of a sub-step of a flight
PLANAR_TURN, SPATIAL_TURN = 0.2, 0.02  # [rad] of a sub-step


def work_of_block(scene: ResolvedScene) -> Iterator[Work]:
    """Sub-steps of flight; steps of the integrator where the contact
    is compliant.
    """
    block, compliant = scene.section(Block), scene.effect("block", CompliantContact)
    if compliant is not None:
        yield segments(scene)
        # springs that limit the step of the integrator
        links = [
            Link("normal_dissipative", block.mass, 0.0, 0.0),
            power_law_link(
                "compliant_contact", block.mass, block.mass * block.gravity, compliant.stiffness, compliant.exponent
            ),
            Link("compliant_contact", block.mass, compliant.tangential_stiffness, compliant.tangential_damping or 0.0),
        ]
        if compliant.tangential_damping:  # a sliding point: its spring relaxes against its damper
            links.append(Link("compliant_contact", compliant.tangential_damping, 0.0, compliant.tangential_stiffness))
        yield from integrator_steps(scene, "block", links)
    # flight is cut into sub-steps of bounded rotation
    angle = _turned(block, scene.duration)
    yield Work(
        "sub-steps of flight of a body that spins",
        angle / (PLANAR_TURN if block.motion == "plane" else SPATIAL_TURN),
        SUBSTEP_COST,
    )


def _turned(block: Block, duration: float) -> float:
    """Angle [rad] that a body turns in ``duration`` [s]: the faster, the longer a known torque
    turns it about an axis that its weight does not hold.
    """
    spin, torque = list(block.angular_velocity), _body_axes(block)
    pressed = max(0.0, block.mass * block.gravity - block.force[2])  # onto the ground
    accelerations = [
        about / inertia if abs(about) > 0.5 * pressed * width else 0.0  # below, it may rest on an edge
        for about, inertia, width in zip(torque, *_inertia(block), strict=True)
    ]
    if block.motion == "plane":
        spin, accelerations = [spin[1]], [accelerations[1]]
    return math.hypot(*spin) * duration + 0.5 * math.hypot(*accelerations) * duration**2


def _body_axes(block: Block) -> list[float]:
    """Known torque [N m] in the axes of the body at the start, by Rodrigues' formula."""
    angle = math.hypot(*block.rotation)
    if block.motion == "plane" or angle == 0.0:
        return list(block.torque)
    axis, torque = [each / angle for each in block.rotation], block.torque
    along = sum(a * b for a, b in zip(axis, torque, strict=True)) * (1.0 - math.cos(angle))
    across = [axis[i - 2] * torque[i - 1] - axis[i - 1] * torque[i - 2] for i in range(3)]
    return [math.cos(angle) * torque[i] - math.sin(angle) * across[i] + along * axis[i] for i in range(3)]


def _inertia(block: Block) -> tuple[list[float], list[float]]:
    """Moments of inertia [kg m^2] about the body's axes, of a hull those of the box around it, and
    its width [m] across each.
    """
    if block.shape == "sphere":
        return [0.4 * block.mass * block.radius**2] * 3, [2.0 * block.radius] * 3
    sides = list(block.sides)
    if block.points is not None:
        sides = [max(each) - min(each) for each in zip(*block.points, strict=True)]
        sides = [sides[0], 0.0, sides[1]] if len(sides) == 2 else sides  # a polygon: about y alone
    widths = [math.hypot(sides[1], sides[2]), math.hypot(sides[0], sides[2]), math.hypot(sides[0], sides[1])]
    return [block.mass * width**2 / 12.0 for width in widths], widths
