"""`python -m comparisons.dynamics`: makes the comparison's environment where needed and measures in it."""

from __future__ import annotations

import os
import subprocess
import sys

from comparisons.dynamics.environment import environment_python, make_current
from comparisons.field.environment import ROOT, SetUpError, clean


def main() -> int:
    """Hands its arguments to `comparisons.dynamics.run`; the status of that."""
    try:
        make_current(_tell, dict(os.environ))
    except SetUpError as error:
        _tell(f"compare-dynamics: {error}")
        return 2
    command = [str(environment_python()), "-m", "comparisons.dynamics.run", *sys.argv[1:]]
    return subprocess.run(command, env=clean(dict(os.environ)), cwd=ROOT, check=False).returncode


def _tell(text: str) -> None:
    sys.stderr.write(f"{text}\n")


if __name__ == "__main__":
    sys.exit(main())
