"""Words in tables of others: units behind names and in rows of their own, times as texts, numbers with commas."""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone

__all__ = [
    "STANDARD_GRAVITY",
    "UNITS",
    "bare_name",
    "factor_of",
    "is_number",
    "number",
    "seconds_of_text",
    "split_unit",
]

STANDARD_GRAVITY = 9.80665
"""[m/s^2] exact by definition"""
_GROUPS: dict[str, dict[str, float]] = {
    "m/s^2": {
        "m/s^2": 1.0, "mm/s^2": 1e-3, "cm/s^2": 1e-2, "ft/s^2": 0.3048, "in/s^2": 0.0254, "g": STANDARD_GRAVITY,
        "mg": 1e-3 * STANDARD_GRAVITY, "gal": 1e-2,
    },
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0},
    "m": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254, "km": 1e3},
    "N": {"n": 1.0, "kn": 1e3, "lbf": 4.4482216152605},
    "Pa": {
        "pa": 1.0, "kpa": 1e3, "mpa": 1e6, "bar": 1e5, "psi": 6894.757293168, "mmhg": 133.322387415, "n/cm^2": 1e4,
        "n/mm^2": 1e6, "n/m^2": 1.0, "kg/cm^2": 98066.5, "g/cm^2": 98.0665,
    },
    "N/m": {"n/m": 1.0, "kn/m": 1e3, "n/mm": 1e3}, "N/rad": {"n/rad": 1.0, "n/deg": 57.29577951308232},
    "m/s": {"m/s": 1.0, "km/h": 1.0 / 3.6, "mm/s": 1e-3},
    "rad": {"rad": 1.0, "deg": 0.017453292519943295},
    "rad/s": {"rad/s": 1.0, "deg/s": 0.017453292519943295},
    "K": {"k": 1.0},
    "Hz": {"hz": 1.0},
    "1": {"": 1.0, "-": 1.0, "1": 1.0, "%": 0.01},
}  # fmt: skip
UNITS = {unit: factor for group in _GROUPS.values() for unit, factor in group.items()}
"""Unit, its spelling made one -> factor to SI."""
_SPELLINGS = {
    "sec": "s", "secs": "s", "second": "s", "seconds": "s", "sek": "s", "msec": "ms", "millisecond": "ms",
    "milliseconds": "ms", "usec": "us", "microseconds": "us", "nsec": "ns", "nanoseconds": "ns", "minutes": "min",
    "gn": "g", "g_n": "g", "g0": "g", "gs": "g", "milli-g": "mg", "m/s/s": "m/s^2", "mps2": "m/s^2", "meter": "m", "meters": "m",
    "metre": "m", "metres": "m", "millimeter": "mm", "millimeters": "mm", "millimetre": "mm", "millimetres": "mm",
    "centimeter": "cm", "centimeters": "cm", "centimetre": "cm", "inch": "in", "inches": "in", "foot": "ft", "feet": "ft",
    "kilometer": "km", "kilometre": "km", "newton": "n", "°/s": "deg/s", "dps": "deg/s", "lb": "lbf", "n/cm2": "n/cm^2",
    "n/mm2": "n/mm^2", "n/m2": "n/m^2", "kg/cm2": "kg/cm^2", "kgf/cm^2": "kg/cm^2", "kgf/cm2": "kg/cm^2", "g/cm2": "g/cm^2",
    "lb/in^2": "psi", "lb/in2": "psi", "°": "deg", "degree": "deg", "degrees": "deg", "kmh": "km/h", "kph": "km/h",
}  # fmt: skip
_UNIT = re.compile(r'"?\s*(.*?)\s*(?:\[([^\]]*)\]|\(([^)]*)\))\s*"?')
_SUFFIX = re.compile(r"(.+)_(s|ms|us|ns)")
_DAY = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})( \d{2}:\d{2}.*)?")
_CLOCK = re.compile(r"(\d{1,2}):(\d{2}):(\d{2}(?:[.,]\d+)?)")


def factor_of(unit: str) -> float | None:
    """Factor of a unit to SI; None for one that is not known. Spellings such as m/s/s, ms-2, m·s⁻², m/s² are one."""
    return UNITS.get(_one_spelling(unit))


def si_unit(unit: str) -> str:
    """The SI unit of what has a unit that is known."""
    spelling = _one_spelling(unit)
    return next(name for name, group in _GROUPS.items() if spelling in group)


def _one_spelling(unit: str) -> str:
    text = unit.strip().lower().replace("µ", "u").replace("μ", "u").replace("²", "^2").replace("⁻", "-")
    text = text.replace("**", "^").replace("·", " ").replace("*", " ").replace("−", "-")
    # m s^-2, ms-2, m s-2 -> m/s^2
    text = re.sub(r"^(m|mm|cm|ft|in)\s*s\^?-\^?2$", r"\1/s^2", text)
    text = re.sub(
        r"^(m|mm|cm|ft|in)/s(?:ec)?\^?2$|^(m|mm|cm|ft|in)/s(?:ec)?/s(?:ec)?$", lambda m: f"{m[1] or m[2]}/s^2", text
    )
    text = " ".join(text.split())
    return _SPELLINGS.get(text, text)


def split_unit(field: str) -> tuple[str, str | None]:
    """Name of a column and the unit behind it: in brackets, behind the name of a time (`time_ms`), or an acceleration's
    behind any name (`az_ft/s2`); None without one.
    """
    match = _UNIT.fullmatch(field.strip())
    if match and match.group(1):
        return match.group(1), next(each for each in match.groups()[1:] if each is not None)
    name = field.strip().strip('"').strip()
    suffix = _SUFFIX.fullmatch(name.lower())
    if suffix and suffix.group(1) in ("time", "t", "timestamp", "stamp", "elapsed"):
        return name, suffix.group(2)
    first, _, last = name.rpartition("_")
    if first and _one_spelling(last) in _GROUPS["m/s^2"]:
        return first, last
    return name, None


def bare_name(name: str) -> str:
    """A name as columns are looked for: without unit, quotes and capitals."""
    return split_unit(name)[0].lower()


def number(text: str) -> float:
    """A number with decimal point, or comma where there is no point; ValueError for what is none."""
    text = text.strip()
    if "_" in text or ("," in text and "." in text):
        raise ValueError(text)  # Python reads 9_8 as 98, and 1.234,5 may be meant in two ways
    return float(text.replace(",", "."))


def is_number(text: str) -> bool:
    """Whether `number` reads a text."""
    try:
        number(text)
    except ValueError:
        return False
    return True


def seconds_of_text(text: str) -> float:
    """A date and time of ISO 8601 as [s] since 1970 (UTC where it names no zone), or a time of day as [s].

    Raises ValueError for any other text.
    """
    text = text.strip()
    if day := _DAY.fullmatch(text):  # 1.3.2026, alone or before a time of day
        text = f"{day[3]}-{int(day[2]):02}-{int(day[1]):02}{day[4] or ' 00:00'}"
    elif re.fullmatch(r"\d{4}-\d{2}-\d{2}", text):
        text += " 00:00"
    if clock := _CLOCK.fullmatch(text):
        return 3600.0 * int(clock[1]) + 60.0 * int(clock[2]) + float(clock[3].replace(",", "."))
    # Digits beyond microseconds, and of any number, which Python before 3.11 does not read
    match = re.fullmatch(r"(\S+?[T ]\d{2}:\d{2}(?::\d{2})?)(?:[.,](\d+))?\s*(Z|[+-]\d{2}:?\d{2})?", text)
    if match is None:
        raise ValueError(text)
    moment = datetime.fromisoformat(match[1])
    zone = match[3]
    if zone and zone != "Z":
        hours, minutes = int(zone[1:3]), int(zone[-2:])
        moment -= timedelta(hours=hours, minutes=minutes) * (1 if zone[0] == "+" else -1)
    fraction = float(f"0.{match[2]}") if match[2] else 0.0
    return moment.replace(tzinfo=timezone.utc).timestamp() + fraction
