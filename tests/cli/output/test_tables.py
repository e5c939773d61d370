"""Tables for a person: numbers whole, words whole, the width of the terminal kept; one JSON object for a script."""

import json
import os
import shutil
import sys

import click
import pytest

from contact_sim_pkg.cli.output.tables import print_json_rows, show_rows, show_sections
from contact_sim_pkg.records.table import Section

ROWS = [
    {"case": "a long text about what is hard about the case " * 2, "value": -1.23456e-11, "left": None, "on": True},
    {"case": "short [not a style]", "value": 1234.5, "left": 2.0, "on": False},
]


def terminal(monkeypatch, columns):
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setattr(shutil, "get_terminal_size", lambda *_arguments, **_options: os.terminal_size((columns, 24)))


def test_a_pipe_gets_one_line_a_row(capsys):
    show_rows(ROWS, as_json=False)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + len(ROWS)
    assert ROWS[0]["case"].strip() in lines[1]
    assert "short [not a style]" in lines[2]
    assert all(line == line.rstrip() for line in lines)


@pytest.mark.parametrize("columns", [60, 80, 120])
def test_a_terminal_gets_lines_that_fit_and_numbers_that_are_whole(capsys, monkeypatch, columns):
    terminal(monkeypatch, columns)
    show_rows(ROWS, as_json=False)
    out = click.unstyle(capsys.readouterr().out)
    assert max(map(len, out.splitlines())) <= columns
    assert "-1.23e-11" in out
    assert "1.23e+03" in out
    assert "a long text about" in out


def test_a_terminal_too_narrow_for_the_numbers_still_gets_them_whole(capsys, monkeypatch):
    terminal(monkeypatch, 10)
    show_rows(ROWS, as_json=False)
    assert "-1.23e-11" in capsys.readouterr().out


def test_sections_have_a_heading_and_a_note(capsys):
    show_sections([Section("first", ROWS, "a note"), Section("second", ROWS[:1])])
    lines = capsys.readouterr().out.splitlines()
    assert (lines[0], lines[4], lines[5], lines[6]) == ("first", "a note", "", "second")


def test_json_is_one_object_whose_rows_are_the_table(capsys):
    print_json_rows([{"value": float("nan"), "list": (1, 2)}])
    assert json.loads(capsys.readouterr().out) == {"rows": [{"value": None, "list": [1, 2]}]}
