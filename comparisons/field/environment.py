"""The environment of the fields' comparison, `.compare-field/`: tamaas from its wheels, ASPHER from source."""

from __future__ import annotations

import os
from pathlib import Path

from comparisons.environment import ROOT, Environment, from_wheels

__all__ = ["ENVIRONMENT"]


def _install_aspher(environment: Environment, log: Path) -> int:
    """From source: its build would fetch Eigen from its host, so headers from a package are put in its way."""
    status = environment.pip(log, "-r", environment.pins("requirements_aspher_build.txt"))
    if status:
        return status
    prefixes = [str(path) for path in environment.folder.glob("lib/python*/site-packages/cmeel.prefix")]
    tools = os.pathsep.join([str(environment.folder / "bin"), os.environ.get("PATH", os.defpath)])
    native = {"CMAKE_PREFIX_PATH": os.pathsep.join(prefixes), "CMAKE_ARGS": "-DASPHER_NATIVE=ON", "PATH": tools}
    build = ("--no-build-isolation", "--no-binary", "aspher", "-r", environment.pins("requirements_aspher.txt"))
    return environment.pip(log, "--no-cache-dir", *build, further=native)


ENVIRONMENT = Environment(
    ROOT / ".compare-field",
    Path(__file__).parent,
    {"tamaas": from_wheels("requirements_tamaas.txt"), "ASPHER": _install_aspher},
    "some minutes: ASPHER is built from source",
)
