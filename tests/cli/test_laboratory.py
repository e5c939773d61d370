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
    assert "which is not installed: pip install ./contact_sim_lab_that_is_not_there" in said
    assert f"bench {arguments[0]}" in said


def test_help_and_the_product_work_without_it(alone, capsys):
    assert main(["--help"]) == 0
    assert "Of the laboratory, which is not installed." in capsys.readouterr().out
    assert main(["show", "seat_ride"]) == 0
