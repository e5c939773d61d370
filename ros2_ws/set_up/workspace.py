"""Builds the packages with colcon, on the environment's interpreter."""

import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from .errors import SetUpError
from .layout import ABSENT, COLCON_DEFAULTS, ENVIRONMENT, PACKAGES, WORKSPACE, environment_python
from .progress import Count, Progress

_COLCON = "import sys; from colcon_core.command import main; sys.exit(main(argv=sys.argv[1:]))"
_STEP = re.compile(r"\[(\d+)/(\d+)\]|\[ *(\d+)%\]")  # of ninja, of make
_HOOK = Path(__file__).parent / "idl_trees"  # read by each generator of messages as it starts
_IN_ENVIRONMENT = '. "$1/local_setup.sh" && shift && exec "$@"'


def build_workspace(environ: dict[str, str], progress: Progress) -> None:
    """Build from scratch: half a build, or one for another environment, is not worth trusting.

    Raises SetUpError where colcon fails.
    """
    progress.remove(*(WORKSPACE / folder for folder in ("build", "install", "log")))
    trees = WORKSPACE / "build" / "idl_trees"
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
    colcon = [str(environment_python()), "-c", _COLCON, "build", "--event-handlers", "console_direct+"]
    colcon += ["--base-paths", "src", *(str(path) for path in absent_packages(environ))]
    command = ["/bin/sh", "-c", _IN_ENVIRONMENT, "sh", str(ENVIRONMENT), *colcon]
    status = progress.run(command, "building messages and package", environ=environ, cwd=WORKSPACE, count=built)
    if status:
        raise SetUpError(
            f"colcon build ended with {status} (its messages stand above and in {WORKSPACE / 'log' / 'latest_build'}): "
            "correct what it names and call make setup again."
        )


def absent_packages(environ: Mapping[str, str]) -> list[Path]:
    """The packages of `ABSENT` that neither the environment nor a sourced ROS 2 has."""
    sourced = environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    prefixes = [ENVIRONMENT, *(Path(entry) for entry in sourced if entry)]
    return [
        package for package in sorted(ABSENT.glob("*"))
        if not any((prefix / "share" / package.name).is_dir() for prefix in prefixes)
    ]  # fmt: skip


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
