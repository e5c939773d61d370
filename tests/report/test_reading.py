"""The series of a recording are the arrays that its bag was made from."""

import numpy as np
import pytest
from tests.report import uneven_bag as known

from contact_sim_pkg.report.reading import cost_series, read_recording
from contact_sim_pkg.report.summary import summarise_recording


@pytest.fixture(scope="module")
def recording(uneven):
    return read_recording(uneven)


def reach_of(lines):
    """Cells from the first edge of all lines to the last, each where a line through the squares of the last two
    pressures comes to 0, at most half a cell beyond the middle of the next one; the last cell's own edge at the end of
    the grid, or where the pressure rises outwards.
    """
    ends = []
    for line in lines:
        for turned in (line, line[::-1]):
            loaded = [place for place, pressure in enumerate(turned) if pressure > 0.0]
            if not loaded:
                continue
            last, beyond = loaded[-1], 0.5
            if 0 < last < len(turned) - 1 and turned[last - 1] > turned[last]:
                fall = turned[last - 1] ** 2 - turned[last] ** 2
                beyond = min(1.0, turned[last] ** 2 / fall)
            ends.append((turned is line, last + beyond))
    if not ends:
        return 0.0
    furthest = [max(end for forward, end in ends if forward is wanted) for wanted in (True, False)]
    return sum(furthest) - (len(lines[0]) - 1)


@pytest.mark.parametrize("name", ["tire", "seat"])
def test_forces_come_block_behind_block_each_with_its_time(recording, name):
    contact = recording.contacts[name]
    assert contact.sample_period == known.PERIOD
    np.testing.assert_allclose(contact.time, known.TIMES, rtol=1e-14)
    for column, values in known.FORCES[name].items():
        np.testing.assert_array_equal(getattr(contact, column), values)


def test_each_body_has_its_own_motion(recording):
    np.testing.assert_allclose(recording.motion.time, known.TIMES, rtol=1e-14)
    for column, values in known.MOTION.items():
        of_bodies = getattr(recording.motion, column)
        assert tuple(of_bodies) == known.BODIES
        np.testing.assert_array_equal([*of_bodies.values()], values)


def test_the_duration_ends_a_period_behind_the_last_sample(recording):
    assert recording.duration == pytest.approx(known.TIMES[-1] + known.PERIOD, rel=1e-14)


def test_the_force_on_the_axle_and_the_episodes_are_all_there(recording):
    axle = recording.series["axle"]
    np.testing.assert_allclose(axle.time, known.TIMES, rtol=1e-14)
    np.testing.assert_array_equal(axle.longitudinal, known.AXLE["longitudinal"])
    np.testing.assert_array_equal(axle.vertical, known.AXLE["vertical"])
    for column, values in known.EPISODES.items():
        np.testing.assert_array_equal(getattr(recording.episodes, column), values)
    assert recording.episodes.point.tolist() == [0, 1, 2, 3, 4]


@pytest.mark.parametrize("name", ["tire", "seat"])
def test_fields_keep_their_scalars_and_the_maps_that_stand_out(recording, name):
    field, maps = recording.fields[name], known.PRESSURES[name].astype(float)
    np.testing.assert_allclose(field.time, known.STAMPS * 1e-9, rtol=1e-14)
    for column in ("load", "peak", "mean", "area", "lame_a", "lame_b", "lame_n", "centre_x", "centre_y"):
        np.testing.assert_array_equal(getattr(field, column), known.FIELDS[name][column])
    np.testing.assert_allclose(field.length, [known.CELL_X * reach_of(each.T) for each in maps], rtol=1e-12)
    np.testing.assert_allclose(field.width, [known.CELL_Y * reach_of(each) for each in maps], rtol=1e-12)
    np.testing.assert_allclose(field.average.pressure, maps.mean(axis=0), rtol=1e-12)
    np.testing.assert_allclose(field.history, maps.sum(axis=2) * known.CELL_Y, rtol=1e-6)
    highest, heaviest = (int(known.FIELDS[name][column].argmax()) for column in ("peak", "load"))
    assert highest != heaviest
    np.testing.assert_array_equal(field.highest.pressure, maps[highest])
    assert field.highest_time == pytest.approx(known.STAMPS[highest] * 1e-9)
    np.testing.assert_array_equal(field.heaviest.field.pressure, maps[heaviest])
    np.testing.assert_array_equal(field.touch.field.pressure, maps[known.EMPTY[name] + 1])
    assert field.average[1:] == (known.CELL_X, known.CELL_Y, known.ORIGIN_X, known.ORIGIN_Y)


def test_of_an_estimated_error_the_largest_of_the_run_counts(recording):
    for place, name in enumerate(known.ESTIMATED):
        assert known.ERRORS[:, place].argmax() not in (0, known.BLOCKS - 1)
        found = next(each for each in recording.estimates if each.column == name)
        assert (found.error, found.largest) == (known.ERRORS[:, place].max(), known.LARGEST[:, place].max())


def test_the_summary_takes_the_largest_residual_of_the_energy_and_the_work_at_the_end(recording):
    energy = summarise_recording(recording)["energy"]
    throughput = max(abs(values).max() for name, values in known.LEDGER.items() if name != "residual")
    assert throughput == abs(known.LEDGER["potential"]).max()
    assert energy["residual_max_J"] == 0.7
    assert energy["residual_relative"] == pytest.approx(0.7 / throughput, rel=1e-12)
    assert energy["throughput_J"] == throughput
    assert energy["supplied_J"] == known.LEDGER["supplied"][-1]
    assert energy["dissipated_J"] == known.LEDGER["dissipated"][-1]


def test_the_summary_adds_counts_and_takes_the_largest_of_errors(recording):
    solver, costs = summarise_recording(recording)["solver"], known.COSTS
    for name in ("steps", "rejected_steps", "events", "field_iterations", "coupling_steps", "coupling_steps_repeated"):
        assert solver[name] == costs[name].sum()
    for name, unit in (("field_residual", ""), ("field_jump", "_N"), ("coupling_error", "")):
        key = f"{name}_max{unit}"
        assert solver[key] == costs[name].max()
    simulated = costs["real_time_factor"] @ costs["wall_time"]
    assert solver["physics_real_time_factor"] == pytest.approx(simulated / costs["wall_time"].sum())


def test_costs_of_an_earlier_release_are_read_by_their_old_names():
    series = cost_series({"time": [0.0, 0.1], "stretches": [3, 5], "stretches_repeated": [1, 0]})
    assert series["coupling_steps"].tolist() == [3.0, 5.0]
    assert series["coupling_steps_repeated"].tolist() == [1.0, 0.0]


def test_pressure_and_area_err_no_less_than_the_force_that_makes_them(recording):
    estimated = summarise_recording(recording)["accuracy"]["estimated"]["tire"]
    force, peak, _seat, area = known.ERRORS.max(axis=0) / known.LARGEST.max(axis=0)
    assert force > 1.2 * max(peak, area), "the estimates of their own are the smaller ones"
    assert estimated == {"force": pytest.approx(force), "peak": pytest.approx(force), "area": pytest.approx(force)}
