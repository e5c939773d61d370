"""The road and the vibration that the package ships: made by their generator, readable, and what they claim to be."""

import numpy
import pytest

from contact_sim_pkg.excitation import make_shipped_data as shipped
from contact_sim_pkg.excitation.opencrg.road import OpenCrgRoad
from contact_sim_pkg.excitation.recorded import RecordedVibration

ROAD, VIBRATION = shipped.DATA / shipped.ROAD_FILE, shipped.DATA / shipped.VIBRATION_FILE


def test_the_files_are_those_of_the_generator():
    start = ROAD.read_bytes().index(b"$$$$") + 73
    made = shipped.stone_road()
    assert ROAD.read_bytes()[:start] == made[:start]
    old, new = (numpy.frombuffer(data[start:], ">f4") for data in (ROAD.read_bytes(), made))
    numpy.testing.assert_allclose(old, new, atol=1e-8)
    rows = [[float(f) for f in line.split(",")] for line in VIBRATION.read_text().splitlines()[1:]]
    made_rows = [[float(f) for f in line.split(",")] for line in shipped.floor_vibration().splitlines()[1:]]
    numpy.testing.assert_allclose(rows, made_rows, atol=1.01e-3)  # three decimals; the FFT may round another way


def test_the_files_are_small():
    assert ROAD.stat().st_size <= 300_000
    assert VIBRATION.stat().st_size <= 200_000


@pytest.mark.parametrize("border", ["repeat", "reflect"])
def test_the_stone_road_goes_on_without_a_seam(border):
    road = OpenCrgRoad(ROAD, border_u=border, border_v="none")
    y = numpy.linspace(-0.3, 0.3, 13)
    for seam in (0.0, 10.0, 20.0):
        before, after = road.heights(numpy.array([seam - 1e-6, seam + 1e-6]), y)
        assert numpy.abs(after - before).max() < 1e-5
    height = road.heights(numpy.arange(0.0, 10.0, 0.01), y)
    assert 0.004 < numpy.std(height) < 0.015


def test_the_stone_road_is_curved_and_whole():
    described = OpenCrgRoad(ROAD).describe()
    assert described["heading_change_rad"] == pytest.approx(0.2, abs=1e-6)
    assert described["missing_cells"] == 0


def test_the_floor_vibration_carries_what_a_real_one_carries():
    described = RecordedVibration(VIBRATION, shipped.RATE).describe()
    assert described["duration_s"] == pytest.approx(20.0)
    assert described["axes"]["z"]["clipped_samples"] >= 2
    assert described["axes"]["z"]["full_scale_m_per_s2"] == 19.613
    assert described["tilt_degrees"] == pytest.approx(numpy.degrees(shipped.TILT), abs=0.2)
    assert 0.6 < described["axes"]["z"]["rms_m_per_s2"] < 1.2
