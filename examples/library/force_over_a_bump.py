"""Largest force of a tire over a bump, by speed."""

from contact_sim_pkg import load_scene, run, series

for speed in (5.0, 10.0, 15.0):
    scene = load_scene("tire_bump", "duration=0.5", f"travel.speed={speed}", "road.position=1.0")
    force = series(run(scene), "tire/force")
    place = force["normal"].argmax()
    print(f"{speed:4.1f} m/s: {force['normal'][place]:6.0f} {force.units['normal']} at {force.time[place]:.3f} s")
