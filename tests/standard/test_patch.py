"""A patch as an image and as a cloud, against Hertz' closed form and single cells."""

import numpy
import pytest
from tests.standard.records import CELL_X, CELL_Y, COLS, ORIGIN_X, ORIGIN_Y, PEAK, RADIUS, ROWS, hertz_patch, patch_of

from contact_sim_pkg.standard.messages import encoded, store
from contact_sim_pkg.standard.patch import cloud_of, image_of

STAMP = 12_345_678_901


def read(message):
    """As a subscriber reads it."""
    return store().deserialize_cdr(encoded(message), message.__msgtype__)


def pixels(image):
    return numpy.frombuffer(image.data, "<f4").reshape(image.height, image.width)


def points(cloud):
    kind = numpy.dtype([(field.name, "<f4") for field in cloud.fields])
    assert [(field.offset, field.datatype, field.count) for field in cloud.fields] == [
        (kind.fields[name][1], 7, 1) for name in kind.names
    ]
    assert kind.itemsize == cloud.point_step
    return numpy.frombuffer(cloud.data, kind)


def test_the_sum_of_an_image_times_the_area_of_a_cell_is_the_force():
    image = read(image_of(hertz_patch(), STAMP, "tire_contact"))
    force = pixels(image).sum(dtype=float) * CELL_X * CELL_Y
    assert force == pytest.approx(2.0 * numpy.pi * RADIUS**2 * PEAK / 3.0, rel=1e-3)  # of the sum on the grid


def test_an_image_is_seen_from_above_with_the_front_on_top_and_the_left_on_the_left():
    pressure = numpy.zeros((ROWS, COLS))
    pressure[-1, -1], pressure[0, 0], pressure[-1, 5] = 1.0, 2.0, 3.0  # front left, rear right, front
    image = read(image_of(patch_of(pressure), STAMP, "tire_contact"))
    seen = pixels(image)
    assert (seen[0, 0], seen[-1, -1], seen[0, COLS - 6]) == (1.0, 2.0, 3.0)
    assert seen.sum() == 6.0


def test_an_image_states_its_layout_stamp_and_frame():
    image = read(image_of(hertz_patch(), STAMP, "tire_contact"))
    assert (image.height, image.width, image.encoding, image.is_bigendian, image.step) == (
        ROWS,
        COLS,
        "32FC1",
        0,
        4 * COLS,
    )
    assert (image.header.stamp.sec, image.header.stamp.nanosec) == (12, 345_678_901)
    assert image.header.frame_id == "tire_contact"
    assert len(image.data) == image.step * image.height


def test_the_points_of_a_cloud_lie_where_the_cells_are_loaded():
    cloud = read(cloud_of(hertz_patch(), STAMP, "seat_contact"))
    found = points(cloud)
    height = PEAK * numpy.sqrt(1.0 - (found["x"].astype(float) ** 2 + found["y"].astype(float) ** 2) / RADIUS**2)
    # the square root is steep at the edge: places are rounded to float32
    assert found["pressure"] == pytest.approx(height, rel=1e-4, abs=1e-3 * PEAK)
    assert len(found) * CELL_X * CELL_Y == pytest.approx(numpy.pi * RADIUS**2, rel=1e-2)
    assert not found["z"].any()
    assert (cloud.height, cloud.width, cloud.row_step) == (1, len(found), 16 * len(found))
    assert cloud.header.frame_id == "seat_contact"


def test_a_cloud_has_one_point_a_loaded_cell_at_its_centre():
    pressure = numpy.zeros((ROWS, COLS))
    pressure[7, 11] = 5.0
    (point,) = points(read(cloud_of(patch_of(pressure), STAMP, "tire_contact")))
    assert point["x"] == pytest.approx(ORIGIN_X + 7 * CELL_X, rel=1e-6)
    assert point["y"] == pytest.approx(ORIGIN_Y + 11 * CELL_Y, rel=1e-6)
    assert point["pressure"] == 5.0


def test_without_contact_a_cloud_is_empty():
    cloud = read(cloud_of(patch_of(numpy.zeros((ROWS, COLS))), STAMP, "tire_contact"))
    assert (cloud.width, len(cloud.data)) == (0, 0)
