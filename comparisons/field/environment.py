"""The comparison's own environment, `.compare-field/`: the peers are installed there and nowhere else.

A peer that cannot be installed is left out, with the reason; the rest goes on. Only the standard library is needed here.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

__all__ = ["ENVIRONMENT", "LEFT_OUT", "ONE_THREAD", "ROOT", "SetUpError", "clean", "environment_python", "make_current"]

ROOT = Path(__file__).resolve().parents[2]
ENVIRONMENT = ROOT / ".compare-field"
REQUIREMENTS = Path(__file__).parent
LEFT_OUT = "left_out.json"
STAMP = "stamp"
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


class SetUpError(Exception):
    """The environment cannot be made."""


def environment_python() -> Path:
    """Its interpreter."""
    return ENVIRONMENT / "bin" / "python"


def clean(environ: dict[str, str]) -> dict[str, str]:
    """The variables to run in it: this project importable, nothing else, one thread everywhere."""
    kept = {name: value for name, value in environ.items() if not name.startswith("PYTHON")}
    path = os.pathsep.join([str(ROOT), str(ROOT / "contact_sim_pkg")])
    return {**kept, "PYTHONPATH": path, **dict.fromkeys(ONE_THREAD, "1")}


def make_current(tell: Callable[[str], None]) -> dict[str, str]:
    """Make the environment where it is missing or its requirements changed; the peers left out, with the reason.

    Raises `SetUpError` where even what measuring needs cannot be installed.
    """
    wanted = _stamp()
    stamp = ENVIRONMENT / STAMP
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != wanted:
        _make(tell)
        stamp.write_text(wanted, encoding="utf-8")
    left_out: dict[str, str] = json.loads((ENVIRONMENT / LEFT_OUT).read_text(encoding="utf-8"))
    return left_out


def _stamp() -> str:
    digest = hashlib.sha256(f"{sys.version_info[:2]} {ROOT}".encode())
    for path in [*sorted(REQUIREMENTS.glob("requirements*.txt")), Path(__file__)]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _make(tell: Callable[[str], None]) -> None:
    shutil.rmtree(ENVIRONMENT, ignore_errors=True)
    tell(f"making {ENVIRONMENT.name}/ (some minutes: ASPHER is built from source)")
    _must([sys.executable, "-m", "venv", str(ENVIRONMENT)], "the virtual environment")
    _must(_pip("-r", str(REQUIREMENTS / "requirements.txt")), "what measuring needs")
    left_out: dict[str, str] = {}
    for name, install in (("tamaas", _install_tamaas), ("ASPHER", _install_aspher)):
        tell(f"installing {name}")
        log = ENVIRONMENT / f"{name}.log"
        status = install(log)
        if status:
            left_out[name] = f"pip ended with {status}: {_last_error(log)} (all of it: {log.relative_to(ROOT)})"
    (ENVIRONMENT / LEFT_OUT).write_text(json.dumps(left_out), encoding="utf-8")


def _install_tamaas(log: Path) -> int:
    return _logged(_pip("--only-binary", ":all:", "-r", str(REQUIREMENTS / "requirements_tamaas.txt")), log)


def _install_aspher(log: Path) -> int:
    """From source: its build would fetch Eigen from its host, so headers from a package are put in its way."""
    status = _logged(_pip("-r", str(REQUIREMENTS / "requirements_aspher_build.txt")), log)
    if status:
        return status
    prefixes = [str(path) for path in ENVIRONMENT.glob("lib/python*/site-packages/cmeel.prefix")]
    tools = os.pathsep.join([str(ENVIRONMENT / "bin"), os.environ.get("PATH", os.defpath)])
    native = {"CMAKE_PREFIX_PATH": os.pathsep.join(prefixes), "CMAKE_ARGS": "-DASPHER_NATIVE=ON", "PATH": tools}
    build = ("--no-build-isolation", "--no-binary", "aspher", "-r", str(REQUIREMENTS / "requirements_aspher.txt"))
    return _logged(_pip("--no-cache-dir", *build), log, native)


def _pip(*arguments: str) -> list[str]:
    return [str(environment_python()), "-m", "pip", "install", "-q", *arguments]


def _must(command: list[str], what: str) -> None:
    if subprocess.run(command, env=clean(dict(os.environ)), check=False).returncode:
        raise SetUpError(
            f"{what} could not be installed into {ENVIRONMENT} (the message stands above): check the network and try again"
        )


def _logged(command: list[str], log: Path, further: dict[str, str] | None = None) -> int:
    environ = {**clean(dict(os.environ)), **(further or {})}
    with log.open("ab") as stream:
        return subprocess.run(command, env=environ, stdout=stream, stderr=stream, check=False).returncode


def _last_error(log: Path) -> str:
    lines = [line.strip() for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or ["no message"])[-1]
