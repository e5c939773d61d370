"""Cases on the workers of a Dask scheduler."""

import importlib.util
import socket
import threading

import pytest

from contact_sim_pkg import sweep
from contact_sim_pkg.sweep.variation import SweepError

VARIED = "impact.mass=0.03,0.06,0.09"
needs_dask = pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="distributed is not installed")


def swept(folder, **named):
    return sweep("impact_steel", folder, VARIED, progress=False, **named)


def without_times(table):
    return [{key: value for key, value in row.items() if key not in ("wall_s", "cpu_s")} for row in table]


@pytest.mark.parametrize(
    ("address", "word"),
    [
        ("host", "not of the form"), ("http://a:1", "not of the form"), ("tcp://a", "not of the form"),
        ("tcp://a:x", "not of the form"), ("tcp://127.0.0.1:1", "nobody answers"),
    ],
)  # fmt: skip
def test_a_scheduler_that_is_not_there_is_one_sentence(tmp_path, address, word):
    with pytest.raises(SweepError, match=word) as refused:
        swept(tmp_path / "out", scheduler=address)
    assert "\n" not in str(refused.value)


@needs_dask
def test_a_server_that_is_no_scheduler_is_said(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as server:

        def answer():
            for _ in range(2):
                peer, _ = server.accept()
                peer.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n" * 20)

        threading.Thread(target=answer, daemon=True).start()
        with pytest.raises(SweepError, match="no scheduler"):
            swept(tmp_path / "out", scheduler=f"tcp://127.0.0.1:{server.getsockname()[1]}")


@needs_dask
def test_the_table_of_a_cluster_is_that_of_this_machine(tmp_path):
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        found = swept(tmp_path / "cluster", scheduler=cluster.scheduler_address)
    assert str(without_times(found)) == str(without_times(swept(tmp_path / "here", jobs=1)))
