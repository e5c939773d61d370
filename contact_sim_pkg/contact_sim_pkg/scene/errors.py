"""Faults of a scene: where they are, and one sentence each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.records.breach import Breach

__all__ = ["Breach", "Fault", "SceneError"]


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault of a scene.

    Attributes:
        file: path of the scene file, or the command-line option that gave the value.
        line: line in the file, from 1; 0 when the value came from an option.
        column: column in the line, from 1; 0 when the value came from an option.
        where: dotted path of the key, empty for a fault of the whole file.
        sentence: what is wrong, the value, what is allowed, the cure.
    """

    file: str
    line: int
    column: int
    where: str
    sentence: str

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return ": ".join(part for part in (place, self.where, self.sentence) if part)


class SceneError(RefusedError, ValueError):
    """A scene that cannot run; carries every fault that was found, ordered by line.

    Faults of command-line options come after those of the file, in the order of the options.
    """

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = sorted(faults, key=lambda fault: (fault.line == 0, fault.line, fault.column))
        super().__init__("\n".join(str(fault) for fault in self.faults))
