"""Rig, effect, command, road, vibration, metric and format of another package: by pip, or by colcon beside the bench."""

from setuptools import setup

setup(
    name="bouncer_rig",
    version="0.1.0",
    packages=["bouncer_rig"],
    package_data={"bouncer_rig": ["scenes/*.yaml"]},
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/bouncer_rig"]),
        ("share/bouncer_rig", ["package.xml"]),
    ],
    license="Apache-2.0",
    entry_points={
        "contact_sim_pkg.rigs": ["bouncer = bouncer_rig:RIGS"],
        "contact_sim_pkg.effects": ["load_change = bouncer_rig:EFFECTS"],
        "contact_sim_pkg.commands": ["bounces = bouncer_rig.bounces"],
        "contact_sim_pkg.roads": ["washboard = bouncer_rig.washboard"],
        "contact_sim_pkg.vibrations": ["knock = bouncer_rig.knock"],
        "contact_sim_pkg.metrics": ["impacts = bouncer_rig.metrics"],
        "contact_sim_pkg.exports": ["md = bouncer_rig.markdown"],
    },
)
