"""The process that makes machine code: its answers, its end, and work without it."""

from __future__ import annotations

import os
import signal
import sys
from concurrent.futures import CancelledError
from typing import Any

import llvmlite.binding as llvm
import pytest

from contact_sim_pkg.compiled import assembler

SQUARE = """
define double @square(double %x) {
  %y = fmul double %x, %x
  ret double %y
}
"""


@pytest.fixture
def running() -> Any:
    """An assembler of the test's own."""
    made = assembler.Assembler()
    yield made
    made.stop()


def bitcode(text: str = SQUARE) -> bytes:
    code: bytes = llvm.parse_assembly(text).as_bitcode()
    return code


def test_it_answers_in_order_with_the_code_that_this_process_would_make(running: assembler.Assembler) -> None:
    cubed = SQUARE.replace("square", "other")
    answers = [running.submit(bitcode(text)).result(60.0) for text in (SQUARE, cubed, SQUARE)]
    assert [b"square" in each.code for each in answers] == [True, False, True]
    assert answers[0] == assembler.assemble(bitcode())


def test_where_the_process_dies_this_one_does_the_work(running: assembler.Assembler) -> None:
    running.submit(bitcode()).result(60.0)
    assert running._process is not None
    os.kill(running._process.pid, signal.SIGKILL)
    assert running.submit(bitcode()).result(60.0) == assembler.assemble(bitcode())
    assert running._process is None


def test_where_no_process_can_be_started_this_one_does_the_work(
    running: assembler.Assembler, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    assert running.submit(bitcode()).result(60.0) == assembler.assemble(bitcode())


def test_a_stop_gives_up_what_waits_and_ends_the_process(running: assembler.Assembler) -> None:
    first = running.submit(bitcode())
    first.result(60.0)
    process = running._process
    assert process is not None
    os.kill(process.pid, signal.SIGSTOP)  # so that the next one cannot be answered
    waiting = [running.submit(bitcode()) for _ in range(3)]
    running.stop()
    assert process.returncode == -signal.SIGKILL
    for each in waiting:
        with pytest.raises(CancelledError):
            each.result(60.0)
    assert running.submit(bitcode()).result(60.0) == assembler.assemble(bitcode())
