"""`bench run`: one scene, on nodes or without ROS."""

from __future__ import annotations

from pathlib import Path

import click

from contact_sim_pkg.cli.output.tables import json_option
from contact_sim_pkg.cli.scene_options import SceneOptions, scene_options


@click.command("run")
@scene_options
@click.option("--offline", is_flag=True, help="Without ROS, in this process, at full speed; the same bits.")
@click.option(
    "--out", type=click.Path(path_type=Path), metavar="DIR", help="Directory of the bag, which must not exist."
)
@click.option(
    "--from-bag", type=click.Path(path_type=Path), metavar="BAG", help="Excitation (and scene) of an earlier run."
)
@click.option(
    "--clock/--no-clock",
    default=True,
    show_default=True,
    help="Simulated time on /clock, unless another node publishes it.",
)
@click.option(
    "--within", multiple=True, metavar="METRIC=0.5%",
    help="Numerical error that a metric may have: steps and cells as loose as it allows, found by short runs.",
)  # fmt: skip
@click.option(
    "--excitation",
    type=click.Choice(["topics", "inside"]),
    default="topics",
    show_default=True,
    help="On nodes: sent by nodes of its own, or made inside the simulator, which then takes steps, resets and live keys.",
)
@click.option("--allow-long", is_flag=True, help="Run even if the estimate is above 10 min of computing.")
@click.option(
    "--strict",
    is_flag=True,
    help="End with status 1 where an estimated numerical error is above the requested accuracy, or the scene expects what"
    " the run does not show.",
)
@click.option("--no-record", is_flag=True, help="Write no bag; the summary is then empty.")
@click.option("--check", is_flag=True, help="Then check the accuracy that was delivered, as `bench accuracy BAG`.")
@json_option
@click.pass_context
def command(
    context: click.Context,
    options: SceneOptions,
    offline: bool,
    out: Path | None,
    from_bag: Path | None,
    clock: bool,
    within: tuple[str, ...],
    excitation: str,
    allow_long: bool,
    strict: bool,
    no_record: bool,
    check: bool,
    as_json: bool,
) -> None:
    """Run SCENE (a name or a YAML file), record it and report its outcome."""
    refuse_without_bag(no_record=no_record, out=out, strict=strict, check=check)
    refuse_two_sources(excitation=excitation, from_bag=from_bag)
    from contact_sim_pkg.cli.run_scene import run_scene

    status = run_scene(
        options,
        offline=offline,
        out=out,
        from_bag=from_bag,
        clock=clock,
        within=within,
        excitation=excitation,
        record=not no_record,
        check=check,
        as_json=as_json,
        allow_long=allow_long,
        strict=strict,
    )
    context.exit(status)


def refuse_two_sources(*, excitation: str, from_bag: Path | None) -> None:
    """Raise UsageError where the excitation would come from the simulator and from a bag."""
    if excitation == "inside" and from_bag is not None:
        raise click.UsageError(
            f"--from-bag {from_bag} and --excitation inside are two sources; leave one of them out (`--offline --from-bag` "
            "repeats a run whose parameters changed)"
        )


def refuse_without_bag(*, no_record: bool, out: Path | None, strict: bool, check: bool) -> None:
    """Raise UsageError for an option that needs the bag which `no_record` leaves out."""
    if no_record and out is not None:
        raise click.UsageError(f"--out {out} names a bag and --no-record writes none; leave one of them out")
    if no_record and strict:
        raise click.UsageError(
            "--strict needs the estimates in the bag, and --no-record writes none; leave one of them out"
        )
    if no_record and check:
        raise click.UsageError(
            "--check compares the bag with a finer run and --no-record writes none; leave one of them out"
        )
