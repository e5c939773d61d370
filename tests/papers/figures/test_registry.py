"""Records of the papers: complete, found by name, and refused in a sentence where they must be."""

import math
import shlex

import pytest

from contact_sim_lab.papers.registry import PAPERS, equation_of, evaluate, figure_of, load, paper_of, papers, values_of
from contact_sim_lab.records.paper import JUDGED, NO_REFERENCE, SHAPE_ONLY, Number, PaperError, Parameter
from contact_sim_pkg.library import load_scene

RESULTS = {
    "driver-seat": ("3", "4", "5", "6", "7"),
    "contact-area": ("4", "5"),
    "tire-road": ("2", "3", "4", "5"),
    "rolling-contact": ("2", "3", "4", "6", "9", "10", "11", "12", "13", "14"),
    "identifiability": ("1",),
}  # figures of the papers that show a result
EQUATIONS = [(paper.key, each.number) for paper in papers() for each in paper.equations]
FIGURES = [(paper.key, each.number) for paper in papers() for each in paper.figures]


def test_every_figure_with_a_result_is_there():
    assert {key: tuple(each.number for each in paper_of(key).figures) for key in PAPERS} == RESULTS
    kinds = [figure_of(paper_of(key), number).kind for key, number in FIGURES]
    assert kinds.count(JUDGED) >= 16
    assert kinds.count(SHAPE_ONLY) + kinds.count(NO_REFERENCE) <= 6


@pytest.mark.parametrize(("key", "number"), FIGURES)
def test_the_record_of_a_figure_is_complete(key, number):
    figure = figure_of(paper_of(key), number)
    assert figure.title and figure.judged_by and figure.made_by  # noqa: PT018
    for place in figure.made_by:
        load_scene(place.removeprefix("scene ")) if place.startswith("scene ") else load(place)


@pytest.mark.parametrize(("key", "number"), EQUATIONS)
def test_an_equation_evaluates_at_its_defaults(key, number):
    equation = equation_of(paper_of(key), number)
    assert callable(load(equation.place))
    found = evaluate(equation, values_of(key, equation.parameters, []))
    assert list(found) == [name for name, _ in equation.results]
    for value in found.values():
        for each in value if isinstance(value, list) else [value]:
            assert each is not None
            assert not (isinstance(each, float) and math.isnan(each))


@pytest.mark.parametrize(("key", "number"), EQUATIONS)
def test_an_equation_is_refused_outside_its_range(key, number):
    equation = equation_of(paper_of(key), number)
    for each in equation.parameters:
        wrong = [str(bound) for bound in (each.above, each.below) if math.isfinite(bound)]
        beyond = ((each.least, -1.0), (each.most, 1.0))
        wrong += [repr(bound + side * max(1.0, abs(bound))) for bound, side in beyond if math.isfinite(bound)]
        for text in [*wrong, "nothing"]:
            with pytest.raises(PaperError, match=each.name):
                values_of(key, equation.parameters, [f"{each.name}={text}"])
    with pytest.raises(PaperError, match="'nothing': unknown"):
        values_of(key, equation.parameters, ["nothing=1"])


def test_numbers_of_an_equation_are_unique():
    assert len(set(EQUATIONS)) == len(EQUATIONS)


@pytest.mark.parametrize(
    ("key", "number", "given", "result", "expected", "tolerance"),
    [
        ("contact-area", "1-spheres", [], "radius", math.sqrt(0.01**2 - 0.0095**2), 1e-15),
        ("contact-area", "42", ["border_speed=3", "places=0.5"], "velocity", [0.75], 1e-15),
        ("contact-area", "104", ["form=printed"], "E'", 1.0790e8 * 5.03 / 5.3033, 1e4),
        ("contact-area", "107", [], "T*", 270.30, 5e-3),
        ("contact-area", "116", ["duration=2e-3", "loss_tangent=0.5"], "time", 1e-3 / math.pi, 1e-15),
        ("contact-area", "124", ["model=maxwell", "time=1", "frequency=1", "modulus=2"], "E' and E''", [1.0, 1.0], 1e-15),
        ("tire-road", "7-printed", [], "load over P", 9.05, 5e-3),
        ("tire-road", "9-printed", [], "approach", 9.8919e-3 * 3.0 ** (-2.0 / 3.0), 1e-6),
        # Ten sites of 40 N within 0.05 m of 0.205 m; of 0.2 m nine, two more lie on the border
        ("tire-road", "10", ["load=4000", "travel=0.205"], "force", 400.0, 1e-9),
        ("tire-road", "10", ["load=4000", "travel=0.2"], "force", 360.0, 1e-9),
        ("rolling-contact", "18", ["damping=0"], "growth rate", 0.4557, 5e-5),
        ("rolling-contact", "18", ["damping=0"], "critical load", 0.0, 0.0),
        ("rolling-contact", "10", ["omega=0.9"], "b/a exact", 0.14896, 5e-6),
        ("driver-seat", "2", ["half_axes_1=1,1,1", "half_axes_2=1,1,1", "centre_2=1.5,0,0"], "d", 0.5, 1e-9),
        ("driver-seat", "8-damping", ["restitution=0.5", "impact_speed=1"], "λ", 1.43275, 5e-6),
        ("driver-seat", "11", ["severity=1.43275"], "e", 0.5, 1e-5),
        ("identifiability", "40", ["angle=0", "height=0.05"], "φ", 0.0, 1e-15),
        ("identifiability", "44", [], "m/J", 6.0 / 0.1**2, 1e-6),
        ("identifiability", "2", [], "z", [4.0 / 3.0, 7.0 / 3.0], 1e-12),
    ],
)  # fmt: skip
def test_an_equation_has_its_value(key, number, given, result, expected, tolerance):
    equation = equation_of(paper_of(key), number)
    found = evaluate(equation, values_of(key, equation.parameters, given))[result]
    assert found == pytest.approx(expected, abs=tolerance)


def test_what_the_function_refuses_is_refused():
    """Two bounds that only hold together: the ring of a pressure beyond the bulk modulus."""
    equation = equation_of(paper_of("contact-area"), "48")
    values = values_of("contact-area", equation.parameters, ["mean_pressure=2e9"])
    with pytest.raises(PaperError, match=r"equation 48: "):
        evaluate(equation, values)


def test_every_system_has_a_command_that_is_one():
    for paper in papers():
        for system in paper.systems:
            words = shlex.split(system.command.replace('"', ""))
            assert words[0] == "bench"
            if words[1] == "run":
                load_scene(
                    words[2], *[word for word, before in zip(words[1:], words, strict=False) if before == "--set"]
                )
            elif "--figure" in words:
                figure_of(paper_of(words[2]), words[words.index("--figure") + 1])
            elif "--equation" in words and "N" not in words:  # N: each of those that the row names
                equation_of(paper_of(words[2]), words[words.index("--equation") + 1])
            elif "--system" in words:
                assert words[words.index("--system") + 1] == system.name
                assert callable(load(system.run))


def test_a_number_is_judged_by_its_tolerance():
    number = Number("x", "m", 1.02, 1.0, 0.03, "by hand", relative=True)
    assert number.verdict == "inside"
    assert number._replace(tolerance=0.01).verdict == "OUTSIDE"
    assert number._replace(obtained=math.nan).verdict == "OUTSIDE"
    assert number._replace(obtained=None).verdict == "not reached"
    assert number._replace(expected=None).verdict == NO_REFERENCE
    assert number.difference == pytest.approx(0.02)
    nothing = number._replace(expected=0.0)
    assert (nothing.difference, nothing.verdict) == (math.inf, "OUTSIDE")
    assert nothing._replace(obtained=0.0).verdict == "inside"


def test_a_list_and_a_whole_number_are_read():
    assert Parameter("x", "m", (0.0,), least=0.0).read("[1, 2.5]") == (1.0, 2.5)
    assert Parameter("n", "", 3).read("4") == 4
    with pytest.raises(PaperError, match=r"n '4\.5': a whole number is needed"):
        Parameter("n", "", 3).read("4.5")


def test_names_that_are_none_are_refused_with_the_nearest():
    with pytest.raises(PaperError, match="did you mean 'tire-road'"):
        paper_of("tire_road")
    with pytest.raises(PaperError, match=r"Figures 1, 7 and 8 are schemes"):
        figure_of(paper_of("rolling-contact"), "7")
