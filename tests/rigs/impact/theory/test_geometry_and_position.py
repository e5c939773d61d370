"""Contact geometry, and where the contact surface lies in both variants: published numbers, volumes by quadrature."""

import math

import mpmath
import pytest

from contact_sim_pkg.rigs.impact.theory import geometry
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.position import SampleHalfSpace, position_variant_1, position_variant_2

RADIUS = 0.01
DEEP = 0.1 * RADIUS
PUBLISHED = SampleHalfSpace(0.8, 0.4)


def test_the_published_numbers_of_both_variants_come_out():
    first = position_variant_1(DEEP, RADIUS, PUBLISHED)
    assert first.alpha == pytest.approx(0.04180, abs=5e-6)
    assert first.surface_depth / first.share_depth == pytest.approx(0.97888, abs=5e-6)
    consistent = position_variant_1(DEEP, RADIUS, PUBLISHED, "consistent")
    k_p = math.sqrt(1.9)
    assert consistent.surface_factor / k_p == pytest.approx(1.120, abs=5e-4)
    assert consistent.alpha == pytest.approx(0.03732, abs=5e-6)
    assert consistent.surface_depth / consistent.share_depth == pytest.approx(0.9812, abs=5e-5)
    second = position_variant_2(DEEP, RADIUS, PUBLISHED)
    assert second.alpha == pytest.approx(0.0374, abs=5e-5)
    assert second.surface_depth / second.share_depth == pytest.approx(0.9626, abs=5e-5)


@pytest.mark.parametrize("depth", [1e-6, 1e-4, 1e-3])
@pytest.mark.parametrize("share", [1.0, 0.6])
def test_volumes_balance_and_are_the_integrals_of_their_areas(depth, share):
    half_space = SampleHalfSpace(share, 0.3, 2e-4, 15.0)
    for variant in (position_variant_1, position_variant_2):
        found = variant(depth, RADIUS, half_space)
        assert found.contact_volume == pytest.approx(
            found.volume - found.compression_volume + found.heating_volume, rel=1e-15
        )
        assert found.heating_volume == pytest.approx(found.volume * 2e-4 * 15.0, rel=1e-14)
        area = math.pi * found.surface_factor**2 * RADIUS * found.surface_depth
        assert 0.5 * area * found.surface_depth == pytest.approx(found.contact_volume, rel=1e-13)
        k_p = math.sqrt(2.0 - depth / RADIUS)
        modulus_ratio = 3.0 * (1.0 - 2.0 * 0.3)  # E1'/K1'
        x1 = share * depth
        work = mpmath.quad(lambda s: mpmath.sqrt(s) ** 3, [0, x1]) * 4.0 / 3.0 * math.sqrt(RADIUS)
        factor = found.surface_factor if variant is position_variant_1 else k_p / math.sqrt(share)
        assert found.compression_volume == pytest.approx(float(work) * factor * modulus_ratio, rel=1e-12)


def test_variant_2_keeps_the_contact_radius_on_the_original_surface():
    found = position_variant_2(DEEP, RADIUS, PUBLISHED)
    radius = geometry.contact_radius(DEEP, RADIUS)
    assert found.surface_factor**2 * RADIUS * found.surface_depth == pytest.approx(radius**2, rel=1e-14)


@pytest.mark.parametrize("rule", ["equal", "consistent"])
def test_an_incompressible_half_space_takes_its_whole_share(rule):
    found = position_variant_1(DEEP, RADIUS, SampleHalfSpace(0.8, 0.5), rule)
    assert found.surface_depth == found.share_depth
    assert found.alpha == 0.0
    assert position_variant_2(DEEP, RADIUS, SampleHalfSpace(0.8, 0.5)).surface_depth == pytest.approx(
        0.8 * DEEP, rel=1e-15
    )


def test_more_compression_than_volume_is_outside_the_model():
    with pytest.raises(ImpactError, match="outside the model"):
        position_variant_1(0.9 * RADIUS, RADIUS, SampleHalfSpace(1.0, -0.5))
    with pytest.raises(ImpactError, match="outside the model"):
        position_variant_2(0.9 * RADIUS, RADIUS, SampleHalfSpace(1.0, -0.5))


def test_the_rule_of_the_factor_and_the_shares_are_checked():
    with pytest.raises(ValueError, match="equal or consistent"):
        position_variant_1(DEEP, RADIUS, PUBLISHED, "iterate")
    with pytest.raises(ImpactError, match="share"):
        position_variant_2(DEEP, RADIUS, SampleHalfSpace(0.0, 0.3))
    with pytest.raises(ImpactError, match="Poisson"):
        position_variant_2(DEEP, RADIUS, SampleHalfSpace(1.0, 0.51))


@pytest.mark.parametrize("ratio", [1e-8, 0.01, 0.3, 1.0])
def test_the_contact_radius_of_a_sphere_on_a_plane_is_that_of_the_cut_sphere(ratio):
    depth = ratio * RADIUS
    expected = float(mpmath.sqrt(mpmath.mpf(RADIUS) ** 2 - (mpmath.mpf(RADIUS) - mpmath.mpf(depth)) ** 2))
    assert geometry.contact_radius(depth, RADIUS) == pytest.approx(expected, rel=1e-12)


def test_two_spheres_intersect_in_the_exact_circle():
    for r1, r2, depth in ((0.01, 0.01, 1e-3), (0.01, 0.03, 2e-3), (0.02, 0.01, 1e-9)):
        with mpmath.workdps(40):
            a, b, x = mpmath.mpf(r1), mpmath.mpf(r2), mpmath.mpf(depth)
            d = a + b - x
            d1 = (d * d + a * a - b * b) / (2 * d)
            expected = float(mpmath.sqrt(a * a - d1 * d1))
        assert geometry.overlap_radius(depth, r1, r2) == pytest.approx(expected, rel=1e-14)
    assert geometry.overlap_radius(0.0, 0.01, 0.02) == 0.0


def test_the_second_order_of_equation_1_is_wrong_for_two_spheres():
    """r^2 = 2 R x - c x^2 with c = (R1^2 - R1 R2 + R2^2)/(R1 + R2)^2: 1/4 for equal spheres, 1 as printed."""
    r1 = r2 = 0.01
    depth = 1e-5
    radius = geometry.effective_radius(r1, r2)
    second = (2.0 * radius * depth - geometry.overlap_radius(depth, r1, r2) ** 2) / depth**2
    assert second == pytest.approx(0.25, rel=1e-2)


def test_depths_beyond_the_geometry_are_noted_and_refused():
    assert geometry.depth_note(0.3 * RADIUS, RADIUS) is None
    assert "0.31" in str(geometry.depth_note(0.31 * RADIUS, RADIUS))
    for depth in (1.0001 * RADIUS, 2.5 * RADIUS, math.nan):
        with pytest.raises(ImpactError):
            geometry.shape_factor(depth, RADIUS)
    assert geometry.contact_radius(-1e-3, RADIUS) == 0.0


def test_a_plane_is_a_radius_without_end():
    assert geometry.effective_radius(0.01, math.inf) == 0.01
    assert geometry.effective_radius(0.02, 0.02) == 0.01
    with pytest.raises(ImpactError, match="two planes"):
        geometry.effective_radius(math.inf, math.inf)
    with pytest.raises(ImpactError, match="radius -1"):
        geometry.effective_radius(-1.0, 1.0)


def test_the_depth_of_the_contact_surface_is_the_share_of_the_half_space():
    assert geometry.depth_factor(RADIUS, RADIUS, 0.2) == pytest.approx(0.8)
