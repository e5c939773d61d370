"""What all tests share: a ROS domain of their own on this host, one thread a process, and one cache of compiled kernels."""

import os
import zlib

# Set before anything imports ROS or numba. A domain of the caller's is not used: tests must not meet a running bench.
os.environ["ROS_DOMAIN_ID"] = str(1 + zlib.crc32(f"{__file__} {os.getpid()}".encode()) % 100)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.setdefault("NUMBA_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
