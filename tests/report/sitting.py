"""A pressure map under someone who sits, in closed form: on any cells, as the field of a run, as the file of a mat."""

import math

import numpy as np

from contact_sim_pkg.bag.messages import encode
from contact_sim_pkg.bag.metadata import recorded_topics
from contact_sim_pkg.bag.writer import BagWriter
from contact_sim_pkg.records.messages import ContactForce
from contact_sim_pkg.report.series import PressureMap
from contact_sim_pkg.run.contact_patch import contact_patch


def sitting(x, y):
    """Pressure [Pa] of two buttocks and two thighs, one side heavier."""
    hips = np.exp(-((x + 0.05) ** 2 + (y - 0.06) ** 2) / 0.0018) + np.exp(-((x + 0.05) ** 2 + (y + 0.06) ** 2) / 0.0018)
    thighs = np.exp(-((x - 0.1) ** 2 / 0.0072 + (np.abs(y) - 0.08) ** 2 / 0.0032))
    return 1e4 * (hips + 0.4 * thighs) * (1.0 + 0.5 * y)


def grid(cell, rows, cols, turn=0.0, shift=(0.0, 0.0)):
    """The pressure under cells whose map lies turned and shifted: cell q at R(turn) q + shift."""
    low_x, low_y = -(rows - 1) / 2 * cell, -(cols - 1) / 2 * cell
    x, y = np.meshgrid(low_x + cell * np.arange(rows), low_y + cell * np.arange(cols), indexing="ij")
    cos, sin = math.cos(turn), math.sin(turn)
    pressure = sitting(cos * x - sin * y + shift[0], sin * x + cos * y + shift[1])
    return PressureMap(np.where(pressure > 50.0, pressure, 0.0), cell, cell, low_x, low_y)


SEAT = grid(0.01, 48, 48)


def run_bag(folder, maps=SEAT, contact="seat"):
    """Ten blocks of a run with one steady field."""
    load = float(maps.pressure.sum()) * maps.cell_x * maps.cell_y
    cells = maps.cell_x, maps.cell_y, maps.origin_x, maps.origin_y
    topics = recorded_topics((f"{contact}/force", f"{contact}/patch"))
    steady, none = np.full(10, load), np.zeros(10)
    with BagWriter(folder, topics, {"scene": "name: steady\nrig: seat\n"}, reserve_bytes=0) as writer:
        for block in range(10):
            stamp = block * 10_000_000
            force = ContactForce(
                block=block, sample_period=1e-3, normal=steady, tangential=none, approach=none, effective_height=none
            )
            writer.write(f"{contact}/force", stamp, encode(force, stamp))
            writer.write(f"{contact}/patch", stamp, encode(contact_patch(block, cells, 0.01, maps.pressure), stamp))
    return folder


def mat_file(path, maps):
    rows, cols = maps.pressure.shape
    pitch = f"ROW_SPACING {1e3 * maps.cell_x} mm\nCOL_SPACING {1e3 * maps.cell_y} mm"
    head = f"ROWS {rows}\nCOLS {cols}\n{pitch}\nUNITS Pa\nASCII_DATA @@\n"
    path.write_text(head + "Frame 1\n" + "\n".join(",".join(f"{v:.3f}" for v in row) for row in maps.pressure))
    return path
