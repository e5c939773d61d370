"""The acceleration of a bag of anybody as columns, so that it can drive a rig as the file of a data logger does."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.reader import open_bag

__all__ = ["columns"]

FIELDS = {"sensor_msgs/msg/Imu": "linear_acceleration", "geometry_msgs/msg/AccelStamped": "accel.linear"}


def columns(path: Path) -> Iterator[tuple[str, str | None, NDArray[numpy.float64]]]:
    """`time` [s] since the first sample, and the axes `x`, `y`, `z` that the only acceleration of a bag has.

    Their unit is not stated: drivers publish in g too. Raises BagError where the bag holds none, or several.
    """
    bag = open_bag(path)
    found = [name for name, row in bag.topics.items() if row.type in FIELDS and bag.count(name)]
    if len(found) != 1:
        held = (
            f"{len(found)} topics with an acceleration ({', '.join(found)})" if found else "no Imu and no AccelStamped"
        )
        raise BagError(
            f"{path} holds {held}; one is needed: write its table by `bench export {path} --csv --topic NAME` and give that"
        )
    field = FIELDS[bag.topics[found[0]].type]
    values = bag.columns(found[0], ("stamp", *(f"{field}.{axis}" for axis in "xyz")))
    stamps = numpy.asarray(values["stamp"], dtype=numpy.int64)
    # Differences in whole nanoseconds: seconds since 1970 have 2e-7 s as numbers
    yield "time", "s", (stamps - stamps[:1]).astype(numpy.float64) * 1e-9
    for axis in "xyz":
        samples = numpy.asarray(values[f"{field}.{axis}"], dtype=numpy.float64)
        if not numpy.isnan(samples).all():  # not recorded
            yield axis, None, samples
