"""`bench accuracy`: what accuracy costs, and what was delivered, on this machine."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.laboratory import laboratory
from contact_sim_pkg.cli.output.say import announce, say
from contact_sim_pkg.cli.output.tables import (
    json_option,
    overwrite_option,
    print_json,
    print_json_rows,
    show_sections,
)


@click.command("accuracy")
@click.argument("names", metavar="SCENE...|BAG|RIG", nargs=-1, required=True)
@click.option(
    "--plot",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Of a scene or a rig: error over time, as a picture.",
)
@click.option("--deep", is_flag=True, help="Of a scene: 1e-4 as well, against 3e-5.")
@click.option("--parts", is_flag=True, help="Of a scene: tables of each tolerance, grid and level instead.")
@click.option(
    "--within", multiple=True, metavar="METRIC=0.5%",
    help="Of a scene: the dials that give metrics these errors, and what they cost.",
)  # fmt: skip
@click.option("--whole", is_flag=True, help="Of a bag: the whole run in place of windows of 0.2 s.")
@overwrite_option
@json_option
def command(
    names: tuple[str, ...], plot: Path | None, deep: bool, parts: bool, within: tuple[str, ...], whole: bool, overwrite: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """What accuracy costs in time, and what was delivered.

    SCENE, a name or a path, or several: the scene at 1e-1, 1e-2, 1e-3 against one finer run. BAG, the directory
    of a recorded run: that run against a finer one. RIG (tire, seat, block, impact, roller): each
    quantity of its contact by inexpensive and expensive formulas, on the same input. For a file
    named like a rig write ./NAME.
    """
    from contact_sim_pkg.records.registry import rig_names

    what, rig = names[0], names[0] in rig_names()
    bag = _is_bag(what) and not rig
    _refuse_options(deep=deep, parts=parts, whole=whole, plot=plot, bag=bag, rig=rig)
    if within:
        if bag or rig or len(names) > 1 or deep or parts or plot is not None:
            raise click.UsageError("--within is for one scene, without other options")
        _choose(what, within, as_json=as_json)
        return
    if len(names) > 1 and (rig or bag or parts):
        raise click.UsageError(f"several names are scenes at first look; give {what} alone")
    if plot is not None:
        from contact_sim_pkg.report.drawing import check_picture

        check_picture(plot, [Path(name) for name in names], overwrite=overwrite)
    if bag:
        _check(Path(what), whole=whole, as_json=as_json)
    else:
        _study(names, plot, "rig" if rig else "parts" if parts else "", deep=deep, overwrite=overwrite, as_json=as_json)


def _is_bag(name: str) -> bool:
    """Whether a name is that of a recording: a directory not called as a shipped scene, or an MCAP
    file.
    """
    from contact_sim_pkg.records.registry import rigs

    shipped = any(name in rig.scenes for rig in rigs().values())
    return Path(name).suffix == ".mcap" or (Path(name).is_dir() and not shipped)


def _refuse_options(*, deep: bool, parts: bool, whole: bool, plot: Path | None, bag: bool, rig: bool) -> None:
    """Raise UsageError for an option that has no meaning beside the others."""
    if whole and not bag:
        raise click.UsageError("--whole is for the bag of a recorded run; a scene has a span round its event")
    if (deep or parts) and (bag or rig):
        raise click.UsageError(f"--{'deep' if deep else 'parts'} is for a scene, not for a {'bag' if bag else 'rig'}")
    if deep and parts:
        raise click.UsageError("--parts has tables of its own; leave --deep out")
    if plot is not None and bag:
        raise click.UsageError("a bag has one accuracy and no picture of several; leave --plot out")


def _choose(name: str, within: tuple[str, ...], *, as_json: bool) -> None:
    """Dials of a scene for the accuracy of metrics."""
    from contact_sim_pkg.scene.resolve import load_resolved
    from contact_sim_pkg.studies.accuracy.by_metric import choose, parsed, rows_of, sections

    choice = choose(lambda accuracy: load_resolved(name, f"accuracy={accuracy:g}"), parsed(within), announce)
    if as_json:
        print_json_rows(rows_of(choice))
    else:
        show_sections(sections(choice))


def _check(path: Path, *, whole: bool, as_json: bool) -> None:
    from contact_sim_pkg.cli.output.checked import check_of_bag, facts_of_check, lines_of_check

    check = check_of_bag(path, whole=whole)
    if as_json:
        print_json(facts_of_check(check)["check"])
    else:
        for line in lines_of_check(check):
            say(line)


def _study(names: tuple[str, ...], plot: Path | None, kind: str, *, deep: bool, overwrite: bool, as_json: bool) -> None:
    """A study of scenes at first look, of the parts of one, or of a rig."""
    if kind == "rig":
        study = laboratory("accuracy.rig_study", f"bench accuracy RIG ({names[0]})")
        rows, draw, sections = study.study(names[0], announce), study.write_plot, study.sections
    elif kind == "parts":
        study = laboratory("accuracy.scene_study", "bench accuracy --parts")
        rows, draw, sections = study.study(names[0], announce), study.write_plot, study.sections
    else:
        from contact_sim_pkg.studies.accuracy import first_look_table

        rows = first_look_table.study(names, announce, deep=deep)
        draw, sections = first_look_table.write_plot, first_look_table.sections
    if as_json:
        print_json_rows(rows)
    else:
        show_sections(sections(rows))
    if plot is not None:
        draw(rows, plot, overwrite=overwrite)  # last: whatever becomes of the picture, the table is there
