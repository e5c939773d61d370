"""What the simulator waits for: by hand-made events, and in a run."""

import numpy
import pytest
from tests.bench_process import needs_ros


@needs_ros
def test_shares_of_a_trace_by_hand():
    from contact_sim_lab.nodes.trace import Events, Schedule, shares

    events, second = Events(10_000_000), 10**9
    # A block each 10 ms: sent half a block's time after the one before was done, recorded at once
    for block in range(200):
        done = 5 * second + block * 10_000_000
        events.done[block] = events.recorded[block] = done
        events.sent[block] = done - 5_000_000
    at = 5.0 + numpy.linspace(0.0, 1.99, 1000)
    found = shares(events, Schedule(at, 0.5 * at, 0.25 * at))
    assert found["on_core"] == pytest.approx(0.5, abs=1e-9)
    assert found["in_queue"] == pytest.approx(0.25, abs=1e-9)
    assert found["waiting"] == pytest.approx(0.25, abs=1e-9)
    assert found["block_not_sent"] == pytest.approx(0.5, abs=0.01)
    assert found["window_closed_by_logger"] == 0.0
    assert found["blocks_per_second"] == pytest.approx(100.0, rel=1e-9)


@needs_ros
def test_a_run_is_traced_and_drawn(tmp_path):
    from contact_sim_lab.nodes.trace import draw, shares, trace

    events, schedule = trace("car_full_bench")
    found = shares(events, schedule)
    assert found["blocks_per_second"] > 0.0
    assert found["on_core"] + found["in_queue"] + found["waiting"] == pytest.approx(1.0)
    draw(events, schedule, tmp_path / "trace.png")
    assert (tmp_path / "trace.png").read_bytes().startswith(b"\x89PNG")
