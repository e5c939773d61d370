"""Tables of impacts: accuracy under noise, rank, and the words for what is missing."""

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_sim_lab.identify.twins.block_impacts import random_block_impacts
from contact_sim_pkg.identify.contact.coulomb import one_impact, two_point
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion import geometry
from contact_sim_pkg.identify.motion.rotation import exponential
from contact_sim_pkg.identify.naming import unobservable
from contact_sim_pkg.identify.table import ImpactTable, estimate_from_impacts, problem_of_impacts

SIDE = 0.1
AXIS = numpy.array([0.0, 1.0, 0.0])
SQUARE = geometry.box([SIDE] * 3)
INERTIA = numpy.array([[4e-3, 3e-4, -2e-4], [3e-4, 3e-3, 1e-4], [-2e-4, 1e-4, 2e-3]])  # I0/m of a lopsided box
LOPSIDED = geometry.box([0.10, 0.14, 0.20])


def planar_estimate(random, count, speed_noise, spin_noise):
    """Estimate from a table of block impacts with noise."""
    exact = random_block_impacts(random, count)
    table = ImpactTable(
        exact.rotation,
        *(field + speed_noise * random.normal(size=field.shape) for field in exact[1:3]),
        *(field + spin_noise * random.normal(size=field.shape) for field in exact[3:5]),
    )
    return estimate_from_impacts(problem_of_impacts(table, SQUARE, (speed_noise or 1e-13, spin_noise or 1e-12), AXIS))


def spatial_table(count, seed=0, push=None):
    """Impacts of the lopsided box with random impulses; the balance r x pi = R S R^T (w+ - w-) makes the spin after."""
    random = numpy.random.default_rng(seed)
    rotation = exponential(random.normal(size=(count, 3)))
    before, spin = random.normal(size=(count, 3)), random.normal(size=(count, 3))
    pushes = random.normal(size=(count, 3)) if push is None else push(rotation)
    reach = numpy.stack(
        [(turned @ LOPSIDED.points.T).T[(turned @ LOPSIDED.points.T)[2].argmin()] for turned in rotation]
    )
    world = rotation @ INERTIA @ numpy.swapaxes(rotation, 1, 2)
    change = numpy.linalg.solve(world, numpy.cross(reach, pushes)[..., None])[..., 0]
    return ImpactTable(rotation, before, before + pushes, spin, spin + change)


def spatial_estimate(table):
    return estimate_from_impacts(problem_of_impacts(table, LOPSIDED, (1e-12, 1e-11)))


def words(found, spatial=True):
    return unobservable(found.directions.missing, found.parameters, found.scale, spatial, False)


def test_ten_impacts_at_1_mm_s_give_the_inertia_to_0_15_percent_and_say_so():
    """200 draws, one sample before and after each impact, 1 mm/s and 10 mrad/s."""
    random = numpy.random.default_rng(2024)
    found = [planar_estimate(random, 10, 1e-3, 1e-2) for _ in range(200)]
    errors = numpy.array([SIDE**2 / 6.0 / each.parameters[0] - 1.0 for each in found])  # of m/J
    reported = numpy.array([numpy.sqrt(each.covariance[0, 0]) / each.parameters[0] for each in found])
    rms = numpy.sqrt(numpy.mean(errors**2))
    assert rms <= 1.5e-3
    assert numpy.sqrt(numpy.mean(reported**2)) == pytest.approx(rms, rel=0.3)


def test_large_noise_does_not_pull_the_estimate_to_one_side():
    """Ten times the noise: the mean over 30 draws lies within four standard errors of the truth."""
    random = numpy.random.default_rng(7)
    values = numpy.array([planar_estimate(random, 10, 1e-2, 1e-1).parameters[0] for _ in range(30)]) / (SIDE**2 / 6.0)
    assert abs(values.mean() - 1.0) < 4.0 * values.std() / numpy.sqrt(30) + 2e-3


@settings(max_examples=20)
@given(st.integers(0, 10_000))
def test_one_exact_planar_impact_gives_the_inertia_to_1e_9(seed):
    found = planar_estimate(numpy.random.default_rng(seed), 1, 0.0, 0.0)
    if found.directions.rank:  # an impulse nearly through the centre of mass is named instead
        assert found.parameters[0] == pytest.approx(SIDE**2 / 6.0, rel=1e-9)


@pytest.mark.parametrize(("count", "rank"), [(1, 3), (2, 5), (3, 6), (8, 6)])
def test_impacts_in_space_have_rank_3_5_6(count, rank):
    found = spatial_estimate(spatial_table(count))
    assert found.directions.rank == rank
    if rank == 6:
        names = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
        assert found.parameters == pytest.approx([INERTIA[place] for place in names], rel=1e-9, abs=1e-12)


def test_after_two_impacts_the_axis_across_both_changes_of_spin_is_named():
    table = spatial_table(2)
    changes = [
        turned.T @ (after - before)
        for turned, before, after in zip(table.rotation, table.spin_before, table.spin_after, strict=True)
    ]
    axis = numpy.cross(*changes)
    axis /= numpy.linalg.norm(axis) * numpy.sign(axis[abs(axis).argmax()])
    named = "(" + ", ".join(f"{value:.4g}" for value in axis) + ")"
    assert words(spatial_estimate(table))[1].startswith(
        f"the moment of inertia about the body axis {named} is not identifiable"
    )


def test_after_one_impact_the_column_that_is_known_is_named():
    table = spatial_table(1)
    change = table.rotation[0].T @ (table.spin_after - table.spin_before)[0]
    change /= numpy.linalg.norm(change) * numpy.sign(change[abs(change).argmax()])
    named = "(" + ", ".join(f"{value:.4g}" for value in change) + ")"
    assert f"only the column of the body axis {named}" in words(spatial_estimate(table))[1]


def test_impulses_through_the_centre_of_mass_tell_nothing_of_the_inertia():
    def central(rotation):
        return numpy.stack(
            [-(turned @ LOPSIDED.points.T).T[(turned @ LOPSIDED.points.T)[2].argmin()] for turned in rotation]
        )

    found = spatial_estimate(spatial_table(4, push=central))
    assert found.directions.rank == 0
    assert words(found)[1].startswith("I0/m is not identifiable")


def test_the_cheap_formulas_agree_with_the_truth():
    exact = random_block_impacts(numpy.random.default_rng(5), 20)
    for turned, *rows in zip(*exact, strict=True):
        velocity_before, velocity_after, spin_before, spin_after = rows
        corners = turned @ SQUARE.points.T
        reach = corners[:, corners[2].argmin()] * [1.0, 0.0, 1.0]
        states = [
            numpy.array([v[0], v[2], -w[1]]) for v, w in ((velocity_before, spin_before), (velocity_after, spin_after))
        ]
        found = two_point(*states, (reach[0], reach[2]))
        assert found.mass_over_inertia == pytest.approx(6.0 / SIDE**2, rel=1e-9)
        inertia, rank = one_impact(turned, (velocity_before, spin_before), (velocity_after, spin_after), reach)
        assert rank == 3
        assert inertia[1, 1] == pytest.approx(SIDE**2 / 6.0, rel=1e-9)


def test_the_two_point_formula_refuses_an_impulse_through_the_centre_of_mass():
    with pytest.raises(IdentificationError, match="through the centre of mass"):
        two_point(numpy.zeros(3), numpy.array([0.3, -0.4, 0.0]), (-0.03, 0.04))


def test_an_empty_table_and_a_table_with_nan_are_refused():
    table = spatial_table(2)
    with pytest.raises(IdentificationError, match="one impact or more"):
        problem_of_impacts(ImpactTable(*(field[:0] for field in table)), LOPSIDED, (1e-3, 1e-2))
    with pytest.raises(IdentificationError, match="finite"):
        problem_of_impacts(table._replace(spin_after=table.spin_after * numpy.nan), LOPSIDED, (1e-3, 1e-2))
