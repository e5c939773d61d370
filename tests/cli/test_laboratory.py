"""Without the laboratory its commands say in one sentence what to install, and all others work."""

import pytest

from contact_sim_pkg.cli import laboratory
from contact_sim_pkg.cli.main import main


@pytest.fixture
def alone(monkeypatch):
    """Where nobody has installed it."""
    monkeypatch.setattr(laboratory, "PACKAGE", "contact_sim_lab_that_is_not_there")


@pytest.mark.parametrize(
    "arguments",
    [["hard"], ["paper"], ["hard", "--accuracy"], ["goals"], ["growth"], ["validation"], ["accuracy", "tire"],
     ["accuracy", "tire_bump", "--parts"]],
)  # fmt: skip
def test_its_commands_name_what_to_install(alone, capsys, arguments):
    assert main(arguments) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "which is not installed: pip install ./contact_sim_lab_that_is_not_there" in said
    assert f"bench {arguments[0]}" in said


@pytest.mark.parametrize("command", ["hard", "goals", "growth", "validation"])
def test_the_help_of_its_commands_names_what_to_install(alone, capsys, command):
    assert main([command, "--help"]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    said = " ".join(printed.out.split())
    assert said.startswith(f"Usage: bench {command}")
    assert said.count("which is not installed: pip install ./contact_sim_lab_that_is_not_there") == 1


def test_help_and_the_product_work_without_it(alone, capsys):
    assert main(["--help"]) == 0
    assert "Of the laboratory, which is not installed." in capsys.readouterr().out
    assert main(["show", "seat_ride"]) == 0
