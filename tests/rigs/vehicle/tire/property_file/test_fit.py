"""The general fit of a tire: two sets of another size, by `bench tire`, over loads and inflations that it was fitted to and
others."""

import json
import math

import pytest
from click.testing import CliRunner
from tests.rigs.vehicle.tire.property_file.tir_file import write

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.cli.tire import command
from contact_sim_pkg.rigs.vehicle.machines.flat_track import flat_track
from contact_sim_pkg.rigs.vehicle.tire.property_file.fit import Lines, Target, fitted_slip, standing_on_belt
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation

HEADER = "inflation ({}),load (N),stiffness (kN/m),deflection (mm),length (mm),width (mm)\n"
# Load [N], stiffness [kN/m], deflection, length, width [mm] by inflation
SWIFT = {
    # 255/55 R20, kPa: MF-Swift coefficients of a whole set (Project Chrono, BSD-3), by the formulas of Besselink, Schmeitz and
    # Pacejka 2010
    200: ((3376, 239.1, 14.78, 109.7, 184.8), (6752, 258.6, 28.35, 168.1, 214.7), (10128, 276.7, 40.96, 218, 228.4)),
    230: ((3376, 267, 13.17, 102.1, 179.3), (6752, 286.8, 25.36, 155.8, 209.9), (10128, 305.2, 36.77, 201.6, 224.8)),
    260: ((3376, 295, 11.88, 95.8, 174.5), (6752, 314.9, 22.95, 145.8, 205.4), (10128, 333.7, 33.36, 188.2, 221.3)),
    290: ((3376, 322.9, 10.82, 90.5, 170.1), (6752, 343, 20.95, 137.3, 201.2), (10128, 362.1, 30.53, 176.9, 217.8)),
    320: ((3376, 350.8, 9.93, 85.9, 166.1), (6752, 371.1, 19.28, 130, 197.3), (10128, 390.3, 28.15, 167.3, 214.4)),
}  # fmt: skip
MEASURED = {
    # 255/40 R17, psi: parabolas through loading and unloading on a flat plate, hulls of ink prints (kktse.github.io, July and
    # October 2021)
    24: ((2224, 214.9, 10.96, 86.6, 177.3), (3559, 228.1, 16.98, 114.5, 200.9), (4448, 236.5, 20.81, 134.4, 214.3),
         (5338, 244.6, 24.51, 147.9, 222.9), (6228, 252.3, 28.05, 161.4, 229.8)),
    27: ((2224, 228.4, 10.43, 78, 172.4), (3559, 244.8, 16.07, 108.2, 193.6), (4448, 255.2, 19.63, 126.2, 209.9),
         (5338, 265.2, 23.05, 137.1, 217.2), (6228, 274.9, 26.35, 151.5, 224.9)),
    30: ((2224, 248.1, 9.32, 78.5, 171.6), (3559, 258.8, 14.59, 102.8, 190.3), (4448, 265.8, 17.98, 115.4, 201.7),
         (5338, 272.5, 21.29, 132.6, 214.7), (6228, 279.1, 24.51, 145.2, 220.9)),
    33: ((2224, 259.8, 9, 76.7, 170.3), (3559, 274, 14, 102.8, 189.9), (4448, 283.1, 17.19, 111.8, 197.2),
         (5338, 291.9, 20.29, 126.7, 211.5), (6228, 300.2, 23.23, 135.3, 216.8)),
    36: ((2224, 276.5, 8.33, 69.4, 162.2), (3559, 287.5, 13.07, 96, 181.3), (4448, 294.5, 16.12, 106.4, 193.1),
         (5338, 301.4, 19.11, 118.1, 205.8), (6228, 308, 21.96, 131.7, 213.1)),
}  # fmt: skip
ROWS = "stiffness", "deflection", "length", "width"


def table_of(file, unit, sets, inflations):
    rows = [",".join(f"{each:g}" for each in (pressure, *row)) for pressure in inflations for row in sets[pressure]]
    file.write_text(HEADER.format(unit) + "\n".join(rows) + "\n")
    return file


def fitted(*arguments):
    shown = CliRunner().invoke(command, [*map(str, arguments), "--json"], catch_exceptions=False)
    assert shown.exit_code == 0
    return json.loads(shown.stdout)


def misses(keys, sets, unit, inflations):
    """Largest relative miss of stiffness, deflection, length and width."""
    worst = dict.fromkeys(ROWS, 0.0)
    for pressure in inflations:
        for load, stiffness, *lengths in sets[pressure]:
            found = standing_on_belt(Inflation(**{**keys, "pressure": unit * pressure}), load)
            published = (1e3 * stiffness, *(1e-3 * each for each in lengths))
            for name, value in zip(ROWS, published, strict=True):
                worst[name] = max(worst[name], abs(getattr(found, name) / value - 1.0))
    return worst


def test_a_larger_tire_is_met_over_loads_and_inflations(tmp_path):
    """Fitted at 200, 260 and 320 kPa, the two between left out of the fit."""
    found = fitted(table_of(tmp_path / "suv.csv", "kPa", SWIFT, SWIFT), "--size", "255/55 R20")
    worst = misses(found["effects"]["tire"]["inflation"], SWIFT, 1e3, SWIFT)
    for name, most in zip(ROWS, (0.06, 0.06, 0.06, 0.14), strict=True):
        assert worst[name] < most
    rows = {row["quantity"]: row for row in found["fit"]}
    assert rows["stiffness, 3376 N, 230 kPa"]["file"] == 267e3
    assert any("compared with all" in note for note in found["notes"])


def test_a_measured_tire_is_predicted_at_inflations_between(tmp_path):
    """Fitted at 24 and 36 psi, blind at 27, 30 and 33."""
    found = fitted(table_of(tmp_path / "car.csv", "psi", MEASURED, (24, 36)), "--size", "255/40 R17")
    worst = misses(found["effects"]["tire"]["inflation"], MEASURED, 6894.757, (27, 30, 33))
    for name, most in zip(ROWS, (0.05, 0.06, 0.08, 0.10), strict=True):
        assert worst[name] < most


def test_how_it_rolls_is_found_again_in_closed_form():
    """Bristles, yaw, bending and extension from stiffnesses and trail on contacts of one width, by hand."""
    bristles, yaw, bending, extension, width = 8e7, 8e3, 9e-5, 4e-5, 0.14
    lines, targets = [], []
    for half in (0.04, 0.065, 0.085):
        own, moment = 2.0 * bristles * width * half**2, 2.0 / 3.0 * bristles * width * half**3
        lines.append(Lines(2.0 * width * half**2, 2.0 / 3.0 * width * half**3, 2.0 * width * half))
        targets.append(Target(
            220e3, 1.0, braking=own / (1.0 + extension * moment),
            cornering=own / (1.0 + bending * moment) / (1.0 + moment / yaw), trail=half / 3.0 * (1.0 + bending * moment),
        ))  # fmt: skip
    usual = {"stiffness": 9.6e7, "yaw": 5e3, "bending": 1.3e-4, "extension": 6e-5}
    found = fitted_slip(lines, targets, usual)
    assert found["stiffness"] == pytest.approx(bristles, rel=0.02)
    assert found["yaw"] == pytest.approx(yaw, rel=0.05)
    assert found["bending"] == pytest.approx(bending, rel=0.05)
    assert found["extension"] == pytest.approx(extension, rel=0.1)


PUBLISHED = {
    "UNLOADED_RADIUS": 0.3135, "ASPECT_RATIO": 0.6, "RIM_RADIUS": 0.1905, "VERTICAL_STIFFNESS": 209.7e3, "Q_FZ2": 15.42,
    "PFZ1": 0.71, "Q_RA1": 0.671, "Q_RA2": 0.733, "Q_RB1": 1.059, "Q_RB2": -1.1878, "BELT_MASS": None, "PKX1": 21.7,
    "PKY1": -15.6, "PKY2": 1.5, "PDX1": 1.04, "PDX2": -0.1, "PDY1": 0.88, "PDY2": -0.13,
}  # fmt: skip
"""Of a 205/60 R15; its cornering and the fall of its friction are made up."""


def test_a_file_is_met_at_three_loads_and_inflations_and_as_it_rolls(tmp_path):
    found = fitted(write(tmp_path, **PUBLISHED))
    rows = {row["quantity"]: row["difference"] for row in found["fit"]}
    of_all = [name for name in rows if name.startswith(("stiffness", "deflection", "length"))]
    assert len(of_all) == 27
    assert max(abs(rows[name]) for name in of_all) < 0.06
    assert max(abs(rows[name]) for name in rows if name.startswith("width")) < 0.14
    brush = found["effects"]["tire"]["brush"]
    assert brush["load_exponent"] == pytest.approx(0.1 / 1.04, rel=1e-4)
    assert brush["load_exponent_across"] == pytest.approx(0.13 / 0.88, rel=1e-4)
    values = [
        f"effects.tire.{effect}={{{', '.join(f'{key}: {value!r}' for key, value in keys.items())}}}"
        for effect, keys in found["effects"]["tire"].items()
    ]
    across = flat_track(4000.0, 16.7, 0.5, *values, "slip={angle: 0.002}").force[-100:].mean(axis=0)
    cornering = 15.6 * 4000.0 * math.sin(2.0 * math.atan(1.0 / 1.5))
    assert -across[1] / 0.002 == pytest.approx(cornering, rel=0.08)
    swept = flat_track(4000.0, 16.7, 1.5, *values, "slip={points: [[0, 0, 0], [1.5, -0.3, 0]]}").force[:, 0]
    assert abs(swept).max() / 4000.0 == pytest.approx(1.04, rel=0.03)


@pytest.mark.fault("A15")
@pytest.mark.parametrize(
    ("text", "size", "sentence"),
    [
        ("load (N),deflection (mm)\n1,2\n2,3\n", "255/40 R17", "columns inflation, load and deflection or stiffness"),
        ("inflation (kPa),load (N),deflection (N)\n200,1000,2\n200,2000,3\n", "255/40 R17", "column deflection is in N; one of m"),
        ("inflation (kPa),load,deflection (mm)\n200,1000,2\n200,2000,3\n", "255/40 R17", "column load has no unit"),
        ("inflation (kPa),load (N),deflection (mm)\n200,1000,2\n200,2000,-3\n", "255/40 R17", "line 3: deflection is -0.003"),
        ("inflation (bar),load (N),deflection (mm)\n8,1000,2\n8,2000,3\n", "255/40 R17", "an inflation of 800000 Pa"),
        ("inflation (bar),load (N),deflection (mm)\n2,1000,2\n2,2000,3\n", "255/40", "size '255/40'"),
        ("inflation (bar),load (N),deflection (mm)\n2,1000,2\n2,2e5,3\n", "255/40 R17", "carries its loads"),
    ],
)  # fmt: skip
def test_a_bad_table_is_one_sentence(tmp_path, capsys, text, size, sentence):
    file = tmp_path / "own.csv"
    file.write_text(text)
    assert main(["tire", str(file), "--size", size]) == 2
    said = capsys.readouterr().err
    assert sentence in said.splitlines()[-1]
