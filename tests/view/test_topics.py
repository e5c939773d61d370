"""The live page over the real middleware: what nodes publish is shown, and a replay is paused from it."""

import os
import re
import signal

import pytest
from tests.bench_process import LONGEST, Nodes, end, needs_ros, resolved, start_bench
from tests.view.frames import Client, written

pytestmark = needs_ros


def test_a_replay_is_shown_paused_and_goes_on(tmp_path):
    pytest.importorskip("websockets")
    bag = written(tmp_path)
    process, nodes = start_bench("view"), Nodes(resolved("seat_ride"), tmp_path)
    try:
        port = int(re.search(r":(\d+)/$", process.stdout.readline().strip())[1])
        own, behind = os.getpriority(os.PRIO_PROCESS, 0), os.getpriority(os.PRIO_PROCESS, process.pid)
        assert behind == min(own + 10, 19)  # it takes no time from the bench
        nodes.start("bag_replay", bag=bag, loop="true", delay=2.0)
        client = Client(port)
        about, series, _ = client.until(lambda about, series, fields: fields and "bench/motion" in series)
        assert 600.0 <= about["maps"][0]["load"] <= 649.0
        assert set(series["bench/motion"][2]) == {2.0}
        client.until(lambda about, *_: about["can"] == ["pause"])
        client.send("pause")
        client.until(lambda about, *_: about["paused"])
        client.send("go")
        client.until(lambda about, series, _: not about["paused"] and "seat/force" in series)
        client.close()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=LONGEST)
        assert process.returncode == 0, errors
        assert "Traceback" not in errors
    finally:
        nodes.end()
        end(process)
