"""Work of the rig block, estimated before the run."""

from __future__ import annotations

import math
from collections.abc import Iterator

from contact_sim_pkg.records.work import Work
from contact_sim_pkg.rigs.body.schema import Block, CompliantContact, RigidContact
from contact_sim_pkg.run.integrator_work import Link, integrator_steps, power_law_link, segments
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

# [s] of a sub-step of a flight; of a step of the scheme stepping
SUBSTEP_COST, STEPPED_COST = 6e-6, 5e-5
PLANAR_TURN, SPATIAL_TURN = 0.2, 0.02  # [rad] of a sub-step


def work_of_block(scene: ResolvedScene) -> Iterator[Work]:
    """Sub-steps of flight or steps of the rigid scheme; steps of the integrator where the contact
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
    law = scene.effect("block", RigidContact) or RigidContact()
    if law.scheme == "stepping":
        yield Work("steps of rigid_contact.step", scene.duration / law.step, STEPPED_COST)
        return
    # flight is cut into sub-steps of bounded rotation
    angle = _turned(block, scene.duration)
    yield Work(
        "sub-steps of flight of a body that spins",
        angle / (PLANAR_TURN if block.motion == "plane" else SPATIAL_TURN),
        SUBSTEP_COST,
    )


def _turned(block: Block, duration: float) -> float:
    """Angle [rad] that a body turns in ``duration`` [s]: the faster, the longer a known torque
    turns it.
    """
    plane = block.motion == "plane"
    corners = [block.sides, [0.0, 0.0, 0.0]] if block.points is None else block.points
    size = 2.0 * block.radius if block.shape == "sphere" else max(math.dist(corners[0], other) for other in corners)
    torque, spin = (abs(each[1]) if plane else math.hypot(*each) for each in (block.torque, block.angular_velocity))
    if torque <= 0.5 * block.mass * block.gravity * size:  # it may rest
        torque = 0.0
    return spin * duration + 0.5 * torque / (block.mass * size**2 / 12.0) * duration**2
