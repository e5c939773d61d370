"""The self-affine road: its height and spectrum against the plane, refusals by name."""

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.roads.self_affine import STRIP, SelfAffineRoad
from contact_sim_pkg.run.sources import make_surface
from contact_sim_pkg.scene.errors import SceneError

X, Y = (side * numpy.arange(count) / count - 0.5 * side for side, count in zip(STRIP, (512, 256), strict=True))


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_height_and_spectrum_over_the_plane_are_those_requested(hurst):
    road = SelfAffineRoad(hurst, 7e-4, 0.2, 0.02, 4)
    heights = road.heights(X, Y)
    assert numpy.sqrt(numpy.mean(heights**2)) == pytest.approx(7e-4, rel=1e-6)
    # Density of each wave vector of the plane; the mean over a ring falls as q^-(2 + 2 H).
    density = numpy.abs(numpy.fft.fft2(heights)) ** 2
    q = numpy.hypot(
        *numpy.meshgrid(numpy.fft.fftfreq(512, STRIP[0] / 512), numpy.fft.fftfreq(256, STRIP[1] / 256), indexing="ij")
    )
    low, high = (density[(q > edge) & (q < 1.25 * edge)].mean() for edge in (8.0, 32.0))
    assert high / low == pytest.approx(4.0 ** -(2.0 + 2.0 * hurst), rel=0.08)
    outside = (q > 51.0) | (q < 4.9)
    assert density[outside].sum() < 1e-9 * density.sum()


def test_the_seed_alone_sets_the_road_and_it_repeats():
    road, again, other = (SelfAffineRoad(0.8, 5e-4, 0.2, 0.02, seed) for seed in (1, 1, 2))
    assert (road.heights(X, Y) == again.heights(X, Y)).all()
    assert numpy.abs(road.heights(X, Y) - other.heights(X, Y)).max() > 1e-4
    assert road.heights(X + 2.0, Y) == pytest.approx(road.heights(X, Y), abs=1e-12)


def test_waves_below_two_cells_are_left_out_with_a_note():
    road = SelfAffineRoad(0.8, 5e-4, 0.2, 0.005, 1, lattice_cell=0.004)
    assert road.describe()["shortest_wavelength_m"] == 0.008
    assert "below 0.008 m (two cells) are left out" in road.describe()["notes"][0]
    with pytest.raises(ExcitationError, match="has no wave"):
        SelfAffineRoad(0.8, 5e-4, 0.2, 0.005, 1, lattice_cell=0.2)
    with pytest.raises(ExcitationError, match=r"no wave between 0\.82 and 0\.83 m; take a wider range"):
        SelfAffineRoad(0.8, 5e-4, 0.83, 0.82, 1)
    with pytest.raises(ExcitationError, match=r"hurst of the self-affine road is 1\.5"):
        SelfAffineRoad(1.5, 5e-4, 0.2, 0.005, 1)


def test_a_scene_makes_it_by_its_keys_and_refuses_waves_out_of_order():
    road = "road={kind: self_affine, hurst: 0.6, rms: 1e-3}"
    found = make_surface(resolved("tire_half_space", road), 1e-3).describe()
    names = ("hurst", "rms_m", "shortest_wavelength_m", "longest_wavelength_m")
    assert [found[name] for name in names] == [0.6, 1e-3, 0.005, 0.2]
    with pytest.raises(SceneError, match=r"road.shortest_wavelength: .*0\.3 m is not below longest_wavelength"):
        resolved("tire_half_space", road, "road.shortest_wavelength=0.3")
