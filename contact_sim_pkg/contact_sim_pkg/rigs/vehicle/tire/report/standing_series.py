"""How the tire stands under its standing load, from `tire/standing`."""

from __future__ import annotations

from typing import Any

from contact_sim_pkg.records.messages import TireStanding
from contact_sim_pkg.report.series import Recording


def standing_of(recording: Recording) -> TireStanding | None:
    """The tire of a recording as it stands; None where the bag does not hold it: an older one, or of a tire that no
    static solution carries.
    """
    return recording.series.get("standing")


class StandingReader:
    """The one message of a run."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._found: TireStanding | None = None

    def add(self, _time: float, _type: str, message: Any) -> None:
        """Read a message."""
        self._found = message

    def finish(self) -> TireStanding | None:
        """The last message read; None without any."""
        return self._found
