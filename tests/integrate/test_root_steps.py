import math

import numpy
import pytest

from contact_sim_lab.laws.one_mass.runs import integrate
from contact_sim_pkg.compiled.results import DONE
from contact_sim_pkg.integrate.root_steps import make_workspace
from contact_sim_pkg.laws.one_mass.parameters import PointContact
from contact_sim_pkg.laws.one_mass.single import empty_mode, run
from contact_sim_pkg.laws.parameters import NormalElastic

SPRING = PointContact(1.0, 0.0, 0.0, 0.0, NormalElastic(100.0, 1.0), None)


def _swing(tolerance, end=0.25):
    """A linear spring that stays in contact: a sine in closed form."""
    start = numpy.array([-0.02, 0.1])
    state = integrate(SPRING, start, numpy.array([0.02, 0.2]) * tolerance, numpy.array([0.0, end])).states[-1]
    exact = -0.02 * math.cos(10.0 * end) + 0.01 * math.sin(10.0 * end)
    return abs(state[0] - exact) / 0.02


@pytest.mark.parametrize("power", range(3, 13))
def test_a_smooth_motion_meets_the_asked_tolerance(power):
    assert _swing(10.0**-power, end=0.04) <= 10.0 * 10.0**-power


def test_the_same_run_gives_the_same_bits():
    times = numpy.linspace(0.0, 3.0, 40)
    rig = PointContact(1.0, 9.81, 0.003, 90.0, NormalElastic(1e6, 1.5), None)
    runs = [integrate(rig, numpy.array([0.05, 0.0]), numpy.array([1e-9, 1e-7]), times).states for _ in range(2)]
    assert runs[0].tobytes() == runs[1].tobytes()


def test_a_workspace_serves_a_second_run_from_an_earlier_time():
    rig = PointContact(20.0, 0.0, 0.0, 0.0, NormalElastic(1e5, 1.5), None)
    work, times, found = make_workspace(2, 2), numpy.array([0.0, 0.5]), []
    for _ in range(2):
        state, out = numpy.array([0.001, -0.5]), numpy.zeros((2, 2))
        work.step[0] = 0.0
        assert run(rig, empty_mode(), state, numpy.array([0.1, 1.0]) * 1e-9, work, times, out) == DONE
        found.append(out.tobytes())
    assert found[0] == found[1]


def test_free_flight_is_exact_and_counts_no_event():
    rig = PointContact(1.0, 9.81, 0.0, 0.0, NormalElastic(1e5, 1.5), None)
    course = integrate(rig, numpy.array([10.0, 2.0]), numpy.array([1e-6, 1e-6]), numpy.array([0.0, 1.0]))
    assert course.states[-1] == pytest.approx([10.0 + 2.0 - 9.81 / 2.0, 2.0 - 9.81], rel=1e-14)
    assert course.events == 0


def test_one_impact_is_two_events():
    course = integrate(SPRING, numpy.array([0.1, -1.0]), numpy.array([1e-8, 1e-8]), numpy.array([0.0, 1.0]))
    assert course.events == 2
    assert course.states[-1, 1] == pytest.approx(1.0, abs=1e-7)
    assert course.states[-1, 0] == pytest.approx(1.0 - 0.1 - math.pi / 10.0, abs=1e-7)
