"""Builds the packages with colcon, on the environment's interpreter."""

import os
import re
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

from .errors import SetUpError
from .layout import ABSENT, COLCON_DEFAULTS, ENVIRONMENT, ON_USE, ON_USE_FOLDER, PACKAGES, WORKSPACE, environment_python
from .progress import Count, Progress

_COLCON = "import sys; from colcon_core.command import main; sys.exit(main(argv=sys.argv[1:]))"
_STEP = re.compile(r"\[(\d+)/(\d+)\]|\[ *(\d+)%\]")  # of ninja, of make
_HOOK = Path(__file__).parent / "idl_trees"  # read by each generator of messages as it starts
_IN_ENVIRONMENT = '. "$1/local_setup.sh" && shift && exec "$@"'


def build_workspace(environ: dict[str, str], progress: Progress) -> None:
    """Build from scratch: half a build, or one for another environment, is not worth trusting.

    Raises SetUpError where colcon fails.
    """
    paths = ["src", *map(str, absent_packages(environ))]
    _build(environ, progress, WORKSPACE, paths, "building messages and package", "make setup")


def build_on_use(name: str, environ: dict[str, str], progress: Progress) -> None:
    """Build a package of `ON_USE` from scratch. Raises SetUpError where colcon fails."""
    folder = ON_USE_FOLDER / name
    folder.mkdir(parents=True, exist_ok=True)
    _build(environ, progress, folder, [str(ABSENT / name)], f"building {name} (once)", "what needed it")


def _build(
    environ: dict[str, str], progress: Progress, folder: Path, paths: Iterable[str], what: str, again: str
) -> None:
    """Build the packages at ``paths`` into ``folder``, by colcon. Raises SetUpError where it fails."""
    progress.remove(*(folder / each for each in ("build", "install", "log")))
    trees = folder / "build" / "idl_trees"
    trees.mkdir(parents=True)
    environ = environ | {
        "COLCON_DEFAULTS_FILE": str(COLCON_DEFAULTS),
        "CMAKE_GENERATOR": _generator(environ),
        "IDL_TREES": str(trees),
        # else colcon has one compilation at a time on a busy machine
        "MAKEFLAGS": f"-j{len(os.sched_getaffinity(0))}",
        "PYTHONPATH": ":".join(filter(None, (str(_HOOK), environ.get("PYTHONPATH")))),
        "PYTHONUNBUFFERED": "1",
    }
    # what the builds print says how far they are
    colcon = [str(environment_python()), "-c", _COLCON, "--log-base", str(folder / "log"), "build"]
    colcon += ["--event-handlers", "console_direct+", "--build-base", str(folder / "build")]
    colcon += ["--install-base", str(folder / "install"), "--base-paths", *paths]
    command = ["/bin/sh", "-c", _IN_ENVIRONMENT, "sh", str(ENVIRONMENT), *colcon]
    status = progress.run(command, what, environ=environ, cwd=WORKSPACE, count=built)
    if status:
        raise SetUpError(
            f"colcon build ended with {status} (its messages stand above and in {folder / 'log' / 'latest_build'}): "
            f"correct what it names and call {again} again."
        )


def absent_packages(environ: Mapping[str, str]) -> list[Path]:
    """The packages of `ABSENT` that neither the environment nor a sourced ROS 2 has, but for those built on first use."""
    return [
        package for package in sorted(ABSENT.glob("*"))
        if package.name not in ON_USE and not is_there(package.name, environ)
    ]  # fmt: skip


def is_there(name: str, environ: Mapping[str, str]) -> bool:
    """Whether the environment or a sourced ROS 2 has a package, our own build of it apart."""
    sourced = environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    prefixes = [ENVIRONMENT, *(Path(entry) for entry in sourced if entry)]
    return any((each / "share" / name).is_dir() for each in prefixes if ON_USE_FOLDER not in each.parents)


def built(line: str) -> Count | None:
    """Steps of the build that are done, from a line that CMake's generator prints."""
    match = _STEP.match(line)
    if match is None:
        return None
    return Count(int(match[3]), 100) if match[3] else Count(int(match[1]), int(match[2]))


def is_built() -> bool:
    """Whether the build's products are where they belong."""
    install = WORKSPACE / "install"
    return (install / "setup.bash").is_file() and all((install / p / "share" / p).is_dir() for p in PACKAGES)


def _generator(environ: dict[str, str]) -> str:
    search = f"{ENVIRONMENT / 'bin'}:{environ.get('PATH', '')}"
    return "Ninja" if shutil.which("ninja", path=search) else "Unix Makefiles"
