"""The packages that the bench needs: one sentence, with the cure, where one is missing or of another version."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, requires, version
from itertools import zip_longest
from pathlib import Path
from types import TracebackType

__all__ = [
    "PackageError",
    "canonical",
    "end_with_sentence",
    "is_met",
    "is_of_ros",
    "package_sentence",
    "packages_named",
]

ROS = (
    "rclpy",
    "_rclpy_pybind11",
    "contact_msgs_defs",
    "lifecycle_msgs",
    "rcl_interfaces",
    "std_msgs",
    "std_srvs",
    "diagnostic_msgs",
    "rosgraph_msgs",
)
OF_ANOTHER_VERSION = (AttributeError, TypeError, NameError, RuntimeError)  # what its use may end in
ENVIRONMENT = "python3 -m venv --system-site-packages ~/contact_bench_env && . ~/contact_bench_env/bin/activate"
_REQUIREMENT = re.compile(r"(?P<name>[\w.-]+)(?P<bounds>[^;]*)(?P<marker>;.*)?")


class PackageError(ImportError):
    """A package is missing or of another version than needed; the sentence holds the cure."""


@contextmanager
def packages_named() -> Iterator[None]:
    """Raise PackageError in the place of what the use of a package ends in that is missing or of another version."""
    try:
        yield
    except Exception as error:
        if sentence := package_sentence(error):
            raise PackageError(sentence) from error
        raise


def end_with_sentence(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """The `sys.excepthook` of a program that is started as a module: exit status 2 and the sentence where a package is
    missing, any other error as usual.
    """
    if sentence := package_sentence(error):
        sys.stderr.write(f"bench: {sentence}\n")
        raise SystemExit(2)
    sys.__excepthook__(kind, error, trace)


def package_sentence(error: BaseException) -> str:
    """What is missing and the cure, where an error comes from a package that is not there or not of
    a version that the bench needs; empty for any other error. The cure stands in two lines below.
    """
    if isinstance(error, PackageError):
        return str(error)
    if isinstance(error, ImportError) and is_of_ros(error):
        return f"{error.name} cannot be imported; source ros2_ws/setup.bash"
    foreign = not type(error).__module__.startswith("contact_sim_pkg")
    if unmet := _unmet() if isinstance(error, (ImportError, *OF_ANOTHER_VERSION)) and foreign else []:
        found = ", ".join(
            f"{name} is {here or 'missing'}, {_in_words(bounds)} is needed" for name, here, bounds in unmet
        )
        return _with_cure(found, [name + bounds for name, _, bounds in unmet])
    if isinstance(error, ImportError) and error.name and not error.name.startswith("contact_sim_pkg"):
        wanted = [name + bounds for name, bounds in _needed() if _is_package_of(name, error.name)]
        return _with_cure(f"{error.name} cannot be imported ({error})", wanted or ["./contact_sim_pkg"])
    return ""


def is_of_ros(error: ImportError) -> bool:
    """Whether what cannot be imported comes with ROS 2 or the workspace."""
    return (error.name or "").partition(".")[0] in ROS


def canonical(package: str) -> str:
    """The name of a package as pip compares it: press_kit and Press.Kit are press-kit."""
    return re.sub(r"[-_.]+", "-", package).lower()


def is_met(package: str) -> bool:
    """Whether a package is installed in a version that the bench needs."""
    return all(name != package for name, _, _ in _unmet())


def _with_cure(fault: str, wanted: list[str]) -> str:
    """The sentence, and below it the two lines that install what is wanted beside the packages of
    the system, which the system's own pip refuses to touch.
    """
    installed = " ".join(each if each.startswith("./") else repr(each) for each in wanted)
    return f"{fault}; install it in an environment of your own:\n  {ENVIRONMENT}\n  pip install {installed}"


def _is_package_of(name: str, module: str) -> bool:
    """Whether a package, such as `ruamel.yaml`, is the one that a module, such as `ruamel`, belongs
    to.
    """
    package, wanted = canonical(name), canonical(module)
    return f"{package}-".startswith(f"{wanted.partition('-')[0]}-") or package == wanted


def _needed() -> list[tuple[str, str]]:
    """Name and bounds of every package that the bench needs: from what is installed, or from
    `setup.py` in a checkout on the search path; none where there is neither.
    """
    try:
        stated = requires("contact_sim_pkg") or []
    except PackageNotFoundError:
        stated = _in_setup(Path(__file__).parents[1] / "setup.py")
    matches = [match for text in stated if (match := _REQUIREMENT.fullmatch(text))]
    return [(each["name"], each["bounds"].strip()) for each in matches if not each["marker"]]


def _in_setup(path: Path) -> list[str]:
    """The list `install_requires` of a setup.py, empty where there is no such file."""
    try:
        listed = re.search(r"install_requires=\[(.*?)\]", path.read_text(encoding="utf-8"), re.DOTALL)
    except OSError:
        return []
    return re.findall(r'"(.+?)"', listed.group(1)) if listed else []


def _unmet() -> list[tuple[str, str, str]]:
    """Name, version installed (empty: none) and versions needed of each package that is not as it
    is needed.
    """
    rows = [(name, _version(name), bounds) for name, bounds in _needed()]
    return [row for row in rows if not row[1] or not _is_within(row[1], row[2])]


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _is_within(found: str, bounds: str) -> bool:
    """Whether a version keeps bounds such as `<3,>=2.6`."""
    for sign, bound in re.findall(r"(>=|<)\s*([\d.]+)", bounds):
        pairs = list(zip_longest(_numbers(found), _numbers(bound), fillvalue=0))
        below = [one for one, _ in pairs] < [other for _, other in pairs]
        if below == (sign == ">="):
            return False
    return True


def _in_words(bounds: str) -> str:
    """`<3,>=2.6` -> `2.6 to below 3`; bounds of another form stay as they are."""
    found = dict(re.findall(r"(>=|<)\s*([\d.]+)", bounds))
    return f"{found['>=']} to below {found['<']}" if len(found) == 2 else bounds


def _numbers(text: str) -> list[int]:
    release = re.match(r"\d+(\.\d+)*", text)
    return [int(part) for part in release.group().split(".")] if release else []
