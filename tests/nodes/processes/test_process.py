"""The life of a node's process."""

import signal
import subprocess
import sys
import time

from tests.bench_process import ENVIRONMENT, needs_ros

COMPUTES_ON = """
import hashlib
from contact_sim_pkg.nodes.processes.process import StopSignals

class Node:
    def abandon(self):
        print("ends the run", flush=True)
        return True

signals = StopSignals()
signals.breaks_off = False
signals.leave_what_computes(Node())
print("computes", flush=True)
hashlib.pbkdf2_hmac("sha256", b"", b"", 2**31 - 1)  # compiled code that lets other threads run, and takes no signal
"""


@needs_ros
def test_a_node_that_computes_on_behind_a_signal_ends_its_run_within_two_seconds():
    command = [sys.executable, "-c", COMPUTES_ON]
    with subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "computes\n"
            began = time.monotonic()
            process.send_signal(signal.SIGINT)
            assert process.wait(10.0) == 0
            assert time.monotonic() - began < 2.0
            assert process.stdout.read() == "ends the run\n"
        finally:
            process.kill()
