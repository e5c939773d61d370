"""The Magic Formula in the running rig: steady forces as of the book's equations, relaxation and works in closed form."""

import math

import mpmath
import numpy
import pytest
from scipy.integrate import quad, solve_ivp
from tests.rigs.vehicle.test_simulation import messages_of
from tests.rigs.vehicle.tire.magic_formula.test_formulas import Book
from tests.rigs.vehicle.tire.magic_formula.whole_set import SCALES, SET, tir_text

from contact_sim_pkg.bag.messages import decode
from contact_sim_pkg.records.messages import AxleForce, ContactForce, ContactShear, EnergyLedger, WrenchStamped
from contact_sim_pkg.rigs.vehicle.model import build
from contact_sim_pkg.rigs.vehicle.simulation import Simulation
from contact_sim_pkg.rigs.vehicle.tire.rolling_formula import relaxed
from contact_sim_pkg.scene.errors import SceneError
from contact_sim_pkg.scene.load import load_scene
from contact_sim_pkg.scene.overrides import set_value
from contact_sim_pkg.scene.resolve import read_resolved, resolve

SPEED, WEIGHT, PRESSURE = 15.0, 340.0 * 9.81, 2.1e5
SHIFTS = dict.fromkeys(
    ("PHX1", "PHX2", "PVX1", "PVX2", "PHY1", "PHY2", "PVY1", "PVY2", "RHX1", "RHY1", "RHY2", "RVY1", "RVY2"), 0.0
)
SCENE = """\
rig: tire
duration: 0.5
travel: {speed: 15}
road: {kind: flat}
effects:
  tire:
    inflation: {pressure: 210000}
    normal_dissipative: {}
    magic_formula: {file: tire.tir}
"""


def resolved(folder, *values, file=None, scene=SCENE):
    (folder / "tire.tir").write_text(tir_text() if file is None else file)
    (folder / "scene.yaml").write_text(scene)
    return resolve(load_scene(folder / "scene.yaml", [set_value(value) for value in values]))


def samples(found, topic, kind, name):
    return numpy.concatenate([getattr(decode(kind, data), name) for data in found[topic]])


def book_at(kappa, alpha, load, **changed):
    """F_x, F_y, M_x, M_y, M_z."""
    with mpmath.workdps(30):
        return Book({**SET, **changed}).forces(float(kappa), float(alpha), float(load), PRESSURE, SPEED)


FIELD = ("effects.tire.contact_field={}", "duration=0.2")


@pytest.mark.parametrize(
    ("kappa", "alpha", "field"),
    [(-0.03, 0.04, ()), (0.2, -0.1, ()), (-1.0, 0.02, ()), (0.0, 0.12, ()), (-0.03, 0.04, FIELD)],
)
def test_at_steady_slip_the_rig_has_the_forces_of_the_book_under_its_own_load(tmp_path, kappa, alpha, field):
    stiff = {"LONGITUDINAL_STIFFNESS": 1e7, "LATERAL_STIFFNESS": 1e7}
    found = messages_of(
        resolved(tmp_path, f"slip={{longitudinal: {kappa}, angle: {alpha}}}", *field, file=tir_text(**stiff))
    )
    load = samples(found, "tire/force", ContactForce, "normal")[-1]
    assert load == pytest.approx(WEIGHT, rel=2e-3)
    along, across, _turning, rolling, moment = book_at(kappa, alpha, load, **stiff)
    axle = decode(AxleForce, found["tire/axle"][-1])
    assert samples(found, "tire/force", ContactForce, "tangential")[-1] == pytest.approx(along, abs=1e-6 * load)
    assert axle.lateral[-1] == pytest.approx(across, abs=1e-6 * load)
    assert axle.moment_z[-1] == pytest.approx(moment, abs=1e-6 * load)
    deflection = samples(found, "tire/force", ContactForce, "approach")[-1]
    radius = 0.5 * 16 * 0.0254 + 0.55 * 0.205 - deflection / 3.0
    assert axle.spin[-1] == pytest.approx((1.0 + kappa) * SPEED / radius, rel=1e-6)
    assert axle.moment_y[-1] == pytest.approx(rolling - radius * along, abs=1e-5 * load)
    shear, wrench = (
        decode(ContactShear, found["tire/shear"][-1]),
        decode(WrenchStamped, found["tire/wrench"][-1]).wrench,
    )
    assert (shear.slip, shear.slip_angle) == pytest.approx((kappa, alpha))
    assert (shear.force_x, shear.force_y, shear.moment_z) == pytest.approx((along, across, moment), abs=1e-5 * load)
    assert (wrench.force.x, wrench.force.y) == pytest.approx((along, across), abs=1e-5 * load)
    assert shear.shear_x.size == 0


@pytest.mark.parametrize("axis", ["X", "Y"])
def test_a_step_of_slip_grows_as_of_first_order(tmp_path, axis):
    """A small one, so that the force goes with it: F / F_end = 1 - exp(-s / sigma), sigma = |K| / C."""
    plain = {**dict.fromkeys(SCALES, 1.0), **SHIFTS}
    slip = "longitudinal: 1.0e-6" if axis == "X" else "angle: 1.0e-6"
    found = messages_of(
        resolved(tmp_path, f"slip={{{slip}}}", "travel.speed=3", "outputs.force_rate=2000", file=tir_text(**plain))
    )
    topic, kind, name = (
        ("tire/force", ContactForce, "tangential") if axis == "X" else ("tire/axle", AxleForce, "lateral")
    )
    force, load = samples(found, topic, kind, name), samples(found, "tire/force", ContactForce, "normal").mean()
    df, dp = load / SET["FNOMIN"] - 1.0, PRESSURE / SET["NOMPRES"] - 1.0
    if axis == "X":
        stiffness = load * (SET["PKX1"] + SET["PKX2"] * df) * math.exp(SET["PKX3"] * df)
        stiffness *= 1.0 + SET["PPX1"] * dp + SET["PPX2"] * dp**2
        carcass = SET["LONGITUDINAL_STIFFNESS"]
    else:
        stiffness = -SET["PKY1"] * SET["FNOMIN"] * (1.0 + SET["PPY1"] * dp)
        stiffness *= math.sin(SET["PKY4"] * math.atan(load / (SET["FNOMIN"] * SET["PKY2"] * (1.0 + SET["PPY2"] * dp))))
        carcass = SET["LATERAL_STIFFNESS"]
    carcass *= (1.0 + SET[f"PCF{axis}1"] * df + SET[f"PCF{axis}2"] * df**2) * (1.0 + SET[f"PCF{axis}3"] * dp)
    way = 3.0 * numpy.arange(len(force)) / 2000.0
    sign = 1.0 if axis == "X" else -1.0
    expected = sign * stiffness * 1e-6 * -numpy.expm1(-way * carcass / stiffness)
    assert way[-1] > 3.0 * stiffness / carcass
    assert force == pytest.approx(expected, abs=2e-4 * abs(expected[-1]))


def test_a_slip_that_changes_along_a_straight_line_relaxes_as_its_differential_equation():
    for old, start, end, way, length in (
        (0.0, 0.1, 0.3, 0.2, 0.4),
        (0.2, -0.1, 0.1, 1.0, 0.05),
        (0.1, 0.0, 0.0, 0.3, 0.3),
    ):
        solved = solve_ivp(
            lambda s, u, a=start, b=end, w=way, sigma=length: (a + (b - a) * s / w - u) / sigma, (0.0, way), [old],
            rtol=1e-11, atol=1e-13,
        )  # fmt: skip
        assert relaxed(old, start, end, way, length) == pytest.approx(solved.y[0, -1], rel=1e-8)
    assert relaxed(0.3, 0.1, 0.2, 1.0, 0.0) == 0.2  # nothing lags
    assert relaxed(0.3, 0.1, 0.2, 0.0, 1.0) == 0.3  # a wheel that stands
    assert relaxed(0.0, math.nan, 0.2, 0.0, 1.0) == 0.0  # the first sample


def ledger(found):
    return [decode(EnergyLedger, data) for data in found["bench/energy"]]


def test_the_ledger_books_what_the_formula_loses_and_what_the_carcass_keeps(tmp_path):
    """Steady: (F_x kappa - F_y tan alpha) V and -M_y omega a second; kept sigma times the integral of F over the slip."""
    kappa, alpha = -0.03, 0.04
    found = messages_of(
        resolved(tmp_path, f"slip={{longitudinal: {kappa}, angle: {alpha}}}", "outputs.force_rate=5000", "duration=1")
    )
    along, across, _turning, rolling, _moment = book_at(kappa, alpha, WEIGHT)
    deflection = samples(found, "tire/force", ContactForce, "approach")[-1]
    radius = 0.5 * 16 * 0.0254 + 0.55 * 0.205 - deflection / 3.0
    lost = (along * kappa - across * math.tan(alpha)) * SPEED - rolling * (1.0 + kappa) * SPEED / radius
    entries = ledger(found)
    assert (entries[-1].dissipated - entries[-11].dissipated) / 0.1 == pytest.approx(lost, rel=1e-5)
    assert (entries[-1].supplied - entries[-11].supplied) / 0.1 == pytest.approx(lost, rel=1e-5)
    assert max(abs(entry.residual) for entry in entries) < 1e-9 * entries[-1].dissipated
    shears = [decode(ContactShear, data) for data in found["tire/shear"]]
    at_road = (along * kappa - across * math.tan(alpha)) * SPEED * 0.01
    assert shears[-1].dissipated == pytest.approx(at_road, rel=1e-5)


def test_the_carcass_keeps_sigma_times_the_integral_of_the_force(tmp_path):
    plain = {**dict.fromkeys(SCALES, 1.0), **SHIFTS, "PCFX1": 0.0, "PCFX2": 0.0, "PCFX3": 0.0}
    found = messages_of(
        resolved(tmp_path, "slip={longitudinal: 0.05}", "outputs.force_rate=10000", file=tir_text(**plain))
    )
    df, dp = WEIGHT / SET["FNOMIN"] - 1.0, PRESSURE / SET["NOMPRES"] - 1.0
    stiffness = WEIGHT * (SET["PKX1"] + SET["PKX2"] * df) * math.exp(SET["PKX3"] * df)
    stiffness *= 1.0 + SET["PPX1"] * dp + SET["PPX2"] * dp**2
    sigma = stiffness / SET["LONGITUDINAL_STIFFNESS"]
    integral, _error = quad(lambda kappa: book_at(kappa, 0.0, WEIGHT, **plain)[0], 0.0, 0.05, epsrel=1e-6)
    assert ledger(found)[-1].stored == pytest.approx(sigma * integral, rel=2e-3)


def test_the_ledger_closes_on_a_rough_road_while_it_brakes_and_turns(tmp_path):
    road = "road={kind: iso8608, roughness_class: C, length: 40, shortest_wavelength: 0.3, longest_wavelength: 20}"
    points = "slip={points: [[0, 0, 0], [0.3, -0.2, 0.0], [0.6, -1.0, 0.0], [1.0, 0.0, 0.1]]}"
    found = messages_of(resolved(tmp_path, road, points, "duration=1", "travel={points: [[0, 15], [1, 10]]}"))
    entries = ledger(found)
    assert entries[-1].dissipated > 1e4
    assert max(abs(entry.residual) for entry in entries) < 1e-6 * entries[-1].dissipated


def test_off_the_road_there_is_no_force(tmp_path):
    bump = "road={kind: bump, position: 3, height: 0.08, length: 0.5}"
    found = messages_of(resolved(tmp_path, bump, "slip={angle: 0.05}", "duration=0.6"))
    normal = samples(found, "tire/force", ContactForce, "normal")
    lateral = samples(found, "tire/axle", AxleForce, "lateral")
    assert (normal == 0.0).any()
    assert not lateral[normal == 0.0].any()
    assert (lateral[(normal > 100.0)][5:] < 0.0).all()


def test_a_wheel_that_stands_keeps_its_slips_and_has_no_rolling_resistance(tmp_path):
    found = messages_of(
        resolved(tmp_path, "slip={angle: 0.05}", "travel={points: [[0, 5], [0.2, 0], [0.5, 0]]}", "duration=0.5")
    )
    lateral, spin = (samples(found, "tire/axle", AxleForce, name) for name in ("lateral", "spin"))
    at_rest = numpy.arange(len(spin)) >= 0.21 * len(spin) / 0.5
    assert not spin[at_rest].any()
    assert lateral[at_rest] == pytest.approx(lateral[-1], rel=1e-3)
    moment, along = (samples(found, "tire/axle", AxleForce, name) for name in ("moment_y", "longitudinal"))
    deflection = samples(found, "tire/force", ContactForce, "approach")
    assert moment[-1] == pytest.approx(-(0.5 * 16 * 0.0254 + 0.55 * 0.205 - deflection[-1] / 3.0) * along[-1], rel=1e-9)


def test_the_coefficients_travel_with_the_saved_scene(tmp_path):
    scene = resolved(tmp_path, "slip={longitudinal: -0.05}", "duration=0.05", file=tir_text(QDRP1=1.0))
    (tmp_path / "tire.tir").unlink()
    again = read_resolved(scene.to_yaml())
    assert again == scene
    assert messages_of(again)["tire/axle"] == messages_of(scene)["tire/axle"]
    keys = again.data["effects"]["tire"]["magic_formula"]
    assert keys["coefficients"]["PKY1"] == SET["PKY1"]
    assert "QDRP1" in keys["unused"].split()
    assert any("QDRP1" in each for each in Simulation(again).cautions)


def test_another_file_is_read_anew(tmp_path):
    scene = resolved(tmp_path)
    (tmp_path / "saved.yaml").write_text(scene.to_yaml())
    (tmp_path / "other.tir").write_text(tir_text(PKY1=-11.0, FITTYP=6, PTX1=1.9, PTY1=1.7, PTY2=2.1))
    changed = resolve(load_scene(tmp_path / "saved.yaml", [set_value("effects.tire.magic_formula.file=other.tir")]))
    keys = changed.data["effects"]["tire"]["magic_formula"]
    assert (keys["coefficients"]["PKY1"], keys["version"]) == (-11.0, "5.2 and PAC2002")
    one = resolve(
        load_scene(tmp_path / "saved.yaml", [set_value("effects.tire.magic_formula.coefficients.PKY1=-12.0")])
    )
    assert one.data["effects"]["tire"]["magic_formula"]["coefficients"]["PKY1"] == -12.0


def test_it_is_absent_where_no_scene_names_it(tmp_path):
    assert build(resolved(tmp_path)).magic_formula is not None
    assert build(resolved(tmp_path, "effects.tire.magic_formula=null")).magic_formula is None


def test_what_was_not_measured_is_named(tmp_path):
    ranges = {"FZMIN": 100.0, "FZMAX": 3000.0, "ALPMIN": -0.2, "ALPMAX": 0.2, "KPUMIN": -0.5, "KPUMAX": 0.5}
    scene = resolved(tmp_path, "slip={longitudinal: -1.0}", file=tir_text(**ranges))
    said = [each for each in Simulation(scene).cautions if "fitted from" in each]
    assert len(said) == 2
    assert "the load at rest is 3335 N" in said[0]
    assert "the slip is -1" in said[1]


REFUSED = [
    (("effects.tire.brush={}", "effects.tire.contact_field={}", "effects.tire.rigid_ring={}"),
     "magic_formula stands in place of"),
    (("effects.tire.rolling_loss={}",), "exclude each other"),
    (("effects.tire.magic_formula={}",), "give a tire property file, or coefficients"),
    (("effects.tire.magic_formula.file=none.tir",), "the file 'none.tir' is not there"),
    (("effects.tire.magic_formula={coefficients: {FNOMIN: 4000.0}}",), "needs UNLOADED_RADIUS, PCX1"),
    (("effects.tire.magic_formula={coefficients: {PCX9: 4000.0}}",), "the Magic Formula has no PCX9; remove it"),
    (("effects.tire.magic_formula={file: tire.tir, version: 6.1 and later}",), "is that of the file"),
    (("effects.tire.magic_formula=null", "slip={angle: 0.1}"), "neither of which the scene names"),
]  # fmt: skip


@pytest.mark.parametrize(("values", "said"), REFUSED)
def test_a_scene_that_is_none_is_refused_in_one_sentence(tmp_path, values, said):
    with pytest.raises(SceneError) as error:
        resolved(tmp_path, *values)
    assert len(error.value.faults) == 1
    assert said in error.value.faults[0].sentence


def test_a_file_without_a_coefficient_is_refused_by_its_name(tmp_path):
    with pytest.raises(SceneError) as error:
        resolved(tmp_path, file=tir_text(PCX1=None, PKY1=None))
    assert "needs PCX1, PKY1" in error.value.faults[0].sentence
    assert len(error.value.faults) == 1
