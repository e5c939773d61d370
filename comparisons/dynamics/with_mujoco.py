"""MuJoCo: soft constraints. Restitution by an underdamped contact whose damping ratio follows from e exactly."""

from __future__ import annotations

import math

import mujoco
import numpy
from scipy.optimize import brentq

from comparisons.dynamics.problems import SIDE, Array, Start

__all__ = ["SETTINGS", "STEPS", "MuJoCo", "version"]

SETTINGS = (
    "implicitfast, elliptic cone, impratio 100, Newton solver, tolerance 1e-12, 20 noslip iterations, solimp 0.9999; "
    "stiffness with 30 steps a period for bounces, else a time constant of 2 steps and critical damping"
)
STEPS = (2e-3, 1e-3, 1e-4, 1e-5)
PERIOD_STEPS = 30.0
WORLD = """<mujoco><option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="100" solver="Newton"
 tolerance="1e-12" iterations="100" noslip_iterations="20" gravity="{gravity}"/><worldbody>
<geom name="floor" type="plane" size="100 100 1" {contact}/>
<body name="body" pos="0 0 {height}" euler="0 {pitch} 0"><freejoint/><geom type="{kind}" size="{size}" mass="1" {contact}/></body>
</worldbody></mujoco>"""


def version() -> str:
    """Of the library."""
    return str(mujoco.__version__)


def _ratio_of_force_end(e: float) -> float:
    """Damping ratio of a contact that must not pull and gives back ``e``."""

    def miss(ratio: float) -> float:
        s = math.sqrt(1.0 - ratio * ratio)
        return math.exp(-(ratio / s) * (math.pi - math.atan2(2.0 * ratio * s, 1.0 - 2.0 * ratio * ratio))) - e

    return float(brentq(miss, 1e-9, 0.999))


class MuJoCo:
    """One world."""

    def __init__(self, step: float) -> None:
        self._step = step

    def place(self, start: Start) -> None:
        """Make the world anew."""
        ratio = (
            1.0
            if start.restitution == 0.0
            else (1e-6 if start.restitution == 1.0 else _ratio_of_force_end(start.restitution))
        )
        frequency = 2.0 * math.pi / (PERIOD_STEPS * self._step)
        constant = 2.0 * self._step if start.restitution == 0.0 else 1.0 / (frequency * ratio)
        contact = (
            f'friction="{start.friction} 0 0" condim="{3 if start.friction else 1}" solref="{constant!r} {ratio!r}" '
            'solimp="0.9999 0.9999 0.001 0.5 2"'
        )
        text = WORLD.format(
            step=repr(self._step), gravity=" ".join(map(repr, start.gravity)), contact=contact, height=repr(start.height),
            pitch=repr(math.degrees(start.pitch)), kind="sphere" if start.ball else "box",
            size="0.05" if start.ball else " ".join([repr(0.5 * SIDE)] * 3),
        )  # fmt: skip
        self._model = mujoco.MjModel.from_xml_string(text)
        self._data = mujoco.MjData(self._model)
        cosine, sine = math.cos(start.pitch), math.sin(start.pitch)
        turned = numpy.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
        self._data.qvel[:3] = start.velocity
        self._data.qvel[3:] = turned.T @ numpy.array([0.0, start.spin, 0.0])
        mujoco.mj_forward(self._model, self._data)

    def run(self, seconds: float) -> None:
        """Go on for a time, all steps in one call."""
        mujoco.mj_step(self._model, self._data, nstep=round(seconds / self._step))

    def state(self) -> tuple[Array, Array, Array]:
        """Position, velocity and angular velocity in world axes."""
        turned = self._data.xmat[1].reshape(3, 3)
        return self._data.qpos[:3].copy(), self._data.qvel[:3].copy(), turned @ self._data.qvel[3:]

    def loads(self) -> Array:
        """Normal forces [N] of the contacts."""
        force = numpy.zeros(6)
        found = []
        for contact in range(self._data.ncon):
            mujoco.mj_contactForce(self._model, self._data, contact, force)
            found.append(float(force[0]))
        return numpy.array(found)
