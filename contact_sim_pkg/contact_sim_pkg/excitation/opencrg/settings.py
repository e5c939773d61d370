"""What an OpenCRG file itself requests of an evaluator: its options and modifiers, as far as they
touch heights over (u, v)."""

from typing import NamedTuple

from contact_sim_pkg.excitation.errors import ExcitationError
from contact_sim_pkg.excitation.opencrg.header import Header

BORDERS = ("none", "zero", "constant", "repeat", "reflect")  # in the order of BORDER_MODE 0 to 4
POLICIES = ("refuse", "ignore", "apply")
_NEUTRAL = {  # entries that change heights over (u, v), with the value that changes nothing
    "scale_z_grid": 1.0, "refline_offset_z": 0.0, "scale_slope": 1.0, "scale_banking": 1.0, "scale_length": 1.0,
    "scale_width": 1.0, "refpoint_u": None, "refpoint_u_fraction": 0.0, "refpoint_u_offset": 0.0, "refpoint_v": 0.0,
    "refpoint_v_fraction": None, "refpoint_v_offset": 0.0, "refpoint_z": 0.0, "grid_nan_mode": None,
    "grid_nan_offset": 0.0,
    "border_mode_u": None, "border_mode_v": None, "border_offset_u": 0.0, "border_offset_v": 0.0,
    "border_smooth_ubeg": 0.0, "border_smooth_uend": 0.0,
}  # fmt: skip
_APPLICABLE = ("scale_z_grid", "refline_offset_z", "border_mode_u", "border_mode_v")


class FileSettings(NamedTuple):
    """The settings that are applied, and a sentence about those that are not."""

    scale_z: float
    offset_z: float
    border_u: str | None
    border_v: str | None
    notes: tuple[str, ...]


def read_settings(header: Header, policy: str) -> FileSettings:
    """Take the file's settings by the policy.

    Args:
        header: the file's text part. policy: refuse: a file with settings that change heights is
        refused, so that the user decides; ignore: they are
            left out and noted; apply: SCALE_Z_GRID, REFLINE_OFFSET_Z and the border modes are used,
            others refused by name.

    Raises:
        ExcitationError: by the policy, or for a border mode that does not exist.
    """
    if policy not in POLICIES:
        raise ExcitationError(
            f"{header.file}: policy '{policy}' for the file's own settings is unknown; allowed: {', '.join(POLICIES)}"
        )
    # Settings that change something.
    entries = {**header.options, **header.modifiers}
    active = {key: value for key, value in entries.items() if key in _NEUTRAL and value.number != _NEUTRAL[key]}
    names = ", ".join(f"{key.upper()} = {value.number:g} (line {value.line})" for key, value in active.items())
    if policy == "refuse" and active:
        raise ExcitationError(
            f"{header.file}: the file asks for {names}; say what is done with them (road.file_settings: apply or ignore)"
        )
    # Not applied: noted.
    if policy != "apply":
        note = (f"Settings of the file that were not applied: {names}.",) if active else ()
        return FileSettings(1.0, 0.0, None, None, note)
    for key, value in active.items():
        if key not in _APPLICABLE:
            raise ExcitationError(
                f"{header.file}, line {value.line}: {key.upper()} cannot be applied; leave the file's settings out "
                "(road.file_settings: ignore) and choose road.missing_cells, road.remove_mean, road.border_u and "
                "road.border_v yourself"
            )
    # Applied: noted as well.
    scale, offset = (
        entries[key].number if key in entries else neutral
        for key, neutral in (("scale_z_grid", 1.0), ("refline_offset_z", 0.0))
    )
    note = (f"Settings of the file that were applied: {names}.",) if active else ()
    return FileSettings(scale, offset, _border(header, "border_mode_u"), _border(header, "border_mode_v"), note)


def _border(header: Header, key: str) -> str | None:
    value = header.options.get(key)
    if value is None:
        return None
    if value.number not in range(len(BORDERS)):
        raise ExcitationError(f"{header.file}, line {value.line}: {key.upper()} is {value.number:g}; allowed: 0 to 4")
    return BORDERS[int(value.number)]
