"""Motion of the sphere from release to release: pieces of flight, contact and rest, each known in
closed form or by its own series.

Pieces are made when they are asked for, so a run is as long as its blocks. What is recorded has no
part in it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.rigs.impact.model import FirstContact, ImpactModel, Release
from contact_sim_pkg.rigs.impact.theory.closed_form.flight import Flight, fall, rebound
from contact_sim_pkg.rigs.impact.theory.contact import (
    LOADED,
    PARTED,
    ContactLaw,
    ContactPhase,
    next_stretch,
    sample,
    static_depth,
    stored,
    touch,
)
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.run.errors import RunError

AT_REST = (
    # Energy of a motion in contact, over that of the weight on the static depth, below which the
    # sphere rests
    1.0e-12
)
STILL = 1.0e-9  # [m/s]: a pendulum that leaves the sample more slowly hangs at rest on it
MOST_PIECES = 10_000  # a block


class Held(NamedTuple):
    """The sphere in the machine's catch, at the height of its release."""

    approach: float  # [m], negative
    potential: float  # [J]


class Rest(NamedTuple):
    """The sphere at rest on the sample."""

    law: ContactLaw


class Piece(NamedTuple):
    """A stretch of time with one kind of motion."""

    begin: float  # [s]
    end: float  # [s], infinite where nothing ends it
    motion: Held | Flight | ContactPhase | Rest
    heat: float  # [J] that the sample has turned into heat before it
    supplied: float  # [J] that the machine has supplied before it


class SphereState(NamedTuple):
    """The sphere at given times; arrays [times]."""

    depth: Vector  # approach [m], negative in flight
    speed: Vector  # its rate [m/s]
    acceleration: Vector  # [m/s^2]
    elastic: Vector  # [N]
    viscous: Vector  # [N]
    kinetic: Vector  # [J]
    potential: Vector  # [J], 0 at the sample's surface
    stored: Vector  # [J] in the sample
    heat: Vector  # [J] since the start of the run
    supplied: Vector  # [J] by the machine since the start of the run


class FinishedImpact(NamedTuple):
    """One impact, from touch to parting."""

    number: int
    release: int
    start: float  # [s]
    temperature: float  # [K]
    touch: FirstContact
    stretches: tuple[ContactPhase, ...]
    duration: float  # [s] to the last loss of force
    parted: float  # [s] simulated time of the end of the overlap
    loss_depth: float  # [m]
    loss_speed: float  # [m/s], opening negative
    speed: float  # [m/s] V0


class ImpactMotion:
    """The sphere's motion. ``state(times)`` gives it, ``take_ended`` the impacts that ended."""

    def __init__(self, model: ImpactModel) -> None:
        """The first release, at time 0."""
        self.model = model
        self._release = 0
        self._bounces = self._impacts = 0
        self._ended: list[FinishedImpact] = []
        self._contact: list[ContactPhase] = []
        self._touch: tuple[float, float, FirstContact] | None = None
        self.pieces: list[Piece] = []
        self.made = 0
        self._append(fall(model.machine, model.releases[0].speed), 0.0, 0.0, 0.0)

    @property
    def release(self) -> Release:
        """The release that the sphere moves by."""
        return self.model.releases[self._release]

    def forget_before(self, time: float) -> None:
        """Drop pieces that ended before ``time`` [s]."""
        self.pieces = [piece for piece in self.pieces if piece.end > time]

    def take_ended(self, time: float) -> list[FinishedImpact]:
        """The impacts whose overlap ended up to ``time`` [s], each once."""
        self._reach(time)
        taken = [impact for impact in self._ended if impact.parted <= time]
        self._ended = [impact for impact in self._ended if impact.parted > time]
        return taken

    def time_of(self, count: int) -> float:
        """When impact number ``count`` (from 1) of the first release has parted, [s]; 0 where the
        sphere comes to rest before.

        Also 0 where more than `MOST_PIECES` pieces do not tell. Raises RunError where a touch is
        outside the model.
        """
        while self._impacts < count and math.isfinite(self.pieces[-1].end) and self.made < MOST_PIECES:
            self._extend()
        return self._ended[count - 1].parted if self._impacts >= count else 0.0

    def state(self, times: Vector) -> SphereState:
        """The state at rising ``times`` [s]. Raises RunError where a touch is outside the model."""
        self._reach(float(times[-1]))
        columns = numpy.zeros((len(SphereState._fields), len(times)))
        for piece in self.pieces:
            inside = (times >= piece.begin) & (times < piece.end)
            if inside.any():
                columns[:, inside] = self._of_piece(piece, times[inside])
        return SphereState(*columns)

    def _reach(self, time: float) -> None:
        """Make pieces until one covers ``time``."""
        made = 0
        while self.pieces[-1].end <= time:
            self._extend()
            made += 1
            if made > MOST_PIECES:
                raise RunError(
                    f"{self.pieces[-1].begin:.6g} s: more than {MOST_PIECES} impacts and flights in one block; the sphere hardly "
                    "bounces any more; end the run earlier, or let it be caught after some bounces"
                )

    def _append(self, motion: Held | Flight | ContactPhase | Rest, begin: float, heat: float, supplied: float) -> None:
        duration = motion.duration if isinstance(motion, (Flight, ContactPhase)) else math.inf
        self.pieces.append(Piece(begin, min(begin + duration, self._next_release()), motion, heat, supplied))
        self.made += 1

    def _next_release(self) -> float:
        following = self._release + 1
        return self.model.releases[following].time if following < len(self.model.releases) else math.inf

    def _extend(self) -> None:
        last = self.pieces[-1]
        if last.end == self._next_release():
            self._lift(last)
        elif isinstance(last.motion, Flight):
            self._begin_contact(last, last.motion)
        elif isinstance(last.motion, ContactPhase):
            self._contact.append(last.motion)
            heat = last.heat + last.motion.heat
            if last.motion.next_kind == PARTED:
                self._part(last, last.motion, heat)
            elif last.motion.next_kind == LOADED and _excess(last.motion) <= AT_REST:
                rest = Rest(last.motion.law)
                lost = _energy(last.motion.law, last.motion.last_depth, last.motion.last_speed)
                self._append(
                    rest, last.end, heat + lost - _energy(rest.law, static_depth(rest.law), 0.0), last.supplied
                )
            else:
                self._append(next_stretch(last.motion), last.end, heat, last.supplied)

    def _lift(self, last: Piece) -> None:
        """The next release takes the sphere from wherever it is."""
        now = self._of_piece(last, numpy.array([last.end]))
        names = SphereState._fields
        kinetic, potential, held, heat, supplied = (
            float(now[names.index(name), 0]) for name in ("kinetic", "potential", "stored", "heat", "supplied")
        )
        self._release += 1
        self._bounces, self._contact, self._touch = 0, [], None
        flight = fall(self.model.machine, self.release.speed)
        energy = 0.5 * self.model.sphere.mass * flight.speed**2
        # what the sample still stores under the lifted sphere becomes heat
        self._append(flight, last.end, heat + held, supplied + energy - kinetic - potential)

    def _begin_contact(self, last: Piece, flight: Flight) -> None:
        try:
            found = self.model.touch(flight.speed, self.release.temperature)
        except ImpactError as error:
            raise RunError(f"{last.end:.6g} s, impact {self._impacts} at {flight.speed:.4g} m/s: {error}") from None
        self._touch, self._contact = (last.end, flight.speed, found), []
        self._append(touch(found.law, flight.speed), last.end, last.heat, last.supplied)

    def _part(self, last: Piece, stretch: ContactPhase, heat: float) -> None:
        assert self._touch is not None
        self._close(last.end)
        self._bounces += 1
        mass, speed = self.model.sphere.mass, -stretch.last_speed
        if self.model.bounces and self._bounces >= self.model.bounces:
            held = self._held()
            self._append(held, last.end, heat, last.supplied + held.potential - 0.5 * mass * speed**2)
            return
        if stretch.law.gravity == 0.0 and speed < STILL:
            self._append(Rest(stretch.law), last.end, heat + 0.5 * mass * speed**2, last.supplied)
            return
        self._append(rebound(self.model.machine, speed), last.end, heat, last.supplied)

    def _held(self) -> Held:
        flight = fall(self.model.machine, self.release.speed)
        approach = flight.at(numpy.zeros(1))[0]
        return Held(float(approach[0]), self.model.sphere.mass * float(flight.potential(approach)[0]))

    def _close(self, parted: float) -> None:
        """Write down the impact; its force was lost at the end of its last loaded stretch."""
        assert self._touch is not None
        start, speed, found = self._touch
        loaded = max(i for i, stretch in enumerate(self._contact) if stretch.kind == LOADED)
        last = self._contact[loaded]
        duration = math.fsum(stretch.duration for stretch in self._contact[: loaded + 1])
        self._ended.append(
            FinishedImpact(
                number=self._impacts,
                release=self._release,
                start=start,
                temperature=self.release.temperature,
                touch=found,
                stretches=tuple(self._contact),
                duration=duration,
                parted=parted,
                loss_depth=last.last_depth,
                loss_speed=last.last_speed,
                speed=speed,
            )
        )
        self._impacts += 1

    def _of_piece(self, piece: Piece, times: Vector) -> NDArray[numpy.float64]:
        """Rows as the fields of `SphereState`."""
        since, mass = times - piece.begin, self.model.sphere.mass
        out = numpy.zeros((len(SphereState._fields), len(times)))
        depth, speed, acceleration, elastic, viscous, kinetic, potential, held, heat, supplied = out
        heat[:], supplied[:] = piece.heat, piece.supplied
        motion = piece.motion
        if isinstance(motion, Held):
            depth[:], potential[:] = motion.approach, motion.potential
        elif isinstance(motion, Flight):
            depth[:], speed[:] = motion.at(since)
            potential[:] = mass * motion.potential(depth)
            acceleration[:] = _flight_acceleration(motion, depth)
        elif isinstance(motion, Rest):
            depth[:] = static_depth(motion.law)
            elastic[:] = motion.law.mass * motion.law.gravity
        else:
            depth[:], speed[:], released = sample(motion, since)
            heat[:] += released
            if motion.kind == LOADED:
                elastic[:], viscous[:] = forces(motion.law, depth, speed)
            acceleration[:] = motion.law.gravity - (elastic + viscous) / mass
        kinetic[:] = 0.5 * mass * speed**2
        if isinstance(motion, (ContactPhase, Rest)):
            held[:] = [stored(motion.law, float(x)) for x in depth]
            potential[:] = -mass * motion.law.gravity * depth
        return out


def forces(law: ContactLaw, depth: Vector, speed: Vector) -> tuple[Vector, Vector]:
    """Elastic and viscous force in [N] of a loaded contact."""
    root = numpy.sqrt(depth)
    return law.elastic * depth * root, law.viscous * root * speed


def course_of(impact: FinishedImpact, count: int) -> tuple[Vector, ...]:
    """Times from the touch, depth, speed, elastic and viscous force at ``count`` even instants up
    to the last loss of force.
    """
    times: Vector = numpy.linspace(0.0, impact.duration, count, dtype=numpy.float64)
    depth, speed, elastic, viscous = (numpy.zeros(count) for _ in range(4))
    begin = 0.0
    for stretch in impact.stretches:
        inside = (times >= begin) & (times <= begin + stretch.duration * (1.0 + 1e-12))
        depth[inside], speed[inside], _heat = sample(stretch, times[inside] - begin)
        if stretch.kind == LOADED:
            elastic[inside], viscous[inside] = forces(stretch.law, depth[inside], speed[inside])
        begin += stretch.duration
    return times, depth, speed, elastic, viscous


def _flight_acceleration(flight: Flight, depth: Vector) -> Vector:
    machine = flight.machine
    arm = getattr(machine, "length", math.inf)
    return numpy.full(len(depth), machine.gravity) if math.isinf(arm) else -machine.gravity * numpy.sin(depth / arm)


def _energy(law: ContactLaw, depth: float, speed: float) -> float:
    return 0.5 * law.mass * speed**2 + stored(law, depth) - law.mass * law.gravity * depth


def _excess(stretch: ContactPhase) -> float:
    """Energy above that at rest, over the work of the weight on the static depth; infinite without
    weight.
    """
    law = stretch.law
    rest = static_depth(law)
    weight = law.mass * law.gravity * rest
    excess = _energy(law, stretch.last_depth, stretch.last_speed) - _energy(law, rest, 0.0)
    return abs(excess) / weight if weight > 0.0 else math.inf
