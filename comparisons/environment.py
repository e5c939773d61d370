"""Environment of its own for a comparison: the peers are installed there and nowhere else.

A peer that cannot be installed is left out, with the reason; the rest goes on. Only the standard library is needed here.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

__all__ = ["LEFT_OUT", "ONE_THREAD", "ROOT", "Environment", "Install", "SetUpError", "clean", "from_wheels", "left_out"]

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = "left_out.json"
STAMP = "stamp"
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")

Install = Callable[["Environment", Path], int]
"""Installs one peer, its output into a log; the status of pip."""


class SetUpError(Exception):
    """The environment cannot be made."""


@dataclass(frozen=True)
class Environment:
    """A virtual environment inside the project.

    Attributes:
        folder: where it is.
        requirements: folder of the pins; `requirements.txt` there is what measuring needs.
        peers: how each is installed, by its name.
        remark: told while it is made.
    """

    folder: Path
    requirements: Path
    peers: Mapping[str, Install]
    remark: str = ""

    @property
    def python(self) -> Path:
        """Its interpreter."""
        return self.folder / "bin" / "python"

    def run(self, module: str, arguments: Sequence[str]) -> int:
        """Make it where needed and run a module of this project in it; the status of that, 2 where it cannot be made."""
        try:
            self.make_current(_tell)
        except SetUpError as error:
            _tell(f"{self.folder.name.removeprefix('.')}: {error}")
            return 2
        command = [str(self.python), "-m", module, *arguments]
        return subprocess.run(command, env=clean(dict(os.environ)), cwd=ROOT, check=False).returncode

    def make_current(self, tell: Callable[[str], None]) -> None:
        """Make it where it is missing or its requirements changed.

        Raises `SetUpError` where even what measuring needs cannot be installed.
        """
        wanted = self._stamp()
        stamp = self.folder / STAMP
        if not stamp.is_file() or stamp.read_text(encoding="utf-8") != wanted:
            self._make(tell)
            stamp.write_text(wanted, encoding="utf-8")

    def pip(self, log: Path, *arguments: str, further: Mapping[str, str] | None = None) -> int:
        """`pip install` in it, output into the log, with further variables; its status."""
        command = [str(self.python), "-m", "pip", "install", "-q", *arguments]
        with log.open("ab") as stream:
            environ = {**clean(dict(os.environ)), **(further or {})}
            return subprocess.run(command, env=environ, stdout=stream, stderr=stream, check=False).returncode

    def pins(self, name: str) -> str:
        """Path of a file of pins."""
        return str(self.requirements / name)

    def _stamp(self) -> str:
        digest = hashlib.sha256(f"{sys.version_info[:2]} {ROOT}".encode())
        for path in [*sorted(self.requirements.glob("requirements*.txt")), Path(__file__)]:
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def _make(self, tell: Callable[[str], None]) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)
        tell(f"making {self.folder.name}/{self.remark and f' ({self.remark})'}")
        self._must([sys.executable, "-m", "venv", str(self.folder)], "the virtual environment")
        needed = [str(self.python), "-m", "pip", "install", "-q", "-r", self.pins("requirements.txt")]
        self._must(needed, "what measuring needs")
        reasons = {}
        for name, install in self.peers.items():
            tell(f"installing {name}")
            log = self.folder / f"{name}.log"
            status = install(self, log)
            if status:
                reasons[name] = (
                    f"pip ended with {status}: {_last_error(log)} (all of it: {self.folder.name}/{log.name})"
                )
        (self.folder / LEFT_OUT).write_text(json.dumps(reasons), encoding="utf-8")

    def _must(self, command: list[str], what: str) -> None:
        if subprocess.run(command, env=clean(dict(os.environ)), check=False).returncode:
            raise SetUpError(
                f"{what} could not be installed into {self.folder} (the message stands above): check the network and try again"
            )


def clean(environ: Mapping[str, str]) -> dict[str, str]:
    """The variables to run in it: this project importable, nothing else, one thread everywhere."""
    kept = {name: value for name, value in environ.items() if not name.startswith("PYTHON")}
    path = os.pathsep.join(str(ROOT / folder) for folder in (".", "contact_sim_pkg", "contact_sim_lab"))
    return {**kept, "PYTHONPATH": path, **dict.fromkeys(ONE_THREAD, "1")}


def from_wheels(pins: str) -> Install:
    """A peer that is installed from wheels alone, by its file of pins."""

    def install(environment: Environment, log: Path) -> int:
        return environment.pip(log, "--only-binary", ":all:", "-r", environment.pins(pins))

    return install


def left_out() -> dict[str, str]:
    """Peers that could not be installed into the environment that runs this, with the reasons."""
    path = Path(sys.prefix) / LEFT_OUT
    found: dict[str, str] = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return found


def _last_error(log: Path) -> str:
    text = log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or ["no message"])[-1]


def _tell(text: str) -> None:
    sys.stderr.write(f"{text}\n")
