"""Each row of the tables of systems is held to its command: the command runs and shows what the row says it shows, each
equation of a row of single formulas stands in the record that evaluates it, and rows of runs have their values.
"""

import functools
import json
import math
import re
import shlex

import numpy
import pytest

from contact_sim_lab.papers.registry import equation_of, evaluate, papers, values_of
from contact_sim_pkg.cli.main import main
from contact_sim_pkg.library import load_scene, run, series

SYSTEMS = [(paper, system) for paper in papers() for system in paper.systems]
SHORTER = {
    "impact_rubber_drop": ("duration=0.3",), "block_fall": ("duration=0.6",), "seat_slip": ("duration=0.3",),
    "seat_slap": ("duration=1",), "seat_general": ("duration=0.3",), "seat_shell": ("duration=0.1",),
    "roller_flutter": ("duration=0.2",), "roller_corrugation": ("duration=0.2",),
    "roller_steady": ("duration=0.5", "effects.roller.subsurface.instants=[0]"),
    "roller_programme": ("duration=0.2", "effects.roller.subsurface.instants=[0]"),
    "tire_half_space": ("duration=0.05",), "tire_irregular_road": ("duration=0.05",),
}  # fmt: skip


@functools.cache
def bag_of(scene, *values):
    return run(load_scene(scene, *values, *SHORTER[scene]))


def words_of(system):
    return shlex.split(system.command)


def run_of(system):
    words = words_of(system)
    return bag_of(words[2], *[word for word, before in zip(words[1:], words, strict=False) if before == "--set"])


def values_in(bag, topic, column):
    """Of a column of samples or of the arrays of the messages."""
    found = series(bag, topic)
    if column in found.columns:
        return numpy.asarray(found[column], float)
    return numpy.concatenate([numpy.ravel(getattr(message, column)) for _, message in bag.decoded(topic)])


RUNS = [system for _, system in SYSTEMS if words_of(system)[1] == "run"]


@pytest.mark.parametrize("system", RUNS, ids=lambda system: system.title[:40])
def test_a_run_publishes_what_its_row_says(system):
    bag = run_of(system)
    for _equations, place in system.shows:
        topic, columns = place.split(": ")
        for column in columns.split(", "):
            found = values_in(bag, topic, column)
            assert found.size
            assert numpy.isfinite(found).all()
            assert numpy.any(found != 0.0), (place, column)


def numbers_of(text):
    """Numbers of equations in a text: those of a range are all between its ends."""
    found = set()
    for first, last in re.findall(r"(?<![\w.])(\d+)(?:[-–](\d+))?(?![\w-])", text):
        found |= set(range(int(first), int(last or first) + 1))
    return found


FORMULAS = [(paper, system) for paper, system in SYSTEMS if system.command.endswith("--equation N")]


@pytest.mark.parametrize(("paper", "system"), FORMULAS, ids=lambda each: getattr(each, "key", ""))
def test_a_single_formula_evaluates_the_equations_of_its_row(paper, system):
    for equations, number in system.shows:
        record = equation_of(paper, number)
        evaluate(record, values_of(paper.key, record.parameters, []))
        named = numbers_of(f"{number} {' '.join(re.findall(r'[(]eqs ([^)]*)[)]', record.title))}")
        assert numbers_of(equations) <= named, (equations, record.title)


QUICK = {("driver-seat", "3"), ("tire-road", "2"), ("identifiability", "1")}
"""The others take a minute each; `bench paper --all` draws them."""


def figure_in(system):
    words = words_of(system)
    return words[words.index("--figure") + 1] if "--figure" in words else ""


FIGURES = [(paper, system) for paper, system in SYSTEMS if (paper.key, figure_in(system)) in QUICK]


@pytest.mark.parametrize(("paper", "system"), FIGURES, ids=lambda each: getattr(each, "key", ""))
def test_a_figure_prints_what_its_row_says(paper, system, tmp_path, capsys):
    status = main([*words_of(system)[1:], "--json", "--output", str(tmp_path / "figure.png")])
    assert status == 0
    names = {row["quantity"] for row in json.loads(capsys.readouterr().out)["numbers"]}
    assert {place for _, place in system.shows} <= names


def test_identify_and_material_print_what_their_rows_say(capsys):
    rows = {words_of(system)[1]: system for _, system in SYSTEMS}
    bags = {"identify": run(load_scene("block_identify")), "material": bag_of("impact_rubber_drop")}
    for name, bag in bags.items():
        words = [str(bag.path) if word in ("BAG", "IMPACTS.csv") else word for word in words_of(rows[name])]
        assert main([*words[1:], "--json"]) == 0
        text = capsys.readouterr().out
        for each in rows[name].shows[0][1].split(", "):
            assert f'"{each}"' in text


def test_the_contact_surface_lies_where_each_variant_says():
    """Goloshchapov eqs 25 to 27 and 38 to 40: k_c = k_p, K_T dT = 6e-4 * 20, rubber of nu = 0.499, a rigid sphere."""
    for variant, power in ((1, 0.5), (2, 1.0)):
        bag = run_of(next(each for each in RUNS if f"variant {variant}" in each.title))
        assert set(values_in(bag, "impact/position", "variant")) == {variant}
        time, depth = (values_in(bag, "impact/course", name) for name in ("time_in_message", "depth"))
        first = slice(0, 201)  # samples of an impact
        found, at = (values_in(bag, "impact/position", name)[1:60] for name in ("surface_depth", "time_in_message"))
        x = numpy.interp(at, time[first], depth[first])
        alpha = 16.0 / (5.0 * math.pi * numpy.sqrt(2.0 - x / 0.01)) * numpy.sqrt(x / 0.01) * (1.0 - 2.0 * 0.499)
        assert found == pytest.approx(x * (1.0 - alpha + 0.012) ** power, rel=2e-3)


def test_the_depth_by_the_hereditary_integral_is_that_of_a_standard_solid():
    """Eq 112, corrected, by the trapezium rule: J(t) = 1/G0 + (1 - e^(-t/tau))/G1 of the impact's complex modulus at pi/T,
    G0 = 3 G' (1 + tan^2), 1/G* = 1/G0 + 1/(G1 (1 + i w tau)).
    """
    ratio, tangent, poisson = 3.0, 0.2, 0.499
    bag = bag_of("impact_rubber_drop", "effects.impact.history={model: standard_solid, instant_ratio: 3}")
    names = ("time_in_message", "elastic_force", "viscous_force")
    time, elastic, viscous = (values_in(bag, "impact/course", name)[:201] for name in names)
    frequency = math.pi / values_in(bag, "impact/events", "duration")[0]
    storage = 0.5 * math.sqrt(2.0) * 8.0e6 * (1.0 - poisson)
    glassy = ratio * storage * (1.0 + tangent**2)
    delayed = 1.0 / (1.0 / (storage * (1.0 + 1j * tangent)) - 1.0 / glassy)  # G1 (1 + i w tau)
    lag = delayed.imag / delayed.real / frequency
    force, fine = elastic + viscous, numpy.linspace(0.0, time[-1], 2001)
    rate = numpy.gradient(numpy.interp(fine, time, force), fine)
    at = fine[100:1001:100]
    cubes = [
        numpy.trapezoid(
            (1.0 / glassy - numpy.expm1(-(t - fine[fine <= t]) / lag) / delayed.real) * rate[fine <= t], fine[fine <= t]
        )
        for t in at
    ]
    wanted = (0.375 * (1.0 - poisson) / math.sqrt(0.01) * numpy.array(cubes)) ** (2.0 / 3.0)
    places, depth = (values_in(bag, "impact/history", name)[:401] for name in ("time_in_message", "depth"))
    assert numpy.interp(at, places, depth) == pytest.approx(wanted, rel=3e-3)


def test_the_static_tilt_balances_pressure_and_bent_shaft():
    """Rolling Contact eqs 16 and 17, corrected: k psi = F R sin psi - T R cos psi (A - l + R sin psi)."""
    bag = run_of(next(each for each in RUNS if "all moments" in each.title))
    psi = values_in(bag, "roller/stability", "tilt")[0]
    a, b, approach = (values_in(bag, "roller/contact", name)[0] for name in ("along_x", "along_y", "approach"))
    pull = 0.1 * 225.0 * math.pi * a * b * (0.005 - approach) / (0.25 * math.pi * 0.005**4)
    of_shaft = -pull * 0.02 * math.cos(psi) * (0.060 - 0.158 + 0.02 * math.sin(psi))
    assert of_shaft > 1e-4
    assert 60.0 * psi == pytest.approx(300.0 * 0.02 * math.sin(psi) + of_shaft, rel=1e-4)


def test_the_ellipse_is_that_of_the_polynomial():
    """Eq 10 as printed, its ten coefficients; R11 along y, R21 along x."""
    bag = run_of(next(each for each in RUNS if "polynomial" in each.title))
    a, b = (values_in(bag, "roller/contact", name)[0] for name in ("along_x", "along_y"))
    omega = abs(1 / 0.21 - 1 / 0.32) / (1 / 0.21 + 1 / 0.32)
    terms = (2.667, -3.577, 4.244, -5.871, 10.312, -18.202, 24.577, -21.858, 11.213, -2.506)
    square = sum(term * omega**power for power, term in enumerate(terms, start=1))
    assert min(a, b) / max(a, b) == pytest.approx(math.sqrt(1.0 - square), rel=1e-9)


def test_each_step_of_the_block_meets_complementarity():
    """Eq 9: from the motion alone c_n, c_t >= 0 within the cone, and c_n only where the lowest corner meets the ground."""
    system = next(each for each in RUNS if "complementarity" in each.title)
    found = series(run_of(system), "bench/motion")
    step = float(numpy.diff(found.time).mean())
    assert step == pytest.approx(1e-3, rel=1e-9)
    v_x, v_z = (numpy.asarray(found[f"velocity.block_{name}"]) for name in ("x", "z"))
    pitch, z = (numpy.asarray(found[f"position.block_{name}"]) for name in ("pitch", "z"))
    normal, tangential = numpy.diff(v_z) + 9.81 * step, numpy.diff(v_x)
    gap = z - 0.05 * (numpy.abs(numpy.cos(pitch)) + numpy.abs(numpy.sin(pitch)))
    assert normal.min() > -1e-12
    assert (numpy.abs(tangential) <= 0.3 * normal + 1e-12).all()
    pushed = normal > 1e-9
    assert pushed.any()
    assert gap[1:][pushed].max() < 0.05 * 1e-3 + 2e-3 * numpy.abs(v_z).max()
    assert gap.min() > -1e-5
