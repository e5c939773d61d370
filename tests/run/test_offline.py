"""The offline run: what it writes, how it ends, and running a bag's excitation again."""

import os
import subprocess
import sys

import pytest
from tests.bench_process import LONGEST_COMMAND
from tests.run.scenes import resolved

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.run.from_bag import sources_from_bag
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.run.sources import make_sources

UNCOMPILED = """
import sys
from contact_sim_pkg.compiled.jit import compiled_functions
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.resolve import load_resolved

scenes = [load_resolved(*each.split("; ")) for each in sys.argv[1:]]
assert {scene.rig for scene in scenes} == set(rigs())
for scene in scenes:
    outcome = run_offline(scene, None)
    assert (outcome.failure, outcome.blocks) == ("", 1), (scene.name, outcome)
assert not any(hasattr(each, "overloads") for each in compiled_functions())
"""

ONE_BLOCK = (
    "impact_rubber_drop; duration=0.01", "roller_steady; duration=0.1; effects.roller.subsurface=null",
    "block_slope; duration=0.01", "seat_slap; duration=0.01", "seat_ride; duration=0.01", "seat_ride_full; duration=0.01",
    "tire_half_space; duration=0.01; effects.tire.contact_field={rows: 8, cols: 8}",
    "car_full_bench; duration=0.01; effects.tire={normal_elastic: {}, normal_dissipative: {}}",
)  # fmt: skip


def recorded(path):
    """Everything that must be the same twice: topic, log time and bytes, in order."""
    return [
        (message.topic, message.log_time, message.data)
        for message in open_bag(path).messages()
        if not TOPICS[message.topic.lstrip("/")].wall_time
    ]


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """Half a second of the full bench."""
    directory = tmp_path_factory.mktemp("bags") / "first"
    outcome = run_offline(resolved("car_full_bench", "duration=0.5"), directory)
    assert (outcome.failure, outcome.blocks) == ("", 50)
    return directory


def test_two_runs_write_the_same_messages_in_the_same_order(bag, tmp_path):
    run_offline(resolved("car_full_bench", "duration=0.5"), tmp_path / "second")
    assert recorded(bag) == recorded(tmp_path / "second")


def test_the_bag_is_in_order_of_stamps_and_has_its_scene(bag):
    opened = open_bag(bag)
    times = [message.log_time for message in opened.messages()]
    assert times == sorted(times)
    assert "car_full_bench" in (opened.scene or "")
    assert opened.count("tire/patch") == opened.count("road/patch") == 50


def test_a_bag_run_again_from_its_excitation_gives_the_same_messages(bag, tmp_path):
    scene = resolved("car_full_bench", "duration=0.5")
    run_offline(scene, tmp_path / "again", sources=sources_from_bag(bag, scene))
    assert recorded(bag) == recorded(tmp_path / "again")


def test_a_bag_that_is_too_short_for_the_scene_is_refused_with_the_duration_that_fits(bag):
    with pytest.raises(BagError, match=r"--duration 0\.5"):
        sources_from_bag(bag, resolved("car_full_bench", "duration=1.0"))


def test_a_bag_on_another_road_lattice_is_refused(bag):
    with pytest.raises(BagError, match=r"keep effects\.tire\.contact_field as recorded"):
        sources_from_bag(bag, resolved("car_full_bench", "duration=0.5", "accuracy=1e-3"))


def test_a_run_that_is_stopped_leaves_a_whole_bag(tmp_path):
    asked = iter([False] * 8 + [True])  # before anything is created, and before each block
    outcome = run_offline(resolved("seat_ride"), tmp_path / "bag", stop=lambda: next(asked))
    assert (outcome.stopped, outcome.blocks) == (True, 7)
    assert open_bag(tmp_path / "bag").complete
    assert open_bag(tmp_path / "bag").count("seat/force") == 7


def test_a_run_that_is_stopped_while_it_is_set_up_creates_nothing(tmp_path):
    outcome = run_offline(resolved("seat_ride"), tmp_path / "bag", stop=lambda: True)
    assert (outcome.stopped, outcome.blocks, outcome.bag) == (True, 0, None)
    assert not (tmp_path / "bag").exists()


def test_a_fault_of_the_program_itself_is_named_in_the_bag_that_it_leaves(tmp_path):
    """A source that raises what no source should, at its fourth block."""

    class Faulty:
        def describe(self):
            return {}

        def block(self, number):
            if number == 3:
                raise ZeroDivisionError("nothing to divide by")
            return source.block(number)

    scene = resolved("seat_ride", "duration=0.2")
    (topic, source), *_ = make_sources(scene).items()
    with pytest.raises(ZeroDivisionError):
        run_offline(scene, tmp_path / "bag", sources={**make_sources(scene), topic: Faulty()})
    told = open_bag(tmp_path / "bag").metadata
    assert (told["ended"], told["blocks_done"]) == ("failed", "3")
    assert told["failure"] == "unexpected ZeroDivisionError: nothing to divide by"


def test_a_block_of_each_rig_runs_uncompiled():
    """As `NUMBA_DISABLE_JIT=1 bench run SCENE --offline`: Python raises where compiled code divides by zero."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1", "CONTACT_BENCH_PLUGINS": "off"}
    command = [sys.executable, "-c", UNCOMPILED, *ONE_BLOCK]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=LONGEST_COMMAND)
    assert done.returncode == 0, done.stderr[-2000:]
