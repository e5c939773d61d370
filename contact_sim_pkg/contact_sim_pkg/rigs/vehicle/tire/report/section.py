"""The part of the page on the rolling tire: pictures and tables; what the run lacks is absent."""

from __future__ import annotations

from contact_sim_pkg.report.drawing import Picture
from contact_sim_pkg.report.figures.contact import contact_section
from contact_sim_pkg.report.figures.peaks import peak_curves
from contact_sim_pkg.report.page import FREQUENCY, Section
from contact_sim_pkg.report.series import FieldSeries, Recording
from contact_sim_pkg.report.signal.peaks import filtered_signals, peak_rows
from contact_sim_pkg.rigs.vehicle.tire.report.axle_series import axle_of
from contact_sim_pkg.rigs.vehicle.tire.report.closed_form import TireReference, tire_reference
from contact_sim_pkg.rigs.vehicle.tire.report.figures_field import (
    displacement_picture,
    relative_pressure_picture,
    stress_picture,
)
from contact_sim_pkg.rigs.vehicle.tire.report.figures_footprint import footprint_stages
from contact_sim_pkg.rigs.vehicle.tire.report.figures_road import (
    Rolling,
    along_the_road,
    force_over_road,
    near_largest_load,
    whole_way,
)
from contact_sim_pkg.rigs.vehicle.tire.report.figures_shear import friction_over_slip, friction_over_time, shear_maps
from contact_sim_pkg.rigs.vehicle.tire.report.figures_spectrum import load_spectrum
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import one_obstacle
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import TIRE
from contact_sim_pkg.rigs.vehicle.tire.report.published import published_section
from contact_sim_pkg.rigs.vehicle.tire.report.road_series import road_of
from contact_sim_pkg.rigs.vehicle.tire.report.shear_series import shear_of
from contact_sim_pkg.rigs.vehicle.tire.report.tables import footprint_table, peak_table
from contact_sim_pkg.rigs.vehicle.tire.report.travel import wheel_travel
from contact_sim_pkg.rigs.vehicle.travel_report import travel_picture

KEY = "rolling"
FRICTION_KEY = "friction"


def tire_sections(number: int, recording: Recording) -> list[Section]:
    """Contact, rolling tire, friction and load by frequency. Call inside `drawing.style()`; the recording has a
    contact of this name.
    """
    rolling = _rolling_section(recording)
    friction = Section(FRICTION_KEY, "Friction of the tire", _friction_pictures(recording))
    spectrum = load_spectrum(KEY, TIRE, recording.contacts[TIRE]) if one_obstacle(recording.scene) is None else None
    by_frequency = Section("tire-load", "Load of the tire", [spectrum] if spectrum else [], part=FREQUENCY)
    published = published_section(recording)
    found = [contact_section(number, TIRE, recording), rolling, friction, by_frequency]
    return found if published is None else [*found, published]


def _rolling_section(recording: Recording) -> Section:
    contact, field, road = recording.contacts[TIRE], recording.fields.get(TIRE), road_of(recording)
    reference = tire_reference(recording.scene)
    travel = road.travel if road is not None else None
    signals = filtered_signals(contact, recording.motion)
    pictures: list[Picture] = []
    if road is not None:
        rolling = Rolling(contact, field, road, reference, axle_of(recording))
        whole = whole_way(rolling)
        if whole is not None:
            pictures.append(force_over_road(KEY, TIRE, rolling, whole))
            pictures.append(along_the_road(KEY, TIRE, rolling, near_largest_load(rolling, whole)))
    if signals:
        pictures.append(peak_curves(KEY, TIRE, signals))
    if field is not None:
        pictures.append(footprint_stages(KEY, TIRE, field, travel))
    pictures += _under_load(field, reference)
    pictures += travel_picture(wheel_travel(recording))
    tables = [footprint_table(field, reference)] if field is not None else []
    tables += [peak_table(peak_rows(signals))] if signals else []
    return Section(KEY, "Rolling tire", pictures, tables)


def _friction_pictures(recording: Recording) -> list[Picture]:
    """Empty without shear in the bag."""
    shear = shear_of(recording)
    if shear is None:
        return []
    field, contact = recording.fields.get(TIRE), recording.contacts[TIRE]
    time, load = (contact.time, contact.normal) if field is None else (field.time, field.load)
    found = [
        friction_over_time(FRICTION_KEY, TIRE, shear),
        friction_over_slip(FRICTION_KEY, TIRE, shear, time, load),
        shear_maps(FRICTION_KEY, TIRE, shear),
    ]
    return [each for each in found if each is not None]


def _under_load(field: FieldSeries | None, reference: TireReference | None) -> list[Picture]:
    """What the heaviest field does; needs a field with load, and the scene's tire."""
    if field is None or reference is None or field.heaviest.load <= 0.0:
        return []
    heaviest = field.heaviest
    found = [
        displacement_picture(KEY, heaviest, reference),
        relative_pressure_picture(KEY, heaviest, reference),
        stress_picture(KEY, heaviest, reference.body.poisson_ratio),
    ]
    return [each for each in found if each is not None]
