"""Where the grid of an OpenCRG file lies: rows along u, long sections along v, and the columns that
hold them.

The header gives most numbers twice (road parameters and channel definitions); they must agree.
"""

import re
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.header import NUMBER, Channel, Header

MOST_CELLS = 1 << 26  # 512 MiB of heights as float64
AGREEMENT = 1e-3  # two statements of one length may differ by this part of the increment

_UNITS = {"reference line phi": "rad", "reference line banking": "m/m", "reference line slope": "m/m"}
_AT_V = re.compile(rf"long section at v ?= ?({NUMBER.pattern})")
_NUMBERED = re.compile(r"long section (\d{1,7})")


class CrgLayout(NamedTuple):
    """Grid lines and columns of the payload."""

    u_start: float  # [m]
    u_increment: float  # [m]
    rows: int | None  # None: the header gives no end, the payload decides
    v: NDArray[numpy.float64]  # [long sections], [m], increasing, left positive
    section_columns: tuple[int, ...]
    reference_columns: dict[str, int]  # phi, banking, slope
    columns: int
    notes: tuple[str, ...]


def make_layout(header: Header) -> CrgLayout:
    """Check the header against itself and lay out the grid; ExcitationError where two statements
    disagree.
    """
    increment = header.road.get("reference_line_increment")
    if increment is None:
        raise ExcitationError(f"{header.file}: the header gives no REFERENCE_LINE_INCREMENT")
    if not 1e-6 <= increment.number <= 1e4:
        raise _fault(
            header, increment.line, f"REFERENCE_LINE_INCREMENT is {increment.number:g} m; allowed: 1e-6 to 1e4 m"
        )
    # Columns by their role, grid lines from the road parameters.
    reference, sections = _sort_channels(header)
    u_start = _number(header, "reference_line_start_u", 0.0)
    notes = _note_virtual(header, u_start, increment.number)
    v = _lateral_positions(header, sections)
    rows = _count_rows(header, u_start, increment.number)
    columns = len(header.channels)
    # Refused before anything is allocated.
    if rows is not None and rows * columns > MOST_CELLS:
        raise ExcitationError(
            f"{header.file}: the header asks for {rows} x {columns} numbers ({8e-9 * rows * columns:.3g} GB), limit "
            f"{MOST_CELLS}; cut the road or thin it out"
        )
    return CrgLayout(
        u_start=u_start,
        u_increment=increment.number,
        rows=rows,
        v=v,
        section_columns=tuple(index for index, _ in sections),
        reference_columns=reference,
        columns=columns,
        notes=notes,
    )


def _fault(header: Header, line: int, sentence: str) -> ExcitationError:
    return ExcitationError(f"{header.file}, line {line}: {sentence}")


def _number(header: Header, key: str, default: float) -> float:
    return header.road[key].number if key in header.road else default


def _sort_channels(header: Header) -> tuple[dict[str, int], list[tuple[int, Channel]]]:
    reference: dict[str, int] = {}
    sections: list[tuple[int, Channel]] = []
    for index, channel in enumerate(header.channels):
        # Unit of the channel.
        is_section = channel.name.startswith("long section")
        unit = "m" if is_section else _UNITS.get(channel.name)
        if unit is None:
            raise _fault(
                header, channel.line, f"channel '{channel.name}' is unknown; allowed: {', '.join(_UNITS)}, long section"
            )
        if channel.fields != (unit,):
            raise _fault(
                header, channel.line, f"unit of '{channel.name}' is '{','.join(channel.fields)}'; only {unit} is read"
            )
        if is_section:
            sections.append((index, channel))
            continue
        # Channels of the reference line, once each.
        short = channel.name.split()[-1]
        if short in reference:
            raise _fault(header, channel.line, f"channel '{channel.name}' is defined a second time")
        reference[short] = index
    if not sections:
        raise ExcitationError(f"{header.file}: the header defines no long section, so the road has no heights")
    return reference, sections


def _note_virtual(header: Header, u_start: float, increment: float) -> tuple[str, ...]:
    """What the virtual channel says otherwise; it serves viewers alone, the road parameters are the
    road's.
    """
    if header.virtual is None:
        return ()
    line, fields = header.virtual.line, header.virtual.fields
    if (
        not re.fullmatch("reference line [ux]", header.virtual.name)
        or len(fields) != 3
        or not all(NUMBER.fullmatch(part) for part in fields[1:])
    ):
        raise _fault(
            header,
            line,
            f"'U:{header.virtual.name},{','.join(fields)}' is no definition 'U:reference line u,m,START,INCREMENT'",
        )
    if fields[0] != "m":
        raise _fault(header, line, f"unit of the virtual channel is '{fields[0]}'; only m is read")
    # The file prints START_U with three decimals
    notes: list[str] = []
    for name, stated, found in (("START_U", u_start, float(fields[1])), ("INCREMENT", increment, float(fields[2]))):
        if abs(stated - found) > max(AGREEMENT * increment, 5.1e-4 if name == "START_U" else 0.0):
            notes.append(
                f"The virtual channel, for viewing only, says {found:g} m where REFERENCE_LINE_{name} says {stated:g} m; "
                "the latter was taken."
            )
    return tuple(notes)


def _count_rows(header: Header, u_start: float, increment: float) -> int | None:
    end = header.road.get("reference_line_end_u")
    if end is None:
        return None
    steps = (end.number - u_start) / increment
    if not 1.0 - AGREEMENT <= steps <= 1e12 or abs(steps - round(steps)) > AGREEMENT:
        raise _fault(
            header,
            end.line,
            f"REFERENCE_LINE_END_U {end.number:.9g} m is {steps:.9g} increments of {increment:g} m behind the start "
            f"at {u_start:.9g} m; a whole number from 1 was expected",
        )
    return round(steps) + 1


def _lateral_positions(header: Header, sections: list[tuple[int, Channel]]) -> NDArray[numpy.float64]:
    matches = [_AT_V.fullmatch(channel.name) for _, channel in sections]
    if all(matches):
        v = numpy.array([float(match.group(1)) for match in matches if match])
        _check_explicit(header, sections, v)
        return v
    for number, (_, channel) in enumerate(sections, start=1):
        match = _NUMBERED.fullmatch(channel.name)
        if match is None or int(match.group(1)) != number:
            raise _fault(header, channel.line, f"'{channel.name}' stands where 'long section {number}' was expected")
    return _even_positions(header, len(sections))


def _check_explicit(header: Header, sections: list[tuple[int, Channel]], v: NDArray[numpy.float64]) -> None:
    falling = numpy.flatnonzero(numpy.diff(v) <= 0.0)
    # Rising positions within the limits.
    if falling.size:
        index = int(falling[0]) + 1
        raise _fault(
            header,
            sections[index][1].line,
            f"long section at v = {v[index]:g} m follows the one at {v[index - 1]:g} m; v must increase",
        )
    if abs(v).max() > 1e4:
        raise ExcitationError(
            f"{header.file}: a long section lies at v = {v[abs(v).argmax()]:g} m; allowed: within +-10000 m"
        )
    # The road parameters must agree.
    tolerance = 5.1e-4 + AGREEMENT * float(numpy.diff(v).min(initial=1.0))
    for key, found in (("long_section_v_right", v[0]), ("long_section_v_left", v[-1])):
        if key in header.road and abs(header.road[key].number - found) > tolerance:
            stated = header.road[key]
            raise _fault(
                header,
                stated.line,
                f"{key.upper()} says {stated.number:g} m, the channel definitions say {found:g} m; they must agree",
            )


def _even_positions(header: Header, count: int) -> NDArray[numpy.float64]:
    stated = {part: header.road.get(f"long_section_v_{part}") for part in ("right", "left", "increment")}
    right, left, increment = (None if value is None else value.number for value in stated.values())
    if right is None and left is None and increment is not None:
        # The format's default: even about the reference line
        right = -0.5 * (count - 1) * increment
    if right is None and left is not None and increment is not None:
        right = left - (count - 1) * increment
    if left is None and right is not None and increment is not None:
        left = right + (count - 1) * increment
    if right is None or left is None:
        raise ExcitationError(
            f"{header.file}: numbered long sections need LONG_SECTION_V_INCREMENT, or LONG_SECTION_V_RIGHT and "
            "LONG_SECTION_V_LEFT"
        )
    width = left - right
    if max(abs(left), abs(right)) > 1e4 or width < 0.0 or (width == 0.0) != (count == 1):
        raise ExcitationError(
            f"{header.file}: {count} long sections lie between v = {right:g} m (right) and {left:g} m (left); v must "
            "increase to the left, within +-10000 m"
        )
    line = max(value.line for value in stated.values() if value is not None)
    if increment is not None and count > 1 and abs((count - 1) * increment - width) > AGREEMENT * abs(increment):
        expected = f"{width / increment + 1.0:.6g}" if increment else "no"
        raise _fault(
            header,
            line,
            f"the road parameters ask for {expected} long sections ({right:g} to {left:g} m in steps of {increment:g} "
            f"m), the channel definitions have {count}; they must agree",
        )
    return numpy.linspace(right, left, count, dtype=numpy.float64)
