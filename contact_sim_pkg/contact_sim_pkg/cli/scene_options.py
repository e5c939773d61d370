"""The options that choose and change a scene, shared by the commands that take one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from contact_sim_pkg.scene.overrides import Override
    from contact_sim_pkg.scene.resolved_scene import ResolvedScene

_FILE = click.Path(path_type=Path)


@dataclass(frozen=True)
class SceneOptions:
    """Scene and changes from the command line."""

    scene: str | None
    assignments: tuple[str, ...]
    duration: str | None
    pace: str | None
    road: Path | None
    vibration: Path | None
    rate: str | None

    def overrides(self) -> list[Override]:
        """The changes to the scene; `--set` comes last and overrides."""
        from contact_sim_pkg.scene import overrides

        made: tuple[tuple[Any, Callable[[Any], Override]], ...] = (
            (self.road, overrides.set_road),
            (self.vibration, overrides.set_vibration),
            (self.rate, overrides.set_rate),
            (self.duration, overrides.set_duration),
            (self.pace, overrides.set_pace),
        )
        chosen = [make(value) for value, make in made if value is not None]
        return chosen + [overrides.set_value(assignment) for assignment in self.assignments]

    def resolve(self, bag: Path | None = None, accuracy: float | None = None) -> ResolvedScene:
        """The resolved scene: the one that was named, or that of the bag where none was; at an ``accuracy`` of the
        caller's, if any.

        Raises:
            SceneError: faults of the scene or of the options. BagError: the bag cannot be read or
            holds no scene.
        """
        if accuracy is not None:
            return replace(self, assignments=(*self.assignments, f"accuracy={accuracy:g}")).resolve(bag)
        if self.scene is not None:
            from contact_sim_pkg.scene.load import load_scene
            from contact_sim_pkg.scene.resolve import resolve

            return resolve(load_scene(self.scene, self.overrides()))
        if bag is None:
            raise click.UsageError("Missing argument 'SCENE' (or --from-bag BAG, whose scene is taken).")
        return _scene_of_bag(bag, self.overrides())

    def within(self, requests: tuple[str, ...], bag: Path | None = None) -> ResolvedScene:
        """The scene with dials for the accuracy of metrics, found by short runs where they pay; says what was chosen.

        Raises:
            As `resolve`; BagError also for a request that is none. RunError: a short run ends early.
        """
        from contact_sim_pkg.cli.output.say import announce, say
        from contact_sim_pkg.studies.accuracy.by_metric import choose, lines_of, parsed

        if any(each.partition("=")[0].strip() == "accuracy" for each in self.assignments):
            raise click.UsageError("--within finds an accuracy, and --set accuracy gives one; leave one of them out")
        choice = choose(lambda accuracy: self.resolve(bag, accuracy), parsed(requests), announce)
        for line in lines_of(choice):
            say(line, err=True)
        return choice.scene


def _scene_of_bag(path: Path, overrides: list[Override]) -> ResolvedScene:
    from contact_sim_pkg.bag.errors import BagError
    from contact_sim_pkg.bag.reader import open_bag
    from contact_sim_pkg.scene.resolve import ResolvedScene, read_explicit

    text = open_bag(path).scene
    if text is None:
        raise BagError(f"{path} holds no scene; name the scene to run with its excitation")
    return ResolvedScene(read_explicit(text, f"scene of {path}", overrides))


def scene_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Adds SCENE and its options to a command, which gets them as `options`."""
    decorators = (
        click.argument("scene", required=False),
        click.option(
            "--set",
            "assignments",
            multiple=True,
            metavar="A.B.C=VALUE",
            help="Change one value of the scene; null removes the key.",
        ),
        click.option("--duration", metavar="S", help="Simulated time, in s."),
        click.option("--pace", metavar="realtime|max|FACTOR", help="How fast blocks are sent; acts on nodes."),
        click.option(
            "--road",
            type=_FILE,
            metavar="FILE",
            help="Road in place of that of the scene: OpenCRG, x and z as a table, ERD, RDF.",
        ),
        click.option(
            "--vibration", type=_FILE, metavar="FILE", help="CSV file in place of the vibration of the scene."
        ),
        click.option("--rate", metavar="HZ", help="Sampling rate of the vibration file."),
    )

    @wraps(function)
    def collect(**values: Any) -> Any:
        names = SceneOptions.__dataclass_fields__
        options = SceneOptions(**{name: values.pop(name) for name in names})
        return function(options=options, **values)

    # the decorator applied last is the first in `--help`
    for decorate in reversed(decorators):
        collect = decorate(collect)
    return collect
