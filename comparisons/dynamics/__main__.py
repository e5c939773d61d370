"""`python -m comparisons.dynamics`: makes the comparison's environment where needed and measures in it."""

from __future__ import annotations

import sys

from comparisons.dynamics.environment import ENVIRONMENT

if __name__ == "__main__":
    sys.exit(ENVIRONMENT.run("comparisons.dynamics.run", sys.argv[1:]))
