"""References of the figures of *Rolling Contact* against closed forms."""

import numpy
import pytest

from contact_sim_lab.papers.registry import figure_of, paper_of
from contact_sim_lab.papers.rolling_contact import figures_track
from contact_sim_lab.twins.subsurface import circle_axis, tensor_under_ellipse, under_ellipse

POISSON = 0.3


@pytest.mark.parametrize("depth", [0.2, 0.48, 1.5])
def test_the_tensor_on_the_axis_of_a_circle(depth):
    """Johnson 1985, eq 3.45."""
    found = tensor_under_ellipse((1.0, 1.0), numpy.array([[0.0, 0.0, depth]]), POISSON)[:, 0]
    axial, radial = circle_axis(depth, POISSON)
    assert found == pytest.approx([radial, radial, axial, 0.0, 0.0, 0.0], abs=1e-5)


def test_the_tensor_has_the_two_components():
    places = numpy.array([(0.6, 0.2, 0.3), (-0.5, 0.3, 0.8)])
    found = tensor_under_ellipse((1.0, 0.6), places, POISSON)
    assert found[[2, 4]] == pytest.approx(under_ellipse((1.0, 0.6), places), abs=1e-12)


@pytest.mark.parametrize(("factor", "said"), [(1.0, set()), (1.1, {"F dω_T/dF at F_N"})])
def test_a_slope_of_the_damage_that_is_wrong_is_outside(factor, said, monkeypatch):
    """The expected growth does not follow the bench's own volumes."""
    volumes = figures_track.dangerous_volumes

    def more(contact, *rest):
        found = volumes(contact, *rest)
        return found._replace(any=factor * found.any)

    monkeypatch.setattr(figures_track, "dangerous_volumes", more)
    numbers = figure_of(paper_of("rolling-contact"), "4").compute({}).numbers
    assert {each.what for each in numbers if each.verdict == "OUTSIDE"} == said
