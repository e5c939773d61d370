"""`bench report`: one HTML page on a bag, or on several bags of one rig side by side; one figure of it for print."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.progress import RunDisplay
from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import overwrite_option, require_option
from contact_sim_pkg.cli.output.working import displayed_elsewhere


@click.command("report")
@click.argument("bags", nargs=-1, required=True, metavar="BAG...", type=click.Path(path_type=Path))
@click.option(
    "--out",
    "--output",
    "out",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="The page; else report.html in the bag, or comparison.html here for several bags; the figure, else NAME.png.",
)
@click.option(
    "--format",
    "printed",
    type=(click.Choice(["png", "svg"]), str),
    metavar="png|svg NAME",
    help="One figure of the page in place of it, for print: PNG of 300 dpi, or SVG; an unknown NAME lists them.",
)
@require_option
@click.option("--check", is_flag=True, help="With what accuracy was delivered: a finer run beside parts of it.")
@click.option("--skip-bad", is_flag=True, help="Continue after damaged chunks.")
@click.option("--across-versions", is_flag=True, help="Compare bags of different versions.")
@overwrite_option
def command(
    bags: tuple[Path, ...],
    out: Path | None,
    printed: tuple[str, str] | None,
    wanted: tuple[str, ...],
    check: bool,
    skip_bad: bool,
    across_versions: bool,
    overwrite: bool,
) -> None:
    """Write the report page of BAG and print its path.

    Up to six bags of one rig are compared on one page, each with the first. A pressure mat (its file, or the bag of
    `bench import`) and a run are laid over each other.
    """
    _refuse_unused(len(bags), printed is not None, bool(wanted), check, across_versions)
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.bag.versions import differences_from, differences_of_bags, installed_versions
    from contact_sim_pkg.cli.bags.mats import bag_of
    from contact_sim_pkg.report.metrics.requirements import read_requirements
    from contact_sim_pkg.report.place import free_figure, free_place
    from contact_sim_pkg.report.reading import refuse_incomparable
    from contact_sim_pkg.run.bag_content import kernel_fingerprint

    requirements = read_requirements(wanted)
    kept = click.get_current_context().with_resource
    recorded = [open_bag(bag_of(bag, kept) if len(bags) > 1 else bag, skip_bad=skip_bad) for bag in bags]
    if printed:
        free_figure(recorded[0], *printed, out, overwrite=overwrite)
    else:
        free_place(recorded, out, overwrite=overwrite)
    mats = len(recorded) > 1 and refuse_incomparable(recorded)
    for each in recorded:
        for note in each.notes:
            say(note if len(bags) == 1 else f"{each.path.parent.name}: {note}", err=True)
    # a page of several bags compares their versions, a page of one those of this installation
    here = installed_versions(kernel_fingerprint())
    others = differences_of_bags(recorded, across=across_versions or mats) or [
        differences_from(each, here) for each in recorded
    ]
    for line in filter(None, others):
        say(line, err=True)
    checked = None
    if check:
        from contact_sim_pkg.cli.output.checked import check_of_bag

        checked = check_of_bag(bags[0])
    begin = "report: reading the bag" if len(bags) == 1 else "report: comparing the bags"
    with displayed_elsewhere(), RunDisplay(1.0, begin, "section") as display:

        def on_read(share: float) -> None:
            display.show_set_up(f"report: reading the bag, {share:.0%}")

        def on_section(number: int, count: int, title: str) -> None:
            display.update(number / count, f"report: section {number + 1} of {count}, {title}")

        # the libraries of pictures are loaded under the display
        from contact_sim_pkg.report.reading import scenes_fit

        with scenes_fit(recorded):
            if printed:
                from contact_sim_pkg.report.printed import write_figure

                kind, name = printed
                page = write_figure(
                    recorded[0], kind, name, out, overwrite=overwrite, on_section=on_section, on_read=on_read
                )
            elif len(recorded) == 1:
                from contact_sim_pkg.report.report import write_report

                page = write_report(
                    recorded[0],
                    out,
                    overwrite=overwrite,
                    requirements=requirements,
                    check=checked,
                    on_section=on_section,
                    on_read=on_read,
                )
            else:
                from contact_sim_pkg.report.comparison.runs import write_comparison

                page = write_comparison(recorded, out, overwrite=overwrite, requirements=requirements)
    say(f"report: {page}")


def _refuse_unused(bags: int, printed: bool, wanted: bool, check: bool, across_versions: bool) -> None:
    """UsageError for an option that the number of bags, or another option, gives no meaning."""
    if printed and bags > 1:
        raise click.UsageError("--format prints a figure of one BAG.")
    if printed and wanted:
        raise click.UsageError("--require judges the tiles of a page; a figure of --format has none.")
    if check and (printed or bags > 1):
        raise click.UsageError("--check is of one BAG and stands on its page.")
    if across_versions and bags == 1:
        raise click.UsageError("--across-versions compares several BAGs.")
