"""A run that is saved and gone on with: the bits of one run, in any bench or process, or a sentence and no change."""

import hashlib
import json
import pickle
import subprocess
import sys
from pathlib import Path

import numpy
import pytest

from contact_sim_lab.pages.state_reference import with_list
from contact_sim_pkg import ContactBench
from contact_sim_pkg.bag.block_encoder import encode_block
from contact_sim_pkg.records.state import State
from contact_sim_pkg.rigid.motion.located import LocatedBody
from contact_sim_pkg.rigs.backrest.simulation import BackrestSimulation
from contact_sim_pkg.rigs.impact.motion import ImpactMotion
from contact_sim_pkg.rigs.roller.ride import TrackRide
from contact_sim_pkg.rigs.vehicle.run.bodies import Bodies
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_shear import RollingShear
from contact_sim_pkg.rigs.vehicle.tire.road_field import RoadField
from contact_sim_pkg.rigs.vehicle.tire.rolling_formula import RollingFormula
from contact_sim_pkg.run.observers import _Observed
from contact_sim_pkg.run.saved_state import MAGIC, StateError

ROOT = Path(__file__).parents[2]
SCENES = [
    ("tire_bump", 8), ("tire_braking", 6), ("tire_magic_formula", 20),
    ("tire_texture", 4), ("seat_ride", 30), ("seat_drop", 12), ("seat_ride_full", 10),
    ("seat_slap", 30), ("block_fall", 25), ("block_zeno", 20), ("box_3d_tumble", 20), ("impact_rubber_drop", 12),
    ("roller_flutter", 12), ("roller_corrugation", 8),
]  # fmt: skip
"""With the number of blocks."""


def bits(step):
    return encode_block([each for each in step.outputs if each.topic != "bench/cost"])


@pytest.mark.parametrize(("scene", "blocks"), SCENES)
def test_a_state_goes_on_with_the_bits_of_one_run(scene, blocks):
    """In a bench that has gone on to elsewhere, and again in that which was saved; what was handed out stays."""
    bench, other = ContactBench(scene), ContactBench(scene)
    for _ in range(blocks // 2):
        bench.step()
    saved = bench.save()
    rest = [bits(bench.step()) for _ in range(blocks - blocks // 2)]
    handed = other.step()
    before = bits(handed)
    while other.time < bench.time + 2.5 * bench.block_length and not other.is_over:
        other.step()
    for each in (other, bench):
        each.load(saved)
        assert each.time == pytest.approx(blocks // 2 * bench.block_length)
        assert [bits(each.step()) for _ in rest] == rest
    assert bits(handed) == before


@pytest.mark.parametrize(
    "scene", ["tire_braking", "seat_ride", "block_fall", "seat_slap", "impact_rubber_drop", "roller_flutter"]
)
def test_a_bench_that_has_made_no_step_saves_and_loads(scene):
    """One of each kind of simulation."""
    bench, fresh = ContactBench(scene), ContactBench(scene)
    start = bench.save()
    first = bits(bench.step())
    saved = bench.save()
    second = bits(bench.step())
    fresh.load(saved)
    assert bits(fresh.step()) == second
    fresh.load(start)
    assert bits(fresh.step()) == first


def test_another_process_goes_on(tmp_path):
    bench = ContactBench("seat_ride", "duration=1")
    bench.step(0.2)
    (tmp_path / "state").write_bytes(bench.save())
    code = (
        "import pathlib, pickle, sys; from contact_sim_pkg import ContactBench; "
        "bench = ContactBench('seat_ride', 'duration=1'); bench.load(pathlib.Path(sys.argv[1]).read_bytes()); "
        "pathlib.Path(sys.argv[2]).write_bytes(pickle.dumps(bench.step(0.1)['seat/force']['normal']))"
    )
    subprocess.run([sys.executable, "-c", code, tmp_path / "state", tmp_path / "force"], check=True, timeout=200)
    found = pickle.loads((tmp_path / "force").read_bytes())  # of this test
    numpy.testing.assert_array_equal(found, bench.step(0.1)["seat/force"]["normal"])


def test_damaged_bytes_are_refused_and_change_nothing():
    bench, beside = ContactBench("block_fall"), ContactBench("block_fall")
    saved = bench.save()
    draw = numpy.random.default_rng(5)
    for place in draw.integers(0, len(saved), 150):
        damaged = bytearray(saved)
        damaged[place] ^= int(draw.integers(1, 256))
        with pytest.raises(StateError, match="were changed"):
            bench.load(bytes(damaged))
    for length in draw.integers(0, len(saved), 50):
        with pytest.raises(StateError, match="were changed"):
            bench.load(saved[:length])
    assert [bits(bench.step()) for _ in range(20)] == [bits(beside.step()) for _ in range(20)]


def rewritten(saved, change):
    """A state whose header was changed by somebody who knows the digest."""
    body = saved[len(MAGIC) + 32 :]
    length = int.from_bytes(body[:8], "little")
    header = json.loads(body[8 : 8 + length])
    change(header)
    text = json.dumps(header).encode()
    body = len(text).to_bytes(8, "little") + text + body[8 + length :]
    return MAGIC + hashlib.sha256(body).digest() + body


def test_no_other_class_than_a_record_of_the_bench_is_made():
    bench = ContactBench("block_fall")

    def foreign(header):
        header["state"]["parts"]["_supplied"] = {"record": "os:terminal_size", "parts": {"sequence": [1, 2]}}

    with pytest.raises(StateError, match="'os:terminal_size' is no record of the bench"):
        bench.load(rewritten(bench.save(), foreign))
    with pytest.raises(StateError, match="is no Other here"):
        bench.load(rewritten(bench.save(), lambda header: header["state"].update(object="contact_sim_pkg.x:Other")))


def test_a_state_of_another_scene_or_version_is_refused():
    bench, other = ContactBench("block_fall"), ContactBench("block_fall", "effects.block.rigid_contact.friction=0.25")
    with pytest.raises(StateError, match="saved with another scene"):
        other.load(bench.save())
    for name in ("bench", "numpy", "processor"):
        with pytest.raises(StateError, match=f"saved with another {name}: older, this is"):
            bench.load(rewritten(bench.save(), lambda header, name=name: header["of"].update({name: "older"})))


def test_what_declares_no_state_is_refused_by_its_name():
    bench = ContactBench("block_fall")
    bench._run.simulation = _Observed(bench._run.simulation, {"effects.block.counting": (None, "")})
    with pytest.raises(StateError, match=r"effects\.block\.counting: what only looks at a run declares no state"):
        bench.save()
    bench = ContactBench("block_fall")
    bench._run.simulation.body = object()
    with pytest.raises(StateError, match=r"BlockBodySimulation\.body is a object, which declares no state"):
        bench.save()


FORGOTTEN = [
    ("block_fall", 25, LocatedBody, "motion"),
    ("impact_rubber_drop", 40, ImpactMotion, "segments"),
    ("seat_slap", 30, BackrestSimulation, "state"),
    ("roller_corrugation", 8, TrackRide, "state"),
    ("seat_ride", 30, Bodies, "state"),
    ("tire_cleat", 80, RoadField, "_solved"),
    ("tire_braking", 6, RollingShear, "_bristles"),
    ("tire_magic_formula", 20, RollingFormula, "_slip"),
]


@pytest.mark.parametrize(("scene", "blocks", "kind", "name"), FORGOTTEN)
def test_a_part_that_is_forgotten_is_seen(monkeypatch, scene, blocks, kind, name):
    """So that the test of all bits is one."""
    bench, other = ContactBench(scene), ContactBench(scene)
    bench.step(blocks // 2 * bench.block_length)
    left = [tuple(each for each in names if each != name) for names in kind.STATE]
    monkeypatch.setattr(kind, "STATE", State(*left))
    saved = bench.save()
    rest = [bits(bench.step()) for _ in range(blocks - blocks // 2)]
    other.step((blocks // 2 + 1) * bench.block_length)  # it is elsewhere
    other.load(saved)
    assert [bits(other.step()) for _ in rest] != rest


def test_the_page_lists_what_the_classes_declare():
    page = ROOT / "docs" / "library.md"
    assert with_list(page.read_text(encoding="utf-8")) == page.read_text(encoding="utf-8")
