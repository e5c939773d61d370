"""The key numbers of a run, as short texts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from contact_sim_pkg.report.energy import AT_REST

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Tile(NamedTuple):
    """One key number."""

    label: str
    value: str
    unit: str
    detail: str


def tiles(summary: dict[str, Any], of_rigs: Sequence[Tile] = ()) -> list[Tile]:
    """Key numbers of a summary from `summarise`, and those of the rigs; numbers that are not
    defined have no tile.
    """
    found: list[Tile] = []
    for name, contact in summary["contacts"].items():
        found += _contact_tiles(name, contact)
    found += _slap_tiles(summary.get("slaps", {}))
    found += of_rigs
    energy = summary.get("energy", {})
    if energy.get("residual_relative") is not None:
        scale = max(energy["throughput_J"], AT_REST)
        detail = f"{number(energy['residual_max_J'])} J of {number(scale)} J"
        label = "energy balance residual"
        if "of" in energy:
            label = f"{label}, {energy['of']}"
            detail = "; outside: ".join([detail, *filter(None, [", ".join(energy["outside"])])])
        found.append(Tile(label, number(energy["residual_relative"]), "", detail))
    solver = summary.get("solver", {})
    if solver.get("physics_real_time_factor") is not None:
        detail = f"without recording and messages; {solver['steps']} steps, {solver['events']} events"
        found.append(Tile("real-time factor of the physics", number(solver["physics_real_time_factor"]), "×", detail))
    return found


def number(value: float) -> str:
    """Text of a value (any unit, dimensionless too) in three digits; very small and large ones as
    1.2·10⁻⁸."""
    if value != 0.0 and not 1e-3 <= abs(value) < 1e6:
        mantissa, exponent = f"{value:.1e}".split("e")
        return f"{mantissa}·10{str(int(exponent)).translate(SUPERSCRIPT)}"
    digits = f"{value:.3g}"
    return f"{value:.0f}" if "e" in digits else digits


def _contact_tiles(name: str, contact: dict[str, Any]) -> list[Tile]:
    span = f"{number(contact['load_min_N'])} to {number(contact['load_max_N'])} N"
    found = [Tile(f"{name} load, mean", number(contact["load_mean_N"]), "N", span)]
    if "peak_pressure_Pa" in contact:
        detail = f"at {contact['peak_pressure_time_s']:.3f} s"
        found.append(Tile(f"{name} peak pressure", number(contact["peak_pressure_Pa"] * 1e-3), "kPa", detail))
        area = number(contact["contact_area_mean_m2"] * 1e4)
        found.append(Tile(f"{name} contact area, mean", area, "cm²", "all cells under pressure"))
    if contact["lift_offs"] or contact["lifted_share"]:
        detail = f"lifted off {contact['lift_offs']} times"
        found.append(Tile(f"{name} without load", number(100.0 * contact["lifted_share"]), "%", detail))
    return found


def _slap_tiles(slaps: dict[str, Any]) -> list[Tile]:
    if not slaps:
        return []
    if not slaps["count"]:
        return [Tile("slaps", "0", "", "no slap ended within the run")]
    span = f"restitution {number(slaps['restitution_min'])} to {number(slaps['restitution_max'])}"
    return [Tile("slaps", str(slaps["count"]), "", span)]
