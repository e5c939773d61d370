"""Lines that turn a run into files, numbers and pictures for people, broken one at a time (`listed` says how).

Report, export, recovery, replay, and what the fixtures of physics and papers once hid because two of their quantities
were equal.
"""

from tests.mutants.listed import Mutant

READING = ("report/test_reading",)
SEAT, TIRE = ("vehicle/test_seat_metrics",), ("report/test_tire_metrics",)
MAT, RIDE = ("metrics/test_mat",), ("signal/test_metrics",)
FIGURES = ("figures/test_contact",)
RECOVER, UNFINISHED, REPLAY = ("bag/test_recover",), ("bag/test_unfinished",), ("protocol/test_player",)

SURVIVED_ONCE = (
    Mutant(
        "foreign._factor",
        "if horizontal and chosen.weighting is WD",
        "if horizontal",
        ("metrics/test_of_bag::test_1_4_belongs_to_a_horizontal_axis_under_the_horizontal_weighting",),
    ),
    Mutant("seat/report/metrics.seat_metrics", "contact.normal <= 0.0", "contact.normal < 0.0", SEAT),
    Mutant("metrics/mat.zones", '("left", place_y > middle), ("right"', '("right", place_y > middle), ("left"', MAT),
    Mutant(
        "export/table._columns",
        "[field.unit] * len(names)",
        "[fields.named[0].unit] * len(names)",
        ("export/test_export::test_columns_of_bodies_have_the_unit_of_their_quantity_and_the_rows_of_their_body",),
    ),
    Mutant("report/energy.relative_residual", "np.abs(ledger.residual).max()", "np.abs(ledger.residual)[-1]", READING),
    Mutant("compare/estimated.accuracy_numbers", "max(error, force) for", "error for", READING),
    Mutant("protocol/player.Player.wait", "* 1e-9 / self._rate", "* 1e-9 * self._rate", REPLAY),
    Mutant("bag/recover.recover", "publish_time=message.publish_time", "publish_time=message.log_time", RECOVER),
    Mutant(
        "brush/belt_motion._move",
        "way * (belt[YAW] + 0.5 * turn)",
        "way * belt[YAW]",
        ("test_belt_motion::test_a_yawing_belt_rolls_aside_by_the_integral_of_its_yaw",),
        interpreted=True,
    ),
    Mutant(
        "contact/load_split._impulses",
        "_pull(J, work, y, row + 2) if problem.width == SPACE else 0.0",
        "0.0",
        ("contact/test_solver::test_sticking_corners_pulled_along_both_tangents_share_the_load_with_the_least_norm",),
        interpreted=True,
    ),
    Mutant(
        "roller/wear.track_under",
        "2.0 * contact.along_y",
        "contact.along_y",
        ("test_corrugation::test_a_track_lies_under_the_whole_length_of_the_contact_with_its_own_hardness",),
    ),
    Mutant(
        "roller/wear.hardness_round",
        "limits[0]]",
        "limits[-1]]",
        ("test_corrugation::test_the_hardness_goes_on_from_the_last_place_to_the_first",),
    ),
    Mutant(
        "impact/effect_outputs.history_of",
        "creep.standard_solid_at(modulus, tangent, frequency, effect.instant_ratio)",
        "creep.standard_solid_at(modulus, tangent, frequency, 2.0)",
        ("test_viscoelasticity::test_the_standard_solid_of_a_run_has_the_ratio_of_its_scene",),
        interpreted=True,
    ),
    Mutant(
        "identifiability/system_axes.moments_of",
        "len(rest) - rank",
        "len(rest)",
        ("systems/test_axes::test_deviations_are_those_that_scipy_fits",),
    ),
)

REPORT = (
    # Vibration
    Mutant("signal/metrics.ride_metrics", "np.abs(weighted).max()", "weighted.max()", RIDE),
    Mutant(
        "metrics/foreign._accelerations",
        "a_w * _factor(each, vertical)",
        "a_w",
        ("metrics/test_of_bag::test_the_highest_axis_decides_on_the_day_with_1_4_of_x_and_y",),
    ),
    Mutant(
        "metrics/foreign._together",
        'endswith(".a_w")',
        'endswith((".a_w", ".mtvv"))',
        ("metrics/test_of_bag::test_the_highest_axis_decides_on_the_day_with_1_4_of_x_and_y",),
    ),
    Mutant(
        "excitation/judge.judge_stamps",
        "len(steps) / float",
        "len(time) / float",
        ("metrics/test_of_bag::test_the_rate_is_that_of_the_steps_between_samples",),
    ),
    Mutant("seat/report/metrics.vibration_metrics", "floor.vibration_dose", "floor.weighted_rms", SEAT),
    Mutant("seat/report/metrics.map_metrics", "field.peak[carries]", "field.mean[carries]", SEAT),
    Mutant("seat/report/metrics.occupant_metrics", "signals.approach[touching]", "signals.approach", SEAT),
    # Maps
    Mutant(
        "metrics/mat.mat_metrics",
        '"centre of pressure, forward", round(1e3 * centre_x',
        '"centre of pressure, forward", round(1e3 * centre_y',
        MAT,
    ),
    # Tire
    Mutant("tire/report/metrics._load", "normal + ride.contact.impulses", "normal", TIRE),
    Mutant("tire/report/metrics._standing", "1e4 * stands.area", "1e3 * stands.area", TIRE),
    Mutant("report/field_series.peak_over", "(cell_x, cell_y)", "(cell_y, cell_x)", TIRE),
    Mutant("tire/report/metrics._along", "-float(axle.longitudinal", "float(axle.longitudinal", TIRE),
    # Series of a bag
    Mutant(
        "report/reading.motion_series",
        '("position", "acceleration", "velocity")',
        '("position", "velocity", "acceleration")',
        READING,
    ),
    Mutant("report/reading._sample_times", "start + period", 'columns["time"][0] + period', READING),
    Mutant("report/reading._duration", "float(each.time[-1]) + each.sample_period", "float(each.time[-1])", READING),
    Mutant("report/reading._estimates", "max(before.error, error)", "error", READING),
    Mutant("report/energy.throughput", "np.abs(entry).max()", "entry.max()", READING),
    # Pictures
    Mutant("figures/contact.load_over_time", '"approach, mm"', '"approach, m"', FIGURES),
    Mutant("figures/contact.footprint_over_time", '"area, cm²"', '"area, mm²"', FIGURES),
    Mutant("figures/contact._mark_peak", "origin_x + row", "origin_x + col", FIGURES),
    Mutant("figures/maps.set_window", "window.high_y, window.low_y", "window.low_y, window.high_y", FIGURES),
    Mutant("figures/maps.extent", "field.origin_x - field.cell_x / 2", "field.origin_x", FIGURES),
    Mutant("signal/lift_off.lifted_intervals", "contact.time[-1] + contact.sample_period", "contact.time[-1]", FIGURES),
    Mutant("signal/loops.area_ratio", "field.area / reference", "field.load / field.load[0]", FIGURES),
)

FILES = (
    # Export
    Mutant(
        "export/table._columns",
        "np.repeat(np.cumsum(counts) - counts, counts)",
        "0",
        ("export/test_export::test_rows_of_samples_equal_those_that_rosbags_reads",),
    ),
    Mutant(
        "export/table.time_of",
        "message.header.stamp.nanosec) / 1e9",
        "0) / 1e9",
        ("export/test_export::test_scalars_of_a_message_are_a_row_with_its_stamp",),
    ),
    Mutant(
        "export/write._write_map",
        "(rows, cols)):",
        "(cols, rows)):",
        ("export/test_export::test_a_map_lies_as_its_message_has_it",),
    ),
    Mutant(
        "export/table._counts",
        ".max(axis=0)",
        ".min(axis=0)",
        ("export/test_export::test_a_column_that_a_block_lacks_is_empty_there_and_full_beside_it",),
    ),
    Mutant(
        "export/table.maps_of",
        "(each.shape[0], each.shape[1])",
        "(each.shape[1], each.shape[0])",
        ("export/test_export::test_a_map_lies_as_its_message_has_it",),
    ),
    Mutant(
        "export/table.UNITS",
        '"torque": "N m"',
        '"torque": "N"',
        ("export/test_export::test_a_foreign_topic_has_its_units_and_each_element_its_own_column",),
    ),
    # Recovery
    Mutant("bag/recover.recover", "topics, bag.metadata)", "topics, {})", RECOVER),
    Mutant("bag/recover.recover", "*lost_quality, *left]", "*lost_quality]", RECOVER),
    Mutant("bag/recover.recover", "sequence=message.sequence", "sequence=0", RECOVER),
    Mutant("mcap/chunked_file.ChunkedFile.end_chunk", "min(times), max(times)", "times[0], times[-1]", RECOVER),
    Mutant("bag/unfinished.leave_metadata", "else first.log_time", "else 0", UNFINISHED),
    # Replay
    Mutant(
        "protocol/player.Player._advance", "message.log_time < self._start", "message.log_time <= self._start", REPLAY
    ),
    Mutant("protocol/player.Player.messages", "self._total - self._skipped", "self._total", REPLAY),
    Mutant("protocol/player.Player._pass_length", "self._bag.end - self._start", "self._bag.end", REPLAY),
    Mutant("protocol/player.Player.progress", "min(self.position(now), self._bag.end)", "self.position(now)", REPLAY),
    Mutant("protocol/player.Player.resume", "if self.paused", "if now >= 0.0", REPLAY),
)

OUTPUTS = (*SURVIVED_ONCE, *REPORT, *FILES)
