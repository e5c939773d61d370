"""A mass that falls on a spring with a damper: rig bouncer. And two effects for the bench's own tire."""

from contact_sim_pkg.records.contact import Contact
from contact_sim_pkg.records.effect import Effect
from contact_sim_pkg.records.rig import Rig
from contact_sim_pkg.records.topic import FORCE, WRENCH, ContactTopic

PAD = Effect(
    name="pad",
    section=f"{__name__}.schema:PadSection",
    help="spring and damper under the mass",
    source="Johnson, Contact Mechanics, section 6.5",
    carries=True,
    feeds=("force", "wrench"),
)
FOOT = Contact(
    name="foot",
    help="contact between mass and pad",
    section=f"{__name__}.schema:FootSection",
    section_help="mass above a pad (rig bouncer)",
    effects=(PAD,),
    topics=(FORCE, WRENCH),
)
RIGS = (
    Rig(
        name="bouncer",
        help="mass that bounces on a pad",
        contacts=(FOOT,),
        scenes={"bouncer_drop": 100},
        simulation=f"{__name__}.simulation:BouncerSimulation",
    ),
)

LOAD_CHANGE = Effect(
    name="load_change",
    section=f"{__name__}.schema:LoadChangeSection",
    help="rate of the tire's normal force, smoothed",
    feeds=("load_change",),
    publishes="load_change",
    topic=ContactTopic("load_change", "contact_msgs_defs/msg/Series"),
    observer=f"{__name__}.load_change:LoadChange",
)
SNUBBER = Effect(
    name="snubber",
    section=f"{__name__}.snubber:SnubberSection",
    help="rubber snubber between wheel and body",
    feeds=("force", "wrench"),
    elements=f"{__name__}.snubber_kernel:snubber_of",
)
EFFECTS = {"tire": (LOAD_CHANGE, SNUBBER)}
