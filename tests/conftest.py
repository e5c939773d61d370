"""What all tests share: a ROS domain of their own on this host, one thread a process, and one cache of compiled kernels."""

import os
import sys
import zlib

import pytest

# Set before anything imports ROS or numba. A domain of the caller's is not used: tests must not meet a running bench.
os.environ["ROS_DOMAIN_ID"] = str(1 + zlib.crc32(f"{__file__} {os.getpid()}".encode()) % 100)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.setdefault("NUMBA_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


@pytest.fixture(autouse=True, scope="module")
def compilation_is_open():
    """A simulation closes compilation when it is prepared; the next module of tests may need other kernels."""
    yield
    jit = sys.modules.get("contact_sim_pkg.core.jit")
    if jit is not None:
        jit.thaw()
