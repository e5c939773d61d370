"""The energy ledger of a rolling tire without a belt says that it is of the vertical motion, and names what is outside."""

import pytest
from tests.run.scenes import resolved

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.figures.bench import energy_balance
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.rig_reports import ledger_scope
from contact_sim_pkg.report.summary import summarise_recording
from contact_sim_pkg.run.offline import run_offline


@pytest.fixture(scope="module")
def braked(tmp_path_factory):
    folder = tmp_path_factory.mktemp("braked") / "bag"
    run_offline(resolved("tire_braking", "duration=0.3", "effects.tire.sidewall_compliance=null"), folder)
    return open_bag(folder)


def test_a_braked_wheel_names_its_friction_with_the_work_that_the_fields_sum_to(braked):
    work = braked.columns("/tire/shear", ("dissipated",))["dissipated"].sum()
    assert work > 1.0
    recording = read_recording(braked)
    energy = summarise_recording(recording)["energy"]
    assert energy["of"] == "vertical motion"
    (friction,) = energy["outside"]
    assert float(friction.partition("(")[2].partition(" J")[0]) == pytest.approx(work, rel=5e-3)  # three digits
    assert "friction of the bristles" in friction
    assert energy["dissipated_J"] < 0.5 * work  # which the ledger does not hold


def test_the_picture_says_the_same(braked):
    recording = read_recording(braked)
    with style():
        picture = energy_balance(recording.ledger, ledger_scope(recording))
    assert "balance of the vertical motion; outside it: friction of the bristles (" in picture.caption


def test_a_belt_on_its_sidewalls_is_in_the_ledger(tmp_path):
    run_offline(resolved("tire_braking", "duration=0.3"), tmp_path / "bag")
    bag = open_bag(tmp_path / "bag")
    work = bag.columns("/tire/shear", ("dissipated",))["dissipated"].sum()
    energy = summarise_recording(read_recording(bag))["energy"]
    assert not {"of", "outside"} & set(energy)
    assert energy["dissipated_J"] == pytest.approx(work, rel=0.05)  # but for the last field


def test_a_ledger_of_the_whole_rig_says_nothing_of_a_scope(tmp_path):
    run_offline(resolved("seat_ride", "duration=0.2"), tmp_path / "bag")
    summary = summarise_recording(read_recording(open_bag(tmp_path / "bag")))
    assert not {"of", "outside"} & set(summary["energy"])
