"""Effects of the contact between roller and shaft."""

from __future__ import annotations

from contact_sim_pkg.records.effect import Effect, choice_of_model

__all__ = ["ROLLER_EFFECTS"]

_SCHEMA = f"{__package__}.schema"
_PAPER = "Rolling Contact"
_QUESTION = choice_of_model("what the roller does is the question of the scene")

ROLLER_EFFECTS = (
    Effect(
        name="normal_elastic", section=f"{_SCHEMA}:RollerElastic", help="elliptic contact", source=_PAPER, carries=True,
        feeds=("force", "wrench"), called_for=_QUESTION,
    ),
    Effect(
        name="tilt_yaw", section=f"{_SCHEMA}:TiltYawSection", help="tilt and yaw of the roller", source=_PAPER,
        needs=("normal_elastic",), publishes="stability", feeds=("contact", "stability"), called_for=_QUESTION,
    ),
    Effect(
        name="gyroscope", section=f"{_SCHEMA}:Gyroscope", help="moments of the spinning roller", source=_PAPER,
        needs=("tilt_yaw",), feeds=("contact", "stability"), called_for=_QUESTION,
    ),
    Effect(
        name="rolling_friction", section=f"{_SCHEMA}:RollingFrictionSection", help="rolling resistance", source=_PAPER,
        needs=("tilt_yaw",), feeds=("contact", "stability"), called_for=_QUESTION,
    ),
    Effect(
        name="shaft_bending", section=f"{_SCHEMA}:ShaftBending", help="the shaft is bent", source=_PAPER,
        needs=("normal_elastic",), feeds=("contact", "force"), called_for=_QUESTION,
    ),
    Effect(
        name="track_waves", section=f"{_SCHEMA}:TrackWaves", help="heave over the heights of the track", source=_PAPER,
        needs=("normal_elastic",), publishes="track", feeds=("track", "contact", "force"), called_for=_QUESTION,
    ),
    Effect(
        name="subsurface", section=f"{_SCHEMA}:Subsurface", help="stress below the surface and dangerous volumes",
        source=_PAPER, needs=("normal_elastic",), publishes="volumes", feeds=("volumes",), called_for=_QUESTION,
    ),
    Effect(
        name="damage", section=f"{_SCHEMA}:Damage", help="wear of the track where its dangerous volume is large",
        source=_PAPER, needs=("track_waves", "subsurface"), feeds=("track", "contact", "force"), called_for=_QUESTION,
    ),
)  # fmt: skip
