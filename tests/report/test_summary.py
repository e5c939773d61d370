"""Summary numbers against the closed forms that the synthetic bags are made of."""

import json
import math

import numpy as np
import pytest
from tests.report import synthetic_bag as known

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import ContactPatch
from contact_sim_pkg.report.energy import relative_residual
from contact_sim_pkg.report.metrics.listing import all_metrics, metrics_of
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.series import LedgerSeries
from contact_sim_pkg.report.summary import longest_block_sentence, solver_numbers, summarise


@pytest.fixture(scope="module")
def summary(car):
    return summarise(car)


def test_a_summary_survives_strict_json(summary, seat, bare):
    for numbers in (summary, summarise(seat), summarise(bare)):
        assert json.loads(json.dumps(numbers, allow_nan=False)) == numbers


def test_name_rig_and_simulated_time_are_those_of_the_scene(summary):
    assert (summary["scene"], summary["rig"], summary["simulated_s"]) == ("synthetic_car", "car", 10.0)


@pytest.fixture(scope="module")
def metrics(car):
    return {each.key: each for each in all_metrics(read_recording(car))}


def test_the_summary_prints_the_list_of_the_run(car, summary):
    listed = metrics_of(read_recording(car))
    assert [row["key"] for row in summary["metrics"]] == [each.key for each in listed]
    assert 8 <= len(listed) <= 14


def test_load_and_lift_off_of_a_clipped_sine(metrics):
    ratio = known.TIRE_MEAN / known.TIRE_AMPLITUDE
    share = math.acos(ratio) / math.pi
    assert metrics["tire.lift_off"].value == pytest.approx(100.0 * share, abs=0.5)
    assert metrics["tire.lift_off"].remark == f"{10.0 * known.TIRE_FREQUENCY:.0f} times"
    assert metrics["tire.lift_off"].verdict == "outside"
    mean = known.TIRE_MEAN * (1.0 - share) + known.TIRE_AMPLITUDE * math.sin(share * math.pi) / math.pi
    assert metrics["tire.load"].value == pytest.approx(mean, rel=1e-3)


def test_seat_vibration_of_a_sine_at_a_tabulated_frequency(metrics):
    assert metrics["seat.a_w"].value == pytest.approx(0.9648 * known.SEAT_RMS, rel=5e-3)
    assert metrics["seat.factor"].value == pytest.approx(100.0 * known.SEAT_RMS / known.FLOOR_RMS, rel=1e-6)
    assert metrics["seat.factor"].verdict == "outside"
    dose = 1.10668 * 0.9648 * known.SEAT_RMS * (8.0 * 3600.0) ** 0.25
    assert metrics["seat.dose"].value == pytest.approx(dose, rel=5e-3)
    assert metrics["seat.crest"].value == pytest.approx(math.sqrt(2.0), rel=0.05)  # with the start of the sine


def test_ten_seconds_are_too_short_for_a_seat(metrics):
    assert metrics["seat.factor"].broken == ("too short: 10 s, 34 s needed",)


def test_the_residual_is_measured_by_the_throughput(summary):
    energy = summary["energy"]

    assert energy["supplied_J"] == pytest.approx(known.SUPPLIED)
    assert energy["dissipated_J"] == pytest.approx(known.DISSIPATED)
    assert energy["residual_relative"] == pytest.approx(known.RESIDUAL / known.SUPPLIED)


@pytest.mark.parametrize(("supplied", "residual"), [(0.0, 0.0), (6e-29, 8e-29), (1.4e-12, 1.3e-13)])
def test_round_off_of_a_rig_at_rest_is_no_residual_worth_a_percentage(supplied, residual):
    still = np.zeros(3)
    ledger = LedgerSeries(still, still, still, still, still, still + supplied, np.array([0.0, -residual, residual]))
    assert relative_residual(ledger) == pytest.approx(residual / 1e-6)


def test_energy_that_appears_in_a_rig_at_rest_is_a_residual():
    still = np.zeros(3)
    ledger = LedgerSeries(still, still, still, still, still, still, still - 0.5)
    assert relative_residual(ledger) > 1.0


def test_solver_counts_are_sums_over_the_blocks(summary):
    assert summary["solver"] == {
        "blocks": 1000, "steps": 12_000, "rejected_steps": 1000, "events": 2000, "field_iterations": 30_000,
        "field_residual_max": 1e-7, "field_jump_max_N": 2.5, "coupling_steps": 4000,
        "coupling_steps_repeated": 1000, "coupling_error_max": 2e-3, "physics_wall_s": pytest.approx(2.0),
        "physics_real_time_factor": pytest.approx(5.0), "overruns": 0,
        "longest_block": {"at_s": 0.0, "wall_s": pytest.approx(2e-3), "of": "coupling steps", "steps": 4, "median_steps": 4.0},
    }  # fmt: skip


def test_the_longest_block_is_named_with_its_steps_and_the_late_ones_are_counted():
    blocks = 5
    cost = {name: np.zeros(blocks) for name in (
        "rejected_steps", "events", "field_iterations", "field_residual", "field_jump", "coupling_error", "coupling_steps_repeated",
    )}  # fmt: skip
    cost |= {
        "time": 0.01 * np.arange(blocks), "wall_time": np.array([2e-3, 3e-3, 12e-3, 11e-3, 2e-3]),
        "steps": np.array([4.0, 4.0, 5.0, 40.0, 4.0]), "coupling_steps": np.zeros(blocks),
    }  # fmt: skip
    cost["real_time_factor"] = 0.01 / cost["wall_time"]
    numbers = solver_numbers(cost)
    assert numbers["overruns"] == 2
    assert longest_block_sentence(numbers) == "the longest, at 0.02 s, 12 ms (5 steps, median 4)"
    cost["coupling_steps"] = np.array([3.0, 3.0, 14.0, 3.0, 2.0])
    assert longest_block_sentence(solver_numbers(cost)) == "the longest, at 0.02 s, 12 ms (14 coupling steps, median 3)"


def test_messages_are_counted_by_topic(summary):
    expected = dict.fromkeys((f"/{name}" for name in known.CAR_TOPICS), 1000) | {"/bench/scene": 1}

    assert summary["messages"] == expected


def test_what_a_scene_lacks_is_absent_from_its_summary(seat, bare):
    assert {row["key"].partition(".")[0] for row in summarise(seat)["metrics"]} == {"seat", "energy"}
    assert set(summarise(bare)) == {"scene", "rig", "simulated_s", "metrics", "messages"}
    assert summarise(bare)["scene"] is None


def test_fields_on_cells_of_two_sizes_in_one_topic_are_refused(tmp_path):
    with BagWriter(tmp_path / "two", recorded_topics(("tire/patch",)), reserve_bytes=0, background=False) as writer:
        for block, rows in enumerate((4, 5)):
            ones = np.ones((rows, 3), dtype=np.float32)
            field = ContactPatch(
                **dict.fromkeys(ContactPatch._fields, 0.01 * (1 + block)) | {"block": block, "pressure": ones}
            )
            writer.write("tire/patch", block, encode(field, block, "tire_contact"))

    with pytest.raises(BagError, match=r"5 x 3 cells of 0\.02 x 0\.02 m, another one on 4 x 3 of 0\.01 x 0\.01 m"):
        summarise(open_bag(tmp_path / "two"))
