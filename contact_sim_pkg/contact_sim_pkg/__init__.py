"""Contact forces and pressure fields of simulated rigs, as ROS 2 topics and bags.

As a library: ``from contact_sim_pkg import compare, load_scene, open_bag, run, series, sweep``; laws of a contact
point in ``contact_sim_pkg.laws``, pressure fields in ``contact_sim_pkg.pressure``, rigs in
``contact_sim_pkg.rigs``. `docs/library.md` has examples. ``run`` and ``sweep`` are also the packages of that name:
they can be called.
"""

from contact_sim_pkg.public import on_use

__version__ = "0.1.0"
__all__ = ["__version__", "load_scene", "open_bag", "series"]

__getattr__ = on_use(
    __name__,
    {
        "BagError": "contact_sim_pkg.bag.errors:BagError",
        "ContactBench": "contact_sim_pkg.steering.contact_bench:ContactBench",
        "RunError": "contact_sim_pkg.run.errors:RunError",
        "SceneError": "contact_sim_pkg.scene.errors:SceneError",
        "compare": "contact_sim_pkg.library:compare",
        "fit": "contact_sim_pkg.library:fit",
        "load_scene": "contact_sim_pkg.library:load_scene",
        "open_bag": "contact_sim_pkg.library:open_bag",
        "series": "contact_sim_pkg.library:series",
        "sweep": "contact_sim_pkg.library:sweep",
    },
)
