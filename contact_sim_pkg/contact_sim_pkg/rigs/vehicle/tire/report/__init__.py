"""Report of a tire on a road."""

from contact_sim_pkg.records.report import ContactReport, SeriesReader

__all__ = ["TIRE_REPORT"]

TIRE_REPORT = ContactReport(
    contact="tire",
    series=(
        SeriesReader(
            name="road",
            types=("contact_msgs_defs/msg/RoadPatch",),
            reader=f"{__name__}.road_series:RoadReader",
            reduces=True,
        ),
        SeriesReader(
            name="axle", types=("contact_msgs_defs/msg/AxleForce",), reader=f"{__name__}.axle_series:AxleReader"
        ),
        SeriesReader(
            name="work", types=("contact_msgs_defs/msg/TireWork",), reader=f"{__name__}.work_series:WorkReader"
        ),
        SeriesReader(
            name="standing",
            types=("contact_msgs_defs/msg/TireStanding",),
            reader=f"{__name__}.standing_series:StandingReader",
        ),
        SeriesReader(
            name="shear",
            types=("contact_msgs_defs/msg/ContactShear",),
            reader=f"{__name__}.shear_series:ShearReader",
            reduces=True,
        ),
    ),
    sections=f"{__name__}.section:tire_sections",
    ledger=f"{__name__}.numbers:ledger_scope",
    metrics=f"{__name__}.metrics:tire_metrics",
    lead=("rolling-way",),
    parts=f"{__name__}.drawing:tire_parts",
    compared=f"{__name__}.metrics:largest_forces",
    answer=(
        "friction up to {friction} of the load, {friction:remark}",
        "load {load}, {load:remark}",
        "dynamic load coefficient {dlc}",
        "off the road {lift_off} of the time",
        "off the road for {off_the_road}",
        "peak pressure {peak_pressure}",
    ),
)
