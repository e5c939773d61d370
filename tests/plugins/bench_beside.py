"""`bench` in a process of its own, with packages of others beside it."""

import subprocess
import sys
from pathlib import Path

from tests.bench_process import ENVIRONMENT, LONGEST_COMMAND

from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.records.plugins import VARIABLE


class Bench:
    """`bench` with packages of others beside it."""

    def __init__(self, folder: Path) -> None:
        self.beside, self.work = folder / "beside", folder / "work"
        self.beside.mkdir()
        self.work.mkdir()

    @property
    def environment(self) -> dict[str, str]:
        """With the packages beside it on the search path, and all plug-ins let in."""
        kept = {name: value for name, value in ENVIRONMENT.items() if name != VARIABLE}
        return {**kept, "PYTHONPATH": f"{self.beside}:{ENVIRONMENT['PYTHONPATH']}"}

    def python(self, program: str) -> tuple[str, str]:
        """What a program prints, on each of its two streams."""
        command = [sys.executable, "-c", program]
        done = subprocess.run(
            command,
            cwd=self.work,
            env=self.environment,
            capture_output=True,
            text=True,
            check=True,
            timeout=LONGEST_COMMAND,
        )
        return done.stdout, done.stderr

    def __call__(self, *arguments: object, status: int = 0, plugins: str = "") -> str:
        """Both of its streams."""
        done = subprocess.run(
            python_command("contact_sim_pkg.cli.main", *map(str, arguments)), capture_output=True, text=True, cwd=self.work,
            env={**self.environment, **({VARIABLE: plugins} if plugins else {})}, timeout=LONGEST_COMMAND,
        )  # fmt: skip
        printed = done.stdout + done.stderr
        assert done.returncode == status, printed
        return printed

    def add(self, name: str, module: str, **groups: str) -> None:
        """A package of one module that announces something."""
        (self.beside / f"{name}.py").write_text(module)
        described = self.beside / f"{name}-1.2.dist-info"
        described.mkdir()
        (described / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.2\n")
        announced = "".join(f"[contact_sim_pkg.{group}]\n{entry}\n" for group, entry in groups.items())
        (described / "entry_points.txt").write_text(announced)
