"""`bench tire`: scene keys from a tire property file or a table of measurements, and `bench tire test`, its standard procedures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, print_json, show_sections
from contact_sim_pkg.cli.tire_test import test_command

if TYPE_CHECKING:
    from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import PropertyFile
    from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import SceneTire

NAMED = 12  # unread keys that are named


class _FileOrCommand(click.Group):
    """A group whose command may be left out: then the argument is a file."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """With the command put in where there is none."""
        if args and args[0] not in (*self.commands, "-h", "--help"):
            args = ["file", *args]
        return super().parse_args(ctx, args)

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Both uses."""
        return ["FILE | test NAME|all SCENE --out DIR"]


@click.group("tire", cls=_FileOrCommand, no_args_is_help=True)
def command() -> None:
    """Scene keys from a tire property file (.tir) or measurements, or the standard procedures of a tire's test bench."""


command.add_command(test_command)


@command.command("file")
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option("--size", help="Size on the sidewall, of a table: '255/40 R17'.")
@click.option("--radius", type=float, help="Free radius [m], where it is not that of the size.")
@json_option
def file_command(file: Path, size: str | None, radius: float | None, as_json: bool) -> int:
    """Scene keys from a tire property file (.tir) of the Magic Formula or MF-Swift; with --size, from a table of measurements
    whose columns are inflation, load, deflection, stiffness, length and width of the contact, braking, cornering, trail, with
    their units in brackets.

    Shows the keys that are read, in SI units, and what becomes of them; the fitted tire beside the
    file over its loads and inflations; and a part of a scene, ready for its `effects`, where radius, stiffness and deflection of
    the fitted tire are within 6 % of the file's. Ends with 1 where they are not.
    """
    from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import read_property_file
    from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import measured_tire, scene_tire
    from contact_sim_pkg.rigs.vehicle.tire.property_file.targets import read_measured

    if size is None:
        tire = read_property_file(file)
        found = scene_tire(tire)
    else:
        measured = read_measured(file)
        tire, found = measured.file, measured_tire(measured, size, radius)
    unread = {"count": len(tire.unread), "first": tire.unread[:NAMED]}
    comparisons = [{**each._asdict(), "difference": each.difference} for each in found.fit]
    notes = [*tire.notes, *found.notes]
    if as_json:
        print_json({
            "file": tire.file, "units": tire.units, "keys": _rows(tire), "not_read": unread, "fit": comparisons,
            "format": tire.format, "notes": notes, "usable": found.usable,
            "effects": {"tire": found.effects} if found.usable else None,
        })  # fmt: skip
    else:
        _show(tire, found, comparisons)
        _say_notes(tire, notes)
    if not found.usable:
        say(_no_scene(tire, found), err=True)
    return 0 if found.usable else 1


def _say_notes(tire: PropertyFile, notes: list[str]) -> None:
    if tire.unread:
        more = ", ..." if len(tire.unread) > NAMED else ""
        notes.append(f"{len(tire.unread)} keys not read: {', '.join(tire.unread[:NAMED])}{more}")
    for note in notes:
        say(note, err=True)


def _no_scene(tire: PropertyFile, found: SceneTire) -> str:
    """Why the file makes no scene, with the figures."""
    from contact_sim_pkg.rigs.vehicle.tire.property_file.scene_keys import USABLE

    if not found.judged:
        return (
            f"{tire.file}: no scene, as the file states no stiffness that one could meet; add VERTICAL_STIFFNESS, best with "
            "FNOMIN"
        )
    figures = "; ".join(
        f"{each.quantity} {each.file:.4g} {each.unit}, fitted {each.tire:.4g} (ratio {each.tire / each.file:.3g})"
        for each in found.judged
    )
    return f"{tire.file}: no scene, as the nearest tire is not within {100 * USABLE:g} % of the file: {figures}"


def _rows(tire: PropertyFile) -> list[dict[str, Any]]:
    from contact_sim_pkg.rigs.vehicle.tire.property_file.keys import KEYS

    return [
        {"key": key, "value": value, "unit": KEYS[key].unit, "line": line, "becomes": KEYS[key].becomes}
        for key, (value, line) in tire.values.items()
    ]


def _show(tire: PropertyFile, found: SceneTire, comparisons: list[dict[str, Any]]) -> None:
    from contact_sim_pkg.records.table import Section

    keys = [{**row, "value": f"{row['value']:.6g}"} for row in _rows(tire)]
    beside = [
        {**row, "file": f"{row['file']:.4g}", "tire": f"{row['tire']:.4g}", "difference": f"{row['difference']:+.1%}"}
        for row in comparisons
    ]
    sections = [Section("", keys)] if keys else []
    if beside:
        sections.append(Section("the fitted tire beside the file, under the nominal load first", beside))
    show_sections(sections)
    if not found.usable:
        return
    say(f"\n# from {Path(tire.file).name}\neffects:\n  tire:")
    for effect, values in found.effects.items():
        say(f"    {effect}:" if values else f"    {effect}: {{}}")
        for key, value in values.items():
            say(f"      {key}: {value}")
