"""The report page: what it holds, what it leaves out, and that nothing in a bag can act in it."""

import base64
import hashlib
import xml.etree.ElementTree as ElementTree

import pytest
from tests.report import synthetic_bag as known
from tests.report.page import Page

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.report.metrics.requirements import read_requirements
from contact_sim_pkg.report.report import write_report

HOSTILE = '<script>alert(1)</script><img src=x onerror="alert(2)"> & "quotes"'


@pytest.fixture(scope="module")
def car_text(car, tmp_path_factory):
    return write_report(car, tmp_path_factory.mktemp("page") / "car.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def car_page(car_text):
    return Page(car_text)


PARTS = ["Time and maps", "Frequency", "Contact", "Against published", "Trust", "Set-up", "Files"]


def test_a_car_with_a_tire_field_has_every_part(car_page):
    assert car_page.headings == PARTS
    assert car_page.tags.count("figcaption") == 4 + 2 + 3 + 2 + 1 + 1 + 1  # a map is one of them
    assert {"Pressure maps of the tire contact", "Normal force and approach of the seat contact over time"} <= set(
        car_page.folds
    )


def test_the_contents_name_every_part_and_every_fold(car_page):
    listed = {value[1:] for tag, name, value in car_page.attributes if (tag, name) == ("a", "href")}
    named = {
        value for tag, name, value in car_page.attributes if tag in ("section", "figure", "details") and name == "id"
    }
    assert named - {"ride-transmissibility", "rolling-way"} == listed


def test_the_page_opens_with_a_verdict_and_the_conditions(car_text):
    answer = car_text[car_text.index('<p class="answer') : car_text.index("<nav")]
    assert "<b>Outside:</b>" in answer
    assert "SEAT" in answer
    assert '<p class="conditions">10 s · ground · tire contact · seat contact</p>' in answer  # a scene without masses


def test_each_section_is_named_before_it_is_drawn(car, tmp_path):
    sections = []
    write_report(car, tmp_path / "car.html", on_section=lambda *section: sections.append(section))
    names = ["tire", "seat", "seat", "energy", "cost"]  # the second of the seat: its vibration, in any bag
    assert sections == [(number, len(names), name) for number, name in enumerate(names)]


def test_a_seat_alone_has_no_tire_and_no_map(seat, tmp_path):
    page = Page(write_report(seat, tmp_path / "seat.html").read_text(encoding="utf-8"))

    assert page.headings == PARTS
    assert not any("Pressure" in description for description in page.values("aria-label"))


def test_a_bag_of_forces_alone_still_gives_a_page(bare, tmp_path):
    page = Page(write_report(bare, tmp_path / "bare.html").read_text(encoding="utf-8"))

    assert page.headings == ["Time and maps", "Contact", "Against published", "Set-up", "Files"]


def test_the_page_lies_in_the_bag_unless_told_otherwise(tmp_path):
    bag = known.bare_bag(tmp_path / "bag")

    assert write_report(bag) == tmp_path / "bag" / "report.html"


def test_nothing_is_loaded_and_only_scripts_of_known_hashes_run(car_page, car_text):
    assert not {"link", "iframe", "object", "embed", "form"} & set(car_page.tags)
    (policy,) = (value for tag, name, value in car_page.attributes if name == "content" and "default-src" in value)
    scripts = [part.split("</script>")[0] for part in car_text.split("<script>")[1:]]
    hashes = [f"'sha256-{base64.b64encode(hashlib.sha256(each.encode()).digest()).decode()}'" for each in scripts]
    assert policy.startswith("default-src 'none'; ")
    assert policy.endswith(f"script-src {' '.join(hashes)}")
    assert len(scripts) == 3  # the plotting library, what all pages share, the page's own
    sources = car_page.values("src") + car_page.values("href") + car_page.values("xlink:href")
    assert all(source.startswith(("#", "data:image/png;base64,")) for source in sources)
    assert not [name for _, name, _ in car_page.attributes if name.startswith("on")]


def test_style_sheets_load_nothing(car_text):
    style = car_text[car_text.index("<style>") : car_text.index("</style>")]

    assert "url(" not in style
    assert "@import" not in style


def test_text_from_a_bag_is_inert(tmp_path):
    quoted = HOSTILE.replace('"', '\\"')
    effects = f'{{"{quoted}": {{"{quoted}": {{"{quoted}": "{quoted}"}}}}}}'
    scene = f'name: "{quoted}"\ndescription: "{quoted}"\nrig: car\neffects: {effects}\n'
    bag = known.car_bag(tmp_path / "hostile", blocks=80, scene=scene)

    page = Page(write_report(bag).read_text(encoding="utf-8"))

    assert page.tags.count("script") == 4  # the series, as JSON, and the three that the policy names
    assert page.tags.count("img") == 1  # the map
    assert page.texts.count(HOSTILE) >= 2  # title and description, word for word


def test_every_picture_says_what_it_shows_and_has_a_caption(car_page):
    described = [value for tag, name, value in car_page.attributes if tag == "div" and name == "aria-label"]

    assert len(described) == car_page.tags.count("figure") == car_page.tags.count("figcaption")
    assert all(described)
    assert len(set(described)) == len(described)


def test_identifiers_are_unique_and_every_reference_is_met(car_page, car_text):
    identifiers = car_page.values("id")
    references = {part.split(")")[0] for part in car_text.split("url(#")[1:]}
    references |= {value[1:] for value in car_page.values("xlink:href") if value.startswith("#")}

    assert references <= set(identifiers)
    assert len(identifiers) == len(set(identifiers))


def test_each_picture_is_well_formed_svg(car_text):
    drawings = [part.split("</svg>")[0] for part in car_text.split("<svg ")[1:]]

    for drawing in drawings:
        ElementTree.fromstring(f"<svg {drawing}</svg>")


@pytest.mark.parametrize(
    "expected",
    [
        "450 kPa (cross) at 0.570 s", "It lifts off 20 times", "mean 24 cm²", "17 samples at full scale: clipped",
        "closed forms, not a simulation", "rows 16, cols 12, tolerance 1e-06", "0.0-synthetic",
        "5 times as fast as the clock", "a force jumped by at most 2.5 N",
    ],
)  # fmt: skip
def test_captions_and_tables_state_the_numbers(car_text, expected):
    assert expected in car_text


def test_topics_are_listed_with_their_counts(car_page):
    row = car_page.texts.index("/tire/force")

    assert [text for text in car_page.texts[row : row + 12] if text][:4] == [
        "/tire/force", "contact_msgs_defs/msg/ContactForce", "1000", "100",
    ]  # fmt: skip


def test_the_same_bag_gives_the_same_page(bare, tmp_path):
    first, second = (write_report(bare, tmp_path / name).read_bytes() for name in ("a.html", "b.html"))

    assert first == second


def test_an_unfinished_bag_is_reported_with_a_warning(tmp_path):
    whole = known.car_bag(tmp_path / "whole", blocks=4000)  # several chunks: a cut one is lost as a whole
    data = whole.path.read_bytes()
    cut = tmp_path / "cut"
    cut.mkdir()
    (cut / whole.path.name).write_bytes(data[: int(len(data) * 0.8)])

    text = write_report(known.open_bag(cut)).read_text(encoding="utf-8")

    assert '<details class="warning">' in text
    assert "of the tire contact" in text


def test_a_minute_at_full_rate_stays_below_three_megabytes(tmp_path):
    bag = known.seat_bag(tmp_path / "minute", blocks=6000)

    assert write_report(bag).stat().st_size < 3_000_000


def test_a_limit_of_ones_own_is_a_tile_of_its_own(car, tmp_path):
    wanted = read_requirements(["seat.lift_off < 90 %"])
    tile = write_report(car, tmp_path / "own.html", requirements=wanted).read_text()
    assert "yours" in tile
    assert "at most 90" in tile
    assert "at most 90" not in write_report(car, tmp_path / "usual.html").read_text()


def test_two_runs_are_judged_by_limits_of_ones_own(car, tmp_path, capsys):
    """One that both hold, and one that both miss."""
    pair = [str(car.path), str(car.path)]
    assert main(["compare", *pair, "--require", "tire.load < 1e6 N"]) in (0, 1)
    assert main(["compare", *pair, "--require", "tire.load < 1 N"]) == 1
    assert "OUTSIDE" in capsys.readouterr().out
    page = tmp_path / "pair.html"
    assert main(["report", *pair, "--require", "tire.load < 1 N", "--out", str(page)]) == 0
    assert "OUTSIDE" in page.read_text()
