"""`make setup`: look whether the machine has what is needed, make the environment, build the workspace.

With the name of a package that is built on first use, that one is built instead, where it is nowhere else.
"""

import fcntl
import os
import sys
import time

from . import preflight, stamps
from .environment import make_environment, modules_compiled
from .errors import MISSING, SetUpError
from .layout import ENVIRONMENT, ON_USE, WORKSPACE, environment_python
from .progress import LOOK, Progress
from .underlay import Underlay, clean_environ, find_underlay
from .workspace import build_on_use, build_workspace, is_built, is_there


def set_up() -> None:
    """Bring environment and workspace up to date; what is current is left alone."""
    underlay = find_underlay(os.environ)
    environ = clean_environ(os.environ, underlay)
    key = stamps.environment_key(underlay)
    build_key = stamps.workspace_key(key)
    environment_is_current = environment_python().exists() and stamps.holds(stamps.ENVIRONMENT_STAMP, key)
    if environment_is_current and is_built() and stamps.holds(stamps.WORKSPACE_STAMP, build_key):
        return
    _check_machine(underlay, environ)
    if not environment_is_current:
        source = "from PyPI" if underlay.prefix is None else f"in {underlay.prefix}"
        _PROGRESS.say(
            f"ROS 2 Jazzy {source}, {underlay.python}: making the environment {ENVIRONMENT} (once, about a minute)"
        )
        make_environment(underlay, environ, _PROGRESS)
        stamps.write(stamps.ENVIRONMENT_STAMP, key)
    stamps.WORKSPACE_STAMP.unlink(missing_ok=True)
    with modules_compiled(environ):
        build_workspace(environ, _PROGRESS)
    stamps.write(stamps.WORKSPACE_STAMP, build_key)
    _PROGRESS.say("done; `source ros2_ws/setup.bash` puts `bench` on the PATH")


def set_up_on_use(name: str) -> None:
    """Bring a package that is built on first use up to date; what is current, or there without us, is left alone."""
    if name not in ON_USE:
        raise SetUpError(f"{name!r} is no package that is built on first use: {', '.join(ON_USE)}.", status=MISSING)
    if not (environment_python().exists() and is_built()):
        raise SetUpError("the workspace is not built: call make setup first.", status=MISSING)
    underlay = find_underlay(os.environ)
    environ = clean_environ(os.environ, underlay)
    key = stamps.on_use_key(name, stamps.environment_key(underlay))
    stamp = stamps.on_use_stamp(name)
    if stamps.holds(stamp, key) or is_there(name, environ):
        return
    stamp.unlink(missing_ok=True)
    build_on_use(name, environ, _PROGRESS)
    stamps.write(stamp, key)


def main() -> int:
    """Run the set-up under a lock; returns the exit status: 0, 1 failed, 2 something is missing, 130 interrupted."""
    lock = os.open(WORKSPACE, os.O_RDONLY)
    # Programs started from here hold the lock too: if this one is killed, the next call waits until they have ended.
    os.set_inheritable(lock, True)
    try:
        _wait_for(lock)
        for name in sys.argv[1:]:
            set_up_on_use(name)
        if not sys.argv[1:]:
            set_up()
    except SetUpError as error:
        for fault in error.faults:
            _PROGRESS.say(fault)
        return error.status
    except KeyboardInterrupt:
        _PROGRESS.say("interrupted; the next call starts over")
        return 130
    finally:
        os.close(lock)
    return 0


def _wait_for(lock: int) -> None:
    while True:
        try:
            return fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            _PROGRESS.show("waiting for another set-up of this project")
            time.sleep(LOOK)


def _check_machine(underlay: Underlay, environ: dict[str, str]) -> None:
    facts = preflight.gather(underlay, environ)
    found = preflight.faults(facts) or preflight.compiler_faults(facts, environ)
    if found:
        raise SetUpError(*found, status=MISSING)


_PROGRESS = Progress(sys.stderr)

if __name__ == "__main__":
    sys.exit(main())
