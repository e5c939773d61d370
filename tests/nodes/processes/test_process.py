"""The life of a node's process."""

import signal
import subprocess
import sys

from tests.bench_process import ENVIRONMENT, LONGEST, needs_ros

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
hashlib.pbkdf2_hmac("sha256", b"", b"", 2**31 - 1)  # a quarter of an hour; other threads run, no signal is taken
"""


@needs_ros
def test_a_node_that_computes_on_behind_a_signal_ends_its_run_all_the_same():
    command = [sys.executable, "-c", COMPUTES_ON]
    with subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "computes\n"
            process.send_signal(signal.SIGINT)
            assert process.wait(LONGEST) == 0
            assert process.stdout.read() == "ends the run\n"
        finally:
            process.kill()


ENDS = """
import gc, os
gc.disable()
from contact_sim_pkg.nodes.bench_node import LifecycleBenchNode
from contact_sim_pkg.nodes.processes.process import run
from contact_sim_pkg.nodes.processes.shared_memory import mapped_segments

class Short(LifecycleBenchNode):
    def __init__(self):
        super().__init__("short")

    def configure(self):
        pass

    def tick(self, now):
        print(len(mapped_segments(os.getpid())) > 0)
        self.exit_status = 0
        return 0.0

assert run(Short, args=[]) == 0
print(len(mapped_segments(os.getpid())) > 0)
"""


@needs_ros
def test_the_middleware_is_gone_when_the_nodes_have_ended():
    """Its threads must not run on while the libraries of the process are taken down.

    In a domain that no other test is in: with a peer there the middleware keeps a segment of it mapped, in one run of four.
    """
    alone = {**ENVIRONMENT, "ROS_DOMAIN_ID": "101"}
    done = subprocess.run([sys.executable, "-c", ENDS], env=alone, capture_output=True, text=True, timeout=LONGEST)
    assert done.stdout.split() == ["True", "False"], done.stderr


POLICIES = """
import os, threading
from contact_sim_pkg.nodes.processes.process import use_batch_policy, use_usual_policy

use_batch_policy()
stop = threading.Event()
thread = threading.Thread(target=stop.wait)
thread.start()
found = lambda: [os.sched_getscheduler(each) for each in (0, thread.native_id)]
print(found())
use_usual_policy()
print(found())
use_usual_policy(everywhere=True)
print(found())
stop.set()
"""


@needs_ros
def test_a_paced_node_returns_the_threads_of_the_middleware_to_the_usual_policy():
    done = subprocess.run([sys.executable, "-c", POLICIES], env=ENVIRONMENT, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["[3, 3]", "[0, 3]", "[0, 0]"]  # sched(7): 3 is SCHED_BATCH, 0 SCHED_OTHER
