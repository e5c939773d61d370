"""Tables of the roller's page: stability under each reported load, dangerous volumes of each
component and of their union.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from contact_sim_pkg.records.messages import RollerStability, RollerVolumes
from contact_sim_pkg.report.tables import Table
from contact_sim_pkg.rigs.roller.forecast import ANY_LOAD

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz", "any")
MOST_ROWS = 40
"""Of a table."""


def stability_table(stability: list[RollerStability], block_length: float) -> Table | None:
    """One row for each reported load; None where there is none. block_length: [s]."""
    if not stability:
        return None
    header = ("from, s", "load, N", "growth rate, 1/s", "frequency, Hz", "static tilt, mrad", "static yaw, mrad",
              "critical load, N", "critical damping, N m s")  # fmt: skip
    rows = [
        (
            f"{each.block * block_length:.5g}", f"{each.load:.5g}", f"{each.growth_rate:+.4g}", f"{each.frequency:.5g}",
            f"{each.tilt * 1e3:.4g}", f"{each.yaw * 1e3:.4g}", _critical_load(each), _or_none(each.critical_damping),
        )
        for each in stability[:MOST_ROWS]
    ]  # fmt: skip
    return Table(
        f"Tilt and yaw under each load of the run{_left_out(len(stability))}", header, rows, "stability under each load"
    )


def volume_tables(volumes: list[RollerVolumes]) -> list[Table]:
    """Volumes in mm³ and shares of V_k, of the contact alone and, where the shaft bends, with its
    bending.
    """
    if not volumes:
        return []
    bent = [each for each in volumes if len(each.with_bending)]
    found = _tables(volumes, "of contact and traction, without bending", lambda each: each.volume)
    return found + (_tables(bent, "with the bending of the shaft", lambda each: each.with_bending) if bent else [])


def _tables(volumes: list[RollerVolumes], what: str, of: Callable[[RollerVolumes], Any]) -> list[Table]:
    header = ("at, s", *COMPONENTS)
    left = _left_out(len(volumes))
    shown = volumes[:MOST_ROWS]
    sizes = [(f"{each.time:.5g}", *(f"{value * 1e9:.4g}" for value in of(each))) for each in shown]
    shares = [
        (f"{each.time:.5g}", *(f"{100.0 * value / each.working_volume:.4g}" for value in of(each))) for each in shown
    ]
    working = f"{volumes[0].working_volume * 1e9:.4g} mm³"
    return [
        Table(f"Dangerous volumes {what}, mm³{left}", header, sizes, f"dangerous volumes {what}"),
        Table(f"The same over the working volume of {working}, %{left}", header, shares, f"their shares, {what}"),
    ]


def _critical_load(each: RollerStability) -> str:
    return "any" if each.critical_load < ANY_LOAD * each.load else _or_none(each.critical_load)


def _or_none(value: float) -> str:
    return "none" if math.isnan(value) else f"{value:.5g}"


def _left_out(rows: int) -> str:
    return f" (the first {MOST_ROWS} of {rows})" if rows > MOST_ROWS else ""
