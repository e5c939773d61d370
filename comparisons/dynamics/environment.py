"""The comparison's own environment, `.compare-dynamics/`: the peers are installed there and nowhere else.

A peer that cannot be installed is left out, with the reason; the rest goes on. Only the standard library is needed here.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from comparisons.field.environment import ROOT, SetUpError, clean

__all__ = ["ENVIRONMENT", "LEFT_OUT", "PEERS", "environment_python", "make_current"]

ENVIRONMENT = ROOT / ".compare-dynamics"
REQUIREMENTS = Path(__file__).parent
LEFT_OUT = "left_out.json"
STAMP = "stamp"
PEERS = ("mujoco", "pybullet")


def environment_python() -> Path:
    """Its interpreter."""
    return ENVIRONMENT / "bin" / "python"


def make_current(tell: Callable[[str], None], environ: dict[str, str]) -> None:
    """Make the environment where it is missing or its requirements changed.

    Raises `SetUpError` where even what measuring needs cannot be installed.
    """
    digest = hashlib.sha256(f"{sys.version_info[:2]} {ROOT}".encode())
    for path in [*sorted(REQUIREMENTS.glob("requirements*.txt")), Path(__file__)]:
        digest.update(path.read_bytes())
    stamp = ENVIRONMENT / STAMP
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != digest.hexdigest():
        _make(tell, clean(environ))
        stamp.write_text(digest.hexdigest(), encoding="utf-8")


def _make(tell: Callable[[str], None], environ: dict[str, str]) -> None:
    shutil.rmtree(ENVIRONMENT, ignore_errors=True)
    tell(f"making {ENVIRONMENT.name}/")
    for command in ([sys.executable, "-m", "venv", str(ENVIRONMENT)], _pip("requirements.txt")):
        if subprocess.run(command, env=environ, check=False).returncode:
            raise SetUpError(
                f"{ENVIRONMENT} could not be made (the message stands above): check the network and try again"
            )
    left_out: dict[str, str] = {}
    for name in PEERS:
        tell(f"installing {name}")
        command = _pip(f"requirements_{name}.txt", "--only-binary", ":all:")
        done = subprocess.run(command, env=environ, check=False, capture_output=True, text=True)
        if done.returncode:
            lines = [line for line in done.stderr.splitlines() if "error" in line.lower()] or ["no message"]
            left_out[name] = f"pip ended with {done.returncode}: {lines[-1].strip()}"
    (ENVIRONMENT / LEFT_OUT).write_text(json.dumps(left_out), encoding="utf-8")


def _pip(requirements: str, *options: str) -> list[str]:
    return [str(environment_python()), "-m", "pip", "install", "-q", *options, "-r", str(REQUIREMENTS / requirements)]
