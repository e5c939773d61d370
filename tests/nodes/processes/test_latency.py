"""From a block of excitation to its forces: by hand-made time stamps, and in a run."""

import struct

import pytest
from tests.bench_process import needs_ros

LENGTH = 10_000_000  # [ns]


def message(block: int) -> bytes:
    return b"\0\1\0\0" + struct.pack("<iI", *divmod(block * LENGTH, 10**9)) + bytes(4)


@needs_ros
def test_a_block_lasts_from_its_last_excitation_to_its_last_force():
    from contact_sim_lab.nodes.latency import Latencies

    latencies = Latencies(LENGTH, forces=2)
    for block in range(200):
        for sent in (5, 3):
            latencies.on_input(message(block), {"source_timestamp": block * LENGTH + sent * 10**6})
        for after in (9, 7):
            latencies.on_force(message(block), {"received_timestamp": block * LENGTH + after * 10**6 + block * 1000})
    latencies.on_force(message(200), {"received_timestamp": 10**18})  # a block of which only a part is seen
    # 4 ms and block number times 1 us: 0 to 199 us evenly
    assert latencies.figures() == {
        "blocks": 200,
        "p50": pytest.approx(4.0995e-3, abs=1e-9),
        "p99": pytest.approx(4.19701e-3, abs=1e-9),
        "largest": pytest.approx(4.199e-3, abs=1e-9),
        "overruns": 0,
        "cause": "",
    }


@needs_ros
@pytest.mark.parametrize(
    ("physics", "cause"), [(0.011, "computed"), (0.001, "waited for a processor, a message or the logger")]
)
def test_the_longest_block_has_a_cause(physics, cause):
    from contact_sim_lab.nodes.latency import Latencies
    from contact_sim_pkg.bag.messages import encode
    from contact_sim_pkg.records.messages import SolverCost

    latencies = Latencies(LENGTH, forces=1)
    for block in range(9):
        latencies.on_input(message(block), {"source_timestamp": block * LENGTH})
        late = 12_000_000 if block == 7 else 2_000_000
        latencies.on_force(message(block), {"received_timestamp": block * LENGTH + late})
        wall, steps = (physics, 31) if block == 7 else (1e-3, 3)
        cost = SolverCost(block=block, wall_time=wall, real_time_factor=1e-2 / wall, coupling_steps=steps)
        latencies.on_cost(encode(cost), {})
    figures = latencies.figures()
    assert figures["overruns"] == 1  # 12 of 10 ms
    assert figures["cause"] == f"block 7: {cause}; {1e3 * physics:.3g} ms of physics, 31 coupling steps (median 3)"


@needs_ros
def test_a_run_without_a_whole_block_is_refused():
    from contact_sim_lab.nodes.latency import Latencies

    with pytest.raises(ValueError, match="no block came"):
        Latencies(LENGTH, forces=1).figures()


@needs_ros
def test_the_latency_of_a_run_is_positive_and_below_its_length():
    from contact_sim_lab.nodes.latency import measure

    found = measure("seat_ride", 10.0)
    assert found["blocks"] > 0
    assert 0.0 < found["p50"] <= found["p99"] <= found["largest"] < 10.0
