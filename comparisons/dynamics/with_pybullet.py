"""PyBullet: sequential impulses, tuned for exactness: no damping, no slop, no threshold of restitution, many iterations."""

from __future__ import annotations

import math

import numpy
import pybullet

from comparisons.dynamics.problems import SIDE, Array, Start

__all__ = ["SETTINGS", "STEPS", "PyBullet", "version"]

SETTINGS = (
    "200 iterations, residual 0, no damping of motion, contact slop 0, restitution threshold 0, contact and friction ERP 0, "
    "cone friction, margin of box and ball 0, floor a box (on a plane block impacts stay 0.19 off)"
)
SLAB = (10.0, 10.0, 1.0)  # [m] half the floor
STEPS = (2e-3, 1e-3, 1e-4, 1e-5)


def version() -> str:
    """Of the library."""
    return str(pybullet.getAPIVersion())


class PyBullet:
    """One world."""

    def __init__(self, step: float) -> None:
        self._step = step
        self._client = pybullet.connect(pybullet.DIRECT)

    def place(self, start: Start) -> None:
        """Make the world anew."""
        client = self._client
        pybullet.resetSimulation(physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=self._step, numSolverIterations=200, numSubSteps=0, restitutionVelocityThreshold=0.0,
            contactSlop=0.0, solverResidualThreshold=0.0, enableConeFriction=1, contactERP=0.0, frictionERP=0.0,
            physicsClientId=client,
        )  # fmt: skip
        pybullet.setGravity(*start.gravity, physicsClientId=client)
        slab = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=SLAB, physicsClientId=client)
        floor = pybullet.createMultiBody(0, slab, -1, [0.0, 0.0, -SLAB[2]], physicsClientId=client)
        if start.ball:
            shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.05, physicsClientId=client)
        else:
            half = [0.5 * SIDE] * 3
            shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=client)
        turn = pybullet.getQuaternionFromEuler([0.0, start.pitch, 0.0])
        self._body = pybullet.createMultiBody(1.0, shape, -1, [0.0, 0.0, start.height], turn, physicsClientId=client)
        for body in (floor, self._body):
            pybullet.changeDynamics(
                body, -1, lateralFriction=math.sqrt(start.friction), restitution=math.sqrt(start.restitution),
                linearDamping=0.0, angularDamping=0.0, rollingFriction=0.0, spinningFriction=0.0,
                collisionMargin=0.0, contactProcessingThreshold=0.0, activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING,
                physicsClientId=client,
            )  # fmt: skip
        pybullet.resetBaseVelocity(self._body, start.velocity, [0.0, start.spin, 0.0], physicsClientId=client)

    def run(self, seconds: float) -> None:
        """Go on for a time, one call a step: there is no other."""
        for _ in range(round(seconds / self._step)):
            pybullet.stepSimulation(physicsClientId=self._client)

    def state(self) -> tuple[Array, Array, Array]:
        """Position, velocity and angular velocity in world axes."""
        position, _turn = pybullet.getBasePositionAndOrientation(self._body, physicsClientId=self._client)
        velocity, spin = pybullet.getBaseVelocity(self._body, physicsClientId=self._client)
        return numpy.array(position), numpy.array(velocity), numpy.array(spin)

    def loads(self) -> Array:
        """Normal forces [N] of the contacts."""
        return numpy.array(
            [contact[9] for contact in pybullet.getContactPoints(self._body, physicsClientId=self._client)]
        )
