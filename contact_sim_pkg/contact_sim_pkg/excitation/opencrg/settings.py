"""What an OpenCRG file itself requests of an evaluator: its options and modifiers, as far as they
touch heights over (u, v)."""

from collections.abc import Collection
from typing import NamedTuple

from contact_sim_pkg.excitation.borders import BORDERS
from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.header import Header, HeaderValue

POLICIES = ("refuse", "ignore", "apply")
_NEUTRAL = {  # entries that change heights over (u, v), with the value that changes nothing
    "scale_z_grid": 1.0, "refline_offset_z": 0.0, "scale_slope": 1.0, "scale_banking": 1.0, "scale_length": 1.0,
    "scale_width": 1.0, "refpoint_u": None, "refpoint_u_fraction": 0.0, "refpoint_u_offset": 0.0, "refpoint_v": 0.0,
    "refpoint_v_fraction": None, "refpoint_v_offset": 0.0, "refpoint_z": 0.0, "grid_nan_mode": None,
    "grid_nan_offset": 0.0,
    "border_mode_u": 2.0, "border_mode_v": 2.0, "border_offset_u": 0.0, "border_offset_v": 0.0,
    "border_smooth_ubeg": 0.0, "border_smooth_uend": 0.0,
}  # fmt: skip
_APPLICABLE = ("scale_z_grid", "refline_offset_z", "border_mode_u", "border_mode_v")
_OF_MISSING_CELLS = ("grid_nan_mode", "grid_nan_offset")
_CHANNEL_OF = {"scale_slope": "slope", "scale_banking": "banking"}


class FileSettings(NamedTuple):
    """The settings that are applied, and sentences about all of them."""

    scale_z: float
    offset_z: float
    border_u: str | None
    border_v: str | None
    notes: tuple[str, ...]


class Circumstances(NamedTuple):
    """What a road is made of and how it is used, which decides whether a setting changes anything."""

    missing_cells: bool  # whether cells have no height
    channels: Collection[str]  # of the reference line
    borders: tuple[str | None, str | None]  # along and across, as the user chose them


def read_settings(header: Header, policy: str, road: Circumstances) -> FileSettings:
    """Take the file's settings by the policy.

    Settings that change nothing on this road pass under each policy: a default of the format, what is done
    with missing cells where none is missing, the scale of a channel that the file does not have, borders where
    the user chose them. Whatever is not applied is named in the notes.

    Args:
        header: the file's text part. policy: refuse: a file with settings that change heights is
        refused, so that the user decides; ignore: they are
            left out and noted; apply: SCALE_Z_GRID, REFLINE_OFFSET_Z and the border modes that the user
            leaves open are used, others refused by name.
        road: what decides whether a setting changes anything.

    Raises:
        ExcitationError: by the policy, or for a border mode that does not exist.
    """
    if policy not in POLICIES:
        raise ExcitationError(
            f"{header.file}: policy '{policy}' for the file's own settings is unknown; allowed: {', '.join(POLICIES)}"
        )
    entries = {**header.options, **header.modifiers}
    borders = {key: _border(header, key, policy) for key in ("border_mode_u", "border_mode_v")}
    chosen = dict(zip(borders, road.borders, strict=True))
    active = [key for key, value in entries.items() if _changes(key, value.number, road)]
    # The borders that the user chose stand under each policy.
    overruled = [key for key in active if chosen.get(key) is not None]
    active = [key for key in active if key not in overruled]
    others = [key for key in overruled if chosen[key] != borders[key]]
    passed = [key for key in entries if key not in (*active, *others)]
    notes = [_said("that change nothing here", entries, passed)] if passed else []
    notes += [_said("that were not applied, for border_u and border_v are chosen", entries, others)] if others else []
    if policy == "refuse" and active:
        raise ExcitationError(
            f"{header.file}: the file asks for {_named(entries, active)}; say what is done with them (road.file_settings: "
            "apply or ignore)"
        )
    if policy != "apply":
        notes += [_said("that were not applied", entries, active)] if active else []
        return FileSettings(1.0, 0.0, None, None, tuple(notes))
    for key in active:
        if key not in _APPLICABLE:
            raise ExcitationError(
                f"{header.file}, line {entries[key].line}: {key.upper()} cannot be applied; leave the file's settings out "
                "(road.file_settings: ignore) and choose road.missing_cells, road.remove_mean, road.border_u and "
                "road.border_v yourself"
            )
    # Applied: noted as well.
    notes += [_said("that were applied", entries, active)] if active else []
    scale, offset = (
        entries[key].number if key in entries else neutral
        for key, neutral in (("scale_z_grid", 1.0), ("refline_offset_z", 0.0))
    )
    return FileSettings(scale, offset, borders["border_mode_u"], borders["border_mode_v"], tuple(notes))


def _changes(key: str, value: float, road: Circumstances) -> bool:
    """Whether a setting changes heights of a road."""
    if key not in _NEUTRAL or value == _NEUTRAL[key]:
        return False
    if key in _OF_MISSING_CELLS:
        return road.missing_cells
    return key not in _CHANNEL_OF or _CHANNEL_OF[key] in road.channels


def _named(entries: dict[str, HeaderValue], keys: list[str]) -> str:
    return ", ".join(f"{key.upper()} = {entries[key].number:g} (line {entries[key].line})" for key in keys)


def _said(what: str, entries: dict[str, HeaderValue], keys: list[str]) -> str:
    return f"Settings of the file {what}: {_named(entries, keys)}."


def _border(header: Header, key: str, policy: str) -> str | None:
    value = header.options.get(key)
    if value is None or (policy == "ignore" and value.number not in range(len(BORDERS))):
        return None
    if value.number not in range(len(BORDERS)):
        raise ExcitationError(f"{header.file}, line {value.line}: {key.upper()} is {value.number:g}; allowed: 0 to 4")
    return BORDERS[int(value.number)]
