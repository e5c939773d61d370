"""The series of a recorded run that summary and report are made of.

What a bag does not hold is empty (no contact, no field) or None (no motion, no ledger, no cost).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_sim_pkg.records.messages import ContactEpisodes
from contact_sim_pkg.report.film import Film
from contact_sim_pkg.report.point_series import PointSeries
from contact_sim_pkg.run.live_parameters import Change
from contact_sim_pkg.run.outputs import Estimate

FloatArray = NDArray[np.float64]
CostSeries: TypeAlias = Mapping[str, FloatArray]
"""Columns of `bench/cost`, one value a block: `time` of the block's start [s], and the fields of
`SolverCost.msg` by name, which gives their units.
"""


class ContactSeries(NamedTuple):
    """Resultants of one contact at the full rate."""

    time: FloatArray
    """[s]"""
    sample_period: float
    """[s]"""
    normal: FloatArray
    """[N]"""
    tangential: FloatArray
    """[N]"""
    approach: FloatArray
    """[m]"""
    effective_height: FloatArray
    """[m] of the ground that a smooth contact would need for the same force"""
    impulses: FloatArray
    """[N] of the road's asperities, beside `normal`; empty without any"""


class PressureMap(NamedTuple):
    """One pressure field with its grid, in the contact's frame."""

    pressure: FloatArray
    """[Pa] [rows, cols], rows along x (forward), cols along y (left)"""
    cell_x: float
    cell_y: float
    """[m] cell size"""
    origin_x: float
    origin_y: float
    """[m] centre of cell (0, 0)"""


class Snapshot(NamedTuple):
    """One field, when it was and what it carries."""

    time: float
    """[s]"""
    load: float
    """[N]"""
    field: PressureMap


class FieldSeries(NamedTuple):
    """Scalars of the pressure field of one contact, and a few maps of it."""

    time: FloatArray
    """[s]"""
    load: FloatArray
    """[N]"""
    peak: FloatArray
    """[Pa]"""
    mean: FloatArray
    """[Pa] load over area"""
    area: FloatArray
    """[m^2]"""
    lame_a: FloatArray
    lame_b: FloatArray
    """[m] semi-axes along x and y of the Lame curve through the contact's boundary; 0 without
    contact
    """
    lame_n: FloatArray
    """exponent of that curve"""
    length: FloatArray
    width: FloatArray
    """[m] along x and y between the outermost edges, which lie between cells; 0 without contact"""
    block_peak: FloatArray
    """[Pa] largest mean pressure over a square of 20 mm, a tread block"""
    highest: PressureMap
    """map at the instant of the largest peak"""
    highest_time: float
    """[s]"""
    average: PressureMap
    """mean over all recorded instants"""
    event: list[Snapshot]
    """the field with the largest load, the fields before and after it, in the order of time"""
    history_time: FloatArray
    """[s] of the rows of `history`"""
    history: FloatArray
    """[N/m] [instants, rows] pressure integrated across the width, on the rows of `average`"""
    history_group: int
    """fields that one row of `history` is the mean of"""
    first: Snapshot
    """the first field of all"""
    touch: Snapshot | None
    """the first field with a load after one without; None where the contact never closes"""
    centre_x: FloatArray
    centre_y: FloatArray
    """[m] centre of pressure, forward and left; 0 without contact"""
    film: Film
    """frames of the whole run"""

    @property
    def heaviest(self) -> Snapshot:
        """The field with the largest load."""
        return max(self.event, key=lambda each: each.load)


class MotionSeries(NamedTuple):
    """Motion of the rig's bodies."""

    time: FloatArray
    """[s]"""
    sample_period: float
    """[s]"""
    position: dict[str, FloatArray]
    """[m] by body"""
    acceleration: dict[str, FloatArray]
    """[m/s^2] by body"""
    velocity: dict[str, FloatArray]
    """[m/s] by body"""


class LedgerSeries(NamedTuple):
    """Energy ledger of the rig."""

    time: FloatArray
    """[s]"""
    kinetic: FloatArray
    potential: FloatArray
    stored: FloatArray
    dissipated: FloatArray
    supplied: FloatArray
    residual: FloatArray
    """[J] each"""


class EpisodeSeries(NamedTuple):
    """Contact episodes in the order in which they ended."""

    point: FloatArray
    """number of the point; -1: all together"""
    touched: FloatArray
    """1: began with a touch; 0: was there from the start of the run"""
    start: FloatArray
    end: FloatArray
    """[s]"""
    compression_work: FloatArray
    restitution_work: FloatArray
    """[J] W_c <= 0 and W_r >= 0"""
    restitution: FloatArray
    """sqrt(W_r / -W_c)"""
    peak_force: FloatArray
    """[N]"""
    largest_approach: FloatArray
    """[m]"""

    def slaps(self) -> EpisodeSeries:
        """The episodes of the whole contact that began with a touch."""
        chosen = (self.point == ContactEpisodes.WHOLE_CONTACT) & (self.touched == 1)
        return EpisodeSeries(*(column[chosen] for column in self))


class TopicCount(NamedTuple):
    """One topic of the bag."""

    name: str
    type: str
    messages: int


class Recording(NamedTuple):
    """Everything that the analysis uses from one bag."""

    name: str
    """of the bag's directory"""
    scene: dict[str, Any]
    """resolved scene; empty for a bag without one"""
    notes: list[str]
    """what the bag says is missing in it"""
    metadata: dict[str, str]
    """texts kept with the recording: versions, excitation, how the run ended; the scene is not
    among them
    """
    topics: list[TopicCount]
    contacts: dict[str, ContactSeries]
    fields: dict[str, FieldSeries]
    motion: MotionSeries | None
    ledger: LedgerSeries | None
    cost: CostSeries | None
    duration: float
    """[s] simulated time of the blocks recorded"""
    episodes: EpisodeSeries | None = None
    points: PointSeries | None = None
    series: Mapping[str, Any] = MappingProxyType({})
    """what only one rig records, by the name of its `records.report.SeriesReader`; what the bag
    does not hold is absent
    """
    estimates: Sequence[Estimate] = ()
    """numerical errors of outputs, the largest of the run"""
    block_errors: Mapping[str, FloatArray] = MappingProxyType({})
    """the same of each block, by column, in its unit"""
    unknown: Mapping[str, str] = MappingProxyType({})
    """what is no number in the messages of a topic such as `seat/force`; a topic without is absent"""
    date: str = ""
    """when the bag's file was written, `2026-11-27`"""
    changes: Sequence[Change] = ()
    """parameters that changed in the run"""
