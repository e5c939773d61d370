"""Memory of the tread: relaxation and creep of a sphere in closed form, and a rolling contact against the hereditary integral."""

from __future__ import annotations

import math

import numpy
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from contact_sim_lab.twins import halfspace as reference
from contact_sim_pkg.pressure.settings import FieldSettings, InflatedBelt
from contact_sim_pkg.rigs.vehicle.field.contact_field import PressureField
from contact_sim_pkg.rigs.vehicle.field.inflated_belt import rubber_share
from contact_sim_pkg.rigs.vehicle.tire.parameters import TreadViscoelasticity
from contact_sim_pkg.rigs.vehicle.tire.tread_viscoelasticity import TreadState, stiffening

Field = NDArray[numpy.float64]
RELAXED, RADIUS, STEP = 4e6, 0.3, 2e-3
TREAD = TreadViscoelasticity(0.0, numpy.array([0.8, 0.4]), numpy.array([5e-3, 4e-2]))
KELVIN_VOIGT = TreadViscoelasticity(6e-3, numpy.empty(0), numpy.empty(0))
SETTINGS = FieldSettings(48, 48, 3e-3, 3e-3, RELAXED, 1e-9, 400, 0)


def sphere(settings: FieldSettings, shift: float = 0.0) -> Field:
    x = (numpy.arange(settings.rows) - 0.5 * (settings.rows - 1)) * settings.cell_x - shift
    y = (numpy.arange(settings.cols) - 0.5 * (settings.cols - 1)) * settings.cell_y
    return numpy.asarray((x[:, None] ** 2 + y[None, :] ** 2) / (2.0 * RADIUS))


class Pressing:
    """A field and its memory, solved step by step."""

    def __init__(self, tread: TreadViscoelasticity, step: float = STEP, settings: FieldSettings = SETTINGS) -> None:
        self.tread_state = TreadState(settings, RELAXED, tread, step)
        self.field = PressureField(settings._replace(modulus=RELAXED * stiffening(tread, step)), "tire")

    def at_approach(self, gap: Field, approach: float) -> float:
        load = self.field.solve(gap + self.tread_state.gap, approach)
        self.tread_state.store(self.field.pressure)
        return load

    def at_load(self, gap: Field, load: float) -> float:
        approach = self.field.solve_load(gap + self.tread_state.gap, load)
        self.tread_state.store(self.field.pressure)
        return approach


def test_the_modulus_over_a_step_is_the_mean_of_the_relaxation_over_it() -> None:
    def relaxation(time: float) -> float:
        return 1.0 + float((TREAD.ratios * numpy.exp(-time / TREAD.times)).sum())

    mean, _ = quad(relaxation, 0.0, STEP)
    assert stiffening(TREAD, STEP) == pytest.approx(mean / STEP, rel=1e-12)
    assert stiffening(KELVIN_VOIGT, STEP) == pytest.approx(1.0 + 6e-3 / STEP)


def test_a_fixed_sphere_relaxes_as_the_modulus_does() -> None:
    pressing, gap = Pressing(TREAD), sphere(SETTINGS)
    elastic = PressureField(SETTINGS, "tire").solve(gap, 4e-3)
    for step in range(1, 30):
        ramp = TREAD.ratios * (TREAD.times / STEP) * -numpy.expm1(-STEP / TREAD.times)  # pressed in over the first step
        expected = 1.0 + float((ramp * numpy.exp(-(step - 1) * STEP / TREAD.times)).sum())
        assert pressing.at_approach(gap, 4e-3) == pytest.approx(elastic * expected, rel=1e-6)


def test_a_loaded_sphere_creeps_as_a_kelvin_voigt_element_does() -> None:
    # Lee and Radok: under a constant load delta^(3/2) follows the creep compliance, 1 - exp(-t/T) for Kelvin-Voigt
    step = 2e-4
    pressing, gap = Pressing(KELVIN_VOIGT, step), sphere(SETTINGS)
    final = PressureField(SETTINGS, "tire").solve_load(gap, 500.0)
    found = numpy.array([pressing.at_load(gap, 500.0) for _ in range(60)])
    time = numpy.arange(1, 61) * step
    expected = final * (1.0 - numpy.exp(-time / 6e-3)) ** (2.0 / 3.0)
    assert found[20:] == pytest.approx(expected[20:], rel=0.025)  # first order in time: h/(2 T) is 0.017


def test_a_sphere_pressed_in_faster_and_faster_follows_lee_and_radok() -> None:
    pressing, gap = Pressing(TREAD, 1e-3), sphere(SETTINGS)
    elastic = PressureField(SETTINGS, "tire").solve(gap, 4e-3) / 4e-3**1.5  # the grid's own 4/3 E* sqrt(R)

    def approach(time: float) -> float:
        return 4e-3 * (time / 0.04) ** 1.5

    for step in range(1, 41):
        load, time = pressing.at_approach(gap, approach(step * 1e-3)), step * 1e-3

    def integrand(earlier: float) -> float:
        relaxation = 1.0 + float((TREAD.ratios * numpy.exp(-(time - earlier) / TREAD.times)).sum())
        return relaxation * 4e-3**1.5 * 2.25 / 0.04 * (earlier / 0.04) ** 1.25

    expected, _ = quad(integrand, 0.0, time)
    assert load == pytest.approx(elastic * expected, rel=0.01)


def test_a_tread_that_stood_for_long_carries_what_an_elastic_one_does() -> None:
    gap = sphere(SETTINGS)
    elastic = PressureField(SETTINGS, "tire")
    load = elastic.solve(gap, 4e-3)
    pressing = Pressing(TREAD)
    pressing.tread_state.settle(0, elastic.pressure)
    for _ in range(3):
        assert pressing.at_approach(gap, 4e-3) == pytest.approx(load, rel=1e-7)


def test_rolling_follows_the_hereditary_integral_summed_over_the_whole_past() -> None:
    settings = FieldSettings(20, 10, 6e-3, 9e-3, RELAXED, 1e-10, 400, 0)
    dense = reference.dense_influence(20, 10, 6e-3, 9e-3, RELAXED)
    pressing, steps, length = Pressing(TREAD, STEP, settings), 12, 20 * 6e-3
    wide = numpy.zeros((20 + steps, 10))  # displacement of the road's rows that ever come into the grid
    changes: list[Field] = []
    for step in range(steps):
        gap = sphere(settings)
        pressing.tread_state.move_to(step)  # one row a step: 3 m/s
        load = pressing.at_approach(gap, 3e-3)
        rows = slice(step, step + 20)
        remembered, raised = _hereditary(changes, wide, rows, step)
        pressure = reference.pressure_at_approach(dense / raised, gap + remembered, 3e-3)
        now = reference.displacement(dense / raised, pressure) + remembered
        after = wide.copy()
        after[rows] = now
        after[rows.stop :] = now[-1]  # rows yet to come are as the row beside them
        changes.append(after - wide)
        wide = after
        assert load == pytest.approx(pressure.sum() * 6e-3 * 9e-3, rel=1e-6)
        assert pressing.field.pressure == pytest.approx(pressure, abs=1e-6 * pressure.max())
    x = (numpy.arange(20) - 9.5) * 6e-3
    assert (
        0.0 < (pressure * x[:, None]).sum() / pressure.sum() < 0.1 * length
    )  # the contact carries more in front: drag


def _hereditary(changes: list[Field], wide: Field, rows: slice, step: int) -> tuple[Field, float]:
    """What the whole past leaves as displacement without pressure, and the modulus of the step over the relaxed one."""
    times, ratios = TREAD.times, TREAD.ratios
    mean = [
        float((ratios * (times / STEP) * -numpy.expm1(-STEP / times) * numpy.exp(-k * STEP / times)).sum())
        for k in range(step + 1)
    ]  # of the branches' relaxation between k and k + 1 steps after a change
    total = mean[0] * wide
    for earlier, change in enumerate(changes):
        total = total - mean[step - earlier] * change
    raised = 1.0 + mean[0]
    return total[rows] / raised, raised


def test_a_slow_and_a_fast_wheel_roll_with_less_drag_than_one_between() -> None:
    settings = FieldSettings(48, 20, 3e-3, 6e-3, RELAXED, 1e-6, 400, 0)
    tread = TreadViscoelasticity(0.0, numpy.array([1.0]), numpy.array([0.02]))
    x = (numpy.arange(48) - 23.5) * 3e-3
    ahead = {}
    for name, step in (("slow", 0.5), ("between", 2e-3), ("fast", 1e-5)):  # a row a step
        pressing = Pressing(tread, step, settings)
        for row in range(60):
            pressing.tread_state.move_to(row)
            pressing.at_approach(sphere(settings), 3e-3)
        p = pressing.field.pressure
        ahead[name] = (p * x[:, None]).sum() / p.sum()
    assert ahead["between"] > 5.0 * max(abs(ahead["slow"]), abs(ahead["fast"]))


def test_a_reset_tread_is_unstrained() -> None:
    pressing, gap = Pressing(TREAD), sphere(SETTINGS)
    first = pressing.at_approach(gap, 4e-3)
    pressing.at_approach(gap, 4e-3)
    pressing.tread_state.reset()
    pressing.field.reset()
    assert pressing.at_approach(gap, 4e-3) == first


@pytest.mark.parametrize("bending", [2.0, 0.0])
def test_the_share_of_the_rubber_is_that_of_each_wave(bending):
    """A wave n imposed all round the ring comes back as V_n / (D_n + S V_n) of it, here by the formula."""
    cells, radius, stiffer = 200, 0.3, 0.7
    cell = 2.0 * math.pi * radius / cells
    belt = InflatedBelt(radius, 7000.0, 6e5, 1e5, bending, 0.0, None, 5e4)
    one_side = rubber_share(belt, stiffer, cells // 2 + 1, cell)
    around = numpy.concatenate([one_side, one_side[-2:0:-1]])
    for n in (2, 5, 12):
        wave = numpy.cos(n * numpy.arange(cells) * cell / radius)
        rubber = 5e4 + bending * (n**2 - 1) ** 2 / radius**4
        rigidity = 6e5 - 5e4 + 1e5 / n**2 + 7000.0 * (n**2 - 1) / radius**2 + rubber
        averaged = math.sin(0.5 * n * cell / radius) / (0.5 * n * cell / radius)  # over the cell that is imposed
        expected = rubber / (rigidity + stiffer * rubber)
        shortest = 1.0 / (1.0 + stiffer) if bending else 0.0
        assert around @ wave == pytest.approx(shortest + (expected - shortest) * averaged, rel=1e-3)
