"""Default directory of a bag, and names that cannot leave it."""

import re
import secrets
from datetime import datetime, timezone
from pathlib import Path

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.files import printable, wrong_name

LONGEST_NAME = 100  # characters of a bag's name
_LONGEST_SCENE = 70  # leaves room for the time and the random suffix


def safe_name(text: str, longest: int = LONGEST_NAME) -> str:
    """One path component of `[A-Za-z0-9._-]` made from any text: not hidden, not `.` or `..`, never
    empty.

    Every other character becomes `_`; leading dots and dashes go; what is longer than `longest` is
    cut.
    """
    name = re.sub(r"[^A-Za-z0-9._-]+", "_", text, flags=re.ASCII).lstrip(".-")[:longest]
    return name if name.strip("_") else "bag"


def new_directory(given: Path | None, scene_name: str) -> Path:
    """Directory of a recording: the one given, or the default one. Raises BagError where that
    exists already, or where it, or the file in it, cannot have its name.
    """
    directory = default_directory(scene_name) if given is None else given
    refuse_wrong_name(directory)
    if directory.exists() or directory.is_symlink():
        raise BagError(f"{directory} exists already; a bag is never overwritten, give another directory")
    return directory


def file_name(directory: Path) -> str:
    """Name of the file in the directory of a bag."""
    return f"{directory.name}_0.mcap"


def refuse_wrong_name(directory: Path) -> None:
    """Raise BagError where the directory of a bag, or the file in it, cannot have its name."""
    if reason := wrong_name(directory) or wrong_name(directory / file_name(directory)):
        raise BagError(f"the bag directory {printable(str(directory))} {reason}")


def default_directory(
    scene_name: str, root: Path = Path("bags"), now: datetime | None = None, token: str | None = None
) -> Path:
    """`root`/SCENE_UTCTIME_RANDOM: the scene's name made safe, time to the second, six random
    hexadecimal digits.
    """
    moment = (now or datetime.now(timezone.utc)).strftime("%Y%m%dT%H%M%SZ")
    return root / f"{safe_name(scene_name, _LONGEST_SCENE)}_{moment}_{token or secrets.token_hex(3)}"
