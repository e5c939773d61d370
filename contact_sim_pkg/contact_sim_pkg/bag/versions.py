"""Dependence of a bag's results beside its scene: the versions that recorded it, beside those
of another bag or of here.
"""

from collections.abc import Mapping, Sequence

from contact_sim_pkg.bag.errors import BagError
from contact_sim_pkg.bag.metadata import software_versions
from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.bag.topics import TOPICS
from contact_sim_pkg.bag.typestore import type_hash
from contact_sim_pkg.files import printable

__all__ = ["differences_from", "differences_of_bags", "installed_versions", "version_differences", "versions_of"]

HARMLESS = ("numpy", "numba", "python")  # named; results are compared all the same


def versions_of(bag: Bag) -> dict[str, str]:
    """Versions of software, and hashes of our message definitions by type, that a bag was recorded
    with, where it says so.
    """
    known = {topic.type for topic in TOPICS.values()}
    ours = {row.type: bag.hash_of(name) for name, row in bag.topics.items() if row.type in known}
    return {key: bag.metadata[key] for key in software_versions("") if key in bag.metadata} | ours


def installed_versions(kernel_fingerprint: str) -> dict[str, str]:
    """The same of this installation."""
    types = dict.fromkeys(topic.type for topic in TOPICS.values())
    return software_versions(kernel_fingerprint) | {name: type_hash(name) for name in types}


def version_differences(first: Mapping[str, str], second: Mapping[str, str]) -> dict[str, str]:
    """By what differs, of all that both name: the two versions, as in `0.1.0 and 0.2.0`."""
    return {
        key: f"{printable(first[key], 80)} and {printable(second[key], 80)}"
        for key in first
        if key in second and first[key] != second[key]
    }


def differences_from(bag: Bag, installed: Mapping[str, str]) -> str:
    """One line on what differs between a bag and this installation; empty where nothing does."""
    found = version_differences(versions_of(bag), installed)
    return f"{bag.path} was recorded by other versions than those here: {_listed(found)}" if found else ""


def differences_of_bags(bags: Sequence[Bag], *, across: bool = False) -> list[str]:
    """A line for each bag whose results are compared with those of the first and whose versions
    differ from its own.

    Raises:
        BagError: package, kernels or message definitions differ, and it is not requested that bags
            are compared `across` them.
    """
    lines = []
    for bag in bags[1:]:
        found = version_differences(versions_of(bags[0]), versions_of(bag))
        sentence = f"{bags[0].path} and {bag.path} were recorded by different versions: {_listed(found)}"
        if set(found) - set(HARMLESS) and not across:
            raise BagError(f"{sentence}; give --across-versions to compare their results all the same")
        lines += [sentence] if found else []
    return lines


def _listed(found: Mapping[str, str]) -> str:
    return ", ".join(f"{key} ({versions})" for key, versions in found.items())
