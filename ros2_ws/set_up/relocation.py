"""Makes the ROS 2 wheels name this environment instead of the machine that they were built on.

The wheels hold CMake exports and shell files with absolute paths of their build: the Python headers, numpy's
headers, and the folder that everything was installed to. CMake refuses a target whose include folder does not exist.
"""

import json
import os
import re
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_PYTHON = r"/opt/python/cp\d+-cp\d+t?"
_SUFFIXES = {".bash", ".cmake", ".dsv", ".sh", ".zsh"}
_PROBE = """
import json, sysconfig, numpy
print(json.dumps([sysconfig.get_path("include"), numpy.get_include()]))
"""


class Target(NamedTuple):
    """What the build machine's paths are replaced by."""

    prefix: Path
    python_headers: str
    numpy_headers: str


def relocate(prefix: Path, python: Path, environ: dict[str, str]) -> int:
    """Rewrite every file of the environment that names the build machine; returns how many."""
    probe = subprocess.run(
        [str(python), "-c", _PROBE], env=environ, cwd="/", check=True, capture_output=True, text=True
    )
    python_headers, numpy_headers = json.loads(probe.stdout)
    target = Target(prefix, python_headers, numpy_headers)
    changed = 0
    for path in _files_with_paths(prefix / "share"):
        text = path.read_text(encoding="utf-8")
        moved = relocated(text, target)
        if moved != text:
            _replace(path, moved)
            changed += 1
    return changed


def relocated(text: str, target: Target) -> str:
    """The text with the build machine's paths replaced; the last pattern is the start of the first two."""
    for pattern, replacement in (
        (_PYTHON + r"/lib/python3\.\d+t?/site-packages/numpy/_?core/include", target.numpy_headers),
        (_PYTHON + r"/include/python3\.\d+t?", target.python_headers),
        (r"/project/build/temp\.[^/\"']+/install", str(target.prefix)),
        (_PYTHON + r"(?![\w/-])", str(target.prefix)),
    ):
        text = re.sub(pattern, lambda _, new=replacement: new, text)  # type: ignore[misc]
    return text


def _files_with_paths(share: Path) -> Iterator[Path]:
    for folder, _, names in os.walk(share):
        in_index = folder.endswith("resource_index/parent_prefix_path")
        yield from (Path(folder, name) for name in names if in_index or Path(name).suffix in _SUFFIXES)


def _replace(path: Path, text: str) -> None:
    """Write a new file in the old one's place: an installer may have linked the old one from its cache."""
    handle, name = tempfile.mkstemp(dir=path.parent)
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        file.write(text)
    new = Path(name)
    new.chmod(path.stat().st_mode)
    new.replace(path)
