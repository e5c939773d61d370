"""Resolved scene -> parameters, grids and timing: the only place where an effect that is not called
for becomes ``None``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy
from scipy.optimize import brentq

from contact_sim_pkg.compiled.arrays import Vector
from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_force
from contact_sim_pkg.laws.parameters import Contact, ElasticLaw, Friction
from contact_sim_pkg.records.constants import GRAVITY
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.records.rig import load
from contact_sim_pkg.rigs.vehicle.acting import Acting, Chassis, refuse_brought, together
from contact_sim_pkg.rigs.vehicle.field.contact_field import FieldGrids, make_grids, tangent_law
from contact_sim_pkg.rigs.vehicle.field.coupling_rule import (
    CouplingRule,
    allowance_of,
    coupled_timing,
    first_ways,
    longest_travels,
    shortest_time,
)
from contact_sim_pkg.rigs.vehicle.field.settings import field_settings
from contact_sim_pkg.rigs.vehicle.motion.ends import Floor, Pan, base_of
from contact_sim_pkg.rigs.vehicle.motion.masses import Mass
from contact_sim_pkg.rigs.vehicle.motion.parameters import Leaning, MasslessNode, Seat, Seated, Softening, Vehicle
from contact_sim_pkg.rigs.vehicle.motion.scales import POSITION_SCALE, VELOCITY_SCALE, contact_scale
from contact_sim_pkg.rigs.vehicle.motion.spring import Spring
from contact_sim_pkg.rigs.vehicle.rest import settle
from contact_sim_pkg.rigs.vehicle.seat import schema as seat_schema
from contact_sim_pkg.rigs.vehicle.seat.cushion import SeatMap, build_pan_cushion, build_seat_map
from contact_sim_pkg.rigs.vehicle.seat.lean import Lean, build_back, interface_at_rest, pose_of, rest_of
from contact_sim_pkg.rigs.vehicle.seat.mass import occupant_mass
from contact_sim_pkg.rigs.vehicle.seat.occupants import OccupantModel
from contact_sim_pkg.rigs.vehicle.seat.shape import SeatShape, seat_gap_on, shape_of
from contact_sim_pkg.rigs.vehicle.tire import schema as tire_schema
from contact_sim_pkg.rigs.vehicle.tire.edges import SharpEdge, landing_of, refuse_high_walls, sharp_edge
from contact_sim_pkg.rigs.vehicle.tire.lattice import standing_load
from contact_sim_pkg.rigs.vehicle.tire.model import (
    Asperities,
    FormulaParts,
    RollingFriction,
    TireGeometry,
    TireParts,
    Tread,
    build_tire,
)
from contact_sim_pkg.rigs.vehicle.tire.mount import Mounted, mounted
from contact_sim_pkg.rigs.vehicle.tire.quarter_car import QuarterCar
from contact_sim_pkg.rigs.vehicle.tire.rolling_loss import RollingLoss
from contact_sim_pkg.rigs.vehicle.tire.standing import TireAtRest
from contact_sim_pkg.run.contact_laws import Cushion, elastic_law, friction, hysteresis, normal_loss
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.fields import given
from contact_sim_pkg.scene.timing import Timing

LINK = 10.0  # loads at rest that a spring or damper of the occupant carries at the size of a motion, at most


Fields = tuple[FieldGrids | None, FieldGrids | None]  # of tire and seat


class Coordinate(NamedTuple):
    """A coordinate that ``bench/motion`` carries."""

    name: str
    place: int  # of its position in the state
    speed: int  # of its velocity
    mass: float  # [kg]
    scale: tuple[float, float]  # [m], [m/s] size of its motion, to which the integrator's tolerance is relative
    is_vertical: bool = True


@dataclass(frozen=True)
class Model:
    """Everything that the simulation of one scene needs."""

    rig: Vehicle
    timing: Timing
    scale: Vector  # [states] error allowed per step
    coordinates: tuple[Coordinate, ...]
    quarter: QuarterCar | None  # None without a tire
    machine: Mounted | None  # that its axle is mounted on; None: a quarter car
    acting: Acting  # what effects bring beside quarter car and occupant
    occupant: OccupantModel | None
    lean: Lean | None  # None where the pan alone carries the occupant
    tire_geometry: TireGeometry | None
    tire_field: FieldGrids | None
    tread: Tread | None
    rolling_friction: RollingFriction | None
    magic_formula: FormulaParts | None
    rolling_loss: RollingLoss | None
    asperities: Asperities | None
    tire_standing: TireAtRest | None
    seat_field: FieldGrids | None
    seat_shape: SeatShape | None
    seat_map: SeatMap | None
    corrector_passes: int
    coupling: CouplingRule | None  # None without a pressure field
    shaken: bool  # whether the scene has a vibration
    edge: SharpEdge | None  # of the road, where no grid determines the peak pressure

    @property
    def states(self) -> int:
        """Number of state variables."""
        return int(self.scale.shape[0])

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the rows of ``bench/motion``: coordinates, and the floor and seat back that they move on."""
        names = [each.name for each in self.coordinates]
        floor = [] if self.quarter is not None else ["floor_z"]
        if self.rig.back is not None:
            names.insert(-1, "seat_back_x")
        return (*floor, *names)

    @property
    def tire_contact(self) -> Contact | None:
        """Laws between tire and road; None without a tire."""
        return None if self.quarter is None else self.quarter.contact.law

    @property
    def has_edge(self) -> bool:
        """Whether the road has an edge that the cells of the tire's field do not place."""
        return self.edge is not None and self.edge.is_short


def build(scene: ResolvedScene, lean: Lean | None = None, solver: type | None = None) -> Model:
    """Parameters of a resolved scene whose occupant leans on a seat back where there is one.

    solver: of a half-space, in place of `RollingField`. Raises FieldError where a pressure field
    cannot carry the standing load.
    """
    with_tire, with_seat = scene.rig in ("tire", "car"), scene.rig in ("seat", "car", "occupant")
    given_seat = scene.section(seat_schema.SeatSection) if with_seat else None
    occupant = None if given_seat is None else given_seat.occupant.model_of()
    # Contacts: each with its pressure field, where the scene calls for one.
    seat_field, shape = (None, None) if given_seat is None else _seat_field(scene, given_seat, solver)
    tire = build_tire(scene, None if given_seat is None else given_seat.occupant, solver) if with_tire else None
    tire_field = None if tire is None else tire.field
    quarter = None if tire is None else tire.quarter
    acting = _acting(scene, quarter, 0.0 if given_seat is None else occupant_mass(given_seat.occupant))
    if quarter is not None and acting.joined:
        quarter = quarter.lightened(acting.mass)
    seat = None if occupant is None else _seat(scene, occupant, lean, quarter, acting)
    cushion = None if occupant is None else build_pan_cushion(scene, rest_of(occupant, pose_of(lean), GRAVITY).pan)
    seat_contact = None if seat is None else _seat_contact(scene, seat, lean, cushion, seat_field, shape)
    masses, elements = ((), ()) if quarter is None else (quarter.masses, quarter.elements)
    masses, elements = (*masses, *(each.mass for each in acting.joined)), (*elements, *acting.elements)
    if occupant is not None and seat is not None and seat_contact is not None:
        elements = (*elements, _seated(scene, occupant, seat, seat_contact, lean))
    rig = Vehicle(GRAVITY, masses, elements)
    if tire is not None:
        load = standing_load(
            scene.section(tire_schema.TireSection), None if given_seat is None else given_seat.occupant
        )
        landing = landing_of(tire.quarter.contact.law.elastic, load, tire.quarter.wheel.mass, tire.footprint_length)
        refuse_high_walls(scene, tire.geometry.form, None if tire_field is None else tire_field.usual.settings, landing)
    # A footprint on a road bounds the length of the coupling steps, and so the segments.
    footprint = None if tire is None or tire_field is None else tire.footprint_length
    timing = coupled_timing(scene, tire_field is not None or seat_field is not None, footprint)
    machine = mounted(scene.section(tire_schema.TireSection)) if with_tire else None
    coordinates = _coordinates(rig, quarter, acting, machine)
    return Model(
        rig=rig,
        timing=timing,
        scale=_scale(rig, coordinates, quarter, acting, given(scene.integrator.relative_tolerance)),
        coordinates=coordinates,
        quarter=quarter,
        machine=machine,
        acting=acting,
        occupant=occupant,
        lean=lean,
        tire_geometry=None if tire is None else tire.geometry,
        tire_field=tire_field,
        tread=None if tire is None else tire.tread,
        rolling_friction=None if tire is None else tire.rolling_friction,
        magic_formula=None if tire is None else tire.magic_formula,
        rolling_loss=None if tire is None else tire.rolling_loss,
        asperities=None if tire is None else tire.asperities,
        tire_standing=None if tire is None else tire.standing,
        seat_field=seat_field,
        seat_shape=shape,
        seat_map=build_seat_map(scene, cushion),
        corrector_passes=max(
            (field.usual.settings.corrector_passes for field in (tire_field, seat_field) if field is not None),
            default=0,
        ),
        coupling=_coupling(scene, rig, footprint, timing, (tire_field, seat_field), tire),
        shaken=scene.vibration is not None,
        edge=sharp_edge(scene, None if tire_field is None else tire_field.usual.settings),
    )


def _seated(
    scene: ResolvedScene, occupant: OccupantModel, seat: Seat, contact: Contact, lean: Lean | None
) -> Seated | Leaning:
    """The occupant on the cushion, and against the seat back where there is one."""
    if lean is None:
        return Seated(seat, contact)
    last = _behind_foam(scene, seat, lean) + (0 if seat.softening is None else 1)
    return Leaning(seat, contact, build_back(lean, occupant, contact, GRAVITY, last))


def _coupling(
    scene: ResolvedScene, rig: Vehicle, footprint: float | None, timing: Timing, fields: Fields, tire: TireParts | None
) -> CouplingRule | None:
    """Rule for the coupling steps between two solutions of the fields.

    ``footprint`` [m] is None without a field on a road. The steps of a viscoelastic tread are its
    own.
    """
    if fields == (None, None):
        return None
    tolerance = given(scene.integrator.coupling_tolerance)
    occupant = None if rig.seat is None else scene.section(seat_schema.SeatSection).occupant
    tire_load = 0.0 if tire is None else standing_load(scene.section(tire_schema.TireSection), occupant)
    seat_load = 0.0 if occupant is None else occupant_mass(occupant) * GRAVITY
    # Allowed errors follow from the loads at rest.
    allowances = (
        allowance_of(None if tire is None else tire.quarter.contact.law, fields[0], tire_load, tolerance),
        allowance_of(rig.seat_contact, fields[1], seat_load, tolerance),
    )
    segments = None if tire is None or tire.tread is None else round(tire.tread.step / timing.segment_length)
    shortest = max(1, round(max(map(shortest_time, allowances)) / timing.segment_length))
    has_bristles = tire is not None and tire.rolling_friction is not None
    longest = longest_travels(footprint, has_bristles, scene.integrator.coupling_length)
    ways = (math.inf, 0.0) if footprint is None else first_ways(footprint, scene.integrator)
    return CouplingRule(tolerance, allowances, longest, shortest, segments, ways)


def _acting(scene: ResolvedScene, quarter: QuarterCar | None, seated: float) -> Acting:
    """What the effects of all contacts bring, contact by contact; ``seated`` [kg] of the occupant."""
    found: list[Acting] = []
    state, mode = 0 if quarter is None else quarter.states, 1  # behind that of the seat's friction
    for contact in rigs()[scene.rig].contacts:
        for effect, keys in scene.effects_at(contact.name):
            if not effect.elements:
                continue
            wheel, body, suspension = (None, None, 0.0)
            if quarter is not None and isinstance(quarter.suspension, Spring):
                wheel, body, suspension = quarter.wheel, quarter.body, quarter.suspension.stiffness
            chassis = Chassis(GRAVITY, wheel, body, seated, suspension, state, mode)
            brought = load(effect.elements)(keys, chassis)
            refuse_brought(f"effects.{contact.name}.{effect.name}", brought, chassis, found)
            found.append(brought)
            state += found[-1].width
            mode += found[-1].modes
    return together(found)


def _seat(
    scene: ResolvedScene, occupant: OccupantModel, lean: Lean | None, quarter: QuarterCar | None, acting: Acting
) -> Seat:
    ends = numpy.array([link[:2] for link in occupant.links], dtype=numpy.int64).reshape(-1, 2)
    springs = numpy.array([link[2:] for link in occupant.links], dtype=numpy.float64).reshape(-1, 2)
    node = None
    if occupant.masses[0] == 0.0:
        node = MasslessNode(sum(link.damping for link in occupant.links if 0 in link[:2]))
    # Its states follow those of the quarter car, whose body is the floor, and of what effects bring.
    floor: Floor
    offset, floor = 0, None
    if quarter is not None and quarter.body is not None:
        offset, floor = quarter.states, quarter.body.place
    if acting.pan is not None:
        floor = Pan(acting.pan) if quarter is None else acting.pan
    offset += acting.width
    masses = numpy.array(occupant.masses, dtype=numpy.float64)
    seat = Seat(offset, masses, ends, springs.T.copy(), node, floor=floor)
    effect = scene.effect("seat", seat_schema.SofteningSection)
    if effect is None:
        return seat
    behind = _behind_foam(scene, seat, lean)
    heights = rest_of(occupant, pose_of(lean), GRAVITY).heights
    softening = Softening(
        behind,
        effect.exponent,
        effect.time_constant,
        effect.least,
        effect.most,
        heights[ends[:, 1]] - heights[ends[:, 0]],
    )
    return seat._replace(softening=softening)


def _behind_occupant(scene: ResolvedScene, seat: Seat, lean: Lean | None) -> int:
    """Index of the first state behind those of the masses and of x."""
    slides = lean is not None or friction(scene, "seat") is not None
    return seat.offset + 2 * len(seat.masses) + (3 if slides else 0)


def _behind_foam(scene: ResolvedScene, seat: Seat, lean: Lean | None) -> int:
    """Index of the first state behind that of the cushion's foam."""
    return _behind_occupant(scene, seat, lean) + (0 if hysteresis(scene, "seat", 0) is None else 1)


def _seat_field(
    scene: ResolvedScene, seat: seat_schema.SeatSection, solver: type | None
) -> tuple[FieldGrids | None, SeatShape | None]:
    modulus = seat.cushion_modulus / (1.0 - seat.cushion_poisson**2)
    settings = field_settings(scene.effect("seat", seat_schema.HalfSpaceField), modulus)
    if settings is None:
        return None, None
    return make_grids(settings._replace(solver=solver), "seat"), shape_of(seat.body)


def _seat_contact(
    scene: ResolvedScene,
    seat: Seat,
    lean: Lean | None,
    cushion: Cushion | None,
    field: FieldGrids | None,
    shape: SeatShape | None,
) -> Contact:
    mass = occupant_mass(scene.section(seat_schema.SeatSection).occupant)
    law: ElasticLaw
    if cushion is not None:
        law = cushion.law
    elif field is not None and shape is not None:
        law, _length = tangent_law(field, lambda grid: seat_gap_on(shape, grid), mass * GRAVITY, "seat")
    else:
        law = elastic_law(scene, "seat")
    memory = hysteresis(scene, "seat", _behind_occupant(scene, seat, lean))
    return Contact(law, normal_loss(scene, "seat", law, mass), friction(scene, "seat"), memory)


def _link_scale(seat: Seat, load: float) -> Vector:
    """Sizes [2, masses] in [m] and [m/s] of the motion of each mass, by the springs and dampers that end
    there: those of `LINK` times the ``load`` [N] at rest. A stiff damper turns a small error of speed
    into a large one of force.
    """
    ending = numpy.zeros((2, len(seat.masses)))
    for values, (lower, upper) in zip(seat.springs.T, seat.ends, strict=True):
        ending[:, lower] += values
        ending[:, upper] += values
    return numpy.divide(LINK * load, ending, out=numpy.full_like(ending, numpy.inf), where=ending > 0.0)


def _coordinate(name: str, mass: Mass, scale: tuple[float, float]) -> Coordinate:
    return Coordinate(name, mass.place, mass.place + 1, mass.mass, scale)


def _least(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    return min(one[0], other[0]), min(one[1], other[1])


def _coordinates(
    rig: Vehicle, quarter: QuarterCar | None, acting: Acting, machine: Mounted | None
) -> tuple[Coordinate, ...]:
    """What moves, in the order of the state vector, with the size of its motion."""
    usual = on_seat = (POSITION_SCALE, VELOCITY_SCALE)
    occupant = 0.0 if rig.seat is None else float(rig.seat.masses.sum())
    if rig.seat is not None:
        touching = float(rig.seat.masses[0]) or occupant  # a massless interface moves with what hangs on it
        on_seat = contact_scale(rig.seat_contact, occupant * rig.gravity, touching)
    found: list[Coordinate] = []
    if quarter is not None:
        wheel, body, belt = quarter.wheel, quarter.body, quarter.belt
        mass = wheel.mass + (0.0 if body is None else body.mass) + occupant + (0.0 if belt is None else belt.mass)
        load = mass * rig.gravity if machine is None else machine.largest
        on_road = contact_scale(quarter.contact.law, load, quarter.tread.mass)
        found.append(_coordinate("wheel_z", wheel, on_road if belt is None else usual))
        if body is not None:
            found.append(_coordinate("body_z", body, on_seat))
        if belt is not None:
            found.append(_coordinate("belt_z", belt, on_road))
    for joined in acting.joined:
        usually = on_seat if joined.mass.place == acting.pan else usual
        found.append(_coordinate(joined.name, joined.mass, _least(usually, joined.scale)))
    for place, furthest, quickest in acting.scales:
        bound = furthest, quickest
        found = [each._replace(scale=_least(each.scale, bound)) if each.place == place else each for each in found]
    if rig.seat is None:
        return tuple(found)
    # Each mass by the links that end there, the first by its contact as well.
    first, count = rig.seat.offset, len(rig.seat.masses)
    heights, speeds = _link_scale(rig.seat, occupant * rig.gravity)
    for i, mass in enumerate(rig.seat.masses.tolist()):
        most, fastest = on_seat if i == 0 else usual
        size = min(float(heights[i]), most), min(float(speeds[i]), fastest)
        if i == 0 and rig.seat.node is not None:
            size = size[0], math.inf  # settled at every instant
        name = f"occupant{i}_z" if i else "seat_frame_z"
        found.append(Coordinate(name, first + i, first + count + i, mass, size))
    if rig.back is not None or (rig.seat_contact is not None and rig.seat_contact.friction is not None):
        x = first + 2 * count
        found.append(Coordinate("occupant_x", x, x + 1, occupant, usual, is_vertical=False))
    return tuple(found)


def _scale(
    rig: Vehicle, coordinates: tuple[Coordinate, ...], quarter: QuarterCar | None, acting: Acting, tolerance: float
) -> Vector:
    """Error allowed per step and state; the two works at the end are not controlled."""
    sizes = numpy.zeros(2 * len(coordinates) + len(acting.states))
    sizes[acting.own_states(0 if quarter is None else quarter.states)] = acting.states
    for each in coordinates:
        sizes[[each.place, each.speed]] = each.scale
    scale: list[float] = (tolerance * sizes).tolist()
    if rig.seat is not None:
        rubbing = None if rig.seat_contact is None else rig.seat_contact.friction
        if rubbing is not None or rig.back is not None:
            load = float(rig.seat.masses.sum()) * rig.gravity
            scale.append((POSITION_SCALE if rubbing is None else _spring_scale(rubbing, load)) * tolerance)
        # The variables of foam run from -1 to 1, the mean square of softening links by m^2/s^4.
        further = (
            rig.seat_contact is not None and rig.seat_contact.hysteresis is not None, rig.seat.softening is not None,
            rig.back is not None and rig.back.contact.hysteresis is not None,
        )  # fmt: skip
        scale += [tolerance] * sum(further)
    return numpy.array([*scale, numpy.inf, numpy.inf])


def _spring_scale(friction: Friction, load: float) -> float:
    """Deflection in [m] of the friction spring: what it reaches under the ``load`` [N] at rest, at
    most the usual size.
    """
    reached = friction.coefficient_static * load / friction.stiffness
    return min(POSITION_SCALE, reached) if reached > 0.0 else POSITION_SCALE


def _hang(quarter: QuarterCar, gravity: float, height: float, state: Vector) -> None:
    """Hold the wheel at the height 0 over a road of effective ``height`` [m]; a belt is in balance on its sidewalls."""
    state[quarter.wheel.place], belt, law = 0.0, quarter.belt, quarter.contact.law.elastic
    if belt is None or quarter.sidewalls is None:
        return
    stiffness, weight = quarter.sidewalls.stiffness, belt.mass * gravity

    def pulled(place: float) -> float:
        return stiffness * place + weight - float(elastic_force(law, max(height - place, 0.0)))

    low = -weight / stiffness  # where it hangs free
    state[belt.place] = low if pulled(low) >= 0.0 else brentq(pulled, low, max(height, low), xtol=1e-15, rtol=1e-14)


def standing_state(model: Model, height: float, rate: float = 0.0) -> Vector:
    """State [states] in equilibrium, in [m] and [m/s], under gravity on a road of effective ``height``
    [m] that rises at a ``rate`` [m/s] under the tire: every body rises with it (decision 0034).
    """
    rig = model.rig
    state = numpy.zeros(model.states)
    floor = 0.0
    occupant = 0.0 if rig.seat is None else float(rig.seat.masses.sum())
    # Wheel, belt and body from the road up: each spring carries what is above it.
    quarter = model.quarter
    if quarter is not None:
        (wheel, wheel_mass), body, belt, machine = quarter.wheel, quarter.body, quarter.belt, model.machine
        carried = 0.0 if body is None else (body.mass + occupant + model.acting.mass) * rig.gravity
        of_belt = 0.0 if belt is None else belt.mass * rig.gravity
        on_wheel = carried + wheel_mass * rig.gravity if machine is None else machine.start - of_belt
        on_road = on_wheel + of_belt
        state[wheel] = height - approach_of_force(quarter.contact.law.elastic, on_road)
        if belt is not None and quarter.sidewalls is not None:
            state[belt.place] = state[wheel]
            state[wheel] -= on_wheel / quarter.sidewalls.stiffness
        if machine is not None and machine.deflection is not None:
            _hang(quarter, rig.gravity, height, state)
        if body is not None and isinstance(quarter.suspension, Spring):
            floor = state[body.place] = state[wheel] - carried / quarter.suspension.stiffness
        for each in quarter.masses:
            state[each.place + 1] = rate
    # What effects bring stands where all forces balance.
    if model.acting.elements:
        for joined in model.acting.joined:
            state[joined.mass.place], state[joined.mass.place + 1] = floor, rate
        own = zip(model.acting.own_states(0 if quarter is None else quarter.states), model.acting.states, strict=True)
        settle(rig, model.acting.modes, occupant * rig.gravity, tuple(own), state, (height, rate))
        base = None if rig.seat is None else base_of(rig.seat.floor)
        floor = 0.0 if base is None else state[base]
    # The occupant on the cushion, its masses on their springs.
    if rig.seat is not None and rig.seat_contact is not None:
        first, count = rig.seat.offset, len(rig.seat.masses)
        assert model.occupant is not None
        pose = pose_of(model.lean)
        rest = rest_of(model.occupant, pose, rig.gravity)
        state[first : first + count] = floor + interface_at_rest(rest, pose, rig.seat_contact) + rest.heights
        state[first + count : first + 2 * count] = rate
    return state
