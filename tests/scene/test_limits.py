"""Caps: refused with the estimate, and nothing allocated."""

import tracemalloc

import pytest

from contact_sim_pkg.scene.limits import BYTES_PER_CELL, memory_needs

FIELD = "effects.tire.contact_field"


def test_a_field_that_needs_too_much_memory_is_refused_with_estimate_and_limit(maker):
    (fault,) = maker.faults("tire", {FIELD: {"rows": 4096, "cols": 4096}})
    needed = 4096 * 4096 * BYTES_PER_CELL / 2**30
    assert fault == f"{FIELD}: 4096 × 4096 cells need {needed:.3g} GiB, limit 1 GiB (limits.memory)"


def test_a_higher_limit_lets_it_pass(maker):
    assert maker.faults("tire", {FIELD: {"rows": 4096, "cols": 4096}, "limits.memory": 8.0}) == []


def test_parts_that_fit_alone_are_summed(maker):
    half = {"rows": 1500, "cols": 1500}
    assert maker.faults("car", {FIELD: half}) == []
    (fault,) = maker.faults("car", {FIELD: half, "effects.seat.half_space_field": half})
    assert "all parts together" in fault


def test_a_billion_cells_are_refused_without_allocating(maker):
    tracemalloc.start()
    (fault,) = maker.faults("tire", {FIELD: {"rows": 32000, "cols": 32000}})
    assert "32000 × 32000 cells need" in fault
    assert tracemalloc.get_traced_memory()[1] < 10e6
    tracemalloc.stop()


def test_a_side_longer_than_the_field_solver_takes_is_refused(maker):
    (fault,) = maker.faults("tire", {FIELD: {"rows": 4097, "cols": 8}})
    assert fault.startswith(f"{FIELD}.rows: 4097 cells")


def test_a_random_road_with_too_many_points_is_refused(maker):
    road = {"kind": "iso8608", "roughness_class": "A", "length": 1e6}
    (fault,) = maker.faults("tire", {"road": road})
    assert fault.startswith("road.length: a road of 1e+06 m with waves down to 0.3 m needs 160000000 points")


def test_too_many_samples_are_refused(maker):
    (fault,) = maker.faults("seat", {"duration": 3600.0, "outputs.force_rate": 1e6})
    assert "samples, limit 1e+09" in fault


def test_the_estimate_covers_the_arrays_of_the_half_space(maker):
    halfspace = pytest.importorskip("contact_sim_pkg.pressure.field.halfspace")
    scene = maker.load("tire", {FIELD: {"rows": 48, "cols": 64}})
    half_space = halfspace.make_half_space(48, 64, 0.004, 0.004, 4e6)
    taken = sum(
        array.nbytes for array in (*half_space, *halfspace.make_buffers(half_space)) if hasattr(array, "nbytes")
    )
    (need,) = memory_needs(scene)
    assert taken < need.bytes < 10 * taken


def test_a_missing_file_says_where_it_was_looked_for(maker):
    recorded = {"kind": "recorded", "file": "nowhere.csv", "rate": 100.0}
    (fault,) = maker.faults("seat", {"vibration": recorded})
    assert fault == f"vibration.file: the file 'nowhere.csv' is not there; looked for {maker.folder / 'nowhere.csv'}"


def test_a_data_file_is_also_looked_for_in_the_package(maker):
    (fault,) = maker.faults("tire", {"road": {"kind": "opencrg", "file": "data/nowhere.crg"}})
    assert "data/nowhere.crg or " in fault
    assert fault.count("nowhere.crg") == 3


def test_a_file_with_another_checksum_is_refused(maker):
    (maker.folder / "floor.csv").write_text("z\n0\n")
    recorded = {"kind": "recorded", "file": "floor.csv", "rate": 100.0, "sha256": "0" * 64}
    (fault,) = maker.faults("seat", {"vibration": recorded})
    assert "another content than the scene states" in fault


def test_a_file_larger_than_its_cap_is_refused(maker):
    with (maker.folder / "huge.csv").open("wb") as stream:
        stream.truncate((256 << 20) + 1)
    (fault, *_) = maker.faults("seat", {"vibration": {"kind": "recorded", "file": "huge.csv", "rate": 1.0}})
    (maker.folder / "huge.csv").unlink()
    assert "at most 268435456 are allowed" in fault or "limits.memory" in fault
