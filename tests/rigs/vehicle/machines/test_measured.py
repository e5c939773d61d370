"""What the test machines measure, beside closed forms."""

import math

import numpy
import pytest

from contact_sim_pkg.records.procedure import ProcedureError
from contact_sim_pkg.rigs.vehicle.machines import measured
from contact_sim_pkg.rigs.vehicle.machines.procedures import QUANTITIES, procedures_of
from contact_sim_pkg.rigs.vehicle.machines.specimen import (
    USUAL,
    body_at,
    refuse_beyond_law,
    scene_on,
    specimen_of,
    table_at,
)
from contact_sim_pkg.rigs.vehicle.tire.force_table import gap_over_level_road
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.scene.load import load_scene

TIRE = {"inflation": {}}
AT = {"load": 4000.0, "inflation": 220e3, "drum_diameter": 0.0}


def test_every_condition_and_column_is_a_known_quantity_in_its_range():
    for each in procedures_of(USUAL).values():
        for sheet in each.sheets:
            assert {*sheet.columns, *each.varied, *each.held} <= {*QUANTITIES}
        for conditions in each.conditions():
            for name, value in conditions.items():
                assert QUANTITIES[name].least <= value <= QUANTITIES[name].most


def test_the_tire_is_that_of_the_scene_without_its_road_and_field():
    specimen = specimen_of(load_scene("tire_cleat"))
    assert {*specimen.effects} == {
        "inflation", "normal_dissipative", "rigid_ring", "brush", "sidewall_compliance", "wheel_spin",
    }  # fmt: skip
    assert specimen.inflation == Inflation().pressure
    assert specimen.load == pytest.approx(340.0 * 9.81)


@pytest.mark.parametrize(("name", "said"), [("seat_ride", "has no tire"), ("tire_half_space", "half-space")])
def test_a_scene_without_an_inflated_tire_is_refused(name, said):
    with pytest.raises(ProcedureError, match=said):
        specimen_of(load_scene(name))


def test_a_ring_whose_stiffness_is_left_open_follows_the_inflation_of_the_case():
    effects = {"inflation": {}, "rigid_ring": {}}
    stiff = [
        scene_on(effects, {"load": 4000.0, "inflation": each}, ("inflation", "rigid_ring")).data["effects"]["tire"][
            "rigid_ring"
        ]
        for each in (160e3, 220e3)
    ]
    assert stiff[0]["stiffness"] < stiff[1]["stiffness"] == Inflation().ring_stiffness


def test_the_pressure_map_carries_the_load_on_the_contact():
    sheets = measured.standing(TIRE, AT)
    (row,), cells, cell = sheets[""], sheets["map"], table_at(TIRE, AT).cell
    assert sum(each["pressure"] for each in cells) * cell.prod() == pytest.approx(AT["load"], rel=2e-3)
    assert len(cells) * cell.prod() == pytest.approx(row["area"], rel=0.1)
    assert sum(each["x"] * each["pressure"] for each in cells) == pytest.approx(0.0, abs=1e-3)
    assert row["mean_pressure"] == AT["load"] / row["area"]


def test_on_a_drum_the_gap_is_that_of_two_circles():
    body, x = body_at(TIRE, 220e3, 1.7), numpy.linspace(-0.15, 0.15, 7)
    gap = gap_over_level_road(body.form, x, numpy.zeros(1))[:, 0]
    radius = body.form.radius_rolling
    circles = radius - numpy.sqrt(radius**2 - x**2) + 0.85 - numpy.sqrt(0.85**2 - x**2)
    assert gap == pytest.approx(circles, abs=1e-14)


def test_a_drum_shortens_the_footprint_and_costs_more_the_smaller_it_is():
    flat, large, small = (
        {**measured.standing(TIRE, {**AT, "drum_diameter": each})[""][0],
         **measured.rolling(TIRE, {**AT, "drum_diameter": each, "speed": 22.0})[""][0]}
        for each in (0.0, 1e4, 1.7)
    )  # fmt: skip
    assert large["length"] == pytest.approx(flat["length"], rel=1e-3)
    assert large["resistance"] == pytest.approx(flat["resistance"], rel=1e-3)
    assert small["length"] < 0.9 * flat["length"]
    assert small["deflection"] > flat["deflection"]
    assert small["resistance"] > flat["resistance"]
    assert small["usual_factor"] == pytest.approx(math.sqrt(1.0 + body_at(TIRE, 220e3).form.radius_rolling / 0.85))


def test_a_load_beyond_the_law_is_refused_by_its_end():
    with pytest.raises(ProcedureError, match=r"load 30000 N is beyond the law, which ends at \d+ N"):
        refuse_beyond_law(TIRE, {**AT, "load": 3e4})


def test_modes_of_the_free_belt_and_of_the_wheel_are_those_of_their_springs():
    (row,) = measured.modes(TIRE, {**AT, "wheel_mass": 40.0, "body_mass": 1e9, "suspension_stiffness": 20e3})[""]
    tire = measured.standing(TIRE, AT)[""][0]["stiffness"]
    assert row["wheel_hop"] == pytest.approx(math.sqrt((tire + 20e3) / 40.0) / (2.0 * math.pi), rel=1e-6)
    assert row["belt_windup"] == pytest.approx(math.sqrt(8.2e4 / 0.6) / (2.0 * math.pi))
    assert row["belt_side"] == pytest.approx(math.sqrt(1.75e5 / 7.0) / (2.0 * math.pi))
    assert row["road_high"] > max(row["belt_along"], row["belt_windup"])


def test_small_steady_slip_is_as_of_the_springs_of_the_bristles():
    """Pacejka 3.2: F_x = 2 k w a^2 kappa = k A^2 / (2 w) kappa of an oblong contact; here within its form."""
    conditions = {"load": 4000.0, "inflation": 220e3, "speed": 16.0, "slip_angle": 0.0, "slip": -0.002}
    (row,) = measured.steady_slip(
        {**TIRE, "brush": {"stiffness_x": 8.4e7, "stiffness_y": 8.4e7}, "sidewall_compliance": {"extension": 0.0}},
        conditions,
    )[""]
    contact = measured.standing(TIRE, AT)[""][0]
    assert row["longitudinal_force"] == pytest.approx(
        -0.002 * 8.4e7 * contact["area"] ** 2 / (2.0 * contact["width"]), rel=0.12
    )
    assert row["lateral_force"] == pytest.approx(0.0, abs=1.0)
    assert math.isnan(row["trail"])
