"""A pressure mat as a bag: its frames as `ContactPatch`, as a run records its own pressure fields."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy

from contact_sim_pkg.bag.encoding import LAST_STAMP, SECOND
from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import IMPORTED_FROM, WARNINGS, RecordedTopic
from contact_sim_pkg.bag.typestore import definition, type_hash
from contact_sim_pkg.bag.writer import BagSummary, BagWriter
from contact_sim_pkg.run.contact_patch import contact_patch
from contact_sim_pkg.standard.mat_files import read_mat

__all__ = ["CONTACTS", "FRONTS", "import_mat"]

PATCH = "contact_msgs_defs/msg/ContactPatch"
FRONTS = ("bottom", "left", "top", "right")
"""Side of the file's map that points forward, or up on a seat back, seen from the occupant's side."""
CONTACTS = {"seat": "bottom", "backrest": "top"}
"""What a mat lies on -> its usual front: row 1 at the seat back, or at its top; column 1 at the occupant's right."""


def import_mat(
    source: Path, target: Path, *, rate: float | None = None, unit: str | None = None, pitch: float | None = None,
    front: str | None = None, contact: str = "seat",
) -> tuple[BagSummary, list[str]]:  # fmt: skip
    """Write a bag of the frames of a mat on the topic of a contact's field; the middle of the mat is its origin.

    Cell (i, j) of a message is row i and column j of the file, from 0, where its front lies at the bottom. Load, centre
    and area are those of the cells, as of a run; the approach is not measured and NaN.

    Args:
        source: a text export of Tekscan or XSENSOR.
        target: folder of the bag.
        rate: [Hz], unit, pitch [m]: as of `read_mat`.
        front: one of `FRONTS`; None: as usual on the contact.
        contact: one of `CONTACTS`.

    Returns:
        Summary of the bag, and what was found and assumed, a sentence each.

    Raises:
        BagError: the mat cannot be read, or the bag exists.
    """
    mat = read_mat(source, rate=rate, unit=unit, pitch=pitch)
    front = front or CONTACTS[contact]
    turns = FRONTS.index(front)
    pitches = (mat.row_pitch, mat.col_pitch) if turns % 2 == 0 else (mat.col_pitch, mat.row_pitch)
    stamps = numpy.round(mat.times * SECOND).astype(numpy.int64)
    if mat.times[-1] * SECOND > LAST_STAMP:
        raise BagError(f"{source}: it spans {mat.times[-1]:.4g} s, more than a stamp can hold; state --rate HZ")
    ahead = "forward" if contact == "seat" else "up"
    notes = [*mat.notes, f"The {front} of the file's map, seen from the occupant's side, points {ahead} (--front)."]
    provenance = {
        IMPORTED_FROM: source.name, "imported_sha256": hashlib.sha256(source.read_bytes()).hexdigest(),
        "imported_as": " ".join(notes), WARNINGS: "\n".join(mat.warnings),
    }  # fmt: skip
    name = f"{contact}/patch"
    topic = RecordedTopic(name, f"/{name}", PATCH, definition(PATCH), type_hash(PATCH), "")
    with BagWriter(target, [topic], provenance) as writer:
        for place, (stamp, frame) in enumerate(zip(stamps, mat.frames, strict=True)):
            pressure = numpy.ascontiguousarray(numpy.rot90(frame, turns), dtype=numpy.float64)
            origin = [-0.5 * (count - 1) * cell for count, cell in zip(pressure.shape, pitches, strict=True)]
            patch = contact_patch(place, (*pitches, origin[0], origin[1]), numpy.nan, pressure)
            writer.write(name, int(stamp), encode(patch, int(stamp), f"{contact}_contact"))
        return writer.close(), notes
