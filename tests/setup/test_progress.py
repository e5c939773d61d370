"""What the set-up shows of programs that take their time, on a terminal and elsewhere."""

import io
import os
import re
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from tests.terminal import Terminal

from set_up.progress import Count, Progress
from set_up.workspace import built

ROOT = Path("/")
HOOK = Path(__file__).resolve().parents[2] / "ros2_ws" / "set_up" / "idl_trees"


class Clock:
    """A second passes with each look at it."""

    def __init__(self):
        self.now = -1.0

    def __call__(self):
        self.now += 1.0
        return self.now


def slow_program(tmp_path, steps: int = 3) -> list[str]:
    """Prints a step, is silent until the test has looked at it often, prints the next."""
    script = tmp_path / "slow.sh"
    script.write_text(f'for n in $(seq {steps}); do echo "[$n/{steps}] step"; sleep 0.2; done\n')
    return ["/bin/sh", str(script)]


def run(stream, command, **options) -> tuple[int, Clock]:
    clock = Clock()
    shown = Progress(stream, clock, look=0.005)
    status = shown.run(command, "building", environ=dict(os.environ), cwd=ROOT, **options)
    shown.say("done")
    return status, clock


def test_without_a_terminal_no_five_seconds_pass_without_a_line_and_none_is_a_flood(tmp_path):
    stream = io.StringIO()
    status, clock = run(stream, slow_program(tmp_path), count=built)
    lines = stream.getvalue().splitlines()
    at = [int(re.match(r"set-up \[ *(\d+) s\]: ", line)[1]) for line in lines]
    assert status == 0
    assert clock.now > 20  # the program was long
    assert max(later - earlier for earlier, later in pairwise(at)) <= 5
    assert min(later - earlier for earlier, later in pairwise(at[1:-1])) >= 3
    assert lines[0].endswith("building")
    assert any(re.search(r"building, \d of 3$", line) for line in lines)
    assert "\x1b" not in stream.getvalue()


def test_on_a_terminal_one_line_is_drawn_again_as_a_bar(tmp_path):
    with Terminal() as terminal:
        run(terminal.stream, slow_program(tmp_path), count=built)
    drawn = terminal.drawn
    left = [line.rsplit("\x1b[K", 1)[-1].strip() for line in drawn.split("\n")]
    assert [line.partition("]: ")[2] for line in left] == ["building", "done", ""]
    bars = re.findall(r"\r\x1b\[Kset-up \[ *\d+ s\]: ([█░]{16}) building(?:, (\d) of 3)?", drawn)
    assert {done for _, done in bars} >= {"1", "2", "3"}
    assert all(bar.count("█") == 16 * int(done or 0) // 3 for bar, done in bars)


def test_what_a_failing_program_printed_is_shown_with_its_status():
    stream = io.StringIO()
    status, _ = run(stream, ["/bin/sh", "-c", "echo on out; echo on err >&2; exit 3"])
    assert status == 3
    assert "on out\non err\n" in stream.getvalue()


def test_waiting_is_said_at_once_and_again():
    stream = io.StringIO()
    shown = Progress(stream, Clock())
    for _ in range(20):
        shown.show("waiting")
    at = [int(re.match(r"set-up \[ *(\d+) s\]: waiting$", line)[1]) for line in stream.getvalue().splitlines()]
    assert at[0] <= 3
    assert len(at) > 5
    assert max(later - earlier for earlier, later in pairwise(at)) <= 5


def test_what_was_made_before_is_removed_and_what_is_missing_is_no_fault(tmp_path):
    (tmp_path / "build" / "deep").mkdir(parents=True)
    stream = io.StringIO()
    shown = Progress(stream)
    shown.remove(tmp_path / "build", tmp_path / "install")
    assert list(tmp_path.iterdir()) == []
    assert "removing the old build, install" in stream.getvalue()
    said = len(stream.getvalue())
    shown.remove(tmp_path / "build", tmp_path / "install")
    assert len(stream.getvalue()) == said


def test_what_a_program_that_succeeds_printed_is_not_shown():
    stream = io.StringIO()
    assert run(stream, ["/bin/echo", "details"])[0] == 0
    assert "details" not in stream.getvalue()


@pytest.mark.parametrize(
    ("line", "counted"),
    [
        ("[12/102] Building C object x.c.o", Count(12, 102)),
        ("[ 23%] Building C object x.c.o", Count(23, 100)),
        ("Starting >>> contact_msgs_defs", None),
    ],
)
def test_steps_of_a_build_are_read_from_ninja_and_from_make(line, counted):
    assert built(line) == counted


def test_a_message_definition_is_parsed_by_the_first_generator_alone(tmp_path):
    parser = tmp_path / "rosidl_parser"
    parser.mkdir()
    (parser / "__init__.py").touch()
    (parser / "parser.py").write_text(
        "def get_ast_from_idl_string(text):\n    print('parsing')\n    return [text.upper()]\n"
    )
    generator = tmp_path / "rosidl_generator_x"
    generator.write_text(
        "from rosidl_parser import parser\nprint(*(parser.get_ast_from_idl_string(t)[0] for t in ('a', 'b', 'a')))\n"
    )
    environ = {**os.environ, "PYTHONPATH": f"{HOOK}:{tmp_path}", "IDL_TREES": str(tmp_path)}

    def generate() -> list[str]:
        return subprocess.check_output([sys.executable, "-B", generator], env=environ, text=True).splitlines()

    assert generate() == ["parsing", "parsing", "A B A"]
    assert generate() == ["A B A"]
