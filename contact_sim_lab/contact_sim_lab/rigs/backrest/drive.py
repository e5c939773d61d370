"""Drive of a backrest scene for the studies, and runs over it: by the bench's kernels, and by scipy
from its twin.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_lab.twins.vehicle import Law, Occupant, normal_force, power_law, states_at_segments
from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.compiled.results import DONE, SENTENCES
from contact_sim_pkg.integrate.dormand_prince import make_workspace
from contact_sim_pkg.laws.parameters import GeneralDissipative, NormalElastic
from contact_sim_pkg.rigs.backrest import entries
from contact_sim_pkg.rigs.backrest.model import BackrestModel, build_backrest
from contact_sim_pkg.rigs.backrest.motion import event_count
from contact_sim_pkg.rigs.backrest.parameters import ENDED, PLACE, START, TOUCHED, BackrestSamples, Shaking, make_mode
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.run.vibration_drive import VIBRATION, accelerations
from contact_sim_pkg.scene.resolved_scene import ResolvedScene

__all__ = ["BackrestMotion", "DrivenBackrest", "drive_of", "fast_run", "slow_run"]


class DrivenBackrest(NamedTuple):
    """What shakes the seat back."""

    model: BackrestModel
    segment: float  # [s]
    acceleration: Vector  # [m/s^2] at the ends of all segments


class BackrestMotion(NamedTuple):
    """What a run gives, at the starts of all segments."""

    approach: NDArray[numpy.float64]  # [samples, points] [m]
    normal: Vector  # [samples] [N] of the whole contact
    friction: Vector  # [samples] [N]
    touches: Vector  # [s] instants at which the first point touches
    supplied: float = 0.0  # [J] work of the shaking and of the sliding
    residual: float = 0.0  # [J] supplied less what is kinetic, potential, stored and dissipated
    place: Vector | None = None  # [samples, 2] [m] of the first point from the shell's middle


def drive_of(scene: ResolvedScene, duration: float) -> DrivenBackrest:
    """Drive of the scene's seat back over ``duration`` [s]."""
    model, sources = build_backrest(scene), make_sources(scene)
    timing = model.timing
    blocks = max(1, min(timing.blocks, round(duration / timing.block_length)))
    forward = [accelerations(timing, block, sources[VIBRATION].block(block))[0] for block in range(blocks)]
    joined = numpy.concatenate([*(part[:-1] for part in forward), forward[-1][-1:]])
    return DrivenBackrest(model, timing.segment_length, joined)


def fast_run(drive: DrivenBackrest, scale: Vector) -> BackrestMotion:
    """By the bench's kernels, with the error ``scale`` [states] allowed per step. Raises
    ArithmeticError where they fail.
    """
    model, count = drive.model, len(drive.acceleration) - 1
    states, points = len(model.start), len(model.rig.gaps)
    state, mode, work = model.start.copy(), make_mode(points), make_workspace(states, event_count(points))
    room = numpy.zeros((count, states)), numpy.zeros((count, states)), numpy.zeros((count, entries.FORCES))
    by_point = numpy.zeros((count, points, entries.POINT_COLUMNS))
    entries.start(model.rig, mode, state, work)
    before = numpy.array(entries.energies(model.rig, mode, 0.0, state))
    shaking, samples = Shaking(0.0, drive.segment, drive.acceleration), BackrestSamples(1, *room, by_point)
    status = entries.advance(model.rig, mode, state, scale, work, shaking, samples)
    if status != DONE:
        raise ArithmeticError(SENTENCES[status])
    rows = numpy.vstack([mode.ended[: mode.counts[ENDED], : mode.lasting.shape[1]], mode.lasting[points]])
    whole = numpy.append(mode.ended[: mode.counts[ENDED], PLACE] == points, True)
    touches = rows[whole & (rows[:, TOUCHED] > 0.0), START]
    forces = room[2]
    kinetic, potential, stored, supplied, dissipated = (
        numpy.array(entries.energies(model.rig, mode, count * drive.segment, state)) - before
    )
    return BackrestMotion(
        by_point[:, :, entries.POINT_APPROACH].copy(), forces[:, entries.NORMAL], forces[:, entries.TANGENTIAL],
        numpy.unique(touches),  # the last episode may have ended
        float(supplied), float(supplied - kinetic - potential - stored - dissipated),
        by_point[:, 0, entries.POINT_UP : entries.POINT_ACROSS + 1],
    )  # fmt: skip


def slow_run(drive: DrivenBackrest) -> BackrestMotion | None:
    """By scipy, without code of the kernels; None for a back that the twin does not know: a shell,
    or one on foam.

    Friction does not act on the normal motion of a back without modes, and is not worked out.
    """
    rig, contact = drive.model.rig, drive.model.rig.contact
    law = _law(contact.elastic, contact.dissipative)
    if law is None or rig.stiffness.any() or contact.hysteresis is not None:
        return None
    mass, none = float(rig.mass[0]), numpy.zeros(0)
    unlinked = numpy.zeros((0, 2), dtype=numpy.int64)
    pressed, still = float(rig.preload[0]) / mass, numpy.zeros(len(drive.acceleration))
    back = Occupant(rig.mass, unlinked, none, none, law)
    found = states_at_segments(
        pressed, None, back, -drive.model.start[:2], drive.segment, cushion=still, height=still,
        acceleration=drive.acceleration,
    )  # fmt: skip
    approach, speed = -found[:, 0], -found[:, 1]
    forces = numpy.array([normal_force(law, x, v) for x, v in zip(approach[:-1], speed[:-1], strict=True)])
    return BackrestMotion(approach[:-1, None], forces, numpy.zeros(0), _touches(drive, pressed, approach, speed))


def _law(elastic: object, loss: object) -> Law | None:
    if not isinstance(elastic, NormalElastic):
        return None
    if isinstance(loss, GeneralDissipative):
        powers = loss.coefficient, loss.approach_exponent, loss.rate_exponent
        return Law(power_law(*elastic), 0.0, powers, loss.lowest_force)
    return Law(power_law(*elastic), float(getattr(loss, "damping", 0.0)))


def _touches(drive: DrivenBackrest, pressed: float, approach: Vector, speed: Vector) -> Vector:
    """Instants at which free flight ends: the root of its cubic, the acceleration being straight in
    each segment.
    """
    length, shaking = drive.segment, drive.acceleration
    found = []
    for i in numpy.flatnonzero((approach[:-1] < 0.0) & (approach[1:] >= 0.0)):
        jerk = (shaking[i + 1] - shaking[i]) / length
        roots = numpy.roots([jerk / 6.0, 0.5 * (pressed + shaking[i]), speed[i], approach[i]])
        real = roots.real[(abs(roots.imag) < 1e-9) & (roots.real >= 0.0)]
        found.append(i * length + float(real.min(initial=math.inf)))
    return numpy.array(found)
