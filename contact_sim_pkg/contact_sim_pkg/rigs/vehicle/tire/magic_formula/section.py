"""Keys of the effect `magic_formula`: a tire property file, or its coefficients."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import Field

from contact_sim_pkg.excitation.kinds import sha256_key
from contact_sim_pkg.files import FileRefusedError
from contact_sim_pkg.records.fields import Section, choice, text
from contact_sim_pkg.rigs.vehicle.tire.magic_formula.coefficients import (
    KNOWN,
    MagicFormula,
    Version,
    formula_of,
    magic_formula,
    stated_coefficients,
)
from contact_sim_pkg.rigs.vehicle.tire.property_file.errors import PropertyFileError
from contact_sim_pkg.rigs.vehicle.tire.property_file.reading import LARGEST_FILE, read_property_file
from contact_sim_pkg.scene.errors import Breach, Fault, SceneError
from contact_sim_pkg.scene.schema.places import find_file

if TYPE_CHECKING:
    from contact_sim_pkg.scene.schema.scene import Scene

__all__ = ["MagicFormulaSection", "magic_formula_breaches"]

WHERE = "effects.tire.magic_formula"
LARGEST = 1e9
SHOWN = 5  # names in a sentence


class MagicFormulaSection(Section):
    """Forces in the plane of the road by the Magic Formula of a tire property file, with its relaxation lengths: in place
    of bristles, belt and their losses. Load and deflection stay those of the scene's tire.
    """

    fixed: ClassVar[str] = "the coefficients of a file are one fit"

    largest_file: ClassVar[int] = LARGEST_FILE
    """[bytes]"""

    file: str | None = text(
        "tire property file (.tir) of MF-Tyre 5.2 to 6.2 or PAC2002; from the scene file's folder",
        default=None, longest=500, example="tire.tir",
    )  # fmt: skip
    sha256: str | None = sha256_key()
    version: Version | None = choice("equations; those of the file by default", default=None)
    coefficients: dict[str, float] | None = Field(
        None,
        description="by the names of a property file, in SI; read from the file when absent",
        json_schema_extra={"unit": "", "allowed": "mapping of names to numbers", "example": None},
    )
    unused: str | None = text(
        "keys of the file that nothing uses; written where a scene is resolved", default=None, longest=100_000
    )

    def open_values(self, scene: Scene) -> dict[str, Any]:
        if self.coefficients is not None:
            return {} if self.version is not None else {"version": "6.1 and later"}
        formula, stated = self._read(scene)
        return {"version": formula.version, "coefficients": stated, "unused": " ".join(formula.ignored)}

    def input_file(self) -> tuple[str, str | None] | None:
        """Name of the file that it reads, and the checksum that the scene states; None: it has its coefficients."""
        return None if self.file is None or self.coefficients is not None else (self.file, self.sha256)

    def file_memory(self, path: Path) -> int:
        """Memory in [bytes] that reading its file takes."""
        return 10 * path.stat().st_size

    def file_fault(self, scene: Scene) -> str:
        """What is wrong with the content of a file that is there; empty: nothing is."""
        try:
            self._read(scene)
        except SceneError as error:
            return error.faults[0].sentence
        return ""

    def formula(self) -> MagicFormula:
        """The formula of a resolved scene."""
        assert self.coefficients is not None
        assert self.version is not None
        return formula_of(self.coefficients, self.version, self.file or "the scene")

    def _read(self, scene: Scene) -> tuple[MagicFormula, dict[str, float]]:
        """Formula and coefficients of the file. Raises SceneError with its sentence, or where it is not there."""
        path = None if self.file is None else find_file(self.file, Path(scene.file).parent)
        if path is None:
            raise SceneError([Fault(scene.file, 1, 1, f"{WHERE}.file", f"the file {self.file!r} is not there")])
        try:
            tire = read_property_file(path)
            return magic_formula(tire), stated_coefficients(tire)
        except (PropertyFileError, FileRefusedError) as error:
            raise SceneError([Fault(scene.file, 1, 1, f"{WHERE}.file", str(error))]) from None


def magic_formula_breaches(scene: Scene) -> Iterator[Breach]:
    """No file and no coefficients, and coefficients that make no formula."""
    keys = scene.effect("tire", MagicFormulaSection)
    if keys is None:
        return
    if keys.coefficients is None:
        if keys.file is None:
            yield Breach(
                f"{WHERE}.file", "is missing; give a tire property file, or coefficients", (f"{WHERE}.coefficients",)
            )
        for name in ("version", "unused"):
            if getattr(keys, name) is not None:
                yield Breach(f"{WHERE}.{name}", "is that of the file; it is given beside coefficients alone")
        return
    if keys.file is None and keys.sha256 is not None:
        yield Breach(f"{WHERE}.sha256", "belongs to a file, of which there is none; remove it")
    sentence = _no_formula(keys.coefficients)
    if sentence:
        yield Breach(f"{WHERE}.coefficients", sentence)


def _no_formula(coefficients: dict[str, float]) -> str:
    """Why coefficients make no formula; empty where they do."""
    unknown = [key for key in coefficients if key not in KNOWN]
    if unknown:
        more = f" and {len(unknown) - SHOWN} more" if len(unknown) > SHOWN else ""
        return f"the Magic Formula has no {', '.join(unknown[:SHOWN])}{more}; remove it"
    for key, value in coefficients.items():
        if not (math.isfinite(value) and abs(value) <= LARGEST):
            return f"{key} is {value:g}; numbers up to {LARGEST:g} in size are allowed"
    try:
        formula_of(coefficients, "6.1 and later", "")
    except PropertyFileError as error:
        return str(error).removeprefix(": ").replace("which the file does not give", "which are not among them")
    return ""
