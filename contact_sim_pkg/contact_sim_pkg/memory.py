"""Memory that reading what others wrote may take: estimated, and refused, before it is taken."""

from __future__ import annotations

import os

from contact_sim_pkg.files import RefusedError, printable

__all__ = ["GIBIBYTE", "LIMIT", "MemoryLimitError", "refuse_above_limit"]

GIBIBYTE = 1 << 30
LIMIT = 1.0
"""[GiB] `limits.memory` of a scene that states none, and of every reader: a bag does not set its own limit."""
OF_READERS = "CONTACT_BENCH_MEMORY"
"""environment variable with another limit of the readers [GiB]"""


class MemoryLimitError(RefusedError):
    """What is read needs more memory than is allowed."""


def refuse_above_limit(needed: float, what: str) -> None:
    """Raise MemoryLimitError where reading `what` needs more than the limit.

    Args:
        needed: [bytes], estimated.
        what: subject of the sentence.
    """
    limit = _limit()
    if needed > limit * GIBIBYTE:
        raise MemoryLimitError(
            f"{what} needs {needed / GIBIBYTE:.3g} GiB of memory, limit {limit:g} GiB (limits.memory); "
            f"{OF_READERS}=GIB in the environment sets another"
        )


def _limit() -> float:
    """[GiB] of a reader. RefusedError where the environment states what is no number above 0."""
    text = os.environ.get(OF_READERS, str(LIMIT))
    try:
        limit = float(text)
    except ValueError:
        limit = 0.0
    if not limit > 0.0:
        raise RefusedError(f"{OF_READERS}={printable(text, 40)}: a number of GiB above 0 is needed, such as {LIMIT:g}")
    return limit
