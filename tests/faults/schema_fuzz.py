"""Every number of the schema at its bounds, beside them, at zero and at the smallest positive number: what a run makes of it.

A case is one value of one number in one base scene. It ends *right* (finite, energy adds up), *refused* or *failed* (a sentence
that names what is wrong), or *long*: the estimate of its work says so, and it is not run. Or it breaks a rule: a traceback, noise
of numpy, a value that is not finite, energy from nowhere, no end within the bounds of processor time and memory. Cases run in a
forked process, which has the compiled kernels of its base and is ended where a case goes beyond its time.
"""

from __future__ import annotations

import math
import multiprocessing
import os
import resource
import time
import warnings
from collections.abc import Iterator
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

import numpy

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.cli.main import refusal
from contact_sim_pkg.compiled.jit import closed
from contact_sim_pkg.records.messages import BodyMotion, ContactForce, EnergyLedger
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.run.rigs import forecast_of, make_simulation
from contact_sim_pkg.run.sources import make_sources
from contact_sim_pkg.run.work import estimated_work, refuse_long
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import resolve
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.scene.schema.catalog import Entry, catalog, without_kinds

BLOCKS = 2  # the second begins with the energies after the first
SECONDS = 10.0  # most time of a case, by the estimate of its work
ENDLESS = 60.0  # most time of a case that computes force tables of cushions first
MEMORY = 2 << 30  # most memory of a case beyond that of its base
RESIDUAL = 0.05  # of the energy that went through
SMALLEST = 5e-324
LEAST = 1e-30  # in size, of a number that is not 0
DENSE = (0.0, SMALLEST, LEAST, -1.0, 1e12, 1e300)  # for an item of a list, whose bounds only the rules know

SLOW_IMPACT = ("impact.speeds=[0.05]",)  # falls 5 ms
COARSE_ROLLER = (
    "effects.roller.subsurface={instants: [0.0], cells_x: 4, cells_y: 4, cells_z: 4}",
    "effects.roller.damage.table_rows=2",
    "effects.roller.track_waves.cells=32",
)
PROFILE = Path(__file__).with_name("profile.csv")
PROGRAMME = Path(__file__).with_name("programme.csv")
FOAM = Path(__file__).parents[2] / "examples" / "inputs" / "foam.csv"
CURVE = f"{{file: {FOAM}, header_line: 1, area: 0.01, thickness: 0.05}}"
BASES: dict[str, tuple[tuple[str, ...], ...]] = {  # rig -> shipped scenes with changes; together they hold every number
    "tire": (
        ("tire_braking",),
        ("tire_cleat",),
        ("tire_bump",),
        ("tire_belgian_block",),
        ("tire_half_space", "effects.tire.envelopment={}"),
        ("tire_bump", "road={kind: step, position: 0.05, height: 0.01}"),
        ("tire_bump", "road={kind: pothole, position: 0.05, depth: 0.01, length: 0.2}"),
        ("tire_irregular_road",),
        ("tire_bump", "effects.tire.bump_stop={}"),
        ("tire_bump", f"road={{kind: profile, file: {PROFILE}, header_line: 1}}"),
        ("tire_drum",),
        ("tire_drum", "tire.mount={kind: held, deflection: 0.02}", "tire.programme=null", "travel={speed: 10}"),
        ("tire_drum", f"tire.programme={{file: {PROGRAMME}, header_line: 1}}"),
    ),
    "seat": (
        ("seat_ride",),
        ("seat_drop", "vibration.start=0"),
        ("seat_ride", "vibration={kind: sweep, start_frequency: 1, end_frequency: 9, amplitude: 1, duration: 9}"),
        ("seat_ride", "vibration={kind: noise, low: 1, high: 9, rms: 1}"),
        ("suspension_seat",),
        ("seat_ride", f"effects.seat.cushion.curve={CURVE}"),
    ),
    "car": (("car_full_bench",),),
    "occupant": (("seat_ride_full",),),
    "backrest": (
        ("seat_slap",),
        ("seat_general",),
        ("seat_shock", "vibration.start=0"),
        ("seat_slip",),
        (
            "seat_shock",
            "vibration.start=0",
            f"effects.backrest={{cushion: {{curve: {CURVE}}}, normal_dissipative: {{}}}}",
        ),
    ),
    "impact": (("impact_rubber_drop", *SLOW_IMPACT), ("impact_temperature_sweep", *SLOW_IMPACT)),
    "block": (("block_fall", "block.position=[0, 0, 0.0693]"),),
    "roller": (("roller_programme", *COARSE_ROLLER),),
}
RARE_BASES: dict[str, tuple[tuple[str, ...], ...]] = {  # what no shipped scene names: compiled for the long form alone
    "tire": (
        ("tire_bump", "effects.tire.tread_viscoelasticity={retardation_time: 0.01, branches: []}"),
        ("tire_bump", "effects.tire.rigid_ring={}", "effects.tire.asperity_impulses={}"),
        ("tire_bump", "effects.tire.rolling_loss={retardation_time: 1e-5}"),
    ),
    "seat": (
        ("seat_ride", "effects.seat.friction={}"),
        ("seat_ride", "effects.seat.softening={}"),
        (
            "seat_ride",
            "effects.seat={normal_elastic: {}, foam: {}, foam_hysteresis: {}, general_dissipative: {}}",
        ),
        ("seat_ride", "effects.seat={normal_elastic: {}, normal_dissipative: {}, half_space_field: {}}"),
    ),
    "backrest": (
        ("seat_slap", "effects.backrest.shell_modes={}"),
        ("seat_shock", "vibration.start=0", "effects.backrest={normal_elastic: {}, foam: {}, normal_dissipative: {}}"),
    ),
    "block": (
        (
            "block_fall",
            "block.position=[0, 0, 0.0693]",
            "effects.block={rigid_contact: {friction: 0.3}, compliant_contact: {}}",
        ),
    ),
}


class Case(NamedTuple):
    """One value of one number."""

    base: tuple[str, ...]
    where: str
    value: Any
    inside: bool = True  # its own bounds, as far as the schema states them

    @property
    def assignment(self) -> str:
        return f"{self.where}={self.value!r}"


class End(NamedTuple):
    """How a case ended."""

    kind: str  # right, refused, failed, long, or the rule that it broke
    sentence: str
    seconds: float


def cases(rig: str) -> list[Case]:
    """All cases of a rig: each number, and the first item of each list, in the first base that holds it."""
    found, taken = [], set()
    for base in (*BASES[rig], *RARE_BASES.get(rig, ())):
        data = scene_of(base).data
        for entry in catalog().values():
            path = _path_in(entry, data, rig)
            if path is not None and entry.location not in taken:
                taken.add(entry.location)
                found += [
                    Case(base, where, value, _inside(entry, value)) for where, value in _values(entry, path, data)
                ]
    return found


def missing_numbers() -> set[str]:
    """Numbers of the schema that no base holds."""
    held = {case.where for rig in BASES for case in cases(rig)}
    numbers = [entry for entry in catalog().values() if entry.kind in ("number", "integer")]
    return {".".join(without_kinds(entry.location)) for entry in numbers} - held


def scene_of(base: tuple[str, ...], *values: str) -> ResolvedScene:
    """A base scene, two blocks long where ``values`` do not say otherwise."""
    name, *changes = base
    scene = load_scene(name, [set_value(text) for text in (*changes, *values)])
    if not any(text.startswith("duration=") for text in values):
        duration = f"duration={BLOCKS * scene.block_length!r}"
        scene = load_scene(name, [set_value(text) for text in (*changes, duration, *values)])
    return resolve(scene)


def _path_in(entry: Entry, data: dict[str, Any], rig: str) -> tuple[str, ...] | None:
    """Path of a number whose section the scene has; None of any other key."""
    path = tuple(str(part) for part in without_kinds(entry.location))
    if entry.kind not in ("number", "integer", "list"):
        return None
    if path[0] == "effects" and path[1] not in [contact.name for contact in rigs()[rig].contacts]:  # type: ignore[index]
        return None
    section: Any = data
    for part in path[:-1]:
        section = section.get(part) if isinstance(section, dict) else None
    if not isinstance(section, dict):
        return None
    if len(path) < len(entry.location) and data[path[0]].get("kind") != entry.location[1]:
        return None
    return path if entry.kind != "list" or section.get(path[-1]) else None


def _values(entry: Entry, path: tuple[str, ...], data: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    where = ".".join(path)
    if entry.kind == "list":
        given: Any = data
        for part in path:
            given = given[part]
        where += ".0"
        if isinstance(given[0], list):
            where += ".0"
        yield from ((where, value) for value in DENSE)
        return
    assert entry.low is not None
    assert entry.high is not None
    if entry.kind == "integer":
        low, high = int(entry.low), int(entry.high)
        yield from ((where, value) for value in dict.fromkeys((low - 1, low, low + 1, high - 1, high, high + 1, 0)))
        return
    low, high = float(entry.low), float(entry.high)
    beside = [math.nextafter(bound, way) for bound in (low, high) for way in (-math.inf, math.inf)]
    yield from ((where, value) for value in dict.fromkeys((low, high, *beside, 0.0, SMALLEST, LEAST)))


def _inside(entry: Entry, value: float) -> bool:
    """Whether a value lies within the bounds of its number; those of a list are known to the rules alone."""
    if 0.0 < abs(value) < LEAST:
        return False
    if entry.low is None or entry.high is None:
        return True
    return entry.low <= value <= entry.high and not (entry.above and value == entry.low)


def end_of(case: Case) -> End:
    """Run a case in this process."""
    began = time.process_time()
    try:
        kind, sentence = _run(case)
    except Exception as error:  # noqa: BLE001  # that is what is looked for
        known = refusal(error)
        kind, sentence = (
            ("traceback", repr(error)) if known is None else (("", "failed", "refused")[known[1]], known[0])
        )
    return End(kind, sentence, time.process_time() - began)


def _run(case: Case) -> tuple[str, str]:
    scene = scene_of(case.base, case.assignment)
    if case.where != "duration":  # of which two blocks are run
        told = refuse_long(scene, allowed=False)
        if sum(part.seconds for part in estimated_work(scene)) > SECONDS:
            return "long", told
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RuntimeWarning)
        messages = _messages(scene)
    noise = [str(each.message) for each in caught if issubclass(each.category, RuntimeWarning)]
    return ("noise", noise[0]) if noise else _judged(messages)


def _messages(scene: ResolvedScene) -> list[tuple[str, int, bytes]]:
    forecast_of(scene)
    simulation, sources = make_simulation(scene), make_sources(scene)
    simulation.prepare()
    messages = []
    with closed():
        for block in range(min(BLOCKS, simulation.blocks)):
            inputs = {topic: source.block(block) for topic, source in sources.items()}
            messages += simulation.advance(block, inputs).messages
    return messages


def _judged(messages: list[tuple[str, int, bytes]]) -> tuple[str, str]:
    """`right`, or the rule that the messages break."""
    worst = 0.0
    for topic, _stamp, data in messages:
        kind: Any = {"bench/energy": EnergyLedger, "bench/motion": BodyMotion}.get(topic)
        kind = ContactForce if topic.endswith("/force") else kind
        if kind is None:
            continue
        value = decode(kind, data)
        for name, part in value._asdict().items():
            if not isinstance(part, (str, tuple)) and not _finite(part):
                return "not finite", f"{topic}: {name}"
        if topic == "bench/energy":
            works = (value.supplied, value.kinetic, value.potential, value.stored, value.dissipated)
            through = max(1e-6, *(abs(float(part)) for part in works))
            worst = max(worst, abs(value.residual) / through)
    return ("right", "") if worst <= RESIDUAL else ("energy", f"residual {worst:.3g} of what went through")


def _finite(part: Any) -> bool:
    return bool(numpy.isfinite(part).all())


def run_all(chosen: list[Case], seconds: float = ENDLESS) -> Iterator[tuple[Case, End]]:
    """The end of each case, those of a base one after another in a process that has its kernels."""
    for base in dict.fromkeys(case.base for case in chosen):
        left = [case for case in chosen if case.base == base]
        end_of(Case(base, "seed", 1))
        while left:
            for case, end in _in_a_process(tuple(left), seconds):
                left.remove(case)
                yield case, end


def _in_a_process(left: tuple[Case, ...], seconds: float) -> Iterator[tuple[Case, End]]:
    """Cases in order, up to the first that does not end in time or ends the process."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe()
    process = context.Process(target=_work, args=(left, theirs), daemon=True)
    process.start()
    theirs.close()
    try:
        for case in left:
            until = _processor_time(process.pid) + seconds
            while not ours.poll(0.1) and process.is_alive():
                if _processor_time(process.pid) > until:
                    yield case, End("no end", f"within {seconds:g} s", seconds)
                    return
            try:
                yield case, ours.recv()
            except EOFError:
                yield case, End("killed", f"exit code {process.exitcode}", seconds)
                return
    finally:
        process.kill()
        process.join()


def _processor_time(process: int | None) -> float:
    """Of a process in [s]: beside others on a busy machine a case is not taken for an endless one."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _work(left: tuple[Case, ...], answer: Connection) -> None:
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
    for case in left:
        answer.send(end_of(case))
