"""`bench list`, `bench show` and `bench new`: the shipped scenes, one with all that it leaves open, and one of your own."""

from __future__ import annotations

import re
from pathlib import Path

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, print_json_rows, show_rows
from contact_sim_pkg.cli.scene_options import SceneOptions, scene_options


@click.command("list")
@click.argument("scenes", nargs=-1, metavar="[SCENE]...")
@click.option("--try", "with_trials", is_flag=True, help="What to try with each: commands, and what they show.")
@json_option
def list_command(scenes: tuple[str, ...], with_trials: bool, as_json: bool) -> None:
    """Scenes that come with the package, smallest first; only those named, where any is."""
    from contact_sim_pkg.scene.load import list_scenes, shipped_names
    from contact_sim_pkg.scene.things_to_try import things_to_try

    for unknown in set(scenes).difference(shipped_names()):
        raise click.UsageError(f"{unknown} is no shipped scene; `bench list` names them.")
    entries = [each for each in list_scenes() if not scenes or each.name in scenes]
    if not with_trials:
        rows = [{"scene": entry.name, "rig": entry.rig, "description": entry.description} for entry in entries]
        show_rows(rows, as_json)
        return
    trials = [(entry, things_to_try(entry.path.read_text(encoding="utf-8"))) for entry in entries]
    if as_json:
        print_json_rows([{"scene": entry.name, **trial._asdict()} for entry, found in trials for trial in found])
        return
    for entry, found in trials:
        if found:
            say(f"{entry.name}: {entry.description}")
        for trial in found:
            say(f"  {trial.command}" + f"\n      {trial.shows}" * bool(trial.shows))


@click.command("show")
@scene_options
@click.option("--source", is_flag=True, help="The scene's file as it was written, comments and all; without changes.")
def show_command(options: SceneOptions, source: bool) -> None:
    """The resolved SCENE: every default, grid and tolerance, as stored in a bag."""
    if not source:
        say(options.resolve().to_yaml(), nl=False)
        return
    from contact_sim_pkg.scene.load import find_scene, load_scene

    if options.scene is None:
        raise click.UsageError("Missing argument 'SCENE'.")
    if options.overrides():
        raise click.UsageError("--source shows the file as it is: leave out what changes it, or --source.")
    load_scene(options.scene)  # what is no scene is refused as elsewhere
    say(find_scene(options.scene).read_text(encoding="utf-8"), nl=False)


@click.command("new")
@click.argument("name")
@click.option("--like", metavar="SCENE", help="Shipped scene to begin with; else the nearest that shares a word.")
def new_command(name: str, like: str | None) -> None:
    """Write NAME.yaml, a scene of your own, from a shipped one with its comments."""
    from contact_sim_pkg.files import FileRefusedError, wrong_name
    from contact_sim_pkg.scene.load import find_scene, load_scene, nearest_name

    path = Path(name if name.endswith((".yaml", ".yml")) else f"{name}.yaml")
    if reason := wrong_name(path):
        raise FileRefusedError(path, reason)
    like = nearest_name(path.stem) if like is None else like
    if like is None:
        raise click.UsageError(
            f"No shipped scene shares a word with {path.stem}: say which one to begin with, --like SCENE of `bench list`."
        )
    load_scene(like)
    text = find_scene(like).read_text(encoding="utf-8")
    own = re.sub(rf"\b(bench \w+) {re.escape(like)}\b", lambda found: f"{found[1]} {path}", text)
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(own)
    except FileExistsError:
        raise FileRefusedError(path, "exists already and is never overwritten; give another name") from None
    except FileNotFoundError:
        raise FileRefusedError(path, "its directory is not there; make it first") from None
    say(f"{path}: made from {like}, see its first comment; run it: bench run {path}")
