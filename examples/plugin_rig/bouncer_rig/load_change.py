"""Rate of a normal force through a filter of first order: an observer of the bench's tire."""

import math
from collections.abc import Iterable, Sequence

import numpy

from bouncer_rig.schema import LoadChangeSection
from contact_sim_pkg.bag.block_encoder import Output
from contact_sim_pkg.records.messages import Series
from contact_sim_pkg.scene.resolved_scene import ResolvedScene


class LoadChange:
    """Sees the blocks of one run, in their order."""

    def __init__(self, scene: ResolvedScene) -> None:
        keys = scene.effect("tire", LoadChangeSection)
        assert keys is not None  # the scene calls for it
        self._time, self._smooth = keys.time, math.nan

    def prepare(self) -> None:
        """No kernel."""

    def observe(self, outputs: Sequence[Output]) -> Iterable[Output]:
        """The rate [N/s] of the smoothed force at each sample of the block."""
        for output in outputs:
            if output.topic == "tire/force":
                force = output.record
                rate = numpy.empty(len(force.normal))
                for sample, normal in enumerate(force.normal):
                    before = normal if math.isnan(self._smooth) else self._smooth
                    self._smooth = before + (normal - before) * -math.expm1(-force.sample_period / self._time)
                    rate[sample] = (normal - self._smooth) / self._time
                series = Series(
                    block=force.block,
                    sample_period=force.sample_period,
                    names=("rate",),
                    units=("N/s",),
                    values=rate[None, :],
                )
                yield Output("tire/load_change", output.stamp, series)
