"""The table over the loss tangent against the solved impact, and its ends."""

import numpy
import pytest

from contact_sim_pkg.rigs.impact.theory.closed_form.scaled_motion import scaled_impact
from contact_sim_pkg.rigs.impact.theory.closed_form.severity import severity_of_loss_tangent
from contact_sim_pkg.rigs.impact.theory.errors import ImpactError
from contact_sim_pkg.rigs.impact.theory.table import LIMITS, look_up


@pytest.mark.parametrize("end", ["force", "gap"])
def test_a_look_up_is_the_solved_impact(end):
    for loss_tangent in numpy.concatenate(
        (numpy.geomspace(1e-9, LIMITS[end], 23), numpy.linspace(0.0, LIMITS[end], 24))
    ):
        found = look_up(float(loss_tangent), end)
        expected = scaled_impact(severity_of_loss_tangent(float(loss_tangent), end), end)
        assert found.restitution == pytest.approx(expected.restitution, abs=1e-12)
        assert found.duration == pytest.approx(expected.duration, abs=1e-12)
        assert found.depth == pytest.approx(expected.depth, abs=1e-12)
        assert found.peak_force == pytest.approx(expected.peak_force, abs=1e-10)


@pytest.mark.parametrize(("loss_tangent", "end"), [(2.01, "force"), (0.31, "gap"), (-1e-9, "force")])
def test_beyond_its_ends_the_table_refuses(loss_tangent, end):
    with pytest.raises(ImpactError, match="table"):
        look_up(loss_tangent, end)
