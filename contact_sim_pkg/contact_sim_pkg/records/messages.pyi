"""Written by `python -m tests.records.message_stub` from the `.msg` files; see `messages.py`."""

from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy
from numpy.typing import NDArray

from .definitions import Definition

def made(definition: Definition) -> Any: ...

class _Record:
    _fields: ClassVar[tuple[str, ...]]
    def _replace(self, **values: Any) -> Self: ...
    def _asdict(self) -> dict[str, Any]: ...

@dataclass(frozen=True, kw_only=True)
class Time(_Record):
    sec: int
    nanosec: int

@dataclass(frozen=True, kw_only=True)
class String(_Record):
    data: str

@dataclass(frozen=True, kw_only=True)
class Vector3(_Record):
    x: float
    y: float
    z: float

@dataclass(frozen=True, kw_only=True)
class Wrench(_Record):
    force: Vector3
    torque: Vector3

@dataclass(frozen=True, kw_only=True)
class WrenchStamped(_Record):
    wrench: Wrench

@dataclass(frozen=True, kw_only=True)
class Clock(_Record):
    clock: Time

@dataclass(frozen=True, kw_only=True)
class AxleForce(_Record):
    block: int
    sample_period: float
    longitudinal: NDArray[numpy.float64]
    vertical: NDArray[numpy.float64]
    lateral: NDArray[numpy.float64] = ...
    moment_y: NDArray[numpy.float64] = ...
    moment_z: NDArray[numpy.float64] = ...
    spin: NDArray[numpy.float64] = ...

@dataclass(frozen=True, kw_only=True)
class BenchProgress(_Record):
    IDLE: ClassVar[int]
    STARTING: ClassVar[int]
    READY: ClassVar[int]
    RUNNING: ClassVar[int]
    FINISHED: ClassVar[int]
    STOPPED: ClassVar[int]
    FAILED: ClassVar[int]
    PAUSED: ClassVar[int]
    RESET: ClassVar[int]
    state: int
    run: int
    block: int
    blocks: int
    messages_sent: int
    real_time_factor: float
    load: float
    peak_pressure: float
    scene: str
    message: str

@dataclass(frozen=True, kw_only=True)
class BenchRecorded(_Record):
    run: int
    block: int
    messages: int
    closed: bool
    bag: str
    message: str

@dataclass(frozen=True, kw_only=True)
class BodyMotion(_Record):
    block: int
    sample_period: float
    bodies: tuple[str, ...]
    position: NDArray[numpy.float64]
    velocity: NDArray[numpy.float64]
    acceleration: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ContactEpisodes(_Record):
    WHOLE_CONTACT: ClassVar[int]
    block: int
    point: NDArray[numpy.int32]
    touched: NDArray[numpy.uint8]
    start: NDArray[numpy.float64]
    end: NDArray[numpy.float64]
    compression_work: NDArray[numpy.float64]
    restitution_work: NDArray[numpy.float64]
    restitution: NDArray[numpy.float64]
    peak_force: NDArray[numpy.float64]
    largest_approach: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ContactForce(_Record):
    block: int
    sample_period: float
    normal: NDArray[numpy.float64]
    tangential: NDArray[numpy.float64]
    approach: NDArray[numpy.float64]
    effective_height: NDArray[numpy.float64]
    impulses: NDArray[numpy.float64] = ...

@dataclass(frozen=True, kw_only=True)
class ContactPatch(_Record):
    block: int
    cell_x: float
    cell_y: float
    origin_x: float
    origin_y: float
    load: float
    peak: float
    mean: float
    area: float
    centre_x: float
    centre_y: float
    approach: float
    lame_a: float
    lame_b: float
    lame_n: float
    pressure: NDArray[numpy.float32]

@dataclass(frozen=True, kw_only=True)
class ContactPoints(_Record):
    APART: ClassVar[int]
    TOUCHES: ClassVar[int]
    STICKS: ClassVar[int]
    SLIPS: ClassVar[int]
    block: int
    x: NDArray[numpy.float64]
    y: NDArray[numpy.float64]
    approach: NDArray[numpy.float64]
    normal: NDArray[numpy.float64]
    tangential: NDArray[numpy.float64]
    displacement: NDArray[numpy.float64]
    state: NDArray[numpy.uint8]

@dataclass(frozen=True, kw_only=True)
class ContactShear(_Record):
    APART: ClassVar[int]
    STICKS: ClassVar[int]
    SLIPS: ClassVar[int]
    block: int
    cell_x: float
    cell_y: float
    origin_x: float
    origin_y: float
    slip: float
    slip_angle: float
    force_x: float
    force_y: float
    moment_z: float
    sliding_share: float
    dissipated: float
    shear_x: NDArray[numpy.float32]
    shear_y: NDArray[numpy.float32]
    state: NDArray[numpy.uint8]

@dataclass(frozen=True, kw_only=True)
class EnergyLedger(_Record):
    block: int
    kinetic: float
    potential: float
    stored: float
    dissipated: float
    supplied: float
    residual: float

@dataclass(frozen=True, kw_only=True)
class ImpactCourse(_Record):
    block: int
    number: int
    start: float
    time: NDArray[numpy.float64]
    depth: NDArray[numpy.float64]
    speed: NDArray[numpy.float64]
    elastic_force: NDArray[numpy.float64]
    viscous_force: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ImpactEvents(_Record):
    block: int
    number: NDArray[numpy.int32]
    release: NDArray[numpy.int32]
    start: NDArray[numpy.float64]
    end: NDArray[numpy.float64]
    mass: NDArray[numpy.float64]
    radius: NDArray[numpy.float64]
    temperature: NDArray[numpy.float64]
    speed: NDArray[numpy.float64]
    duration: NDArray[numpy.float64]
    restitution: NDArray[numpy.float64]
    measured_speed: NDArray[numpy.float64]
    measured_duration: NDArray[numpy.float64]
    measured_restitution: NDArray[numpy.float64]
    depth: NDArray[numpy.float64]
    compression_time: NDArray[numpy.float64]
    peak_force: NDArray[numpy.float64]
    peak_time: NDArray[numpy.float64]
    compression_work: NDArray[numpy.float64]
    restitution_work: NDArray[numpy.float64]
    storage_modulus: NDArray[numpy.float64]
    loss_tangent: NDArray[numpy.float64]
    shape_factor: NDArray[numpy.float64]
    gravity: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ImpactFront(_Record):
    block: int
    number: int
    start: float
    shear_speed: float
    front_time: float
    front_depth: float
    front_heat: float
    time: NDArray[numpy.float64]
    border_speed: NDArray[numpy.float64]
    front_speed: NDArray[numpy.float64]
    supersonic: NDArray[numpy.uint8]

@dataclass(frozen=True, kw_only=True)
class ImpactHistory(_Record):
    block: int
    number: int
    start: float
    model: str
    time: NDArray[numpy.float64]
    depth: NDArray[numpy.float64]
    valid: NDArray[numpy.uint8]

@dataclass(frozen=True, kw_only=True)
class ImpactPosition(_Record):
    block: int
    number: int
    start: float
    variant: int
    time: NDArray[numpy.float64]
    surface_depth: NDArray[numpy.float64]
    compression: NDArray[numpy.float64]
    volume: NDArray[numpy.float64]
    compression_volume: NDArray[numpy.float64]
    heating_volume: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ImpactStress(_Record):
    block: int
    number: int
    start: float
    shape: str
    time: NDArray[numpy.float64]
    radius: NDArray[numpy.float64]
    place: NDArray[numpy.float64]
    elastic: NDArray[numpy.float64]
    viscous: NDArray[numpy.float64]
    limited: NDArray[numpy.uint8]

@dataclass(frozen=True, kw_only=True)
class ImpactWave(_Record):
    block: int
    number: int
    start: float
    amplitude: float
    length: float
    frequency: float
    damping: float
    speed: float
    relative_speed: float
    start_time: float
    start_radius: float
    ring_ratio: float
    time: NDArray[numpy.float64]
    radius: NDArray[numpy.float64]
    height: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class ParameterChange(_Record):
    block: int
    key: str
    value: float

@dataclass(frozen=True, kw_only=True)
class RoadPatch(_Record):
    block: int
    travel_start: float
    travel_end: float
    first_row: int
    cell_x: float
    cell_y: float
    height: NDArray[numpy.float32]

@dataclass(frozen=True, kw_only=True)
class RollerContact(_Record):
    block: int
    period: float
    load: NDArray[numpy.float64]
    along_x: NDArray[numpy.float64]
    along_y: NDArray[numpy.float64]
    angle: NDArray[numpy.float64]
    peak_pressure: NDArray[numpy.float64]
    approach: NDArray[numpy.float64]
    tilt: NDArray[numpy.float64]
    yaw: NDArray[numpy.float64]
    heave: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class RollerStability(_Record):
    block: int
    load: float
    growth_rate: float
    frequency: float
    tilt: float
    yaw: float
    critical_load: float
    critical_damping: float
    root_real: NDArray[numpy.float64]
    root_imaginary: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class RollerTrack(_Record):
    block: int
    body: str
    turns: float
    cycles: float
    turn_time: float
    radius: float
    height: NDArray[numpy.float64]
    load: NDArray[numpy.float64]
    axial: NDArray[numpy.float64] = ...
    lowered: float
    range: float
    free: float
    checked: float
    check_error: float

@dataclass(frozen=True, kw_only=True)
class RollerVolumes(_Record):
    block: int
    time: float
    load: float
    along_x: float
    along_y: float
    angle: float
    peak_pressure: float
    approach: float
    normal_limit: float
    shear_limit: float
    working_volume: float
    volume: NDArray[numpy.float64]
    with_bending: NDArray[numpy.float64] = ...

@dataclass(frozen=True, kw_only=True)
class SeatResponse(_Record):
    block: int
    segments: int
    segment_length: float
    floor_weighted_rms: float
    seat_weighted_rms: float
    seat_factor: float
    frequency: NDArray[numpy.float64]
    floor_density: NDArray[numpy.float64]
    seat_density: NDArray[numpy.float64]
    transmissibility: NDArray[numpy.float64]
    transmissibility_phase: NDArray[numpy.float64]
    transmissibility_coherence: NDArray[numpy.float64]
    apparent_mass: NDArray[numpy.float64]
    apparent_mass_phase: NDArray[numpy.float64]
    apparent_mass_coherence: NDArray[numpy.float64]
    seat_to_head: NDArray[numpy.float64] = ...
    seat_to_head_phase: NDArray[numpy.float64] = ...
    seat_to_head_coherence: NDArray[numpy.float64] = ...

@dataclass(frozen=True, kw_only=True)
class Series(_Record):
    block: int
    sample_period: float
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: NDArray[numpy.float64]

@dataclass(frozen=True, kw_only=True)
class SolverCost(_Record):
    block: int
    wall_time: float
    real_time_factor: float
    steps: int = ...
    rejected_steps: int = ...
    events: int = ...
    field_iterations: int = ...
    field_residual: float = ...
    field_jump: float = ...
    coupling_steps: int = ...
    coupling_steps_repeated: int = ...
    coupling_error: float = ...
    estimated: tuple[str, ...] = ...
    estimated_error: NDArray[numpy.float64] = ...
    estimated_of: NDArray[numpy.float64] = ...

@dataclass(frozen=True, kw_only=True)
class TireStanding(_Record):
    block: int
    load: float
    deflection: float
    stiffness: float
    length: float
    width: float
    area: float
    mean_pressure: float

@dataclass(frozen=True, kw_only=True)
class TireWork(_Record):
    block: int
    axle: float
    drift: float
    rim: float
    slopes: float
    moving: float
    springs: float
    strained: float
    brake: float
    dampers: float
    rolling: float
    bristles: float
    sampling: float

@dataclass(frozen=True, kw_only=True)
class VibrationBlock(_Record):
    block: int
    sample_period: float
    acceleration_x: NDArray[numpy.float64]
    acceleration_z: NDArray[numpy.float64]
