"""Keys of a foam whose stress over strain was measured."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, TypeAlias

from pydantic import Field

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.kinds import sha256_key
from contact_sim_pkg.records.fields import Section, number, numbers, text
from contact_sim_pkg.records.registry import rigs
from contact_sim_pkg.scene.errors import Breach, Fault, SceneError
from contact_sim_pkg.scene.schema.foam_points import FEWEST_POINTS, Points, point_fault, share_of
from contact_sim_pkg.scene.schema.places import find_file

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["FoamCurveSection", "curves_of", "share_at"]

MOST_POINTS = 200
Point: TypeAlias = Annotated[list[Annotated[float, Field(ge=0.0, le=1e9)]], Field(min_length=2, max_length=3)]


class FoamCurveSection(Section):
    """Foam by its own curve, in place of modulus, plateau, densification and hardness: a file of force over
    deflection, or the points themselves. The elastic stress is the mean of loading and unloading; the area of the loop
    gives the share of foam_hysteresis where that has none of its own.
    """

    fixed: ClassVar[str] = "foam is one curve as a whole"

    largest_file: ClassVar[int] = 16 << 20
    """[bytes]"""

    file: str | None = text(
        "table of deflection or strain and force or stress, each with its unit; from the scene file's folder",
        default=None, longest=500, example="foam.csv",
    )  # fmt: skip
    sha256: str | None = sha256_key()
    header_line: int | None = number(
        1, 10_000, "1", "line of the column names; null: the first that is no comment", default=None
    )
    area: float | None = number(
        1e-5, 10.0, "m^2", "area of specimen or plate that the force acts on evenly; not beside a stress", default=None
    )
    thickness: float | None = number(
        0.001, 2.0, "m", "thickness of the specimen, by which a deflection becomes a strain; that of the cushion by default",
        default=None,
    )  # fmt: skip
    points: list[Point] | None = numbers(
        "1, Pa, Pa",
        "strain, stress while loading and, where measured, while unloading; read from the file when absent",
        f"{FEWEST_POINTS} to {MOST_POINTS} points, each of 2 or 3 numbers that rise from point to point",
        default=None, shortest=FEWEST_POINTS, longest=MOST_POINTS,
    )  # fmt: skip

    def open_values(self, scene: Scene) -> dict[str, Any]:
        if self.points is not None:
            return {}
        return {"points": self.measured(scene), "thickness": _place_of(self, scene)[1]}

    def input_file(self) -> tuple[str, str | None] | None:
        """Name of the file that it reads, and the checksum that the scene states; None: it has its points."""
        return None if self.file is None or self.points is not None else (self.file, self.sha256)

    def file_memory(self, path: Path) -> int:
        """Memory in [bytes] that reading its file takes."""
        from contact_sim_pkg.excitation.table_files import memory_needed

        return memory_needed(path)

    def measured(self, scene: Scene) -> Points:
        """The points, read from the file where the scene does not hold them. Raises SceneError with the sentence of
        the file, or where it is not there.
        """
        if self.points is not None:
            return self.points
        where, thickness = _place_of(self, scene)
        path = None if self.file is None else find_file(self.file, Path(scene.file).parent)
        if path is None:
            raise SceneError([Fault(scene.file, 1, 1, f"{where}.file", f"the file {self.file!r} is not there")])
        from contact_sim_pkg.scene.schema.foam_file import read_foam_file  # scipy takes 0.2 s

        try:
            return read_foam_file(path, self.area, self.thickness or thickness, self.header_line, where)
        except ExcitationError as error:
            raise SceneError([Fault(scene.file, 1, 1, f"{where}.file", str(error))]) from None

    def breaches(self, where: str) -> Iterator[Breach]:
        """Keys at ``where`` that do not belong together, points that are no curve."""
        if self.file is None and self.points is None:
            yield Breach(f"{where}.file", "is missing; give the file of the test, or points", (f"{where}.points",))
        if self.file is None:
            for name in ("sha256", "header_line", "area", "thickness"):
                if getattr(self, name) is not None:
                    yield Breach(f"{where}.{name}", "belongs to a file, of which there is none; remove it")
        if self.points is not None and (sentence := point_fault(self.points)):
            yield Breach(f"{where}.points", sentence)

    def file_fault(self, scene: Scene) -> str:
        """What is wrong with the content of a file that is there; empty: nothing is."""
        try:
            self.measured(scene)
        except SceneError as error:
            return error.faults[0].sentence
        return ""


def curves_of(scene: Scene) -> Iterator[tuple[str, FoamCurveSection]]:
    """Dotted path and section of each measured foam of a scene."""
    for contact in rigs()[scene.rig].contacts:
        for name, effect in scene.effects_at(contact):
            curve = getattr(effect, "curve", None)
            if isinstance(curve, FoamCurveSection):
                yield f"effects.{contact.name}.{name}.curve", curve


def share_at(scene: Scene, hysteresis: Section) -> float | None:
    """Share of the measured foam at the contact of a scene's ``hysteresis``; None where no loop was measured there."""
    for contact in rigs()[scene.rig].contacts:
        effects = [effect for _name, effect in scene.effects_at(contact)]
        if any(effect is hysteresis for effect in effects):
            curves = (getattr(effect, "curve", None) for effect in effects)
            curve = next((each for each in curves if isinstance(each, FoamCurveSection)), None)
            return None if curve is None else share_of(curve.measured(scene))
    return None


def _place_of(curve: FoamCurveSection, scene: Scene) -> tuple[str, float]:
    """Dotted path of a curve, and the thickness [m] of its cushion."""
    for contact in rigs()[scene.rig].contacts:
        for name, effect in scene.effects_at(contact):
            if getattr(effect, "curve", None) is curve:
                return f"effects.{contact.name}.{name}.curve", float(effect.thickness)  # type: ignore[attr-defined]
    raise KeyError("the curve belongs to no cushion of the scene")
