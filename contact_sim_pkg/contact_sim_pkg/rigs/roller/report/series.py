"""What a bag of the roller rig holds, in one pass."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.bag.messages import record_of
from contact_sim_pkg.records.messages import RollerContact, RollerStability, RollerTrack, RollerVolumes
from contact_sim_pkg.report.series import Recording

FloatArray = NDArray[np.float64]

KINDS: dict[str, Any] = {
    f"contact_msgs_defs/msg/{kind.__name__}": kind
    for kind in (RollerContact, RollerTrack, RollerVolumes, RollerStability)
}


class RollerSeries(NamedTuple):
    """The roller of a run; what the scene does not record is empty."""

    time: FloatArray  # [s] of the samples
    contact: RollerContact  # of all blocks
    tracks: list[RollerTrack]
    volumes: list[RollerVolumes]
    stability: list[RollerStability]

    def dangerous_volumes(self) -> FloatArray:
        """[m^3] [reports] of any stress, with the bending of the shaft where it bends."""
        kinds = ((each.with_bending if len(each.with_bending) else each.volume) for each in self.volumes)
        return np.array([float(each[-1]) for each in kinds])


def roller_of(recording: Recording) -> RollerSeries | None:
    """Roller of a recording; None where the bag holds no state of it."""
    return recording.series.get("roller")


class RollerReader:
    """Reads messages in the order of the bag."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self._taken: dict[Any, list[Any]] = {kind: [] for kind in KINDS.values()}
        self._times: list[FloatArray] = []

    def add(self, seconds: float, type_name: str, message: Any) -> None:
        """Read a message of one of its types. Raises MessageError where its arrays do not fit."""
        kind = KINDS[type_name]
        value = record_of(kind, message)
        self._taken[kind].append(value)
        if isinstance(value, RollerContact):
            self._times.append(seconds + value.period * np.arange(len(value.load), dtype=np.float64))

    def finish(self) -> RollerSeries | None:
        """What was read; None without a contact."""
        blocks = self._taken[RollerContact]
        if not blocks:
            return None
        names = [name for name in RollerContact._fields if name not in ("block", "period")]
        columns = {name: np.concatenate([getattr(each, name) for each in blocks]) for name in names}
        contact = RollerContact(block=0, period=blocks[0].period, **columns)
        rest = (self._taken[kind] for kind in (RollerTrack, RollerVolumes, RollerStability))
        return RollerSeries(np.concatenate(self._times), contact, *rest)
