"""The packages that the bench needs: one sentence, with the cure, where one is missing or of another version."""

from __future__ import annotations

import re
from importlib.metadata import PackageNotFoundError, requires, version
from itertools import zip_longest

__all__ = ["package_sentence"]

ROS = (
    "rclpy",
    "_rclpy_pybind11",
    "contact_msgs_defs",
    "rcl_interfaces",
    "std_msgs",
    "std_srvs",
    "diagnostic_msgs",
    "rosgraph_msgs",
)
OF_ANOTHER_VERSION = (AttributeError, TypeError, NameError, RuntimeError)  # what its use may end in
_REQUIREMENT = re.compile(r"(?P<name>[\w.-]+)(?P<bounds>[^;]*)(?P<marker>;.*)?")


def package_sentence(error: BaseException) -> str:
    """What is missing and the cure, where an error comes from a package that is not there or not of
    a version that the bench needs; empty for any other error.
    """
    if isinstance(error, ImportError) and (error.name or "").partition(".")[0] in ROS:
        return f"{error.name} cannot be imported; source ros2_ws/setup.bash (`bench run --offline` needs no ROS)"
    foreign = not type(error).__module__.startswith("contact_sim_pkg")
    if unmet := _unmet() if isinstance(error, (ImportError, *OF_ANOTHER_VERSION)) and foreign else []:
        found = ", ".join(f"{name} is {here or 'missing'}, {bounds} is needed" for name, here, bounds in unmet)
        return f"{found}; pip install {' '.join(repr(name + bounds) for name, _, bounds in unmet)}"
    if isinstance(error, ImportError) and error.name and not error.name.startswith("contact_sim_pkg"):
        return f"{error.name} cannot be imported ({error}); pip install ./contact_sim_pkg installs what the bench needs"
    return ""


def _unmet() -> list[tuple[str, str, str]]:
    """Name, version installed (empty: none) and versions needed of each package that is not as it
    is needed; none where the bench itself is not installed.
    """
    try:
        needed = [match for text in requires("contact_sim_pkg") or [] if (match := _REQUIREMENT.fullmatch(text))]
    except PackageNotFoundError:
        return []
    rows = [(each["name"], _version(each["name"]), each["bounds"].strip()) for each in needed if not each["marker"]]
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


def _numbers(text: str) -> list[int]:
    release = re.match(r"\d+(\.\d+)*", text)
    return [int(part) for part in release.group().split(".")] if release else []
