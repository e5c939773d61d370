"""Published figures on the seated occupant, beside those of the default model of the scenes."""

from __future__ import annotations

import numpy

from contact_sim_pkg.records.published import Published
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import apparent_mass
from contact_sim_pkg.rigs.vehicle.seat.occupants import softened
from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection, SofteningSection

__all__ = ["VALIDATION"]

FREQUENCIES = numpy.arange(2.0, 10.0, 0.005)  # [Hz]
DEFAULT = OccupantSection().model_of()
FAIRLEY = "Fairley and Griffin 1989, J. Biomech. 22, 81; quoted from later reviews"
HUANG = "Huang and Griffin 2006, J. Sound Vib. 298, 824, and earlier work of the group; quoted from reviews"


def _peak(rms: float | None = None) -> tuple[float, float]:
    """Frequency [Hz] and magnitude over the mass at rest of the largest apparent mass, of links
    softened by an ``rms`` [m/s^2].
    """
    model = DEFAULT if rms is None else softened(DEFAULT, rms, SofteningSection().exponent)
    magnitude = abs(apparent_mass(model, FREQUENCIES)) / model.mass
    return float(FREQUENCIES[magnitude.argmax()]), float(magnitude.max())


VALIDATION = (
    Published(
        machine="occupant", quantity="frequency of the largest apparent mass, rigid seat, about 1 m/s² rms", unit="Hz",
        value="4 to 6 (60 people, median near 5)", band=(4.0, 6.0), source=FAIRLEY, ours=lambda: _peak()[0],
        note="damping pulls the peak of the models below their undamped mode, 5.2 Hz for the default",
    ),
    Published(
        machine="occupant", quantity="largest apparent mass over that at rest", unit="", value="about 1.5", band=(1.3, 1.7),
        source=FAIRLEY, ours=lambda: _peak()[1],
    ),
    Published(
        machine="occupant", quantity="softening: frequency of that peak at 0.25 m/s² rms", unit="Hz", value="6 ± 0.5",
        band=(5.5, 6.5), source=HUANG, ours=lambda: _peak(0.25)[0], fitted=True,
    ),
    Published(
        machine="occupant", quantity="softening: frequency of that peak at 2 m/s² rms", unit="Hz", value="4 ± 0.5",
        band=(3.5, 4.5), source=HUANG, ours=lambda: _peak(2.0)[0], fitted=True,
    ),
)  # fmt: skip
