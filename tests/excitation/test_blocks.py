"""Blocks: place, overlap, independence of the order, refusals."""

import numpy
import pytest

from contact_sim_pkg.excitation.blocks import RoadBlocks, VibrationBlocks
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import Setting
from contact_sim_pkg.excitation.roads.cleat import CleatRoad
from contact_sim_pkg.excitation.roads.iso8608 import Iso8608Road
from contact_sim_pkg.excitation.signals import AxisSignal
from contact_sim_pkg.excitation.travel import Travel
from contact_sim_pkg.excitation.vibrations.noise import NoiseSignal
from contact_sim_pkg.excitation.vibrations.sine import Sine


class Plane:
    """Height 2 x + 3 y, so that every node tells where it lies."""

    def heights(self, x, y):
        return 2.0 * x[:, None] + 3.0 * y[None, :]

    def describe(self):
        return {"kind": "plane", "notes": []}


def plane_blocks(points, half_length=0.1, cols=5):
    return RoadBlocks(Plane(), Travel(points), 0.01, 0.01, 0.02, half_length, cols)


def test_nodes_lie_where_the_message_says():
    patch = plane_blocks([(0.0, 20.0)]).block(7)
    rows, cols = patch.height.shape
    x = (patch.first_row + numpy.arange(rows)) * patch.cell_x
    y = (numpy.arange(cols) - (cols - 1) / 2) * patch.cell_y
    numpy.testing.assert_allclose(patch.height, 2.0 * x[:, None] + 3.0 * y, rtol=1e-6, atol=1e-6)
    assert patch.height.dtype == numpy.float32


@pytest.mark.parametrize("points", [[(0.0, 20.0)], [(0.0, 0.0)], [(0.0, 10.0), (0.1, -10.0)]])
def test_a_strip_covers_travel_and_reach_with_a_node_to_spare(points):
    travel, blocks = Travel(points), plane_blocks(points)
    for block in range(12):
        patch = blocks.block(block)
        first = patch.first_row * patch.cell_x
        last = (patch.first_row + len(patch.height) - 1) * patch.cell_x
        path = [travel.position(t) for t in numpy.linspace(block * 0.01, (block + 1) * 0.01, 20)]
        assert first + patch.cell_x <= min(path) - 0.1 + 1e-9
        assert last - patch.cell_x >= max(path) + 0.1 - 1e-9
        assert (patch.travel_start, patch.travel_end) == (path[0], pytest.approx(path[-1], abs=1e-12))


def test_standing_still_gives_the_same_strip_in_every_block():
    blocks = plane_blocks([(0.0, 0.0)])
    numpy.testing.assert_array_equal(blocks.block(0).height, blocks.block(900).height)
    assert blocks.block(0).first_row == blocks.block(900).first_row


def test_overlapping_strips_agree_to_the_bit_and_in_any_order():
    def make():
        road = Iso8608Road(256e-6, 3, length=50.0, texture_wavelength=0.05)
        return RoadBlocks(road, Travel([(0.0, 15.0)]), 0.01, 0.005, 0.005, 0.2, 16)

    forward, backward = make(), make()
    patches = {block: forward.block(block) for block in (0, 1, 2, 40)}
    for block in (40, 2, 1, 0):
        assert backward.block(block).height.tobytes() == patches[block].height.tobytes()
    shift = patches[1].first_row - patches[0].first_row
    common = patches[0].height[shift : shift + len(patches[1].height)]
    assert len(common) > 0
    assert common.tobytes() == patches[1].height[: len(common)].tobytes()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 0.01, 0.01, 0.1, 4), "block_length"),
        ((0.01, -1.0, 0.01, 0.1, 4), "cell_x"),
        ((0.01, 0.01, float("inf"), 0.1, 4), "cell_y"),
        ((0.01, 0.01, 0.01, -0.1, 4), "half_length"),
        ((0.01, 0.01, 0.01, 0.1, 0), "0 cols"),
        ((0.01, 1e-6, 0.01, 0.1, 100), "limit 4000000"),
    ],
)
def test_a_bad_lattice_is_refused(arguments, message):
    with pytest.raises(ExcitationError, match=message):
        RoadBlocks(Plane(), Travel([(0.0, 10.0)]), *arguments)


def test_a_surface_without_heights_is_refused_by_its_block():
    class Hole(Plane):
        def heights(self, x, y):
            return numpy.where(x[:, None] > 1.0, numpy.nan, super().heights(x, y))

    blocks = RoadBlocks(Hole(), Travel([(0.0, 10.0)]), 0.01, 0.01, 0.01, 0.1, 3)
    place = r"block 12: .* no finite height .*: it is nan at x = 1\.08 m, y = -0\.01 m"
    with pytest.raises(ExcitationError, match=place):
        blocks.block(12)


def test_samples_lie_at_whole_multiples_of_the_period_and_share_the_ends():
    blocks = VibrationBlocks(AxisSignal(z=[Sine(2.0, 7.0)]), 0.01, 1000.0)
    first, second = blocks.block(4), blocks.block(5)
    time = numpy.arange(40, 51) / 1000.0
    numpy.testing.assert_allclose(first.acceleration_z, 2.0 * numpy.sin(2.0 * numpy.pi * 7.0 * time), atol=1e-13)
    assert first.acceleration_z[-1] == second.acceleration_z[0]
    assert (len(first.acceleration_z), first.sample_period) == (11, 0.001)
    assert not first.acceleration_x.any()


def test_vibration_blocks_are_the_same_bits_in_any_order():
    def make():
        return VibrationBlocks(AxisSignal(x=[NoiseSignal(1.0, 1.0, 40.0, 5)]), 0.01, 2000.0)

    forward, backward = make(), make()
    wanted = [forward.block(block).acceleration_x.tobytes() for block in range(5)]
    assert [backward.block(block).acceleration_x.tobytes() for block in (4, 3, 2, 1, 0)] == wanted[::-1]


def test_a_rate_that_does_not_fit_the_block_is_refused():
    with pytest.raises(ExcitationError, match=r"4\.76 samples at 476"):
        VibrationBlocks(AxisSignal(), 0.01, 476.0)


@pytest.mark.parametrize(("length", "noted"), [(0.005, True), (0.05, False)])
def test_an_obstacle_that_can_fall_between_the_nodes_is_noted(length, noted):
    cleat = CleatRoad(kind="cleat", position=1.0, height=0.02, length=length)
    surface = cleat.surface(Setting(1, 1.0, 0.01, None, cell=0.006))
    road = RoadBlocks(surface, Travel([(0.0, 5.0)]), 0.01, 0.006, 0.006, 0.2, 9)
    notes = road.describe()["notes"]
    assert any("falls between two nodes" in note for note in notes) == noted
