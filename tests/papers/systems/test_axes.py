"""System *axes*: impacts of rigid bodies by Newton and Euler, and a recorded motion of a box."""

import numpy
import pytest
from scipy.optimize import curve_fit
from tests.identify import foreign_bag, motions

from contact_sim_lab.papers.driver_seat.system_distance import rotation_about
from contact_sim_lab.papers.identifiability import system_axes
from contact_sim_lab.papers.identifiability.system_axes import Moments, axes, moments_of
from contact_sim_lab.papers.registry import paper_of
from contact_sim_lab.records.paper import PaperError
from contact_sim_pkg.identify.contact.coulomb import impact_equations

MOMENTS = numpy.array([0.004, 0.007, 0.009])
TURN = rotation_about(numpy.array([0.3, -0.2, 0.4]))
BASIS = numpy.einsum("ik,jk->kij", TURN, TURN)


def impact(seed, moment=None):
    """Equations of a random impact: the change of the spin from a known moment of the impulse over the mass."""
    random = numpy.random.default_rng(seed)
    rotation = rotation_about(random.normal(size=3))
    reach, push = random.normal(size=3), random.normal(size=3)
    if moment is not None:
        # A reach and an impulse with this moment: it is normal to both.
        along = rotation @ TURN @ moment
        reach = numpy.cross(along, random.normal(size=3))
        push = numpy.cross(along, reach) / (reach @ reach)
    turned = rotation @ TURN
    change = turned @ ((turned.T @ numpy.cross(reach, push)) / MOMENTS)
    velocity, spin = random.normal(size=3), random.normal(size=3)
    return impact_equations(BASIS, rotation, (velocity, spin), (velocity + push, spin + change), reach)


def test_one_impact_gives_all_three_moments():
    matrix, right = impact(1)
    found = moments_of([matrix], [right])
    assert found.rank == 3
    assert found.values == pytest.approx(MOMENTS, rel=1e-11)


def test_deviations_are_those_that_scipy_fits():
    """Three impacts with errors of their right sides, each weighted by the size of its moment."""
    matrices, rights = zip(*(impact(seed) for seed in (4, 5, 6)), strict=True)
    rights = [right + 1e-3 * numpy.random.default_rng(seed).normal(size=3) for seed, right in enumerate(rights)]
    found = moments_of([*matrices], rights)
    rows, right = numpy.concatenate(matrices), numpy.concatenate(rights)
    sizes = numpy.repeat([numpy.linalg.norm(each) for each in rights], 3)
    values, covariance = curve_fit(lambda x, *moments: x @ numpy.array(moments), rows, right, p0=MOMENTS, sigma=sizes)
    assert found.values == pytest.approx(values, rel=1e-6)
    assert found.deviations == pytest.approx(numpy.sqrt(numpy.diag(covariance)), rel=1e-4)


def test_each_axis_has_its_own_moment_and_deviation_in_the_table(tmp_path, monkeypatch):
    known = Moments(
        numpy.array([0.004, 0.007, 0.009]), numpy.array([0.0002, numpy.inf, 0.0005]), 2, numpy.zeros((1, 3))
    )
    monkeypatch.setattr("contact_sim_lab.papers.identifiability.system_axes.moments_of", lambda *_: known)
    foreign_bag.write_odometry(tmp_path / "bag", motions.states_of(motions.spatial()))
    result = axes(tmp_path / "bag", {"box": tuple(motions.LENGTHS), "axes": (0.0, 0.0, 0.0), "gravity": 9.81})
    assert result.rows == [
        {"axis": "x", "I_over_m_m2": 0.004, "deviation_m2": 0.0002, "m_over_I_1_m2": 250.0},
        {"axis": "y", "I_over_m_m2": None, "deviation_m2": None, "m_over_I_1_m2": None},
        {"axis": "z", "I_over_m_m2": 0.009, "deviation_m2": 0.0005, "m_over_I_1_m2": pytest.approx(1.0 / 0.009)},
    ]


def test_a_moment_without_a_part_about_an_axis_hides_that_axis():
    """Of the body-frame components of the moment none may vanish (Identifiability, below eq 31)."""
    matrix, right = impact(2, numpy.array([0.0, 0.3, -0.5]))
    found = moments_of([matrix], [right])
    assert found.rank == 2
    assert numpy.isfinite(found.deviations).tolist() == [False, True, True]
    assert found.values[1:] == pytest.approx(MOMENTS[1:], rel=1e-10)
    again = moments_of(*zip(impact(2, numpy.array([0.0, 0.3, -0.5])), impact(3), strict=True))
    assert again.rank == 3
    assert again.values == pytest.approx(MOMENTS, rel=1e-10)


def test_the_motion_of_a_box_gives_its_moments(tmp_path):
    foreign_bag.write_odometry(tmp_path / "bag", motions.states_of(motions.spatial()))
    values = {"box": tuple(motions.LENGTHS), "axes": (0.0, 0.0, 0.0), "gravity": 9.81}
    result = axes(tmp_path / "bag", values)
    found = [row["I_over_m_m2"] for row in result.rows]
    assert found == pytest.approx(numpy.diag(motions.SPATIAL_INERTIA), rel=1e-6)
    assert "rank 3 of 3" in result.note


def test_deviations_are_those_of_weighted_least_squares():
    """Noisy equations, each over the size of its right side: sqrt of the diagonal of s^2 (A'A)^-1, by numpy's inverse."""
    random = numpy.random.default_rng(8)
    matrices, rights = zip(*(impact(seed) for seed in (4, 5, 6, 7)), strict=True)
    rights = [right * (1.0 + 1e-3 * random.normal(size=3)) for right in rights]
    sizes = [numpy.linalg.norm(right) for right in rights]
    a = numpy.concatenate([each / size for each, size in zip(matrices, sizes, strict=True)])
    b = numpy.concatenate([each / size for each, size in zip(rights, sizes, strict=True)])
    best, rest = numpy.linalg.lstsq(a, b)[:2]
    wanted = numpy.sqrt(numpy.diag(numpy.linalg.inv(a.T @ a)) * rest[0] / (12 - 3))
    found = moments_of(list(matrices), rights)
    assert found.values == pytest.approx(best, rel=1e-10)
    assert found.deviations == pytest.approx(wanted, rel=1e-9)
    assert len(set(numpy.round(wanted, 9))) == 3


def test_a_row_carries_its_own_deviation(tmp_path, monkeypatch):
    found = Moments(numpy.array([0.5, 0.25, 0.125]), numpy.array([0.03, numpy.inf, 0.01]), 2, numpy.zeros((1, 3)))
    monkeypatch.setattr(system_axes, "moments_of", lambda _matrices, _rights: found)
    foreign_bag.write_odometry(tmp_path / "bag", motions.states_of(motions.spatial()))
    rows = axes(tmp_path / "bag", {"box": tuple(motions.LENGTHS), "axes": (0.0, 0.0, 0.0), "gravity": 9.81}).rows
    assert [tuple(row.values()) for row in rows] == [
        ("x", 0.5, 0.03, 2.0),
        ("y", None, None, None),
        ("z", 0.125, 0.01, 8.0),
    ]
    (shown,) = (each.shows for each in paper_of("identifiability").systems if each.name == "axes")
    assert {name for _, place in shown for name in place.split(", ")} <= set(rows[0])


def test_three_lengths_and_an_impact_are_needed(tmp_path):
    with pytest.raises(PaperError, match="box and axes take three numbers each"):
        axes(tmp_path, {"box": (0.1, 0.1), "axes": (0.0, 0.0, 0.0), "gravity": 9.81})
