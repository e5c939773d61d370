"""The contact point that moves with the shell: where it is, and that its force keeps a potential."""

import numpy
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize
from tests.rigs.backrest.backrest_runs import GRAVITY, LAW, LOSS, driven, sine
from tests.run.scenes import FRICTIONLESS, resolved

from contact_sim_pkg.rigs.backrest import entries as columns
from contact_sim_pkg.rigs.backrest.contact_search import nearest_point
from contact_sim_pkg.rigs.backrest.model import build_backrest, resting_state

WIDTH, HEIGHT, RADII = 0.40, 0.50, (0.6, 1.5)


def shell(modes, *values):
    common = (
        *FRICTIONLESS,
        "effects.backrest.shell_modes={}",
        "effects.backrest.contact_search={}",
        "backrest.preload=20",
    )
    scene = resolved("seat_slap", *common, f"effects.backrest.shell_modes.modes={modes}", *values)
    return build_backrest(scene).rig


def depth(q, place):
    """Depth at one place, from the sines and the paraboloid."""
    side = round(len(q) ** 0.5)
    orders = numpy.arange(1, side + 1) * numpy.pi
    shapes = numpy.outer(numpy.sin(orders * place[0] / WIDTH), numpy.sin(orders * place[1] / HEIGHT)).ravel()
    away = numpy.array([place[0] - 0.5 * WIDTH, place[1] - 0.5 * HEIGHT])
    return shapes @ q - 0.5 * (away**2 / RADII).sum()


def shapes_at(q, place):
    side = round(len(q) ** 0.5)
    orders = numpy.arange(1, side + 1) * numpy.pi
    return numpy.outer(numpy.sin(orders * place[0] / WIDTH), numpy.sin(orders * place[1] / HEIGHT)).ravel()


def deepest(q, starts):
    """The largest depth by scipy from several starts."""
    bounds = [(0.0, WIDTH), (0.0, HEIGHT)]
    found = [minimize(lambda p: -1e3 * depth(q, p), s, bounds=bounds, options={"ftol": 1e-15}) for s in starts]
    return max(-1e-3 * each.fun for each in found)


@pytest.mark.parametrize("modes", [1, 4, 9])
@pytest.mark.parametrize("size", [0.002, 0.05])
def test_no_place_of_the_shell_is_nearer_than_the_one_found(modes, size):
    random, search = numpy.random.default_rng(modes), shell(modes).search
    grid = numpy.stack(numpy.meshgrid(numpy.linspace(0.0, WIDTH, 6), numpy.linspace(0.0, HEIGHT, 6)), -1).reshape(-1, 2)
    for _ in range(6):
        q = size * random.normal(size=modes) / numpy.arange(1, modes + 1)
        place = nearest_point(search, q)
        assert 0.0 <= place[0] <= WIDTH
        assert 0.0 <= place[1] <= HEIGHT
        assert depth(q, place) >= deepest(q, grid) - 1e-9


def test_the_shell_slaps_as_its_slow_twin():
    """Four modes against scipy, which searches the point anew in every evaluation."""
    rig, shaking = shell(4), sine(1.5 * GRAVITY, 5.25)
    start = resting_state(rig)
    at = [numpy.array([0.5 * WIDTH, 0.5 * HEIGHT])]

    def rates(time, state):
        q, v = state[:4], state[4:]
        at[0] = minimize(lambda p: -1e3 * depth(q, p), at[0], method="BFGS", options={"gtol": 1e-8}).x
        shape = shapes_at(q, at[0])
        approach, rate = depth(q, at[0]), shape @ v
        force = LAW.coefficient * max(approach, 0.0) ** LAW.exponent * max(0.0, 1.0 + LOSS.damping * rate)
        pushed = rig.modal[3] + rig.modal[4] * shaking(time) - rig.modal[1] * q - rig.modal[2] * v
        return numpy.concatenate([v, (pushed - shape * force) / rig.modal[0]])

    times = numpy.arange(0.0, 0.2, 0.01)
    slow = solve_ivp(rates, (0.0, 0.2), start[:8], "RK45", times, rtol=1e-7, atol=1e-10, max_step=1e-3)
    found = driven(rig, shaking, 0.2, 1e-9, size=1e-3, rate=10_000, sample_every=100)
    assert (found.forces[:, columns.NORMAL] == 0.0).any()
    error = numpy.abs(found.states[:, :4] - slow.y.T[:, :4]).max()
    assert error <= 1e-4 * numpy.abs(slow.y[:4]).max()


@pytest.mark.parametrize("modes", [4, 9])
def test_a_force_whose_point_moves_keeps_its_potential(modes):
    found = driven(shell(modes), sine(1.5 * GRAVITY, 5.25), 1.0, 1e-9, size=1e-3)
    moved = numpy.ptp(found.points[:, 0, [columns.POINT_UP, columns.POINT_ACROSS]], axis=0)
    assert moved.max() > 0.001, "the point does not move"
    assert abs(found.residual) <= 1e-6 * found.supplied


def test_rest_is_a_balance_of_forces():
    rig = shell(9)
    q = resting_state(rig)[:9]
    place = nearest_point(rig.search, q)
    force = LAW.coefficient * depth(q, place) ** LAW.exponent
    assert rig.preload - rig.stiffness * q == pytest.approx(force * shapes_at(q, place), abs=1e-9)
