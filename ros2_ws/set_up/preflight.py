"""What the machine must have, looked at before anything is downloaded."""

import json
import os
import platform
import re
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from .layout import PROJECT, WORKSPACE
from .underlay import Underlay

PYTHON_OLDEST = (3, 11)
PYTHON_NEWEST = (3, 14)
GLIBC_OLDEST = (2, 28)
DISK_NEEDED = 2.0e9  # [bytes]: the environment takes 1.1 GB, its download 0.4 GB

C_COMPILERS = ("cc", "gcc", "clang")
CXX_COMPILERS = ("c++", "g++", "clang++")

_PROBE = """
import importlib.util, json, sys, sysconfig
print(json.dumps({
    "version": list(sys.version_info[:2]),
    "include": sysconfig.get_path("include"),
    "venv": all(importlib.util.find_spec(name) for name in ("venv", "ensurepip")),
}))
"""


class Facts(NamedTuple):
    """What was found on this machine."""

    system: str
    machine: str
    glibc: tuple[int, int] | None
    python: Path
    python_version: tuple[int, int]
    headers: Path
    has_venv: bool
    c_compiler: str | None
    cxx_compiler: str | None
    ros_from_pip: bool
    project: Path
    free_bytes: int
    is_writable: bool


def gather(underlay: Underlay, environ: Mapping[str, str]) -> Facts:
    """Look at the machine and at the interpreter that the environment shall be made with."""
    output = subprocess.run(
        [str(underlay.python), "-I", "-c", _PROBE], env=dict(environ), check=True, capture_output=True, text=True
    ).stdout
    python = json.loads(output)
    return Facts(
        system=platform.system(),
        machine=platform.machine(),
        glibc=_glibc_version(),
        python=underlay.python,
        python_version=(python["version"][0], python["version"][1]),
        headers=Path(python["include"]),
        has_venv=python["venv"],
        c_compiler=_compiler("CC", C_COMPILERS, environ),
        cxx_compiler=_compiler("CXX", CXX_COMPILERS, environ),
        ros_from_pip=underlay.prefix is None,
        project=PROJECT,
        free_bytes=shutil.disk_usage(PROJECT).free,
        is_writable=all(os.access(folder, os.W_OK | os.X_OK) for folder in (PROJECT, WORKSPACE)),
    )


def faults(facts: Facts) -> list[str]:
    """One sentence, with its cure, for each thing that is missing; empty where set-up can start."""
    return [*_platform_faults(facts), *_python_faults(facts), *_compiler_faults(facts), *_folder_faults(facts)]


def compiler_faults(facts: Facts, environ: Mapping[str, str]) -> list[str]:
    """Try both compilers on one line that needs the Python headers and the C++ library."""
    found = []
    for language, compiler, source in (
        ("c", facts.c_compiler, "#include <Python.h>\nint main(void) { return 0; }\n"),
        ("c++", facts.cxx_compiler, "#include <vector>\nint main() { return 0; }\n"),
    ):
        command = [*(compiler or "").split(), "-fsyntax-only", "-x", language, f"-I{facts.headers}", "-"]
        result = subprocess.run(command, input=source, env=dict(environ), capture_output=True, text=True, check=False)
        if result.returncode:
            reason = next((line for line in result.stderr.splitlines() if "error" in line), f"exit {result.returncode}")
            found.append(
                f"the compiler {compiler} cannot translate an empty program ({reason}): "
                "install the C and C++ development files (Debian, Ubuntu: sudo apt install build-essential)."
            )
    return found


def _platform_faults(facts: Facts) -> list[str]:
    if facts.system != "Linux":
        return [f"this system is {facts.system}: the nodes need Linux: for offline use, pip install ./contact_sim_pkg."]
    if not facts.ros_from_pip:
        return []
    found = []
    if facts.machine not in ("x86_64", "AMD64"):
        found.append(
            f"this processor is {facts.machine}, and ROS 2 from PyPI exists for x86-64 only: "
            "install ROS 2 Jazzy with apt and source /opt/ros/jazzy/setup.bash first."
        )
    if facts.glibc is None or facts.glibc < GLIBC_OLDEST:
        have = "another C library" if facts.glibc is None else "glibc {}.{}".format(*facts.glibc)
        found.append(f"this system has {have}, and glibc 2.28 or later is needed: use a distribution of 2019 or later.")
    return found


def _python_faults(facts: Facts) -> list[str]:
    name = "{}.{}".format(*facts.python_version)
    if not PYTHON_OLDEST <= facts.python_version <= PYTHON_NEWEST:
        return [f"{facts.python} is Python {name}, and 3.11 to 3.14 are supported: name another with make PYTHON=…"]
    found = []
    if not facts.has_venv:
        found.append(
            f"{facts.python} has no venv module: install it (Debian, Ubuntu: sudo apt install python{name}-venv), "
            "or name another Python with make PYTHON=…"
        )
    if not (facts.headers / "Python.h").is_file():
        found.append(
            f"the headers of Python {name} are missing (no Python.h in {facts.headers}): install them "
            f"(Debian, Ubuntu: sudo apt install python{name}-dev), or name another Python with make PYTHON=…"
        )
    return found


def _compiler_faults(facts: Facts) -> list[str]:
    found = []
    for language, compiler, debian, fedora, tried in (
        ("C", facts.c_compiler, "gcc", "gcc", C_COMPILERS),
        ("C++", facts.cxx_compiler, "g++", "gcc-c++", CXX_COMPILERS),
    ):
        if compiler is None:
            found.append(
                f"no {language} compiler found (looked for {', '.join(tried)}): install one "
                f"(Debian, Ubuntu: sudo apt install {debian}; Fedora: sudo dnf install {fedora})."
            )
    return found


def _folder_faults(facts: Facts) -> list[str]:
    found = []
    if re.search(r"[\s:;\"'\\$]", str(facts.project)):
        found.append(
            f"the project's path '{facts.project}' holds a blank, a colon, a quote or a dollar sign, which CMake and "
            "search paths cannot carry: move the project to a path without."
        )
    if not str(facts.project).isascii():
        found.append(
            f"the project's path '{facts.project}' holds letters beyond ASCII, which the message generators of ROS 2 cannot "
            "carry: move the project to a path without."
        )
    if not facts.is_writable:
        found.append(
            f"{facts.project} cannot be written, and the environment and the build go into it: "
            "work on a copy of your own, or change its permissions."
        )
    if facts.free_bytes < DISK_NEEDED:
        found.append(
            f"{facts.free_bytes / 1e9:.1f} GB are free at {facts.project}, and {DISK_NEEDED / 1e9:.0f} GB are needed: "
            "free some space."
        )
    return found


def _compiler(variable: str, names: tuple[str, ...], environ: Mapping[str, str]) -> str | None:
    asked = environ.get(variable)
    if asked:
        return asked if shutil.which(asked.split()[0], path=environ.get("PATH")) else None
    return next((name for name in names if shutil.which(name, path=environ.get("PATH"))), None)


def _glibc_version() -> tuple[int, int] | None:
    try:
        match = re.fullmatch(r"glibc (\d+)\.(\d+).*", os.confstr("CS_GNU_LIBC_VERSION") or "")
    except (AttributeError, OSError, ValueError):
        return None
    return (int(match[1]), int(match[2])) if match else None
