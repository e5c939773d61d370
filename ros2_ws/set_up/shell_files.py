"""The shell files of the environment, by which colcon and `setup.bash` find it as they find /opt/ros/jazzy."""

import os
from pathlib import Path

from .underlay import DISTRIBUTION, Underlay

_PREPEND = r"""_contact_bench_prepend() {  # NAME VALUE: in front, once
  eval "set -- \"\$1\" \"\$2\" \"\${$1:-}\""
  case ":$3:" in *":$2:"*) ;; *) export "$1=$2${3:+:$3}" ;; esac
}
"""

# An empty entry, left since `setup.bash` was sourced, would have Python import from the current folder before a line of ours runs.
_LAUNCHER = """#!/bin/sh
''':'
case ":${{PYTHONPATH:-/}}:" in
  *::*) PYTHONPATH=$(printf %s "$PYTHONPATH" | sed -E "s/:+/:/g; s/^:|:$//g") ;;
esac
exec "{python}" "$0" "$@"
'''
import sys

from contact_sim_pkg.cli.start import main

sys.exit(main())
"""


def write_shell_files(prefix: Path, underlay: Underlay) -> None:
    """Write setup.* and local_setup.* for sh, bash and zsh, and the `bench` command."""
    text = _local_setup(prefix, underlay)
    for stem in ("local_setup", "setup"):
        for shell in ("sh", "bash", "zsh"):
            (prefix / f"{stem}.{shell}").write_text(text, encoding="utf-8")
    bench = prefix / "bin" / "bench"
    # Starts by /bin/sh: the kernel cuts a first line that names a long path.
    bench.write_text(_LAUNCHER.format(python=prefix / "bin" / "python"), encoding="utf-8")
    bench.chmod(0o755)


def _local_setup(prefix: Path, underlay: Underlay) -> str:
    lines = [_PREPEND]
    if underlay.prefix is None:
        libraries = [prefix / "lib", *sorted(prefix.glob("lib/python3.*/site-packages/ros_*.libs"))]
        lines += [
            f'_contact_bench_prepend AMENT_PREFIX_PATH "{prefix}"',
            f'_contact_bench_prepend CMAKE_PREFIX_PATH "{prefix}"',
            f'_contact_bench_prepend LD_LIBRARY_PATH "{os.pathsep.join(map(str, libraries))}"',
            f"export ROS_DISTRO={DISTRIBUTION} ROS_VERSION=2 ROS_PYTHON_VERSION=3",
            "# The library path is set above: the wheels need not restart every interpreter to set it.",
            "export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1",
        ]
    lines += [
        f'_contact_bench_prepend PATH "{prefix}/bin"',
        f'export VIRTUAL_ENV="{prefix}"  # CMake looks for Python here first',
        "unset -f _contact_bench_prepend",
    ]
    return "\n".join(lines) + "\n"
