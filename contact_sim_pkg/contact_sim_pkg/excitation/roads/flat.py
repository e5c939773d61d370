"""The even road."""

from typing import Any, ClassVar, Literal

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.blocks import Surface
from contact_sim_pkg.excitation.kinds import RoadKind, Setting

Array = NDArray[numpy.float64]


class FlatRoad(RoadKind):
    """An even road at height 0."""

    is_even: ClassVar[bool] = True

    kind: Literal["flat"]

    def surface(self, setting: Setting) -> Surface:
        """See RoadKind."""
        return self

    def shortest_wave(self, limit: float) -> None:
        """See RoadKind."""

    def heights(self, x: Array, y: Array) -> Array:
        """Zeros, [len(x), len(y)]."""
        return numpy.zeros((len(x), len(y)))

    def describe(self) -> dict[str, Any]:
        """See blocks.Surface."""
        return {"kind": self.kind, "notes": []}


KIND = FlatRoad
