"""Effects of the contact between roller and shaft."""

from __future__ import annotations

from contact_sim_pkg.records.effect import Effect

__all__ = ["ROLLER_EFFECTS"]

_SCHEMA = f"{__package__}.schema"
_PAPER = "Rolling Contact"

ROLLER_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:RollerElastic", help="elliptic contact", source=_PAPER, carries=True,
        feeds=("force", "wrench"),
    ),
    Effect(
        name="tilt_yaw", section=f"{_SCHEMA}:TiltYawSection", help="tilt and yaw of the roller", source=_PAPER,
        needs=("normal_elastic",), publishes="stability", feeds=("contact", "stability"),
    ),
    Effect(
        name="gyroscope", section=f"{_SCHEMA}:Gyroscope", help="moments of the spinning roller", source=_PAPER,
        needs=("tilt_yaw",), feeds=("contact", "stability"),
    ),
    Effect(
        name="rolling_friction", section=f"{_SCHEMA}:RollingFrictionSection", help="rolling resistance", source=_PAPER,
        needs=("tilt_yaw",), feeds=("contact", "stability"),
    ),
    Effect(
        name="shaft_bending", section=f"{_SCHEMA}:ShaftBending", help="the shaft is bent", source=_PAPER,
        needs=("normal_elastic",), feeds=("contact", "force"),
    ),
    Effect(
        name="track_waves", section=f"{_SCHEMA}:TrackWaves", help="heave over the heights of the track", source=_PAPER,
        needs=("normal_elastic",), publishes="track", feeds=("track", "contact", "force"),
    ),
    Effect(
        name="subsurface", section=f"{_SCHEMA}:Subsurface", help="stress below the surface and dangerous volumes",
        source=_PAPER, needs=("normal_elastic",), publishes="volumes", feeds=("volumes",),
    ),
    Effect(
        name="damage", section=f"{_SCHEMA}:Damage", help="wear of the track where its dangerous volume is large",
        source=_PAPER, needs=("track_waves", "subsurface"), feeds=("track", "contact", "force"),
    ),
)  # fmt: skip
