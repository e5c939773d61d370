"""Makes the Python environment inside the project: ROS 2 from PyPI, or what a sourced ROS 2 lacks."""

import re
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

from .errors import SetUpError
from .layout import BUILD_TOOLS_LOCK, ENVIRONMENT, LOCK, environment_python
from .relocation import relocate
from .shell_files import write_shell_files
from .underlay import Underlay

CMAKE_OLDEST = (3, 20)

# What a ROS 2 of the system has in versions of its own, which its message generators and classes were made with.
SYSTEM_NAMES = {"catkin-pkg", "empy", "lark-parser", "numpy", "pyyaml", "setuptools"}


def make_environment(underlay: Underlay, environ: dict[str, str]) -> None:
    """Make the environment anew: virtual environment, locked packages, paths, shell files.

    Raises SetUpError where venv or pip fail.
    """
    _remove(ENVIRONMENT)
    options = [] if underlay.prefix is None else ["--system-site-packages"]
    _run([str(underlay.python), "-m", "venv", *options, str(ENVIRONMENT)], environ, "the virtual environment")
    (ENVIRONMENT / "base_python").write_text(f"{underlay.python}\n", encoding="utf-8")
    _install(underlay, environ)
    if underlay.prefix is None:
        relocate(ENVIRONMENT, environment_python(), environ)
    write_shell_files(ENVIRONMENT, underlay)


def system_requirements(lock: Iterable[str], system_has_colcon: bool) -> list[str]:
    """The lines of the lock that a sourced ROS 2 lacks."""
    return [line for line in lock if not _comes_with_ros(line, system_has_colcon)]


def missing_build_tools(environ: dict[str, str]) -> list[str]:
    """The names, cmake and ninja, that have to come from PyPI."""
    path = environ.get("PATH")
    missing = [] if _cmake_version(environ) >= CMAKE_OLDEST else ["cmake"]
    if not any(shutil.which(name, path=path) for name in ("ninja", "make", "gmake")):
        missing.append("ninja")
    return missing


def _install(underlay: Underlay, environ: dict[str, str]) -> None:
    lines = _pins(LOCK)
    if underlay.prefix is not None:
        lines = system_requirements(lines, _has_colcon(environ))
    tools = missing_build_tools(environ)
    lines += [pin for pin in _pins(BUILD_TOOLS_LOCK) if _name(pin) in tools]
    wanted = ENVIRONMENT / "requirements.txt"
    wanted.write_text("\n".join(lines) + "\n", encoding="utf-8")
    command = [str(environment_python()), "-m", "pip", "install", "-q", "--prefer-binary", "-r", str(wanted)]
    _run(command, environ, "the locked packages")


def _pins(lock: Path) -> list[str]:
    lines = (line.strip() for line in lock.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def _name(pin: str) -> str:
    return re.split(r"[\[=<>;~! ]", pin, maxsplit=1)[0].lower().replace("_", "-")


def _comes_with_ros(pin: str, system_has_colcon: bool) -> bool:
    name = _name(pin)
    return name.startswith("ros-") or name in SYSTEM_NAMES or (system_has_colcon and name.startswith("colcon-"))


def _has_colcon(environ: dict[str, str]) -> bool:
    command = [str(environment_python()), "-c", "import colcon_core, colcon_cmake, colcon_ros, colcon_defaults"]
    return subprocess.run(command, env=environ, cwd="/", capture_output=True, check=False).returncode == 0


def _cmake_version(environ: dict[str, str]) -> tuple[int, int]:
    if not shutil.which("cmake", path=environ.get("PATH")):
        return (0, 0)
    shown = subprocess.run(["cmake", "--version"], env=environ, capture_output=True, text=True, check=False).stdout
    match = re.search(r"version (\d+)\.(\d+)", shown)
    return (int(match[1]), int(match[2])) if match else (0, 0)


def _remove(folder: Path) -> None:
    if folder.is_symlink() or folder.is_file():
        folder.unlink()
    elif folder.exists():
        shutil.rmtree(folder)


def _run(command: list[str], environ: dict[str, str], what: str) -> None:
    status = subprocess.run(command, env=environ, cwd="/", check=False, close_fds=False).returncode
    if status:
        raise SetUpError(
            f"{what} could not be made ({Path(command[0]).name} ended with {status}, its message stands above): "
            "check the network and call make setup again, it starts over."
        )
