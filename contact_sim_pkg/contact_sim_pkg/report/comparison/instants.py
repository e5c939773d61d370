"""The films of several runs at the instants that all of them recorded, so that a difference is of two fields of one
instant.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contact_sim_pkg.bag.reader import Bag
from contact_sim_pkg.report.field_series import place_of
from contact_sim_pkg.report.film import Film, FilmReader
from contact_sim_pkg.report.reading import PATCH, contact_names
from contact_sim_pkg.report.series import FieldSeries, FloatArray, Recording

__all__ = ["SAME", "at_common_instants", "common_instants"]

SAME = 1e-6
"""[s] by which two fields of one instant may lie apart"""


def at_common_instants(bags: Sequence[Bag], recordings: Sequence[Recording]) -> list[Recording]:
    """The recordings with films of the same instants, those of the largest load and the largest peak of each run among
    them, as many as a film of its own has; where a run has no field near one of them, what its own film had.

    Args:
        bags: of the runs.
        recordings: read from them. A run that has no instant in common with the first and those between keeps its film.

    Raises:
        BagError: a message does not fit its definition.
    """
    found = [{**each.fields} for each in recordings]
    for contact in dict.fromkeys(name for fields in found for name in fields):
        places = [place for place, fields in enumerate(found) if contact in fields]
        fields = [found[place][contact] for place in places]
        common = _common_of_all([each.time for each in fields])
        if len(fields) < 2 or common.size == 0:
            continue
        most = max(each.film.time.size for each in fields)
        wanted = _thinned(common, most, fields)
        for place, each in zip(places, fields, strict=True):
            if common_instants(each.time, common).size:
                found[place][contact] = each._replace(film=_film_at(bags[place], contact, _with_own(wanted, each.film)))
    return [each._replace(fields=fields) for each, fields in zip(recordings, found, strict=True)]


def common_instants(one: FloatArray, other: FloatArray) -> FloatArray:
    """Those of ascending times [s] that are also in another ascending series."""
    return one[_distance(one, other) < SAME]


def _common_of_all(times: Sequence[FloatArray]) -> FloatArray:
    """[s] in the first one and all others that share any with those before."""
    found = times[0]
    for each in times[1:]:
        both = common_instants(found, each)
        found = both if both.size else found
    return found if any(common_instants(each, found).size for each in times[1:]) else found[:0]


def _distance(one: FloatArray, other: FloatArray) -> FloatArray:
    """[s] from each time to the nearest of the ascending others."""
    if other.size == 0:
        return np.full(one.size, np.inf)
    after = np.clip(np.searchsorted(other, one), 0, other.size - 1)
    found: FloatArray = np.minimum(np.abs(one - other[after]), np.abs(one - other[np.maximum(after - 1, 0)]))
    return found


def _thinned(common: FloatArray, most: int, fields: Sequence[FieldSeries]) -> FloatArray:
    """Every n-th common instant, and the extremes of all runs as far as they are common."""
    largest = [each.time[values.argmax()] for each in fields for values in (each.load, each.peak)]
    extremes = common[_distance(common, np.unique(largest)) < SAME]
    return np.union1d(common[:: -(-common.size // most)], extremes)


def _with_own(wanted: FloatArray, film: Film) -> FloatArray:
    """The wanted instants, and those of a film where its frames lie closer than these do, and its extremes."""
    spacing = float(np.median(np.diff(film.time))) if film.time.size > 1 else SAME
    apart = _distance(film.time, wanted)
    own = apart > 0.5 * spacing + SAME
    for values in (film.load, film.peak):
        own[values.argmax()] |= apart[values.argmax()] > SAME
    return np.union1d(wanted, film.time[own])


def _film_at(bag: Bag, contact: str, instants: FloatArray) -> Film:
    """The film of the fields of a contact at given instants."""
    names, reader, widest = contact_names(bag), FilmReader(most=instants.size), None
    topic = next(name for name, row in bag.topics.items() if row.type == PATCH and names[name] == contact)
    for message in bag.messages(topic):
        time = message.log_time * 1e-9
        if _distance(np.array([time]), instants)[0] < SAME:
            field = bag.decode(message)
            reader.add(time, field)
            widest = field if widest is None or field.rows * field.cols > widest.rows * widest.cols else widest
    return reader.finish(widest, place_of)
