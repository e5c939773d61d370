"""One run as a loop over numbered blocks, without ROS. Called, it runs a scene: `library.run`."""

import sys
from types import ModuleType
from typing import Any


class _Callable(ModuleType):
    def __call__(self, scene: Any, directory: Any = None, *, progress: bool = True) -> Any:
        """As `library.run`, under the name that `from contact_sim_pkg import run` gives it."""
        from contact_sim_pkg.public import on_use

        return on_use("contact_sim_pkg", {"run": "contact_sim_pkg.library:run"})("run")(
            scene, directory, progress=progress
        )


sys.modules[__name__].__class__ = _Callable
