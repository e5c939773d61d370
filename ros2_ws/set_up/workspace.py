"""Builds both packages with colcon, on the environment's interpreter."""

import shutil
import subprocess

from .errors import SetUpError
from .layout import COLCON_DEFAULTS, ENVIRONMENT, PACKAGES, WORKSPACE, environment_python

_COLCON = "import sys; from colcon_core.command import main; sys.exit(main(argv=sys.argv[1:]))"
_IN_ENVIRONMENT = '. "$1/local_setup.sh" && shift && exec "$@"'


def build_workspace(environ: dict[str, str]) -> None:
    """Build from scratch: half a build, or one for another environment, is not worth trusting.

    Raises SetUpError where colcon fails.
    """
    for folder in ("build", "install", "log"):
        shutil.rmtree(WORKSPACE / folder, ignore_errors=True)
    environ = environ | {"COLCON_DEFAULTS_FILE": str(COLCON_DEFAULTS), "CMAKE_GENERATOR": _generator(environ)}
    colcon = [str(environment_python()), "-c", _COLCON, "build"]
    command = ["/bin/sh", "-c", _IN_ENVIRONMENT, "sh", str(ENVIRONMENT), *colcon]
    status = subprocess.run(command, env=environ, cwd=WORKSPACE, check=False, close_fds=False).returncode
    if status:
        raise SetUpError(
            f"colcon build ended with {status} (its messages stand above and in {WORKSPACE / 'log' / 'latest_build'}): "
            "correct what it names and call make setup again."
        )


def is_built() -> bool:
    """Whether the build's products are where they belong."""
    install = WORKSPACE / "install"
    return (install / "setup.bash").is_file() and all((install / p / "share" / p).is_dir() for p in PACKAGES)


def _generator(environ: dict[str, str]) -> str:
    search = f"{ENVIRONMENT / 'bin'}:{environ.get('PATH', '')}"
    return "Ninja" if shutil.which("ninja", path=search) else "Unix Makefiles"
