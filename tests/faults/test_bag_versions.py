"""Bags of other versions: what differs is said, results are compared across versions only where that was asked for."""

import dataclasses

import pytest
from tests.bag.hand_made import VIBRATION, seat_ride, write

from contact_sim_pkg.cli.main import main as bench
from contact_sim_pkg.run import offline

DIFFERENT = [("package_version", "0.0.1"), ("kernel_fingerprint", "0" * 20)]


@pytest.fixture(scope="module")
def ride():
    return seat_ride()


def other(ride, key, value):
    return dataclasses.replace(ride, texts={**ride.texts, key: value})


@pytest.mark.fault("E12")
@pytest.mark.parametrize(("key", "value"), DIFFERENT)
def test_bags_of_different_versions_are_compared_on_request_only(capsys, tmp_path, ride, key, value):
    bags = [write(tmp_path / "new", ride).parent, write(tmp_path / "old", other(ride, key, value)).parent]
    page = tmp_path / "page.html"
    command = ["report", *map(str, bags), "--out", str(page)]
    assert bench(command) == 2
    out, said = capsys.readouterr()
    assert out == ""
    assert f"were recorded by different versions: {key} ({ride.texts[key]} and {value}); give --across-versions" in said
    assert not page.exists()
    assert bench([*command, "--across-versions"]) == 0
    assert f"were recorded by different versions: {key} (" in capsys.readouterr().err
    assert page.exists()


@pytest.mark.fault("E12")
def test_bags_that_differ_in_the_python_alone_are_compared_and_that_is_said(capsys, tmp_path, ride):
    bags = [write(tmp_path / "new", ride).parent, write(tmp_path / "old", other(ride, "python", "3.9.1")).parent]
    assert bench(["report", *map(str, bags), "--out", str(tmp_path / "page.html")]) == 0
    assert "different versions: python (" in capsys.readouterr().err


@pytest.mark.fault("E12")
@pytest.mark.parametrize(("key", "value"), DIFFERENT)
@pytest.mark.parametrize("command", ["report", "run"])
def test_a_bag_of_another_version_is_read_and_simulated_again_with_a_word(
    capsys, tmp_path, monkeypatch, ride, command, key, value
):
    bag = write(tmp_path / "old", other(ride, key, value))
    outcome = offline.RunOutcome(0, 0.0, 0.0, None, False, "", {})
    monkeypatch.setattr(offline, "run_offline", lambda *_: outcome)  # what is said comes before the simulation
    arguments = {
        "report": [bag, "--out", tmp_path / "page.html"],
        "run": ["--offline", "--no-record", "--from-bag", bag],
    }
    assert bench([command, *map(str, arguments[command])]) == 0
    assert f"was recorded by other versions than those here: {key} ({value} and " in capsys.readouterr().err
    bag = write(tmp_path / "same", ride)
    arguments = {
        "report": [bag, "--out", tmp_path / "same.html"],
        "run": ["--offline", "--no-record", "--from-bag", bag],
    }
    assert bench([command, *map(str, arguments[command])]) == 0
    assert "versions" not in capsys.readouterr().err


@pytest.mark.fault("B9", "E12")
def test_an_excitation_of_another_definition_drives_nothing(capsys, tmp_path, ride):
    text = "uint64 block\nfloat64 sample_period\nfloat64[] acceleration_z\n"
    bag = write(tmp_path / "old", dataclasses.replace(ride, definitions={VIBRATION: text}))
    assert bench(["run", "--offline", "--no-record", "--from-bag", str(bag)]) == 2
    assert (
        "/platform/vibration was recorded with another definition of contact_msgs_defs/msg/" in capsys.readouterr().err
    )
