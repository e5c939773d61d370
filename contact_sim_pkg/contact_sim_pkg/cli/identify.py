"""`bench identify`: inertia, impulses and what stays unidentified, from the motion in a bag."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from contact_sim_pkg.cli.output.say import say
from contact_sim_pkg.cli.output.tables import json_option, overwrite_option, print_json, show_sections
from contact_sim_pkg.cli.output.working import doing

if TYPE_CHECKING:
    from contact_sim_pkg.identify.identify import Identification
    from contact_sim_pkg.identify.motion.geometry import Shape
    from contact_sim_pkg.identify.motion.wrench import ExternalWrench
    from contact_sim_pkg.identify.readers.axes import Axes
    from contact_sim_pkg.identify.readers.body_states import RecordedStates
    from contact_sim_pkg.records.table import Section

VECTOR = (float, float, float)
FILE = click.Path(path_type=Path)
AXES = click.Choice(["auto", "world", "body"])


@click.command("identify")
@click.argument("bag", type=FILE)
@click.option("--topic", metavar="NAME", help="Odometry or PoseStamped; found by type otherwise.")
@click.option("--twist-topic", metavar="NAME", help="TwistStamped beside a PoseStamped.")
@click.option(
    "--twist-axes",
    type=AXES,
    default="auto",
    help="Axes of the twist; auto: the child_frame_id of Odometry, the frame of the header for TwistStamped; the "
    "result reports the choice.",
)
@click.option("--box", type=VECTOR, metavar="X Y Z", help="The body is a box of these lengths [m].")
@click.option("--sphere", type=float, metavar="R", help="The body is a sphere of this radius [m].")
@click.option(
    "--hull", type=FILE, metavar="FILE", help="The body is the hull of the points in a CSV file: x, y, z [m]."
)
@click.option("--ground", type=float, default=0.0, metavar="HEIGHT", help="Height of the ground along its normal [m].")
@click.option(
    "--normal",
    type=VECTOR,
    default=(0.0, 0.0, 1.0),
    metavar="X Y Z",
    help="Normal of the ground; gravity is unchanged.",
)
@click.option(
    "--gravity",
    type=float,
    default=9.81,
    metavar="G",
    help="[m/s^2], along -z of the frame of the poses; 9.81 otherwise.",
)
@click.option(
    "--force", type=VECTOR, metavar="X Y Z", help="Known constant force at the centre of mass [N], world axes."
)
@click.option("--torque", type=VECTOR, metavar="X Y Z", help="Known constant torque [N m], world axes.")
@click.option(
    "--force-topic",
    metavar="NAME",
    help="WrenchStamped: the known wrench over time. Straight lines join its samples: record it at the rate of the states.",
)
@click.option(
    "--force-axes",
    type=AXES,
    default="auto",
    help="Axes of the wrench of --force-topic; auto: world axes where its header names the frame of the poses, else body "
    "axes; the result reports the choice.",
)
@click.option(
    "--friction",
    type=float,
    metavar="MU",
    help="Known friction coefficient: a slide under a known force then identifies the mass. Else a result.",
)
@click.option(
    "--noise",
    type=(float, float, float, float),
    metavar="X R V W",
    help="Standard deviations of position [m], rotation [rad], velocity [m/s], angular velocity [rad/s]; "
    "estimated from the flights otherwise.",
)
@click.option("--plot", type=FILE, metavar="FILE", help="Motion, impulses and parameters as a picture.")
@overwrite_option
@json_option
def command(
    bag: Path, topic: str | None, twist_topic: str | None, twist_axes: Axes, box: tuple[float, float, float] | None,
    sphere: float | None, hull: Path | None, ground: float, normal: tuple[float, float, float], gravity: float,
    force: tuple[float, float, float] | None, torque: tuple[float, float, float] | None, force_topic: str | None,
    force_axes: Axes, friction: float | None, noise: tuple[float, float, float, float] | None, plot: Path | None,
    overwrite: bool, as_json: bool,
) -> None:  # fmt: skip
    """Inertia and impulses of the rigid body whose motion BAG holds.

    BAG: of the bench (bench/motion), or any with Odometry, or PoseStamped and TwistStamped, of the
    centre of mass. Contacts and their modes are found. Parameters that the motion does not
    identify, such as the mass without a known force, are named.

    A cut MCAP is read as far as its whole chunks go.

    Gravity acts along -z of the world frame in which the poses are given: z is up. --normal turns
    the ground only. Turn a recording with y up or NED before, or give the weight as known force
    (--gravity 0 --force ...), which then fixes the mass.

    Of each contact: c_n/m, c_t/m; friction, mu for a straight slide, else a lower bound for a
    contact that sticks, reverses or turns (JSON: friction, friction_at_least); Newton's e, the
    ratio -u_n+/u_n- of normal speeds (JSON: newton_restitution), which with friction is not the e
    of an energetic or Poisson rule.
    """
    from contact_sim_pkg.identify.errors import IdentificationError
    from contact_sim_pkg.identify.identify import Setup, identify
    from contact_sim_pkg.identify.motion.geometry import plane
    from contact_sim_pkg.identify.motion.states import SampleNoise
    from contact_sim_pkg.identify.motion.wrench import constant
    from contact_sim_pkg.identify.readers.body_states import read_body_states
    from contact_sim_pkg.identify.report import rows as identification_rows
    from contact_sim_pkg.records.table import Section

    if plot is not None:
        from contact_sim_pkg.report.drawing import check_picture

        check_picture(plot, [bag, hull], overwrite=overwrite)
    shape = _shape(box, sphere, hull)
    _check_wrench_options((force, torque) != (None, None), force_topic, force_axes)
    doing(f"identify: reading {bag}")
    recorded = read_body_states(bag, topic, twist_topic, twist_axes)
    wrench = constant(force, torque)
    if force_topic is not None:
        recorded, wrench = _wrench(bag, recorded, force_topic, force_axes)
    # notes first: a refusal ends the command before anything else is shown
    spreads = None if noise is None else SampleNoise(*noise)
    setup = Setup(shape, plane(normal, ground), wrench, gravity, spreads, friction=friction)
    for note in recorded.notes:
        say(f"bench: {note}", err=True)
    try:
        doing(f"identify: contacts and parameters of {len(recorded.states.time)} samples")
        found = identify(recorded.states, setup)
    except IdentificationError:
        for line in recorded.reading:
            say(f"bench: {line}", err=True)
        raise
    if as_json:
        heads = {"bag": str(bag), "first_stamp_ns": recorded.origin, "reading": list(recorded.reading)}
        print_json({**heads, **identification_rows.facts(found)})
    else:
        reading = Section("Reading of the bag", [{"what was read, and how": line} for line in recorded.reading])
        show_sections([*_sections(found), reading])
    if plot is not None:
        from contact_sim_pkg.identify.report.plot import write_plot

        write_plot(found, plot, overwrite=overwrite)


def _shape(box: tuple[float, float, float] | None, sphere: float | None, hull: Path | None) -> Shape:
    from contact_sim_pkg.identify.motion import geometry
    from contact_sim_pkg.identify.report.input import hull_of_file

    if sum(each is not None for each in (box, sphere, hull)) != 1:
        raise click.UsageError("the shape of the body is needed once: --box X Y Z, --sphere R or --hull FILE")
    if box is not None:
        return geometry.box(box)
    return hull_of_file(hull) if hull is not None else geometry.sphere(float(sphere or 0.0))


def _check_wrench_options(constant: bool, topic: str | None, axes: Axes) -> None:
    if topic is not None and constant:
        raise click.UsageError("give the known wrench once: --force-topic, or --force and --torque")
    if topic is None and axes != "auto":
        raise click.UsageError("--force-axes goes with --force-topic; --force and --torque are in world axes")


def _wrench(bag: Path, recorded: RecordedStates, topic: str, axes: Axes) -> tuple[RecordedStates, ExternalWrench]:
    """The wrench of a topic, and the states with what is to report about it."""
    from contact_sim_pkg.identify.motion.wrench import sampled
    from contact_sim_pkg.identify.readers.wrenches import read_wrench

    samples, notes, reading = read_wrench(bag, topic, recorded, axes)
    states = recorded._replace(notes=(*recorded.notes, *notes), reading=(*recorded.reading, reading))
    return states, sampled(*samples)


def _sections(found: Identification) -> list[Section]:
    """Sections of the tables: parameters, warnings, what is not identifiable, contacts."""
    from contact_sim_pkg.identify.report.rows import contact_rows, parameter_rows
    from contact_sim_pkg.records.table import Section

    where = "motion in a plane" if found.axis is not None else "motion in space"
    title = f"Parameters: {where}, {found.flights} flights, rank {found.rank} of {found.unknowns} unknowns"
    parts = [Section(title, [_digits(row) for row in parameter_rows(found)])]
    if found.warnings:
        parts.append(Section("Consistency warnings", [{"warning": line} for line in found.warnings]))
    if found.unobservable:
        parts.append(Section("Not identifiable", [{"what and why": line} for line in found.unobservable]))
    noise = found.noise
    spreads = (
        f"noise of the samples: position {noise.position:.2g} m, rotation {noise.rotation:.2g} rad, velocity "
        f"{noise.velocity:.2g} m/s, angular velocity {noise.angular_velocity:.2g} rad/s"
    )
    parts.append(
        Section(
            f"Contacts: {len(found.contacts)}", [_digits(row) for row in contact_rows(found)], f"{HEADS}; {spreads}"
        )
    )
    return parts


HEADS = (
    "friction: |c_t|/c_n, which is mu where the slip kept its direction and a lower bound (>=) where it stuck, reversed or "
    "turned; Newton's e: ratio -u_n+/u_n- of normal speeds, not the e of an energetic or Poisson rule where there is friction"
)
EXACT = ("value", "time [s]", "c_n/m [m/s]", "c_t/m [m/s]", "c_n [N s]", "c_t [N s]")
DIGITS = 9


def _digits(row: dict[str, Any]) -> dict[str, Any]:
    """The row with more digits where a table's three are too few."""
    return {
        name: f"{value:.{DIGITS}g}" if name in EXACT and isinstance(value, float) else value
        for name, value in row.items()
    }
