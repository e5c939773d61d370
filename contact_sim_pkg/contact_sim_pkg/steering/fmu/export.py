"""A unit written: description, library, scene and its files, and the command that steps it, in one archive."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from importlib.resources import as_file, files
from pathlib import Path

from contact_sim_pkg import __version__
from contact_sim_pkg.files import RefusedError, check_output, new_file
from contact_sim_pkg.python_process import python_command
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.steering.contact_bench import ContactBench
from contact_sim_pkg.steering.fmu.description import described, model_identifier
from contact_sim_pkg.steering.fmu.variables import inputs_of, outputs_of

__all__ = ["ExportError", "export_fmu"]

COMPILERS = ("cc", "gcc", "clang")
OPTIONS = ("-std=c11", "-O2", "-s", "-shared", "-fPIC", "-o")
LONGEST_COMPILATION = 120.0  # [s]
FIRST_DAY = (1980, 1, 1, 0, 0, 0)  # of an archive: the same scene makes the same bytes


class ExportError(RefusedError):
    """A unit cannot be made on this machine; the text says what is missing."""


def export_fmu(scene: ResolvedScene, path: Path, *, overwrite: bool = False) -> int:
    """Write a scene as a co-simulation unit of FMI 2.0 for this machine; returns its number of outputs.

    Kernels are compiled, and one block is stepped for the names of bodies.

    Raises:
        ExportError: there is no compiler of C, or it fails. FileRefusedError: the file exists, or cannot be written.
        SceneError: an input file of the scene is not there.
    """
    check_output(path, overwrite=overwrite)
    library = compiled_library()
    bench = ContactBench(scene)
    outputs, inputs = outputs_of(bench), inputs_of(bench)
    text, held = scene.to_yaml(), _input_files(scene)
    model = {
        "bench": __version__,
        "outputs": [[each.topic, each.column] for each in outputs],
        "inputs": [each.column for each in inputs],
        "files": {where: f"files/{name}" for where, (name, _) in held.items()},
    }
    guid = hashlib.sha256(json.dumps([model, text]).encode()).hexdigest()[:32]
    content: dict[str, bytes | Path] = {
        "modelDescription.xml": described(scene, guid, outputs, inputs),
        f"binaries/linux64/{model_identifier(scene.name)}.so": library,
        "resources/model.json": json.dumps({"guid": guid, **model}).encode(),
        "resources/scene.yaml": text.encode(),
        "resources/command": "\n".join(_command()).encode(),
        **{f"resources/files/{name}": file for name, file in held.values()},
    }
    with (
        new_file(path, [file for _, file in held.values()], overwrite=overwrite) as stream,
        zipfile.ZipFile(stream, "w") as archive,
    ):
        for name, each in content.items():
            data = each.read_bytes() if isinstance(each, Path) else each
            archive.writestr(zipfile.ZipInfo(name, FIRST_DAY), data, zipfile.ZIP_DEFLATED)
    return len(outputs)


def compiled_library(environment: Mapping[str, str] | None = None) -> bytes:
    """The library of every unit, made by the system's compiler of C, or by ``CC``. Raises ExportError as `export_fmu`."""
    given = os.environ if environment is None else environment
    if sys.platform != "linux" or platform.architecture()[0] != "64bit":
        raise ExportError(f"a unit is a library of 64-bit Linux; this is {sys.platform}")
    command = shlex.split(given.get("CC", "")) or [_first_compiler(given)]
    if not command[0] or not shutil.which(command[0], path=given.get("PATH")):
        missing = (
            f"{command[0]}, as CC says, is not there" if command[0] else f"none of {', '.join(COMPILERS)} is there"
        )
        raise ExportError(
            f"an FMU needs a compiler of C, and {missing}; on Debian and Ubuntu: apt install gcc libc6-dev"
        )
    with tempfile.TemporaryDirectory(prefix="contact-bench-") as folder, as_file(files(__package__)) as sources:
        made = Path(folder) / "unit.so"
        try:
            ended = subprocess.run(
                [*command, *OPTIONS, str(made), str(sources / "fmi2.c"), "-lm"], capture_output=True, text=True,
                errors="replace", timeout=LONGEST_COMPILATION, check=False,
            )  # fmt: skip
        except (OSError, subprocess.TimeoutExpired) as error:
            raise ExportError(f"{command[0]} does not compile the library of the FMU: {error}") from None
        if ended.returncode or not made.is_file():
            said = next((line for line in ended.stderr.splitlines() if "error" in line), "it says nothing")
            raise ExportError(f"{command[0]} does not compile the library of the FMU: {said.strip()}")
        return made.read_bytes()


def _first_compiler(environment: Mapping[str, str]) -> str:
    return next((name for name in COMPILERS if shutil.which(name, path=environment.get("PATH"))), "")


def _input_files(scene: ResolvedScene) -> dict[str, tuple[str, Path]]:
    """By the key of each input file of a scene, its name in the unit and its path."""
    return {where: (f"{where}{path.suffix}", scene.file_path(where)) for where, path in scene.files.items()}


def _command() -> list[str]:
    """The command that `serve` is added to: this bench in this environment, whatever that of the host is."""
    search = [str(Path(__file__).parents[3]), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    libraries = os.environ.get("LD_LIBRARY_PATH")
    keep = ["-u", "LD_LIBRARY_PATH"] if libraries is None else [f"LD_LIBRARY_PATH={libraries}"]
    path = f"PYTHONPATH={os.pathsep.join(dict.fromkeys(filter(None, search)))}"
    command = ["/usr/bin/env", "-u", "PYTHONHOME", *keep, path, *python_command("contact_sim_pkg.cli.main")]
    if broken := next((each for each in command if "\n" in each), ""):
        raise ExportError(f"{broken!r} has a line break: the FMU cannot start the bench there")
    return command
