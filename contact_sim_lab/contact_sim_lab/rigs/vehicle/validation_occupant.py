"""Published figures on the seated occupant, beside those of the models of the literature."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, TypeAlias

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.records.metric import Published
from contact_sim_pkg.rigs.vehicle.seat.biodynamics import apparent_mass, seat_to_head
from contact_sim_pkg.rigs.vehicle.seat.occupants import OCCUPANTS, OccupantModel, softened
from contact_sim_pkg.rigs.vehicle.seat.schema import OccupantSection, SofteningSection

__all__ = ["VALIDATION"]

FREQUENCIES = numpy.arange(2.0, 10.0, 0.005)  # [Hz]
FAIRLEY = "Fairley and Griffin 1989, J. Biomech. 22, 81; quoted from later reviews"
HUANG = "Huang and Griffin 2006, J. Sound Vib. 298, 824, and earlier work of the group; quoted from reviews"
HEADS = "people on rigid seats without backrest: usual values, of no single publication"
DAMPED = "fitted to a whole curve, not to its peak; damping pulls that below the undamped mode of {} Hz"
UNDAMPED = {"iso_5982": 4.51, "wan_schimmels": 4.43}  # [Hz] lowest mode of the models below the band
LINEAR = (
    "58 people on elastic seats had higher peaks than on a rigid one (Vibration 2022, 5(4), 51); a linear occupant has "
    "the same on every seat"
)

Response: TypeAlias = Callable[[OccupantModel, Any], NDArray[numpy.complex128]]


def _frequency(response: Response, model: OccupantModel) -> float:
    """Frequency [Hz] of the largest response."""
    return float(FREQUENCIES[abs(response(model, FREQUENCIES)).argmax()])


def _largest(response: Response, model: OccupantModel) -> float:
    """Magnitude of the largest response."""
    return float(abs(response(model, FREQUENCIES)).max())


def _softened(rms: float) -> float:
    """Frequency [Hz] of the largest apparent mass of the default under an ``rms`` [m/s^2] of the
    seat.
    """
    return _frequency(apparent_mass, softened(OccupantSection().model_of(), rms, SofteningSection().exponent))


def _of(quantity: str, unit: str, value: str, band: tuple[float, float], source: str, ours: Callable[[], float], *,
        fitted: bool = False, note: str = "") -> Published:  # fmt: skip
    return Published(machine="occupant", quantity=quantity, unit=unit, value=value, band=band, source=source, ours=ours,
                     fitted=fitted, note=note)  # fmt: skip


def _of_model(name: str, model: OccupantModel) -> Iterator[Published]:
    """Peaks of the apparent mass of a model, and of its seat-to-head transmissibility where it has a
    head.
    """
    yield _of(f"frequency of the largest apparent mass, rigid seat, about 1 m/s² rms, `{name}`", "Hz",
              "4 to 6 (60 people, median near 5)", (4.0, 6.0), FAIRLEY, lambda: _frequency(apparent_mass, model),
              note=DAMPED.format(UNDAMPED[name]) if name in UNDAMPED else "")  # fmt: skip
    yield _of(f"largest apparent mass over that at rest, `{name}`", "", "about 1.5", (1.3, 1.7), FAIRLEY,
              lambda: _largest(apparent_mass, model) / model.mass)  # fmt: skip
    if model.head is not None:
        yield _of(f"frequency of the largest seat-to-head transmissibility, `{name}`", "Hz", "4 to 6", (4.0, 6.0), HEADS,
                  lambda: _frequency(seat_to_head, model),
                  note="as its apparent mass" if name == "wan_schimmels" else "")  # fmt: skip
        yield _of(f"largest seat-to-head transmissibility, `{name}`", "", "1.2 to 1.8", (1.2, 1.8), HEADS,
                  lambda: _largest(seat_to_head, model), note=LINEAR if name == "iso_5982" else "")  # fmt: skip


VALIDATION = [
    *(each for name, model in OCCUPANTS.items() if model.links for each in _of_model(name, model)),
    _of("softening: frequency of the largest apparent mass at 0.25 m/s² rms", "Hz", "6 ± 0.5", (5.5, 6.5), HUANG,
        partial(_softened, 0.25), fitted=True),
    _of("softening: frequency of the largest apparent mass at 2 m/s² rms", "Hz", "4 ± 0.5", (3.5, 4.5), HUANG,
        partial(_softened, 2.0), fitted=True),
]  # fmt: skip
