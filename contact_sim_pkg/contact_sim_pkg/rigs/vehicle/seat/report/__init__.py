"""Report of a cushion under its load."""

from contact_sim_pkg.records.report import ContactReport

__all__ = ["SEAT_REPORT"]

SEAT_REPORT = ContactReport(
    contact="seat",
    closing_sections=f"{__name__}.section:ride_sections",
    warnings=f"{__name__}.ride:seat_warnings",
    metrics=f"{__name__}.metrics:seat_metrics",
    weighted=f"{__name__}.metrics:weighted_metrics",
    tables={"third-octaves": f"{__name__}.tables:band_table", "impedance": f"{__name__}.tables:impedance_table"},
    lead=("ride-transmissibility",),
    parts=f"{__name__}.drawing:seat_parts",
    answer=(
        "SEAT {factor}: the seat {factor:remark}",
        "suspension uses {travel_used} of its travel, stops hit {stop_hits} times",
        "T(f) peaks at {peak} at {peak_frequency}",
        "a_w {a_w}, {a_w:remark}",
        "eight hours {a_8:remark}",
        "seat {seat_peak} over a floor of {floor_peak}",
        "off the seat for {off_the_seat}",
        "without load {lift_off} of the time",
    ),
    curves=f"{__name__}.comparison:seat_curves",
    comparison=f"{__name__}.comparison:seat_comparison",
)
