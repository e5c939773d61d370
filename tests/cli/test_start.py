"""The first moments of a command, and what it refuses before it works."""

import subprocess
import sys
import textwrap

import pytest
from tests.bench_process import ENVIRONMENT
from tests.report.synthetic_bag import car_bag, seat_bag

from contact_sim_pkg.cli.main import main

INTERRUPTED = """
    import os, signal, sys

    wanted = sys.argv[1]

    class Finder:
        def find_spec(self, name, path=None, target=None):
            if name == wanted:
                os.kill(os.getpid(), signal.SIGINT)

    signal.signal(signal.SIGINT, signal.default_int_handler)  # also where the tests run in the background
    sys.meta_path.insert(0, Finder())
    from contact_sim_pkg.cli.start import main
    sys.argv = ["bench", "show", "seat_ride"]
    sys.exit(main())
"""


@pytest.mark.parametrize("module", ["contact_sim_pkg.cli.main", "click", "contact_sim_pkg.cli.scenes", "pydantic"])
def test_ctrl_c_while_modules_are_read_ends_quietly(module):
    """A signal at the moment at which a module is looked for."""
    found = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(INTERRUPTED), module],
        env=ENVIRONMENT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (found.returncode, found.stdout, found.stderr.strip()) == (0, "", "")


@pytest.fixture
def unread(monkeypatch):
    """A bag whose messages are read fails the test."""
    monkeypatch.setattr("contact_sim_pkg.report.reading._decode", lambda *_: pytest.fail("the bag was read"))


@pytest.mark.parametrize("out", ["there.html", "nowhere/page.html", "x" * 252 + ".html"])
def test_a_page_that_cannot_be_made_is_refused_before_the_bag_is_read(tmp_path, capsys, unread, out):
    bag = car_bag(tmp_path / "bag").path
    (tmp_path / "there.html").write_text("mine")
    assert main(["report", str(bag), "--out", str(tmp_path / out)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert main(["report", str(bag), str(bag), "--out", str(tmp_path / out)]) == 2


@pytest.mark.parametrize("command", ["report", "compare"])
def test_two_rigs_are_refused_before_the_bags_are_read(tmp_path, capsys, unread, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    one, two = car_bag(tmp_path / "one").path, seat_bag(tmp_path / "two").path
    assert main([command, str(one), str(two)]) == 2
    assert "bags of one rig can be compared" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["run", "--offline"], ["report"], ["metrics"], ["show"], ["export", "--csv"]])
def test_a_name_that_no_file_can_have_is_refused(capsys, arguments):
    assert main([*arguments, 300 * "n"]) == 2
    assert "n" * 300 in capsys.readouterr().err
