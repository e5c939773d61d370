"""A number that a sentence suggests, fed through the rules before it is printed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextvars import ContextVar

from pydantic import ValidationError

from contact_sim_pkg.scene.errors import Breach
from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["allows"]

_judging: ContextVar[bool] = ContextVar("judging", default=False)
"""A suggestion is being judged: the sentences of what it breaks need none of their own."""


def allows(scene: Scene, where: str, value: float, *rules: Callable[[Scene], Iterable[Breach]]) -> bool:
    """Whether a scene with another ``value`` at the key ``where`` fits the schema and mends a breach of ``rules``
    without another one.

    Args:
        scene: with types that are right.
        where: dotted path of a number.
        value: in the unit of the key.
        rules: those that suggest the number.
    """
    if _judging.get():
        return False
    token = _judging.set(True)
    try:
        changed = Scene.model_validate(_with(scene, where, value))
        changed._file = scene.file
        before, after = ({breach.where for rule in rules for breach in rule(each)} for each in (scene, changed))
        return after < before
    except ValidationError:
        return False
    finally:
        _judging.reset(token)


def _with(scene: Scene, where: str, value: float) -> dict[str, object]:
    data = scene.model_dump(exclude_none=True)
    *sections, key = where.split(".")
    found = data
    for section in sections:
        found = found.setdefault(section, {})
    found[key] = value
    return data
