"""Tells whether what was made still fits what it was made from, by a hash kept beside it."""

import hashlib
from collections.abc import Iterable
from pathlib import Path

from .layout import (
    ABSENT,
    BUILD_TOOLS_LOCK,
    COLCON_DEFAULTS,
    ENVIRONMENT,
    LOCK,
    ON_USE,
    ON_USE_FOLDER,
    PACKAGES,
    PROJECT,
    WORKSPACE,
)
from .underlay import Underlay

ENVIRONMENT_STAMP = ENVIRONMENT / "environment.stamp"
WORKSPACE_STAMP = ENVIRONMENT / "workspace.stamp"

_RECIPE = ("environment.py", "relocation.py", "shell_files.py", "underlay.py")
_PACKAGING = ("CMakeLists.txt", "package.xml", "setup.cfg", "setup.py")
_INSTALLED_BY_NAME = ("launch/*", "config/*", "resource/*")


def environment_key(underlay: Underlay) -> str:
    """Hash of all that the environment is made from: lock, recipe, interpreter, ROS 2, project folder."""
    recipe = [WORKSPACE / "set_up" / name for name in _RECIPE]
    facts = (PROJECT, underlay.kind, underlay.prefix, underlay.python, underlay.python.resolve())
    return _hash(map(str, facts), [LOCK, BUILD_TOOLS_LOCK, *recipe])


def workspace_key(environment: str) -> str:
    """Hash of all that the build depends on. Python sources are linked, not copied: they are not in it."""
    absent = [package for package in sorted(ABSENT.glob("*")) if package.name not in ON_USE]
    roots = [*(PROJECT / package for package in PACKAGES), *absent]
    files = [root / name for root in roots for name in _PACKAGING if (root / name).exists()]
    files += [path for root in roots for path in sorted(root.glob("msg/*.msg"))]
    # Of what is linked one by one, the names matter and not the content.
    names = [str(path) for root in roots for glob in _INSTALLED_BY_NAME for path in sorted(root.glob(glob))]
    return _hash([environment, *names], [COLCON_DEFAULTS, WORKSPACE / "set_up" / "workspace.py", *files])


def on_use_key(name: str, environment: str) -> str:
    """Hash of all that the build of a package of `ON_USE` depends on."""
    files = sorted(path for path in (ABSENT / name).rglob("*") if path.is_file())
    return _hash([environment], [COLCON_DEFAULTS, *files])


def on_use_stamp(name: str) -> Path:
    """Where the stamp of a package of `ON_USE` lies."""
    return ON_USE_FOLDER / name / "build.stamp"


def holds(stamp: Path, key: str) -> bool:
    """Whether the stamp was written for this key."""
    return stamp.is_file() and stamp.read_text(encoding="ascii").strip() == key


def write(stamp: Path, key: str) -> None:
    """Write the stamp in one step, so that a kill leaves either none or a whole one."""
    new = stamp.with_suffix(".new")
    new.write_text(key + "\n", encoding="ascii")
    new.replace(stamp)


def _hash(texts: Iterable[str], files: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for text in texts:
        digest.update(text.encode() + b"\0")
    for path in files:
        digest.update(str(path).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()
