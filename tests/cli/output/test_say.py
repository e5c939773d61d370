"""What a command prints of a stranger's text moves no cursor and colours nothing."""

import ast
import json
import re
from pathlib import Path

import pytest

from contact_sim_pkg import cli
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import print_json, show_rows

CLI = Path(cli.__file__).parent
LABORATORY = CLI.parents[2] / "contact_sim_lab" / "contact_sim_lab" / "cli"
HOSTILE = "a\x1b[2J\x9b31m\u202e\x7f\x00b"
SAFE = re.compile(r"[^\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]*")


def test_one_place_prints():
    """Tables and JSON make their texts printable themselves, and an error is a sentence of `main`."""
    own = {"say.py", "tables.py", "main.py", "progress.py"}
    printing = {
        path.name
        for path in (*CLI.rglob("*.py"), *LABORATORY.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("click.echo", "print", "sys.stdout.write")
    }
    assert printing - own == set()


def test_lines_keep_their_ends_and_lose_their_control_characters(capsys):
    say(f"{HOSTILE}\nδ 5 °C")
    say(HOSTILE, err=True, nl=False)
    out, err = capsys.readouterr()
    assert out == "a\\x1b[2J\\x9b31m\\u202e\\x7f\\x00b\nδ 5 °C\n"
    assert err == out.partition("\n")[0]


def test_tables_and_json_carry_texts_that_are_printable(capsys):
    show_rows([{HOSTILE: HOSTILE, "list": [HOSTILE, 1]}], as_json=False)
    assert SAFE.fullmatch(capsys.readouterr().out)
    value = {HOSTILE: [HOSTILE, "δ 5 °C", "\U000e0001"]}
    print_json(value)
    out = capsys.readouterr().out
    assert SAFE.fullmatch(out)
    assert "δ 5 °C" in out
    assert json.loads(out) == value


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_column_of_a_stranger_is_printed_as_text(tmp_path, capsys, form):
    header = f"m,R,V0,tau,k,T,{HOSTILE[:5]}"
    rows = "\n".join(f"0.01,0.01,1.0,{tau},0.6,293,1" for tau in (0.0010, 0.00101, 0.00102))
    file = tmp_path / "impacts.csv"
    file.write_text(f"{header}\n{rows}\n")
    main(["material", str(file), *form])
    out, err = capsys.readouterr()
    assert SAFE.fullmatch(out + err)
    assert "a\\x1b[2J" in err
