"""A pressure field as an image and as a cloud of points."""

from __future__ import annotations

import numpy
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__Image as Image
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__PointCloud2 as PointCloud2
from rosbags.typesys.stores.ros2_jazzy import sensor_msgs__msg__PointField as PointField

from contact_sim_pkg.records.messages import ContactPatch
from contact_sim_pkg.standard.messages import header

CLOUD_FIELDS = ("x", "y", "z", "pressure")
"""Of each point, float32: its place [m] in the frame of the contact, and the pressure [Pa] there."""


def image_of(patch: ContactPatch, stamp: int, frame: str) -> Image:
    """The pressure [Pa] of each cell as `32FC1`, seen from above: the front on top, the left on the left.

    Pixel (r, c) is cell (rows - 1 - r, cols - 1 - c); the sum of the pixels times the area of a cell
    is the load. `stamp` in [ns].
    """
    seen = patch.pressure[::-1, ::-1].astype("<f4", "C")
    rows, cols = seen.shape
    return Image(
        header=header(stamp, frame), height=rows, width=cols, encoding="32FC1", is_bigendian=0, step=4 * cols,
        data=seen.reshape(-1).view(numpy.uint8),
    )  # fmt: skip


def cloud_of(patch: ContactPatch, stamp: int, frame: str) -> PointCloud2:
    """The loaded cells as points in the plane z = 0, row by row; none without contact. `stamp` in [ns]."""
    row, col = numpy.nonzero(patch.pressure > 0.0)
    points = numpy.zeros((len(row), len(CLOUD_FIELDS)), "<f4")
    points[:, 0] = patch.origin_x + row * patch.cell_x
    points[:, 1] = patch.origin_y + col * patch.cell_y
    points[:, 3] = patch.pressure[row, col]
    step = points.itemsize * points.shape[1]
    fields = [
        PointField(name=name, offset=4 * place, datatype=PointField.FLOAT32, count=1)
        for place, name in enumerate(CLOUD_FIELDS)
    ]
    return PointCloud2(
        header=header(stamp, frame), height=1, width=len(points), fields=fields, is_bigendian=False, point_step=step,
        row_step=step * len(points), data=points.reshape(-1).view(numpy.uint8), is_dense=True,
    )  # fmt: skip
