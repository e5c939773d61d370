"""A contact that outgrows its grid: solved on a wider one, recorded, summarised; refused by name where that is too small."""

import subprocess
import sys

import numpy
import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.records.messages import ContactPatch, SolverCost
from contact_sim_pkg.report.reading import FieldReader, read_recording
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.run.offline import run_offline
from contact_sim_pkg.scene.errors import SceneError

LEFT_OUT = """
import sys
from contact_sim_pkg.compiled.jit import never_called
from contact_sim_pkg.run.rigs import make_simulation
from contact_sim_pkg.scene.resolve import load_resolved

make_simulation(load_resolved("tire_half_space", sys.argv[1])).prepare()
print(*(entry.__name__ for entry in never_called()))
"""


def test_a_high_bump_is_run_on_two_grids_and_summarised(tmp_path):
    outcome = run_offline(resolved("tire_bump", "road.height=0.1", "duration=1.2"), tmp_path / "bag")
    assert outcome.failure == ""
    messages = list(open_bag(tmp_path / "bag").messages())
    fields = [decode(ContactPatch, m.data) for m in messages if m.topic == "/tire/patch"]
    assert {field.pressure.shape for field in fields} == {(72, 48), (144, 96)}
    for field in fields:
        assert float(field.pressure.sum()) * field.cell_x * field.cell_y == pytest.approx(
            field.load, rel=1e-6, abs=1e-9
        )
    field = read_recording(open_bag(tmp_path / "bag")).fields["tire"]
    assert field.peak.max() == pytest.approx(max(each.peak for each in fields), rel=1e-6)
    # Behind the bump a block has the residual of its own fields: no two are the same to the bit, and a
    # wheel in the air has none
    behind = 1 + max(field.block for field in fields if field.pressure.shape == (144, 96))
    touching = {field.block for field in fields if field.load > 0.0}
    costs = [decode(SolverCost, m.data) for m in messages if m.topic == "/bench/cost"][behind:]
    residuals = [cost.field_residual for cost in costs if cost.block in touching]
    assert len(set(residuals)) == len(residuals) > 5
    assert {cost.field_residual for cost in costs if cost.block not in touching} == {0.0}


def test_a_grid_that_the_standing_contact_fills_compiles_nothing_later():
    """Only the bump leaves room around the contact, so that a window is smaller than the grid."""
    small = ("effects.tire.contact_field.length=0.14", "effects.tire.contact_field.width=0.22")
    scene = resolved("tire_bump", *small, "road.height=0.015", "duration=1.2")
    assert run_offline(scene, None).failure == ""


def test_what_looks_beside_a_grid_is_compiled_where_the_run_starts_on_the_wide_one():
    """In a process of its own: here another test may have called it."""
    grid = "effects.tire.contact_field={length: 0.15, width: 0.2, rows: 31, cols: 27}"
    done = subprocess.run([sys.executable, "-c", LEFT_OUT, grid], capture_output=True, text=True, check=True)
    assert not {"clear_beyond", "touches_beyond", "grown_window", "mean_slope"} & set(done.stdout.split())


def test_a_heavy_car_starts_on_the_wide_grid():
    assert run_offline(resolved("tire_bump", "tire.body_mass=3000", "duration=0.05"), None).failure == ""


def test_a_grid_that_cannot_hold_the_standing_contact_is_refused_by_name():
    with pytest.raises(
        SceneError, match=r"effects\.tire\.contact_field: the contact does not fit .* enlarge length and width"
    ):
        Simulation(resolved("tire_half_space", "effects.tire.contact_field.length=0.02"))


def patch(pressure, origin=(0.0, 0.0), cell=0.01):
    rows, cols = pressure.shape
    values = ContactPatch(
        block=0, cell_x=cell, cell_y=cell, origin_x=origin[0], origin_y=origin[1], load=1.0, peak=float(pressure.max()),
        mean=0.0, area=0.0, centre_x=0.0, centre_y=0.0, approach=0.0, lame_a=0.0, lame_b=0.0, lame_n=2.0, pressure=pressure,
    )  # fmt: skip
    return type("Message", (), {**values._asdict(), "pressure": pressure.ravel(), "rows": rows, "cols": cols})()


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_mean_lays_cells_over_each_other_by_their_place(order):
    wide = numpy.arange(48.0).reshape(6, 8)
    narrow = numpy.full((2, 4), 100.0)
    messages = [patch(wide, (-0.03, -0.04)), patch(narrow, (-0.01, -0.02))]
    fields = FieldReader()
    for number in order:
        fields.add(0.01 * number, messages[number])
    expected = wide.copy()
    expected[2:4, 2:6] += 100.0
    series = fields.finish()
    numpy.testing.assert_allclose(series.average.pressure, expected / 2.0)
    assert series.highest.pressure.shape == (2, 4)


def test_fields_on_other_cells_are_refused():
    fields = FieldReader()
    fields.add(0.0, patch(numpy.ones((4, 4))))
    with pytest.raises(BagError, match="same cells"):
        fields.add(0.01, patch(numpy.ones((4, 4)), cell=0.02))
    with pytest.raises(BagError, match="must hold the other"):
        fields.add(0.01, patch(numpy.ones((6, 2))))
