"""The text part of an OpenCRG file: named sections of `KEY = value` lines and the list of channels.

Source: ASAM OpenCRG 1.2, chapter 3 (text in ISO 8859-1; `*` in column 1 and `!` start comments;
`$NAME` opens and `$` closes a section; a line that starts with `$$$$` ends the header).
"""

import re
from difflib import get_close_matches
from typing import NamedTuple

from contact_sim_pkg.excitation.errors import ExcitationError

LONGEST_HEADER = 1 << 24  # [bytes]; real headers have a few kilobytes
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")

ROAD_KEYS = frozenset(
    ["reference_line_increment", "long_section_v_right", "long_section_v_left", "long_section_v_increment"]
    + [
        f"reference_line_{end}_{what}"
        for end in ("start", "end")
        for what in ("u", "s", "b", "x", "y", "z", "phi", "lon", "lat", "alt")
    ]
    + [f"reference_line_offset_{what}" for what in ("x", "y", "z", "phi")]
)
OPTION_KEYS = frozenset({
    "border_mode_u", "border_mode_v", "border_offset_u", "border_offset_v", "border_smooth_ubeg", "border_smooth_uend",
    "refline_continuation", "refline_search_u", "refline_search_u_fraction", "refline_search_init_u",
    "refline_search_init_u_fraction", "refline_search_far", "refline_search_close", "warn_msgs", "warn_curv_local",
    "warn_curv_global", "log_msgs", "log_eval", "log_evalf", "log_hist", "log_stat", "log_statf",
    "log_eval_freq", "log_stat_freq",
    "check_eps", "check_inc", "check_tol", "check_pro", "check_wgs",
})  # fmt: skip
MODIFIER_KEYS = frozenset({
    "scale_z_grid", "scale_slope", "scale_banking", "scale_length", "scale_width", "scale_curvature", "grid_nan_mode",
    "grid_nan_offset", "refline_offset_x", "refline_offset_y", "refline_offset_z", "refline_offset_phi", "refpoint_u",
    "refpoint_u_fraction", "refpoint_u_offset", "refpoint_v", "refpoint_v_fraction", "refpoint_v_offset", "refpoint_x",
    "refpoint_y", "refpoint_z", "refpoint_phi",
})  # fmt: skip
KEYED_SECTIONS = {"road_crg": ROAD_KEYS, "road_crg_opts": OPTION_KEYS, "road_crg_mods": MODIFIER_KEYS}
SECTIONS = (*KEYED_SECTIONS, "ct", "kd_definition", "road_crg_mpro", "road_crg_file")


class Channel(NamedTuple):
    """One channel definition: a column of the payload (`D:`) or the virtual channel (`U:`)."""

    name: str
    fields: tuple[str, ...]  # unit, and for the virtual channel start and increment
    line: int


class HeaderValue(NamedTuple):
    """One number of the header."""

    number: float
    line: int


class Header(NamedTuple):
    """What the text part says."""

    file: str
    road: dict[str, HeaderValue]
    options: dict[str, HeaderValue]
    modifiers: dict[str, HeaderValue]
    format: str  # LRFI, LDFI, KRBI or KDBI
    channels: tuple[Channel, ...]
    virtual: Channel | None
    payload_start: int  # [bytes] first byte after the `$$$$` line
    payload_line: int  # number of the first line of a text payload, from 1


def parse_header(data: bytes, file: str) -> Header:
    """Read the text part.

    Args:
        data: the whole file.
        file: its name for messages.

    Raises:
        ExcitationError: with file and line, for what is malformed, unknown, given twice or missing.
    """
    return _Parser(file).parse(data)


class _Parser:
    def __init__(self, file: str) -> None:
        self.file = file
        self.line = 0
        self.section: str | None = None
        self.seen: set[str] = set()
        self.values: dict[str, dict[str, HeaderValue]] = {name: {} for name in KEYED_SECTIONS}
        self.format: str | None = None
        self.channels: list[Channel] = []
        self.virtual: Channel | None = None

    def fail(self, sentence: str) -> ExcitationError:
        return ExcitationError(f"{self.file}, line {self.line}: {sentence}")

    def parse(self, data: bytes) -> Header:
        start = 0
        while True:
            end = data.find(b"\n", start, LONGEST_HEADER)
            self.line += 1
            if data.startswith(b"$$$$", start):
                if end < 0:
                    raise self.fail("the file ends with the line of $ that should be followed by the road data")
                break
            if end < 0:
                raise self.fail(
                    "the header has no end: a line that starts with $$$$ was expected; the file is cut or no OpenCRG "
                    "file"
                )
            self._read(data[start:end].rstrip(b"\r").decode("latin-1"))
            start = end + 1
        return self._finish(end + 1)

    def _read(self, text: str) -> None:
        if text.startswith("*"):
            return
        if text.startswith("$"):
            self._switch(text[1:].partition("!")[0].strip())
            return
        if self.section == "ct":
            return
        text = text.partition("!")[0].strip()
        # The map projection does not touch heights over (u, v)
        if not text or self.section == "road_crg_mpro":
            return
        if self.section == "kd_definition":
            self._define(text)
        elif self.section in KEYED_SECTIONS:
            self._assign(self.section, text)
        else:
            raise self.fail(f"'{text[:60]}' stands outside of every section")

    def _switch(self, keyword: str) -> None:
        name = keyword.split()[0].lower() if keyword else ""
        if name.strip("$*-=") == "":
            if self.section is None:
                raise self.fail("a section ends here that was never opened")
            self.section = None
            return
        if self.section is not None:
            raise self.fail(
                f"section ${name.upper()} opens inside section ${self.section.upper()}, which has no closing $ line"
            )
        if name == "road_crg_file":
            raise self.fail("the file refers to another file ($ROAD_CRG_FILE); give that file itself")
        if name not in SECTIONS:
            raise self.fail(f"section ${name.upper()} is unknown{_suggest(name, SECTIONS)}")
        if name in self.seen:
            raise self.fail(f"section ${name.upper()} is there a second time")
        self.seen.add(name)
        self.section = name

    def _assign(self, section: str, text: str) -> None:
        key, equals, number = (part.strip() for part in text.partition("="))
        key = key.lower()
        known, values = KEYED_SECTIONS[section], self.values[section]
        if not equals or key not in known:
            raise self.fail(f"'{key}' is no key of section ${section.upper()}{_suggest(key, known)}")
        if key in values:
            raise self.fail(f"{key} was already given in line {values[key].line}")
        if not NUMBER.fullmatch(number) or abs(float(number)) > 1e12:
            raise self.fail(f"{key} is '{number}'; a plain number was expected")
        values[key] = HeaderValue(float(number), self.line)

    def _define(self, text: str) -> None:
        kind, rest = text[:2], text[2:].strip()
        name, *fields = (part.strip() for part in rest.split(","))
        name = " ".join(name.lower().split())
        if kind == "#:" and self.format is None:
            if rest.upper() not in ("LRFI", "LDFI", "KRBI", "KDBI"):
                raise self.fail(f"data format '{rest}' is unknown; allowed: LRFI, LDFI, KRBI, KDBI")
            self.format = rest.upper()
        elif kind == "D:":
            self.channels.append(Channel(name, tuple(fields), self.line))
        elif kind == "U:" and self.virtual is None:
            self.virtual = Channel(name, tuple(fields), self.line)
        else:
            raise self.fail(
                f"'{text[:60]}' is no channel definition; D:name,unit was expected, and #: and U: at most once"
            )

    def _finish(self, payload_start: int) -> Header:
        if self.section is not None:
            raise self.fail(f"section ${self.section.upper()} is not closed before the road data")
        for name in ("road_crg", "kd_definition"):
            if name not in self.seen:
                raise self.fail(f"the header ends without a section ${name.upper()}")
        return Header(
            file=self.file,
            road=self.values["road_crg"],
            options=self.values["road_crg_opts"],
            modifiers=self.values["road_crg_mods"],
            format=self.format or "KRBI",
            channels=tuple(self.channels),
            virtual=self.virtual,
            payload_start=payload_start,
            payload_line=self.line + 1,
        )


def _suggest(name: str, known: "frozenset[str] | tuple[str, ...]") -> str:
    near = get_close_matches(name, sorted(known), 1)
    return f"; did you mean {near[0].upper()}?" if near else ""
