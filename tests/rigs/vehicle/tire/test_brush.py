"""Brush friction against Pacejka's closed forms, quadrature of strips and bristles followed one by one."""

import math

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from contact_sim_lab.rigs.vehicle.brush_twin import (
    follow_bristles,
    hertz_brush,
    linear_start,
    parabolic_brush,
    steady_strip,
)
from contact_sim_pkg.rigs.vehicle.tire.brush.lattice import resample
from contact_sim_pkg.rigs.vehicle.tire.brush.rolling_brush import (
    PatchGrid,
    RollingStep,
    advance_brush,
    brush_state_on,
    make_brush_state,
    rolling_step,
)
from contact_sim_pkg.rigs.vehicle.tire.brush.steps import PAD, unit_slide
from contact_sim_pkg.rigs.vehicle.tire.parameters import Brush

LOAD, HALF_LENGTH, WIDTH, STIFFNESS = 4000.0, 0.06, 0.12, 3.0e7
PEAK = 0.75 * LOAD / (HALF_LENGTH * WIDTH)
COULOMB = Brush(STIFFNESS, STIFFNESS, 0.9, 0.9)
STICKY = Brush(STIFFNESS, STIFFNESS, 1.0, 0.7)
ENDLESS = Brush(STIFFNESS, STIFFNESS, 1e6, 1e6)  # never slides


class Contact:
    """Bristles, the stress under them and what the last step gave."""

    def __init__(self, brush, pressure, grid):
        self.brush, self.pressure, self.grid = brush, numpy.array(pressure), grid
        self.state = make_brush_state(*self.pressure.shape)
        self.shear_x, self.shear_y = numpy.zeros_like(self.pressure), numpy.zeros_like(self.pressure)
        self.mode = numpy.zeros(self.pressure.shape, dtype=numpy.uint8)

    def step(self, step, pressure=None, origin_x=None):
        if pressure is not None:
            self.pressure = pressure
        if origin_x is not None:
            self.grid = self.grid._replace(origin_x=origin_x)
        self.result = advance_brush(
            self.brush, self.state, self.grid, self.pressure, step, self.shear_x, self.shear_y, self.mode
        )
        return self.result

    def roll(self, travel, slip, slip_angle, steps=1):
        for _ in range(steps):
            self.step(rolling_step(travel, slip, slip_angle))
        return self.result

    @property
    def deflections(self):
        bristles = self.state.bristles
        return numpy.hypot(bristles.deflection_x[PAD:-PAD], bristles.deflection_y[PAD:-PAD])


def strip_contact(brush, cells, profile, cols=3):
    """`cells` rows over the contact length with borders at its ends, 4 empty rows on each side; profile(x/a) [Pa]."""
    cell = 2.0 * HALF_LENGTH / cells
    x = (numpy.arange(cells + 8) - 0.5 * (cells + 7)) * cell
    inside = abs(x) < HALF_LENGTH
    p = numpy.where(inside, profile(x / HALF_LENGTH), 0.0)
    grid = PatchGrid(x[0], -0.5 * WIDTH + 0.5 * WIDTH / cols, cell, WIDTH / cols)
    return Contact(brush, numpy.repeat(p[:, None], cols, axis=1), grid)


def parabola(u):
    return PEAK * (1.0 - u * u)


def uniform(u):
    return numpy.full_like(u, LOAD / (2.0 * HALF_LENGTH * WIDTH))


def hertz_contact(brush, cells, cols, semi_axes, peak):
    a, b = semi_axes
    cell_x, cell_y = 2.0 * a / cells, 2.0 * b / cols
    x = (numpy.arange(cells + 4) - 0.5 * (cells + 3)) * cell_x
    y = (numpy.arange(cols + 4) - 0.5 * (cols + 3)) * cell_y
    p = peak * numpy.sqrt(numpy.maximum(0.0, 1.0 - (x[:, None] / a) ** 2 - (y / b) ** 2))
    return Contact(brush, p, PatchGrid(x[0], y[0], cell_x, cell_y))


def steady_angle(cells, slip_angle):
    return strip_contact(COULOMB, cells, parabola).roll(0.0137, 0.0, slip_angle, 12)


@pytest.mark.parametrize("slip_angle", [0.02, 0.05, 0.1, 0.2, 0.3])
def test_side_force_and_aligning_moment_are_pacejkas(slip_angle):
    force, moment = parabolic_brush(LOAD, HALF_LENGTH, WIDTH, STIFFNESS, 0.9, math.tan(slip_angle))
    result = steady_angle(64, slip_angle)
    assert result.force_y == pytest.approx(-force, rel=2e-3)
    assert result.moment_z == pytest.approx(moment, rel=5e-3)
    assert abs(result.force_x) <= 1e-12 * force


@pytest.mark.parametrize("slip", [-0.5, -0.2, -0.05, 0.03, 0.1, 0.3])
def test_force_along_the_travel_is_pacejkas(slip):
    force, _ = parabolic_brush(LOAD, HALF_LENGTH, WIDTH, STIFFNESS, 0.9, abs(slip) / (1.0 + slip))
    result = strip_contact(COULOMB, 64, parabola).roll(0.0137, slip, 0.0, 24)
    assert result.force_x == pytest.approx(math.copysign(force, slip), rel=2e-3)
    assert abs(result.force_y) + abs(result.moment_z) <= 1e-12 * force


def largest_error(cells, slip_angle):
    """Relative error of the side force, the largest of sixteen places of the belt's lattice in a cell."""
    force, _ = parabolic_brush(LOAD, HALF_LENGTH, WIDTH, STIFFNESS, 0.9, math.tan(slip_angle))
    contact = strip_contact(COULOMB, cells, parabola)
    contact.roll(0.3, 0.0, slip_angle)
    return max(abs(contact.roll(contact.grid.cell_x / 16, 0.0, slip_angle).force_y + force) for _ in range(16)) / force


def test_errors_fall_with_the_square_of_the_cell():
    angles = [0.02, 0.04, 0.07, 0.11, 0.16, 0.22, 0.27]
    coarse, fine = (numpy.array([largest_error(cells, a) for a in angles]) for cells in (32, 128))
    assert coarse.max() < 1.2e-2
    assert numpy.linalg.norm(fine) < numpy.linalg.norm(coarse) / 10.0  # 16 for a pure square


@pytest.mark.parametrize("slip", [0.02, 0.06, 0.15])
def test_under_a_hertz_pressure_the_strips_add_up(slip):
    axes, peak = (0.08, 0.06), 0.4e6
    force, moment = hertz_brush(peak, axes, STIFFNESS, 0.9, 0.9, slip)
    result = hertz_contact(COULOMB, 80, 60, axes, peak).roll(0.0171, 0.0, math.atan(slip), 12)
    assert result.force_y == pytest.approx(-force, rel=6e-3)
    assert result.moment_z == pytest.approx(moment, rel=2e-2, abs=1e-3 * force * axes[0])


@pytest.mark.parametrize("slip", [0.03, 0.08, 0.15])
def test_sliding_behind_the_static_limit_is_kinetic(slip):
    force, moment = steady_strip(lambda x: parabola(x / HALF_LENGTH), HALF_LENGTH, STIFFNESS, 1.0, 0.7, slip)
    result = strip_contact(STICKY, 256, parabola).roll(0.0137, 0.0, math.atan(slip), 12)
    assert result.force_y == pytest.approx(
        -force * WIDTH, rel=5e-3
    )  # the stress jumps at the border, which is a cell wide
    assert result.moment_z == pytest.approx(moment * WIDTH, abs=5e-3 * force * WIDTH * HALF_LENGTH)


def test_combined_slip_gives_a_force_along_the_slip():
    slip, slip_angle = 0.05, 0.06
    sigma = math.hypot(slip, math.tan(slip_angle)) / (1.0 + slip)
    force, _ = parabolic_brush(LOAD, HALF_LENGTH, WIDTH, STIFFNESS, 0.9, sigma)
    result = strip_contact(COULOMB, 64, parabola).roll(0.0137, slip, slip_angle, 12)
    assert math.hypot(result.force_x, result.force_y) == pytest.approx(force, rel=2e-3)
    assert math.atan2(result.force_y, result.force_x) == pytest.approx(
        math.atan2(-math.tan(slip_angle), slip), abs=1e-9
    )


@pytest.mark.parametrize(("slip", "slip_angle"), [(0.5, -0.4), (-0.6, 0.3), (0.0, 0.8), (2.0, 0.1)])
def test_a_sliding_tire_is_pushed_by_the_kinetic_friction_against_its_sliding(slip, slip_angle):
    brush = Brush(6.0e7, 4.0e7, 0.8, 0.5)
    contact = strip_contact(brush, 40, parabola)
    result = contact.roll(0.02, slip, slip_angle, 30)
    load = contact.pressure.sum() * contact.grid.cell_x * contact.grid.cell_y
    sliding = numpy.array([slip, -math.tan(slip_angle)])
    expected = 0.5 * load * sliding / numpy.linalg.norm(sliding)
    assert result.sliding_share == 1.0
    assert math.hypot(result.force_x, result.force_y) == pytest.approx(0.5 * load, rel=1e-2)
    assert (result.force_x, result.force_y) == pytest.approx(tuple(expected), abs=3e-2 * load)
    assert abs(result.moment_z) < 1e-2 * load * HALF_LENGTH


@pytest.mark.parametrize("slip", [1e-6, -1e-6])
def test_the_slip_stiffness_is_two_k_a_squared_times_the_width(slip):
    result = strip_contact(ENDLESS, 20, uniform).roll(0.031, slip, 0.0, 10)
    # a travel of 5.17 cells: the centres lie between bristles, and the first row is one half of a cell off at most
    assert result.force_x / slip == pytest.approx(2.0 * STIFFNESS * HALF_LENGTH**2 * WIDTH, rel=2e-3)
    whole = strip_contact(ENDLESS, 20, uniform).roll(0.006 / (1.0 + slip), slip, 0.0, 30)
    assert whole.force_x * (1.0 + slip) / slip == pytest.approx(2.0 * STIFFNESS * HALF_LENGTH**2 * WIDTH, rel=1e-9)


def test_after_a_step_in_slip_angle_the_force_grows_with_the_rolled_way():
    cells, slip_angle = 60, 1e-3
    contact = strip_contact(ENDLESS, cells, uniform)
    contact.roll(0.0, 0.0, 0.0)
    cell = contact.grid.cell_x
    for n in range(1, cells + 10):
        result = contact.roll(cell, 0.0, slip_angle)
        force, moment = linear_start(HALF_LENGTH, WIDTH, STIFFNESS, math.tan(slip_angle), n * cell)
        assert result.force_y == pytest.approx(-force, rel=1e-9)
        assert result.moment_z == pytest.approx(moment, abs=2e-3 * force * HALF_LENGTH)


def test_ways_of_no_whole_cells_grow_alike():
    contact = strip_contact(ENDLESS, 60, uniform)
    contact.roll(0.0, 0.0, 0.0)
    whole, _ = linear_start(HALF_LENGTH, WIDTH, STIFFNESS, math.tan(1e-3), 1.0)
    for n in range(1, 100):
        result = contact.roll(0.00137, 0.0, 1e-3)
        force, _ = linear_start(HALF_LENGTH, WIDTH, STIFFNESS, math.tan(1e-3), n * 0.00137)
        assert result.force_y == pytest.approx(-force, abs=3e-4 * whole)


def test_a_changing_load_and_a_mixed_slip_agree_with_bristles_followed_one_by_one():
    slip, slip_angle, travel = 0.06, -0.05, 0.05
    contact = strip_contact(STICKY, 400, parabola)
    contact.roll(0.0, slip, slip_angle)
    lower = 0.4 * contact.pressure
    result = contact.step(rolling_step(travel, slip, slip_angle), pressure=lower)

    def pressure(x, part):
        return numpy.maximum(0.0, parabola(x / HALF_LENGTH)) * (1.0 - 0.6 * part)

    x = contact.grid.origin_x + numpy.arange(contact.pressure.shape[0]) * contact.grid.cell_x
    inside = x[abs(x) < HALF_LENGTH]
    step = rolling_step(travel, slip, slip_angle)
    slide = (step.belt - step.travel, -step.drift)
    stress = follow_bristles(pressure, inside, STIFFNESS, (1.0, 0.7), step.belt, slide, 4000)
    expected = stress.sum(axis=0) * contact.grid.cell_x * WIDTH
    assert (result.force_x, result.force_y) == pytest.approx(tuple(expected), rel=5e-3)
    assert 0.05 < result.sliding_share < 0.95


def test_one_step_of_32_cells_equals_32_steps_of_one_cell():
    once, often = (hertz_contact(STICKY, 40, 20, (0.08, 0.06), 0.4e6) for _ in range(2))
    cell = once.grid.cell_x
    for contact in (once, often):
        contact.step(RollingStep(0.3 * cell, 0.3 * cell, 0.0))
    once.step(RollingStep(32 * cell, 34 * cell, 3 * cell))
    for _ in range(32):
        often.step(RollingStep(cell, 34 / 32 * cell, 3 / 32 * cell))
    assert numpy.allclose(once.shear_x, often.shear_x, rtol=1e-9, atol=1e-6)
    assert numpy.allclose(once.shear_y, often.shear_y, rtol=1e-9, atol=1e-6)
    assert once.result[:3] == pytest.approx(often.result[:3], rel=1e-9)


def test_the_lattice_of_the_road_passes_without_a_trace():
    cells, slip_angle, travel = 48, 0.08, 0.0137
    contact = strip_contact(COULOMB, cells, parabola)
    cell, rows = contact.grid.cell_x, contact.pressure.shape[0]
    force, moment = parabolic_brush(LOAD, HALF_LENGTH, WIDTH, STIFFNESS, 0.9, math.tan(slip_angle))
    for n in range(60):
        middle = round(n * travel / cell)
        origin = (middle - 0.5 * (rows - 1)) * cell - n * travel
        x = origin + numpy.arange(rows) * cell
        p = numpy.repeat(numpy.maximum(0.0, parabola(x / HALF_LENGTH))[:, None], 3, axis=1)
        result = contact.step(rolling_step(travel, 0.0, slip_angle), pressure=p, origin_x=origin)
        if n > 10:
            assert result.force_y == pytest.approx(-force, rel=1.5e-2)
            assert result.moment_z == pytest.approx(moment, rel=5e-2)


@pytest.mark.parametrize("offset", [0.3, 0.8, -0.7, 2.25, -3.0])
def test_the_last_pressure_is_read_on_the_straight_line_between_two_rows(offset):
    rows = numpy.arange(20.0)
    before = numpy.zeros((20, 2))
    before[PAD:-PAD] = 1.0e5 + 1.0e4 * numpy.sin(rows[PAD:-PAD, None]) * [[1.0, -2.0]]
    expected = numpy.array([numpy.interp(rows + offset, rows, column, 0.0, 0.0) for column in before.T]).T
    nearest = numpy.ceil(rows + offset - 0.5)
    loaded = (nearest >= PAD) & (nearest < 20 - PAD) & (rows >= PAD) & (rows < 20 - PAD)
    resample(before, offset, numpy.empty_like(before))
    assert before == pytest.approx(numpy.where(loaded[:, None], expected, 0.0), rel=1e-12)


def test_a_locked_wheel_drags_its_bristles_and_then_slides():
    contact = strip_contact(COULOMB, 40, parabola)
    contact.step(RollingStep(0.0, 0.0, 0.0))
    way = 1e-5
    result = contact.roll(way, -1.0, 0.0)
    stress = numpy.minimum(STIFFNESS * way, 0.9 * contact.pressure)
    area = contact.grid.cell_x * contact.grid.cell_y
    assert result.force_x == pytest.approx(-stress.sum() * area, rel=1e-12)
    result = contact.roll(0.05, -1.0, 0.0)
    assert result.force_x == pytest.approx(-0.9 * contact.pressure.sum() * area, rel=1e-12)
    assert abs(result.moment_z) < 1e-9
    limit = 0.9 * contact.pressure
    slid = numpy.where(limit > STIFFNESS * way, 0.05 + way - limit / STIFFNESS, 0.05)
    assert result.dissipated == pytest.approx((limit * slid).sum() * area, rel=1e-9)


def test_without_load_there_is_no_friction():
    contact = strip_contact(COULOMB, 20, parabola)
    contact.roll(0.01, 0.1, 0.1, 5)
    result = contact.step(rolling_step(0.01, 0.1, 0.1), pressure=numpy.zeros_like(contact.pressure))
    assert result[:4] == (0.0, 0.0, 0.0, 0.0)
    assert not contact.shear_x.any()
    assert not contact.shear_y.any()
    assert not contact.deflections.any()


def test_a_hole_in_the_contact_frees_the_bristles_that_pass_it():
    contact = strip_contact(ENDLESS, 40, uniform)
    contact.pressure[20:24] = 0.0
    contact.roll(0.012, 0.0, 0.01, 20)
    cell = contact.grid.cell_x
    grown = STIFFNESS * math.tan(0.01) * cell
    assert contact.shear_y[19, 0] == pytest.approx(-0.5 * grown, rel=1e-9)
    assert contact.shear_y[4, 0] == pytest.approx(-15.5 * grown, rel=1e-9)
    assert contact.shear_y[24, 0] == pytest.approx(-19.5 * grown, rel=1e-9)
    assert not contact.shear_y[20:24].any()


def test_at_standstill_every_bristle_sticks():
    contact = hertz_contact(STICKY, 40, 20, (0.08, 0.06), 0.4e6)
    moving = contact.roll(0.0137, 0.05, 0.1, 12)
    stresses = contact.shear_x.copy(), contact.shear_y.copy()
    held = contact.roll(0.0, 0.05, 0.1, 3)
    assert held[:3] == pytest.approx(moving[:3], rel=1e-12)
    assert held[3] == moving[3]
    assert held[4:] == (0.0, 0.0)
    assert numpy.allclose(contact.shear_x, stresses[0], rtol=1e-12)
    assert numpy.allclose(contact.shear_y, stresses[1], rtol=1e-12)


def test_at_standstill_a_falling_pressure_lets_the_bristles_slip():
    contact = strip_contact(COULOMB, 20, parabola)
    full = contact.pressure.copy()
    contact.roll(0.01, 0.0, 0.3, 20)
    contact.step(rolling_step(0.0, 0.0, 0.0), pressure=0.5 * full)
    half = contact.result.force_y
    again = contact.step(rolling_step(0.0, 0.0, 0.0), pressure=full)
    assert again.force_y == pytest.approx(half, rel=1e-3), "what has slipped does not come back"


def test_the_other_slip_angle_gives_the_mirror_image():
    left, right = (strip_contact(STICKY, 40, parabola) for _ in range(2))
    a, b = left.roll(0.0137, 0.04, 0.07, 9), right.roll(0.0137, 0.04, -0.07, 9)
    assert (a.force_x, a.force_y, a.sliding_share) == (b.force_x, -b.force_y, b.sliding_share)
    assert a.moment_z == pytest.approx(-b.moment_z, rel=1e-12)


def test_rolling_backwards_is_the_mirror_image_of_rolling_forwards():
    ahead, back = (strip_contact(STICKY, 40, parabola) for _ in range(2))
    a, b = ahead.roll(0.0137, 0.04, 0.07, 9), back.roll(-0.0137, 0.04, -0.07, 9)
    assert b.force_x == pytest.approx(-a.force_x, rel=1e-6)
    assert b.force_y == pytest.approx(a.force_y, rel=1e-6)
    assert b.moment_z == pytest.approx(-a.moment_z, rel=1e-6)


def test_a_wheel_that_turns_on_the_spot_is_driven_by_the_kinetic_friction():
    contact = strip_contact(STICKY, 40, parabola)
    for _ in range(10):
        result = contact.step(RollingStep(0.0, 0.02, 0.0))
    load = contact.pressure.sum() * contact.grid.cell_x * contact.grid.cell_y
    assert result.force_x == pytest.approx(0.7 * load, rel=1e-2)


def test_a_belt_that_yaws_on_the_spot_drags_each_bristle_by_its_lever():
    """A point x, y of the belt moves by psi (-y, x), the road holds the tip: tau = k psi (y, -x), as long as all stick."""
    yaw = 1e-4
    contact = strip_contact(ENDLESS, 24, uniform, cols=7)
    contact.grid = contact.grid._replace(origin_x=contact.grid.origin_x + 0.02, origin_y=contact.grid.origin_y - 0.03)
    result = contact.step(RollingStep(0.0, 0.0, 0.0, 0.1, yaw))
    rows, cols = contact.pressure.shape
    x = contact.grid.origin_x + contact.grid.cell_x * numpy.arange(rows)[:, None]
    y = contact.grid.origin_y + contact.grid.cell_y * numpy.arange(cols)[None, :]
    loaded = contact.pressure > 0.0
    assert contact.shear_x == pytest.approx(numpy.where(loaded, STIFFNESS * yaw * y, 0.0), rel=1e-9)
    assert contact.shear_y == pytest.approx(numpy.where(loaded, -STIFFNESS * yaw * x, 0.0), rel=1e-9)
    # Of the rectangle about the origin of the frame: area times lever, polar moment of area.
    area, square = 2.0 * HALF_LENGTH * WIDTH, (4.0 * HALF_LENGTH**2 + WIDTH**2) / 12.0
    assert result.force_x == pytest.approx(-STIFFNESS * yaw * area * 0.03, rel=1e-9)
    assert result.force_y == pytest.approx(-STIFFNESS * yaw * area * 0.02, rel=1e-9)
    assert result.moment_z == pytest.approx(-STIFFNESS * yaw * area * (square + 0.02**2 + 0.03**2), rel=1e-2)


def test_the_same_steps_give_the_same_bits():
    results = []
    for _ in range(2):
        contact = hertz_contact(STICKY, 30, 20, (0.08, 0.06), 0.4e6)
        results.append((contact.roll(0.0137, 0.05, 0.1, 7), contact.shear_x.tobytes(), contact.shear_y.tobytes()))
    assert results[0] == results[1]


def test_power_of_the_slip_is_what_friction_dissipates():
    for slip_angle in (0.03, 0.1, 0.3):
        contact = strip_contact(COULOMB, 128, parabola)
        result = contact.roll(0.0137, 0.02, slip_angle, 14)
        work = result.force_x * 0.02 * 0.0137 - result.force_y * math.tan(slip_angle) * 0.0137
        assert result.dissipated + result.released == pytest.approx(work, rel=5e-3)


def test_bristles_that_only_stick_release_the_energy_that_their_way_through_the_contact_stored():
    """Each leaves with the deflection 2a tan(alpha): k (2a tan(alpha))^2/2 for each area that has passed."""
    slip_angle, cells, rolled = 0.1, 24, 6
    contact = strip_contact(ENDLESS, cells, uniform)
    half = 0.5 * contact.grid.cell_x  # bristles stand on the border of the contact at the end of every other step
    contact.roll(half, 0.0, slip_angle, 2 * cells + 4)
    results = [contact.roll(half, 0.0, slip_angle) for _ in range(2 * rolled)]
    stored = 0.5 * STIFFNESS * (2.0 * HALF_LENGTH * math.tan(slip_angle)) ** 2
    released = sum(result.released for result in results)
    assert released == pytest.approx(stored * rolled * contact.grid.cell_x * WIDTH, rel=1e-9)
    assert not any(result.dissipated for result in results)


@pytest.mark.parametrize(("sliding", "drift"), [(0.5, 0.0), (0.0, 3.0), (-3.0, 4.0)])
def test_sliding_friction_falls_with_the_slip_speed_as_polachs_law_says(sliding, drift):
    """A belt that stands still in its contact slides: after a way that no bristle can follow each carries mu(v) p."""
    speed, duration = 2.0, 0.1
    contact = strip_contact(STICKY._replace(speed=speed), 20, parabola)
    for _ in range(2):
        result = contact.step(RollingStep(-sliding * duration, 0.0, drift * duration, duration))
    coefficient = 0.7 + 0.3 * math.exp(-math.hypot(sliding, drift) / speed)
    load = contact.pressure.sum() * contact.grid.cell_x * contact.grid.cell_y
    assert math.hypot(result.force_x, result.force_y) == pytest.approx(coefficient * load, rel=1e-9)
    assert math.atan2(result.force_y, result.force_x) == pytest.approx(math.atan2(-drift, sliding), abs=1e-9)


def test_energy_of_a_start_is_stored_dissipated_or_released():
    contact = strip_contact(COULOMB, 128, parabola)
    contact.roll(0.0, 0.0, 0.0)
    before, work, lost = 0.0, 0.0, 0.0
    for _ in range(80):
        result = contact.roll(0.0011, 0.0, 0.1)
        work += -0.5 * (before + result.force_y) * math.tan(0.1) * 0.0011
        lost += result.dissipated + result.released
        before = result.force_y
    cell_area = contact.grid.cell_x * contact.grid.cell_y
    stored = 0.5 * STIFFNESS * (contact.deflections**2).sum() * cell_area
    assert work == pytest.approx(stored + lost, rel=5e-3)
    assert 0.02 * work < stored < 0.9 * work


@settings(max_examples=80)
@given(
    steps=st.lists(
        st.tuples(
            st.floats(-0.05, 0.1), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1), st.floats(0.0, 2.0), st.floats(-1.0, 1.0)
        ),
        min_size=1,
        max_size=6,
    ),
    ratios=st.tuples(st.floats(0.1, 1.5), st.floats(0.2, 1.0)),
    softness=st.floats(0.1, 10.0),
)
def test_friction_dissipates_and_never_exceeds_the_static_limit(steps, ratios, softness):
    brush = Brush(STIFFNESS, softness * STIFFNESS, ratios[0], ratios[0] * ratios[1])
    contact = hertz_contact(brush, 16, 8, (0.08, 0.06), 0.4e6)
    full, origin = contact.pressure.copy(), contact.grid.origin_x
    for travel, belt, drift, scale, jitter in steps:
        result = contact.step(
            RollingStep(travel, belt, drift), scale * full, origin + 0.5 * jitter * contact.grid.cell_x
        )
        stress = numpy.hypot(contact.shear_x, contact.shear_y)
        assert numpy.all(stress <= brush.coefficient_static * contact.pressure * (1.0 + 1e-12))
        assert min(result.dissipated, result.released) >= 0.0
        assert 0.0 <= result.sliding_share <= 1.0
        assert numpy.all(numpy.isfinite(result))


def test_bristles_move_to_a_wider_grid_and_back():
    stays, moves = (hertz_contact(STICKY, 30, 20, (0.08, 0.06), 0.4e6) for _ in range(2))
    for contact in (stays, moves):
        contact.roll(0.0137, 0.05, 0.05, 4)
    (rows, cols), grid, pressure = stays.pressure.shape, moves.grid, moves.pressure
    for more_rows, more_cols in ((7, 4), (0, 0)):
        moves.state = brush_state_on(moves.state, rows + 2 * more_rows, cols + 2 * more_cols, grid.cell_x)
        moves.pressure = numpy.pad(pressure, ((more_rows, more_rows), (more_cols, more_cols)))
        moves.shear_x, moves.shear_y = numpy.zeros_like(moves.pressure), numpy.zeros_like(moves.pressure)
        moves.mode = numpy.zeros(moves.pressure.shape, dtype=numpy.uint8)
        moves.grid = grid._replace(
            origin_x=grid.origin_x - more_rows * grid.cell_x, origin_y=grid.origin_y - more_cols * grid.cell_y
        )
        expected, found = stays.roll(0.0111, 0.05, 0.05), moves.roll(0.0111, 0.05, 0.05)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 1.0, 1.0001, 4.0])
@pytest.mark.parametrize("limit", [1.0, 1e3, 9.9e4])
def test_the_sliding_way_solves_coulombs_law(ratio, limit):
    brush = Brush(2.0e7, ratio * 2.0e7, 1.0, 1.0)
    trial = (6.0e4, 8.0e4)

    def excess(way):
        return math.hypot(trial[0] / (1.0 + way * 2.0e7), trial[1] / (1.0 + way * ratio * 2.0e7)) - limit

    way = brentq(excess, 0.0, 1.0, xtol=1e-300, rtol=1e-14)
    assert unit_slide(brush, *trial, limit) == pytest.approx(way, rel=1e-7)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_ways_that_are_not_finite_end_in_forces_that_are_not(bad):
    result = strip_contact(STICKY, 20, parabola).step(RollingStep(0.01, bad, 0.0))
    assert not math.isfinite(result.force_x)


def test_bad_numbers_are_refused_by_name():
    with pytest.raises(ValueError, match="travel is nan, it must be a finite number"):
        rolling_step(math.nan, 0.0, 0.0)
    with pytest.raises(ValueError, match=r"slip angle is 2\.0 rad, it must lie between"):
        rolling_step(1.0, 0.0, 2.0)
    with pytest.raises(ValueError, match="grid of 0 x 4 cells"):
        make_brush_state(0, 4)
    with pytest.raises(ValueError, match="from 4 to 7 columns, the two must differ by an even number"):
        brush_state_on(make_brush_state(4, 4), 4, 7, 0.01)


def test_a_field_that_is_not_on_the_cells_of_the_bristles_is_refused():
    state, grid = make_brush_state(6, 5), PatchGrid(0.0, 0.0, 0.01, 0.01)
    right, wrong = numpy.zeros((6, 5)), numpy.zeros((5, 6))
    mode = numpy.zeros((6, 5), dtype=numpy.uint8)
    for fields in ((wrong, right, right, mode), (right, wrong, right, mode), (right, right, right, mode[:4].copy())):
        with pytest.raises(ValueError, match="not on the cells of the bristles"):
            advance_brush(COULOMB, state, grid, fields[0], rolling_step(0.01, 0.0, 0.0), *fields[1:])


def test_bristles_that_a_falling_pressure_lets_go_lose_what_they_had_stored():
    """Strained on a standing belt, then the pressure falls to a tenth: friction takes the difference of k u^2 / 2."""
    contact = strip_contact(COULOMB, 20, uniform)
    contact.step(RollingStep(0.0, 0.0, 0.0))
    contact.step(RollingStep(5e-3, 0.0, 0.0))
    area, before = contact.grid.cell_x * contact.grid.cell_y, contact.deflections.copy()
    assert 0.1 * 0.9 * PEAK < STIFFNESS * before.max() < 0.9 * PEAK  # they stick
    result = contact.step(RollingStep(0.0, 0.0, 0.0), 0.1 * contact.pressure)
    lost = 0.5 * STIFFNESS * area * (before**2 - contact.deflections**2).sum()
    assert lost > 0.0
    assert result.dissipated == pytest.approx(lost, rel=1e-9)
