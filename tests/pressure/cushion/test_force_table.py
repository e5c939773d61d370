"""Table of a cushion: force law between the nodes, maps that add up to the force, and tables kept on disk."""

import hashlib
import io
import math
import os

import numpy
import pytest
from scipy.interpolate import CubicSpline
from tests.pressure.cushion.cushions import PAN, pan_layer

from contact_sim_pkg.laws.elastic_law import approach_of_force, elastic_energy, elastic_force, elastic_stiffness
from contact_sim_pkg.pressure import kept_arrays as kept_arrays_module
from contact_sim_pkg.pressure.cushion.force_table import (
    SPACING,
    SPARSE,
    ForceTable,
    between,
    kept_table,
    make_table,
    smoothed,
    without_maps,
)
from contact_sim_pkg.run.tables_between import KeyRange

F_TABLE = (5.9, 20.7, 46.3, 95.0, 179.1, 280.5, 386.5, 496.3, 613.3, 746.8, 910.1, 1136.6, 1515.0)  # at 5, 10 ... 65 mm


@pytest.fixture(scope="module")
def layer():
    return pan_layer()


@pytest.fixture(scope="module")
def table(layer):
    return make_table(layer)


def test_regression_of_the_median_on_the_pan(table):
    law = table.law()
    found = [elastic_force(law, 5e-3 * i) for i in range(1, 14)]
    # The lowest point lies between cells: 0.06 mm of approach.
    assert found == pytest.approx(F_TABLE, rel=0.01, abs=1.7)


def test_between_the_nodes_the_law_is_the_layer(layer, table):
    law = table.law()
    for approach in (0.00325, 0.01025, 0.02025, 0.03525, 0.05025, 0.06225):
        found = layer.solve(approach)
        # A cell that enters between two nodes bends the force: seen where few touch.
        assert elastic_force(law, approach) == pytest.approx(found.force, rel=2e-3, abs=0.02)
        assert elastic_energy(law, approach) == pytest.approx(layer.energy(found), rel=2e-3)
    for approach in (0.02, 0.0395, 0.055):
        mean = numpy.mean([elastic_stiffness(law, approach + d) for d in numpy.linspace(-1e-3, 1e-3, 21)])
        ends = [layer.solve(approach + d).force for d in (-1e-3, 1e-3)]
        assert mean == pytest.approx((ends[1] - ends[0]) / 2e-3, rel=0.01)


def test_every_map_adds_up_to_the_force(table):
    law = table.law()
    for approach in (1e-6, 1e-4, 7.3e-4, 0.0123, 0.0399, 0.0679, 0.07, 0.2):
        for factor in (1.0, 0.3):
            force = factor * elastic_force(law, approach)
            pressure = table.map_at(approach, force)
            assert pressure.min() >= 0.0
            assert pressure.sum() * table.cell_area == pytest.approx(force, rel=1e-12)
    assert not table.map_at(0.02, 0.0).any()


def test_a_map_between_two_nodes_is_that_of_the_layer(layer, table):
    for approach in (0.0123, 0.02525, 0.0394, 0.05525):
        found = layer.solve(approach)
        miss = table.map_at(approach, found.force) - found.pressure
        assert numpy.linalg.norm(miss) <= 0.012 * numpy.linalg.norm(found.pressure)


def test_progress_is_reported_to_the_end():
    parts = []
    make_table(pan_layer(cell=0.02), spacing=4e-3, on_progress=parts.append)
    assert len(parts) == 17
    assert parts[-1] == 1.0
    assert parts == sorted(parts)


def test_where_solutions_lead_changes_no_solution(layer, table):
    """Each node against the layer solved from nothing."""
    for i in (1, 2, 3, 40, 90, len(table.force) - 1):
        found = layer.solve(i * SPACING)
        assert table.force[i] == pytest.approx(found.force, rel=1e-8)
        assert table.pressure[i] == pytest.approx(found.pressure, rel=1e-6, abs=1e-6 * float(found.pressure.max()))


def small_table(value=1.0):
    pressure = numpy.full((3, 2, 2), value, dtype=numpy.float32)
    return ForceTable(1e-3, 1e-4, numpy.array([0.0, 1.0, value + 2.0]), numpy.array([0.0, 0.1, 0.2]), pressure)


def refuse():
    raise AssertionError("it was kept")


def test_a_table_is_computed_once_for_each_description(tmp_path):
    first = kept_table("a", small_table, tmp_path)
    again = kept_table("a", refuse, tmp_path)
    assert again.spacing == first.spacing
    assert again.cell_area == first.cell_area
    for name in ("force", "largest_strain", "pressure"):
        assert numpy.array_equal(getattr(again, name), getattr(first, name))
    assert kept_table("b", lambda: small_table(5.0), tmp_path).force[2] == 7.0
    assert kept_table("a", refuse, tmp_path).force[2] == 3.0


@pytest.mark.parametrize("damage", ["cut", "bit", "empty", "foreign"])
def test_a_damaged_file_is_computed_again(tmp_path, damage):
    kept_table("a", small_table, tmp_path)
    (path,) = tmp_path.iterdir()
    content = bytearray(path.read_bytes())
    if damage == "bit":
        content[-20] ^= 1
    path.write_bytes({"cut": content[:-7], "bit": content, "empty": b"", "foreign": b"PK\x03\x04"}[damage])
    assert kept_table("a", small_table, tmp_path).force[2] == 3.0
    assert kept_table("a", refuse, tmp_path).force[2] == 3.0


OPENED = {"mode": lambda path: path.chmod(0o666), "owner": lambda path: os.chown(path, 65534, 65534)}


@pytest.mark.fault("G12")
@pytest.mark.parametrize("way", OPENED)
def test_a_table_that_others_own_or_may_write_is_computed_again(tmp_path, caplog, way):
    """Its force times 1.5, with the right hash in front, as one who may write to it can make it."""
    if way == "owner" and os.getuid() != 0:
        pytest.skip("only root can give a file to another user")
    kept_table("a", small_table, tmp_path)
    (path,) = tmp_path.iterdir()
    with numpy.load(io.BytesIO(path.read_bytes()[32:])) as arrays:
        changed = {**arrays, "force": 1.5 * arrays["force"]}
    buffer = io.BytesIO()
    numpy.savez(buffer, **changed)
    path.write_bytes(hashlib.sha256(buffer.getvalue()).digest() + buffer.getvalue())
    assert kept_table("a", refuse, tmp_path).force[2] == 4.5, "so it would be taken"
    OPENED[way](path)
    assert kept_table("a", small_table, tmp_path).force[2] == 3.0
    (line,) = caplog.messages
    assert str(path) in line
    assert "it is computed again" in line
    assert kept_table("a", refuse, tmp_path).force[2] == 3.0
    assert (path.stat().st_uid, path.stat().st_mode & 0o777) == (os.getuid(), 0o600)


def test_without_a_directory_the_table_is_computed_at_each_start(tmp_path):
    missing = tmp_path / "none"
    assert kept_table("a", small_table, missing).force[2] == 3.0
    assert not missing.exists()


def test_the_oldest_tables_give_way(tmp_path, monkeypatch):
    kept_table("first", small_table, tmp_path)
    (one,) = tmp_path.iterdir()
    monkeypatch.setattr(kept_arrays_module, "MOST_BYTES", 4 * one.stat().st_size + 1)
    for number in range(6):
        kept_table(f"n{number}", small_table, tmp_path)
        for age, path in enumerate(sorted(tmp_path.iterdir(), key=lambda p: p.stat().st_mtime)):
            os.utime(path, (1e9 + age, 1e9 + age))
    assert len(list(tmp_path.iterdir())) == 4
    assert kept_table("n5", refuse, tmp_path).force[2] == 3.0


def solved_below(reach=0.85, **keys):
    """The forces of a table of 10 mm cells, as a run has them."""
    foam = PAN._replace(**keys)
    maps, below = pan_layer(cell=0.01, foam=foam), pan_layer(cell=0.005, foam=foam)
    far = reach * foam.thickness
    return smoothed(make_table(maps, SPACING, far), make_table(below, SPARSE * SPACING, far))


def test_slopes_do_not_scatter_with_the_cells_that_enter():
    """Against cells of a quarter of the maps': 1.1 % of scatter and 4 % at most where those of the maps are solved."""
    finer = make_table(pan_layer(cell=0.0025), SPARSE * SPACING, 0.7 * PAN.thickness)
    exact = CubicSpline(finer.spacing * numpy.arange(len(finer.force)), finer.force)
    approaches = numpy.linspace(0.01, 0.05, 200)
    law = solved_below().law()
    slopes = numpy.array([elastic_stiffness(law, float(each)) for each in approaches])
    miss = slopes / exact(approaches, 1) - 1.0
    assert miss.std() < 1.5e-3
    assert abs(miss).max() < 5e-3


VARIED = {
    "modulus": (4.4e4, 4.6e4),
    "plateau": (3.2e3, 3.6e3),
    "densification": (75.0, 85.0),
    "thickness": (0.078, 0.082),
}


@pytest.mark.parametrize("key", VARIED)
def test_stiffness_at_rest_goes_one_way_over_a_key_of_the_foam(key):
    """In steps of which the smallest moves it by 0.1 %; solved on the cells of the map, it went to and fro."""
    laws = [solved_below(0.6, **{key: float(value)}).law() for value in numpy.linspace(*VARIED[key], 5)]
    steps = numpy.diff([elastic_stiffness(law, approach_of_force(law, 498.0)) for law in laws])
    assert (steps > 0.0).all() or (steps < 0.0).all()
    assert numpy.ptp(steps) < 0.3 * abs(steps).mean()


def test_maps_add_up_to_the_smoothed_force():
    table = solved_below(0.3)
    law = table.law()
    for approach in (1e-4, 7.3e-4, 0.0123, 0.02):
        force = elastic_force(law, approach)
        assert force > 0.0
        assert table.map_at(approach, force).sum() * table.cell_area == pytest.approx(force, rel=1e-12)


def test_between_tables_of_a_key_the_force_is_that_of_its_own_table():
    """Of the plateau, at Chebyshev's points and away from them: 1e-5 of the force, no more than a table scatters."""
    points = KeyRange("seat", "plateau", 2400.0, 4800.0).points
    tables = [solved_below(0.6, plateau=float(each)) for each in points]
    for plateau in (2450.0, 3000.0, 3771.0, 4700.0):
        own = solved_below(0.6, plateau=plateau)
        found = between(numpy.log(points), tables, math.log(plateau))
        assert found.force[10:] == pytest.approx(own.force[10:], rel=1.5e-5)
        assert found.largest_strain == pytest.approx(own.largest_strain, abs=1e-4)
        slopes = [elastic_stiffness(each.law(), 0.03) for each in (found, own)]
        assert slopes[0] == pytest.approx(slopes[1], rel=2e-4)


def test_a_table_without_maps_has_the_forces_of_one_with_them():
    far = 0.4 * PAN.thickness
    forces = make_table(pan_layer(cell=0.005), SPARSE * SPACING, far)
    with_maps = smoothed(make_table(pan_layer(cell=0.01), SPACING, far), forces)
    found = without_maps(forces, SPACING)
    assert numpy.array_equal(found.force, with_maps.force)
    assert found.largest_strain == pytest.approx(with_maps.largest_strain, abs=1e-3)
    assert found.pressure.size == 0


def test_points_of_a_key_are_those_of_chebyshev():
    """Roots of T5 for a factor of two, in the logarithm of the key."""
    found = KeyRange("seat", "plateau", 2.0, 4.0).points
    assert numpy.polynomial.chebyshev.chebval(2.0 * numpy.log2(found) - 3.0, [0, 0, 0, 0, 0, 1]) == pytest.approx(
        numpy.zeros(5), abs=1e-12
    )
    assert len(KeyRange("seat", "plateau", 1.0, 10.0).points) == 9
    with pytest.raises(ValueError, match="low"):
        _ = KeyRange("seat", "plateau", 0.0, 1.0).points
