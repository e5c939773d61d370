"""Pictures of a contact: what is drawn over an axis is the signal in the unit of its label, and lies where it was."""

import re

import numpy as np
import pytest
from tests.report import uneven_bag as known

from contact_sim_pkg.report.drawing import style
from contact_sim_pkg.report.figures import bench, contact
from contact_sim_pkg.report.figures.maps import extent, loaded_window
from contact_sim_pkg.report.reading import read_recording
from contact_sim_pkg.report.signal.loops import area_ratio, loop_work, normal_loop

UNITS = {"N": 1.0, "kN": 1e-3, "mm": 1e3, "kPa": 1e-3, "cm²": 1e4, "s": 1.0, "J": 1.0}
FORCE, FIELD = known.FORCES["tire"], known.FIELDS["tire"]
STAMPS = known.STAMPS * 1e-9


@pytest.fixture(scope="module")
def recording(uneven):
    return read_recording(uneven)


@pytest.fixture
def figure_of(monkeypatch):
    """The figure of a picture, before it becomes text, and its caption."""

    def drawn(module, name, *given):
        kept = []
        monkeypatch.setattr(
            module, "picture", lambda _key, figure, _description, caption: kept.append((figure, caption))
        )
        with style():
            getattr(module, name)(*given)
        return kept[0]

    return drawn


def scale_of(label):
    return UNITS[label.rpartition(", ")[2].partition(" ")[0]]


def points(line, axes):
    """Points of a line in SI units by the labels of its axes; over time where the lowest axes has the label."""
    across = axes.get_xlabel() or axes.figure.axes[-1].get_xlabel()
    return np.array(line.get_data()) / [[scale_of(across)], [scale_of(axes.get_ylabel())]]


def test_forces_and_approach_over_time_are_in_the_units_of_their_labels(recording, figure_of):
    figure, caption = figure_of(contact, "load_over_time", "key", "tire", recording.contacts["tire"])
    for axes, name in zip(figure.axes, ("normal", "tangential", "impulses", "approach"), strict=True):
        np.testing.assert_allclose(points(axes.lines[0], axes), [known.TIMES, FORCE[name]], rtol=1e-12)
    shaded = [path.vertices[:4] for path in figure.axes[0].collections[0].get_paths()]
    spans = [(corners[:, 0].min(), corners[:, 0].max()) for corners in shaded]
    np.testing.assert_allclose(spans, [(known.TIMES[9], known.TIMES[11]), (known.TIMES[20], known.TIMES[21])])
    assert figure.axes[0].lines[1].get_ydata()[0] == pytest.approx(1e-3 * FORCE["normal"].mean())
    assert "It lifts off 2 times; 10.71% of the time" in caption
    numbers = [float(each) for each in re.findall(r"\d+(?:\.\d+)?", caption)][:5]
    normal, approach = FORCE["normal"], 1e3 * FORCE["approach"]
    expected = normal.min(), normal.max(), normal.mean(), approach.min(), approach.max()
    assert numbers == pytest.approx(expected, rel=5e-3)


def test_a_contact_open_to_the_end_is_shaded_to_the_end(recording, figure_of):
    seat = recording.contacts["seat"]
    seat = seat._replace(normal=np.where(np.arange(28) >= 26, 0.0, seat.normal))
    figure, _ = figure_of(contact, "load_over_time", "key", "seat", seat)
    last = figure.axes[0].collections[0].get_paths()[-1].vertices[:4, 0]
    assert (last.min(), last.max()) == pytest.approx((known.TIMES[25], known.TIMES[-1] + known.PERIOD))


def test_load_over_approach_is_the_curve_of_the_samples(recording, figure_of):
    figure, _ = figure_of(contact, "load_over_approach", "key", "tire", recording.contacts["tire"])
    np.testing.assert_allclose(
        points(figure.axes[0].lines[0], figure.axes[0]), [FORCE["approach"], FORCE["normal"]], rtol=1e-12
    )


def test_peak_area_and_outline_over_time_are_in_the_units_of_their_labels(recording, figure_of):
    figure, caption = figure_of(contact, "footprint_over_time", "key", "tire", recording.fields["tire"])
    for axes, name in zip(figure.axes, ("peak", "area"), strict=False):
        np.testing.assert_allclose(points(axes.lines[0], axes), [STAMPS, FIELD[name]], rtol=1e-12)
    carries = np.arange(known.BLOCKS) != known.EMPTY["tire"]
    for line, name in zip(figure.axes[2].lines, ("lame_a", "lame_b"), strict=True):
        assert line.get_label().startswith(name[-1])
        np.testing.assert_allclose(points(line, figure.axes[2])[1][carries], FIELD[name][carries], rtol=1e-12)
    cross = np.ravel(points(figure.axes[0].lines[1], figure.axes[0]))
    assert cross == pytest.approx([STAMPS[FIELD["peak"].argmax()], FIELD["peak"].max()])
    area = 1e4 * FIELD["area"]
    assert f"Contact area 0 to {area.max():.4g} cm², mean {area.mean():.4g} cm²" in caption


def test_the_cross_lies_on_the_cell_with_the_largest_pressure_and_left_is_on_the_left(recording, figure_of):
    figure, caption = figure_of(contact, "pressure_maps", "key", "tire", recording.fields["tire"])
    highest = known.PRESSURES["tire"][FIELD["peak"].argmax()]
    row, col = np.unravel_index(highest.argmax(), highest.shape)
    x, y = 1e3 * (known.ORIGIN_X + row * known.CELL_X), 1e3 * (known.ORIGIN_Y + col * known.CELL_Y)
    axes = figure.axes[0]
    assert np.ravel(axes.lines[-1].get_data()) == pytest.approx([y, x])
    left, right = axes.get_xlim()
    back, front = axes.get_ylim()
    assert (left > right, front > back) == (True, True)
    # the picture has the largest value in the cell under the cross
    image = axes.images[0]
    low_y, high_y, low_x, high_x = image.get_extent()
    at = [int((x - low_x) / (high_x - low_x) * known.ROWS), int((y - low_y) / (high_y - low_y) * known.COLS)]
    assert image.origin == "lower"
    assert image.get_array()[tuple(at)] == pytest.approx(1e-3 * highest.max(), rel=1e-6)
    assert f"{1e-3 * highest.max():.4g} kPa (cross) at {STAMPS[FIELD['peak'].argmax()]:.3f} s" in caption


def test_cells_reach_half_a_cell_beyond_their_centres(recording):
    grid = recording.fields["tire"].average
    last_x, last_y = known.ORIGIN_X + 5 * known.CELL_X, known.ORIGIN_Y + 3 * known.CELL_Y
    expected = (known.ORIGIN_Y - 0.0035, last_y + 0.0035, known.ORIGIN_X - 0.0055, last_x + 0.0055)
    assert extent(grid) == pytest.approx(1e3 * np.array(expected))
    # loaded from row 1 to 5 and from column 0 to 2, two cells around them
    window = loaded_window(grid)
    edges = (known.ORIGIN_X + (1 - 2.5) * 0.011, known.ORIGIN_X + (5 + 2.5) * 0.011)
    assert (window.low_x, window.high_x) == pytest.approx(1e3 * np.array(edges))
    edges = (known.ORIGIN_Y - 2.5 * 0.007, known.ORIGIN_Y + (2 + 2.5) * 0.007)
    assert (window.low_y, window.high_y) == pytest.approx(1e3 * np.array(edges))


def test_the_energy_is_drawn_with_its_residual_over_the_throughput(recording, figure_of):
    figure, _ = figure_of(bench, "energy_balance", recording.ledger)
    ledger = known.LEDGER
    held = ledger["kinetic"] + ledger["potential"] + ledger["stored"]
    for line, values in zip(figure.axes[0].lines, (ledger["supplied"], ledger["dissipated"], held), strict=True):
        np.testing.assert_allclose(line.get_data(), [STAMPS, values], rtol=1e-12)
    np.testing.assert_allclose(figure.axes[1].lines[0].get_ydata(), ledger["residual"] / abs(ledger["potential"]).max())


def test_the_work_of_a_loop_has_the_sign_of_force_along_its_way_and_an_area_is_over_the_first(recording):
    loop = normal_loop(recording.contacts["tire"])
    steps = np.diff(FORCE["approach"])
    assert loop_work(loop) == pytest.approx((0.5 * (FORCE["normal"][1:] + FORCE["normal"][:-1])) @ steps, rel=1e-12)
    field = recording.fields["tire"]
    ratio = area_ratio(field._replace(time=field.time - field.time[0]))
    assert ratio.reference == FIELD["area"][0]
    np.testing.assert_allclose(ratio.ratio, FIELD["area"] / FIELD["area"][0])
