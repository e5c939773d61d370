"""Steps, budgets, threads and arrays that a kernel must not stumble over (FAULTS part D, F7)."""

import ast
import hashlib
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy
import pytest
from tests.bench_process import ENVIRONMENT, messages, resolved

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_pkg.bag.encoding import deserialize
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.compiled import jit
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.parameters import NormalElastic
from contact_sim_pkg.pressure.field.halfspace import make_half_space
from contact_sim_pkg.pressure.field.solver import make_workspace, solve_at_load
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.records.messages import VibrationBlock
from contact_sim_pkg.run import offline
from contact_sim_pkg.run.sources import make_sources

PACKAGE = Path(jit.__file__).resolve().parents[1]
PRESSED = PointContact(1.0, 10.0, 0.0, 0.0, NormalElastic(1e8, 1.0), None)  # sinks 1e-7 m under its weight


@pytest.mark.fault("D3")
@pytest.mark.parametrize("interval", [0.5, 1.0, 2.0, 4.0])
def test_an_output_interval_beyond_the_stability_limit_of_an_explicit_step_changes_nothing(interval):
    """Undamped spring, 1e4 rad/s; an explicit step of the pair is unstable above 3.3/frequency. Nobody chooses the step."""
    frequency, limit = 1e4, 3.3e-4
    times = numpy.arange(0.0, 5e-3, interval * limit)
    states = integrate(PRESSED, numpy.array([-1.5e-7, 0.0]), numpy.array([1e-7, 1e-3]) * 1e-10, times).states
    assert states[:, 0] == pytest.approx(-1e-7 - 0.5e-7 * numpy.cos(frequency * times), abs=1e-13)


def small_problem():
    """Half-space, workspace, gap and pressure of a ball on 16 x 16 cells."""
    half_space = make_half_space(16, 16, 1e-3, 1e-3, 1e6)
    x = (numpy.arange(16) - 7.5) * 1e-3
    gap = (x[:, None] ** 2 + x[None, :] ** 2) / 0.1
    return half_space, make_workspace(half_space), gap, numpy.zeros((16, 16))


def read_only(field):
    """The same values, not to be written."""
    field = field.copy()
    field.flags.writeable = False
    return field


@pytest.mark.fault("D8")
@pytest.mark.parametrize("name", ["gap", "pressure"])
@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda field: field.astype(numpy.float32), "of float32"),
        (lambda field: numpy.repeat(field, 2, axis=1)[:, ::2], "contiguous False"),
        (lambda field: field.T.copy().T, "contiguous False"),
        (read_only, "writable False"),
    ],
    ids=["single precision", "strided", "by columns", "read-only"],
)
def test_an_array_of_another_kind_is_refused_by_name_before_a_kernel_sees_it(name, spoil, said):
    half_space, work, gap, pressure = small_problem()
    arrays = {"gap": gap, "pressure": pressure}
    arrays[name] = spoil(arrays[name])
    with pytest.raises(ValueError, match=rf"{name} is .*{said}.*pass numpy.array"):
        solve_at_load(half_space, work, arrays["gap"], 1.0, 1e-6, 100, arrays["pressure"])


@pytest.mark.fault("D10")
def test_no_kernel_shares_its_work_among_threads():
    """So that sums have one order: no parallel target, no prange."""
    found = []
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            named = isinstance(node, (ast.Name, ast.Attribute)) and ast.unparse(node).split(".")[-1] == "prange"
            asked = isinstance(node, ast.keyword) and node.arg == "parallel"
            found += [f"{path.name}:{node.lineno}"] if named or asked else []
    assert found == []
    assert "parallel" not in jit.COMPILE_OPTIONS


@pytest.mark.fault("D10")
def test_the_same_scene_gives_the_same_bits_with_one_thread_and_with_two(tmp_path):
    hashes = set()
    for threads in ("1", "2"):
        bag = tmp_path / threads
        command = python_command("contact_sim_pkg.cli.main", "run", "seat_ride", "--offline")
        subprocess.run(
            [*command, "--set", "duration=0.2", "--out", str(bag)],
            env={**ENVIRONMENT, "NUMBA_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads, "OMP_NUM_THREADS": threads},
            check=True, capture_output=True,
        )  # fmt: skip
        hashes.add(hashlib.sha256(repr(messages(bag)).encode()).hexdigest())
    assert len(hashes) == 1


@pytest.mark.fault("F7")
def test_other_threads_go_on_while_a_kernel_computes():
    """Without nogil the ticker would stand still for the whole call."""
    half_space = make_half_space(128, 128, 1e-3, 1e-3, 1e6)
    x = (numpy.arange(128) - 63.5) * 1e-3
    gap = (x[:, None] ** 2 + x[None, :] ** 2) / 1.0 + 1e-4 * numpy.random.default_rng(1).random((128, 128))
    work, pressure = make_workspace(half_space), numpy.zeros((128, 128))
    solve_at_load(half_space, work, gap, 100.0, 1e-2, 1, pressure)  # compiled

    ticks, over = [], threading.Event()

    def tick():
        while not over.is_set():
            ticks.append(time.perf_counter())
            time.sleep(1e-4)

    ticker = threading.Thread(target=tick)
    ticker.start()
    shares: list[float] = []
    try:
        while not shares or (min(shares) > 0.5 and len(shares) < 10):  # a busy machine may starve the ticker once
            pressure[:] = 0.0
            began = time.perf_counter()
            solve_at_load(half_space, work, gap, 100.0, 1e-15, 3000, pressure)
            ended = time.perf_counter()
            seen = [began, *(each for each in ticks if began < each < ended), ended]
            shares.append(float(numpy.diff(seen).max()) / (ended - began))
    finally:
        over.set()
        ticker.join()
    assert min(shares) <= 0.5, "the ticker stood still for most of every call"


@pytest.mark.fault("D7")
def test_with_bounds_checks_a_kernel_that_reads_beyond_its_array_is_noticed(tmp_path):
    """What `make bounds` sets reaches kernels as this project compiles them."""
    (tmp_path / "beyond.py").write_text(
        "import numpy\n"
        "from contact_sim_pkg.compiled.jit import entry, kernel\n"
        "@kernel\ndef read(values, i):\n    return values[i]\n"
        "@entry\ndef total(values):\n    return read(values, 8)\n"
        "try:\n    total(numpy.zeros(4))\nexcept IndexError:\n    print('noticed')\n"
    )
    done = subprocess.run(
        [sys.executable, str(tmp_path / "beyond.py")],
        env={**ENVIRONMENT, "NUMBA_BOUNDSCHECK": "1", "CONTACT_BENCH_CACHE": str(tmp_path / "cache")},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout == "noticed\n"


@pytest.mark.fault("C6")
@pytest.mark.parametrize("number", [0, 2**31, 2**33 - 10, 2**37])
def test_the_stamp_of_a_late_block_is_exact_to_the_nanosecond(number):
    """43 years of blocks: number and length are integers, nothing is summed up."""
    block = VibrationBlock(
        block=number, sample_period=1e-3, acceleration_x=numpy.zeros(10), acceleration_z=numpy.zeros(10)
    )
    stamp = number * 10_000_000
    message = deserialize("contact_msgs_defs/msg/VibrationBlock", encode(block, stamp))
    assert message.block == number
    assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == stamp


@pytest.mark.fault("C6")
@pytest.mark.parametrize(("late", "tolerance"), [(3_600_000 - 20, 1e-9), (2**37, 1e-5)])
def test_a_run_whose_counter_has_gone_far_goes_on_as_at_its_start_with_exact_stamps(late, tolerance):
    """The longest scene has 3.6e6 blocks; the stamps of ROS end at 2.1e11 blocks of 10 ms, and a double of seconds rounds."""

    def twenty_from(first):
        """Stamps after that block's and numbers after its own of what twenty blocks record; force and energies."""
        scene = resolved("seat_ride", "duration=0.3")
        simulation, ((topic, source),) = offline.make_simulation(scene), make_sources(scene).items()
        simulation.prepare()
        simulation.advance(0, {topic: source.block(0)})
        simulation._next_block = first
        places, force, dissipated = [], [], []
        for number in range(20):
            given = source.block(1 + number)._replace(block=first + number)
            for name, stamp, record, _frame in simulation.advance(first + number, {topic: given}).outputs:
                own = record.block - first if "block" in record._fields else number
                places.append((name, stamp - first * 10_000_000, own))
                force += record.normal.tolist() if name == "seat/force" else []
                dissipated += [record.dissipated] if name == "bench/energy" else []
        return places, numpy.array(force), numpy.array(dissipated)

    places, force, dissipated = twenty_from(1)
    places_late, force_late, dissipated_late = twenty_from(late)
    assert places_late == places
    assert {own for _name, _stamp, own in places} == set(range(20))
    assert force_late == pytest.approx(force, abs=tolerance * force.max())
    assert dissipated_late == pytest.approx(dissipated, abs=tolerance * dissipated.max())


@pytest.mark.fault("F8")
def test_a_run_that_gets_no_more_memory_ends_by_name_with_its_bag_whole(tmp_path, monkeypatch):
    scene = resolved("seat_ride", "duration=0.2")
    make = offline.make_simulation

    def hungry(given):
        simulation = make(given)
        advance = simulation.advance

        def fail_at_seven(block, inputs):
            if block == 7:
                raise MemoryError("Unable to allocate 9.31 GiB")
            return advance(block, inputs)

        simulation.advance = fail_at_seven
        return simulation

    monkeypatch.setattr(offline, "make_simulation", hungry)
    with pytest.raises(MemoryError):
        offline.run_offline(scene, tmp_path / "bag")
    bag = open_bag(tmp_path / "bag")
    assert bag.metadata["failure"].startswith("out of memory in block 7: Unable to allocate 9.31 GiB")
    assert sum(each.topic == "/seat/force" for each in bag.messages()) == 7
