"""Motion of the sphere from release to release: segments of flight, contact and rest, each known in
closed form or by its own series.

Segments are made on request, so a run is as long as its blocks. What is recorded has no
part in it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigs.impact.model import FirstContact, ImpactModel, Release
from contact_sim_pkg.rigs.impact.theory.closed_form.flight import Flight, fall, rebound
from contact_sim_pkg.rigs.impact.theory.contact import (
    LOADED,
    PARTED,
    ContactLaw,
    ContactPhase,
    next_phase,
    sample,
    static_depth,
    stored,
    touch,
)
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.run.errors import RunError

# Energy of a motion in contact, over that of the weight on the static depth, below which the
# sphere rests
RESTING_ENERGY = 1.0e-12
RESTING_SPEED = 1.0e-9  # [m/s]: a pendulum that leaves the sample more slowly hangs at rest on it
MOST_SEGMENTS = 10_000  # a block


class Caught(NamedTuple):
    """The sphere in the machine's catch, at the height of its release."""

    approach: float  # [m], negative
    potential: float  # [J]


class Rest(NamedTuple):
    """The sphere at rest on the sample."""

    law: ContactLaw


class MotionSegment(NamedTuple):
    """A phase of time with one kind of motion."""

    begin: float  # [s]
    end: float  # [s], infinite where nothing ends it
    motion: Caught | Flight | ContactPhase | Rest
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
    phases: tuple[ContactPhase, ...]
    duration: float  # [s] to the last loss of force
    parted: float  # [s] simulated time of the end of the overlap
    loss_depth: float  # [m]
    loss_speed: float  # [m/s], opening negative
    speed: float  # [m/s] V0


class ImpactMotion:
    """The sphere's motion. ``state(times)`` gives it, ``pop_ended`` the impacts that ended."""

    STATE = State(("_release", "_bounces", "_impacts", "_ended", "_contact", "_touch", "segments", "made"))

    def __init__(self, model: ImpactModel) -> None:
        """The first release, at time 0."""
        self.model = model
        self._release = 0
        self._bounces = self._impacts = 0
        self._ended: list[FinishedImpact] = []
        self._contact: list[ContactPhase] = []
        self._touch: tuple[float, float, FirstContact] | None = None
        self.segments: list[MotionSegment] = []
        self.made = 0
        self._append(fall(model.machine, model.releases[0].speed), 0.0, 0.0, 0.0)

    @property
    def release(self) -> Release:
        """The release that the sphere moves by."""
        return self.model.releases[self._release]

    def drop_before(self, time: float) -> None:
        """Drop segments that ended before ``time`` [s]."""
        self.segments = [segment for segment in self.segments if segment.end > time]

    def pop_ended(self, time: float) -> list[FinishedImpact]:
        """The impacts whose overlap ended up to ``time`` [s], each once."""
        self._reach(time)
        ended = [impact for impact in self._ended if impact.parted <= time]
        self._ended = [impact for impact in self._ended if impact.parted > time]
        return ended

    def time_of(self, count: int) -> float:
        """When impact number ``count`` (from 1) of the first release has parted, [s]; 0 where the
        sphere comes to rest before.

        Also 0 where more than `MOST_SEGMENTS` segments do not decide. Raises RunError where a touch
        is outside the model.
        """
        while self._impacts < count and math.isfinite(self.segments[-1].end) and self.made < MOST_SEGMENTS:
            self._extend()
        return self._ended[count - 1].parted if self._impacts >= count else 0.0

    def state(self, times: Vector) -> SphereState:
        """The state at rising ``times`` [s]. Raises RunError where a touch is outside the model."""
        self._reach(float(times[-1]))
        columns = numpy.zeros((len(SphereState._fields), len(times)))
        for segment in self.segments:
            inside = (times >= segment.begin) & (times < segment.end)
            if inside.any():
                columns[:, inside] = self._states_of(segment, times[inside])
        return SphereState(*columns)

    def _reach(self, time: float) -> None:
        """Make segments until one covers ``time``."""
        made = 0
        while self.segments[-1].end <= time:
            self._extend()
            made += 1
            if made > MOST_SEGMENTS:
                raise RunError(
                    f"{self.segments[-1].begin:.6g} s: more than {MOST_SEGMENTS} impacts and flights in one "
                    "block; the sphere hardly "
                    "bounces any more; end the run earlier, or let it be caught after some bounces"
                )

    def _append(
        self, motion: Caught | Flight | ContactPhase | Rest, begin: float, heat: float, supplied: float
    ) -> None:
        duration = motion.duration if isinstance(motion, (Flight, ContactPhase)) else math.inf
        self.segments.append(MotionSegment(begin, min(begin + duration, self._next_release()), motion, heat, supplied))
        self.made += 1

    def _next_release(self) -> float:
        following = self._release + 1
        return self.model.releases[following].time if following < len(self.model.releases) else math.inf

    def _extend(self) -> None:
        last = self.segments[-1]
        if last.end == self._next_release():
            self._lift(last)
        elif isinstance(last.motion, Flight):
            self._begin_contact(last, last.motion)
        elif isinstance(last.motion, ContactPhase):
            self._contact.append(last.motion)
            heat = last.heat + last.motion.heat
            if last.motion.next_kind == PARTED:
                self._part(last, last.motion, heat)
            elif last.motion.next_kind == LOADED and _excess(last.motion) <= RESTING_ENERGY:
                rest = Rest(last.motion.law)
                lost = _energy(last.motion.law, last.motion.last_depth, last.motion.last_speed)
                self._append(
                    rest, last.end, heat + lost - _energy(rest.law, static_depth(rest.law), 0.0), last.supplied
                )
            else:
                self._append(next_phase(last.motion), last.end, heat, last.supplied)

    def _lift(self, last: MotionSegment) -> None:
        """Start the next release, wherever the sphere is."""
        now = self._states_of(last, numpy.array([last.end]))
        names = SphereState._fields
        kinetic, potential, in_sample, heat, supplied = (
            float(now[names.index(name), 0]) for name in ("kinetic", "potential", "stored", "heat", "supplied")
        )
        self._release += 1
        self._bounces, self._contact, self._touch = 0, [], None
        flight = fall(self.model.machine, self.release.speed)
        energy = 0.5 * self.model.sphere.mass * flight.speed**2
        # What the sample still stores under the lifted sphere becomes heat.
        self._append(flight, last.end, heat + in_sample, supplied + energy - kinetic - potential)

    def _begin_contact(self, last: MotionSegment, flight: Flight) -> None:
        try:
            found = self.model.touch(flight.speed, self.release.temperature)
        except ImpactError as error:
            raise RunError(f"{last.end:.6g} s, impact {self._impacts} at {flight.speed:.4g} m/s: {error}") from None
        self._touch, self._contact = (last.end, flight.speed, found), []
        self._append(touch(found.law, flight.speed), last.end, last.heat, last.supplied)

    def _part(self, last: MotionSegment, phase: ContactPhase, heat: float) -> None:
        assert self._touch is not None
        self._close(last.end)
        self._bounces += 1
        mass, speed = self.model.sphere.mass, -phase.last_speed
        if self.model.bounces and self._bounces >= self.model.bounces:
            caught = self._catch()
            self._append(caught, last.end, heat, last.supplied + caught.potential - 0.5 * mass * speed**2)
            return
        if phase.law.gravity == 0.0 and speed < RESTING_SPEED:
            self._append(Rest(phase.law), last.end, heat + 0.5 * mass * speed**2, last.supplied)
            return
        self._append(rebound(self.model.machine, speed), last.end, heat, last.supplied)

    def _catch(self) -> Caught:
        flight = fall(self.model.machine, self.release.speed)
        approach = flight.at(numpy.zeros(1))[0]
        return Caught(float(approach[0]), self.model.sphere.mass * float(flight.potential(approach)[0]))

    def _close(self, parted: float) -> None:
        """Write down the impact; its force was lost at the end of its last loaded phase."""
        assert self._touch is not None
        start, speed, found = self._touch
        # The contact lasts to the end of its last loaded phase.
        loaded = max(i for i, phase in enumerate(self._contact) if phase.kind == LOADED)
        last = self._contact[loaded]
        duration = math.fsum(phase.duration for phase in self._contact[: loaded + 1])
        self._ended.append(
            FinishedImpact(
                number=self._impacts,
                release=self._release,
                start=start,
                temperature=self.release.temperature,
                touch=found,
                phases=tuple(self._contact),
                duration=duration,
                parted=parted,
                loss_depth=last.last_depth,
                loss_speed=last.last_speed,
                speed=speed,
            )
        )
        self._impacts += 1

    def _states_of(self, segment: MotionSegment, times: Vector) -> NDArray[numpy.float64]:
        """Rows as the fields of `SphereState`."""
        since, mass = times - segment.begin, self.model.sphere.mass
        out = numpy.zeros((len(SphereState._fields), len(times)))
        depth, speed, acceleration, elastic, viscous, kinetic, potential, stored_energy, heat, supplied = out
        heat[:], supplied[:] = segment.heat, segment.supplied
        motion = segment.motion
        # Depth, speed and forces by the kind of motion.
        if isinstance(motion, Caught):
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
        # Energies.
        kinetic[:] = 0.5 * mass * speed**2
        if isinstance(motion, (ContactPhase, Rest)):
            stored_energy[:] = [stored(motion.law, float(x)) for x in depth]
            potential[:] = -mass * motion.law.gravity * depth
        return out


def forces(law: ContactLaw, depth: Vector, speed: Vector) -> tuple[Vector, Vector]:
    """Elastic and viscous force [N] of a loaded contact at depth [m] and speed [m/s], each
    [samples].
    """
    root = numpy.sqrt(depth)
    return law.elastic * depth * root, law.viscous * root * speed


def course_of(impact: FinishedImpact, count: int) -> tuple[Vector, ...]:
    """Times from the touch, depth, speed, elastic and viscous force at ``count`` even instants up
    to the last loss of force.

    Times: [count] [s]; depth [m], speed [m/s] and forces [N] alike.
    """
    times: Vector = numpy.linspace(0.0, impact.duration, count, dtype=numpy.float64)
    depth, speed, elastic, viscous = (numpy.zeros(count) for _ in range(4))
    begin = 0.0
    for phase in impact.phases:
        inside = (times >= begin) & (times <= begin + phase.duration * (1.0 + 1e-12))
        depth[inside], speed[inside], _heat = sample(phase, times[inside] - begin)
        if phase.kind == LOADED:
            elastic[inside], viscous[inside] = forces(phase.law, depth[inside], speed[inside])
        begin += phase.duration
    return times, depth, speed, elastic, viscous


def _flight_acceleration(flight: Flight, depth: Vector) -> Vector:
    machine = flight.machine
    arm = getattr(machine, "length", math.inf)
    return numpy.full(len(depth), machine.gravity) if math.isinf(arm) else -machine.gravity * numpy.sin(depth / arm)


def _energy(law: ContactLaw, depth: float, speed: float) -> float:
    return 0.5 * law.mass * speed**2 + stored(law, depth) - law.mass * law.gravity * depth


def _excess(phase: ContactPhase) -> float:
    """Energy above that at rest, over the work of the weight on the static depth; infinite without
    weight.
    """
    law = phase.law
    rest = static_depth(law)
    weight = law.mass * law.gravity * rest
    excess = _energy(law, phase.last_depth, phase.last_speed) - _energy(law, rest, 0.0)
    return abs(excess) / weight if weight > 0.0 else math.inf
