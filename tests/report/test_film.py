"""Frames of a film and the series beside them: which are kept, and that no peak is lost."""

import base64
import json
from types import SimpleNamespace

import numpy as np
import pytest

from contact_sim_pkg.report import timeline
from contact_sim_pkg.report.film import MOST_FRAMES, FilmReader

ROWS, COLS = 6, 4


def field(load, peak, where=(2, 1)):
    pressure = np.zeros((ROWS, COLS))
    pressure[where] = peak
    return SimpleNamespace(
        rows=ROWS,
        cols=COLS,
        pressure=pressure.ravel(),
        load=load,
        peak=peak,
        cell_x=0.01,
        cell_y=0.02,
        origin_x=-0.03,
        origin_y=0.1,
    )


def film_of(fields):
    reader = FilmReader()
    for number, each in enumerate(fields):
        reader.add(0.01 * number, each)
    return reader.finish(fields[0], lambda inner, outer: (0, 0))


def test_few_fields_are_all_kept_and_cut_to_what_is_loaded():
    film = film_of([field(10.0, 50.0), field(20.0, 100.0, (3, 2))])
    assert film.time == pytest.approx([0.0, 0.01])
    assert film.highest == 1
    assert film.largest == 100.0
    # rows 1 to 4 and cols 0 to 3: one cell round those that are ever loaded
    assert film.frames.shape == (2, 4, 4)
    assert film.frames[0, 1, 1] == 128  # half of 255, rounded up: what is loaded is never blank
    assert film.frames[1, 2, 2] == 255
    assert np.count_nonzero(film.frames) == 2
    assert (film.origin_x, film.origin_y) == pytest.approx((-0.03 + 0.01, 0.1))


def test_of_many_fields_the_largest_load_and_peak_are_kept():
    """Odd places fall out when every second is dropped."""
    fields = [field(10.0, 50.0) for _ in range(2 * MOST_FRAMES + 7)]
    fields[101], fields[203] = field(90.0, 60.0), field(20.0, 500.0)
    film = film_of(fields)
    assert film.time.size <= MOST_FRAMES + 2
    assert (np.diff(film.time) > 0.0).all()
    assert film.time[film.load.argmax()] == pytest.approx(1.01)
    assert film.time[film.highest] == pytest.approx(2.03)
    assert film.frames.max() == 255


def test_a_field_without_pressure_is_blank():
    film = film_of([field(0.0, 0.0)])
    assert film.largest == 0.0
    assert not film.frames.any()


def test_thinning_keeps_every_extreme():
    time = np.linspace(0.0, 10.0, 50_001)
    values = np.sin(time)
    values[31_416] = 7.0
    values[12_345] = -9.0
    edges = np.linspace(0.0, 10.0, timeline.INTERVALS + 1)
    thin = timeline._on(edges, edges[:-1], time, values)
    assert thin.size == 2 * timeline.INTERVALS
    assert (thin.max(), thin.min()) == (7.0, -9.0)


def test_the_data_of_a_page_can_end_no_element(rolling):
    from contact_sim_pkg.report.reading import read_recording

    recording = read_recording(rolling)
    contact = recording.contacts["tire"]
    text = timeline.page_data(recording._replace(contacts={"</script><b>": contact}))
    assert "<" not in text
    data = json.loads(text)
    assert data["groups"][0]["series"][0]["name"] == "</script><b>"
    times = np.frombuffer(base64.b64decode(data["time"]), dtype="<f4")
    values = np.frombuffer(base64.b64decode(data["groups"][0]["series"][0]["values"]), dtype="<f4")
    assert times.size == values.size == 2 * timeline.INTERVALS
    assert values.max() == pytest.approx(contact.normal.max(), rel=0.02)


@pytest.mark.parametrize("samples", [101, 20_001])
def test_a_run_that_ended_before_another_has_a_gap_behind_it(samples):
    edges = np.linspace(0.0, 10.0, timeline.INTERVALS + 1)
    time = np.linspace(0.0, 2.0, samples)
    shown = timeline._on(edges, edges[:-1], time, 3.0 + time)
    assert shown[edges[:-1] <= 2.0] == pytest.approx(3.0 + edges[:-1][edges[:-1] <= 2.0])
    assert np.isnan(shown[edges[:-1] > 2.05]).all()
