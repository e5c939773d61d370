"""Building stones of the scene schema: a section, and fields with unit, range, default and one line
of help.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar, Literal, TypeAlias, TypeVar

from pydantic import BaseModel, ConfigDict, Field, field_validator
from pydantic_core import PydanticCustomError

Value = TypeVar("Value")

Live: TypeAlias = Literal["excitation", "law"]
"""What a key that may change in a run acts on: what moves the rig, or a law of its motion."""

LEAST = 1e-30
"""In size, of any number but 0: squares and quotients of smaller ones leave the range of 64-bit
numbers.
"""

TOO_NEAR_ZERO = "too_near_zero"
"""The fault of a smaller one."""


class Section(BaseModel):
    """A mapping of a scene: strict types, no unknown keys, no NaN, cannot be changed."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False, defer_build=True)

    fixed: ClassVar[str] = ""
    """Why its keys hold for a whole run, but for those that are live; empty: what holds for their kind of value."""

    def open_values(self, scene: Any) -> dict[str, Any]:
        """Values of the keys that a `scene.Scene` leaves open, where they follow from other keys or
        from `accuracy`.
        """
        return {}

    @field_validator("*")
    @classmethod
    def _computable(cls, value: Any) -> Any:
        """Refuse numbers, and lists with numbers, that are not 0 and closer to it than `LEAST`."""
        if any(0.0 < abs(each) < LEAST for each in _floats(value)):
            raise PydanticCustomError(TOO_NEAR_ZERO, "too near to 0")
        return value


def _floats(value: Any) -> Iterator[float]:
    if isinstance(value, float):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _floats(item)


def given(value: Value | None) -> Value:
    """A value of a resolved scene, which leaves none open."""
    assert value is not None
    return value


def number(
    low: float,
    high: float,
    unit: str,
    meaning: str,
    *,
    default: Any = ...,
    above: bool = False,
    example: float | None = None,
    live: Live | None = None,
    fixed: str = "",
) -> Any:
    """A number or whole number from low to high, all in `unit` (`[1]`: dimensionless); `above`: low
    itself is not allowed.

    `example` is a valid value of a field that has no default. `live`: it may change between two blocks of a run; else
    `fixed` may say why not.
    """
    bounds: dict[str, Any] = {"gt" if above else "ge": low, "le": high}
    extra: dict[str, Any] = {"unit": unit, "example": example, "live": live or "", "fixed": fixed}
    return Field(default, description=meaning, json_schema_extra=extra, **bounds)


def choice(meaning: str, *, default: Any = ..., example: Any = None) -> Any:
    """A field that takes one of a few words, or a section; its type names them."""
    return Field(default, description=meaning, json_schema_extra={"unit": "", "example": example})


def text(
    meaning: str, *, default: Any = ..., pattern: str = r"^[^\x00-\x1f]*$", longest: int = 1000, example: str = ""
) -> Any:
    """A text of at most `longest` characters that matches `pattern`."""
    extra: dict[str, Any] = {"unit": "", "example": example}
    return Field(default, description=meaning, pattern=pattern, max_length=longest, json_schema_extra=extra)


def numbers(
    unit: str, meaning: str, allowed: str, *, default: Any = ..., shortest: int, longest: int, example: Any = None
) -> Any:
    """A list; `allowed` says in words what it may hold."""
    extra: dict[str, Any] = {"unit": unit, "allowed": allowed, "example": example}
    if isinstance(default, list):
        return Field(
            default_factory=lambda: list(default),
            description=meaning,
            min_length=shortest,
            max_length=longest,
            json_schema_extra=extra,
        )
    return Field(default, description=meaning, min_length=shortest, max_length=longest, json_schema_extra=extra)
