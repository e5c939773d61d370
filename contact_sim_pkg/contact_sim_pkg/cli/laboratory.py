"""The laboratory, where it is installed: studies that no run, report or replay needs."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

import click

__all__ = ["AbsentError", "laboratory"]

PACKAGE = "contact_sim_lab"


class AbsentError(click.ClickException):
    """The laboratory is not installed: a sentence, and exit status 2."""

    exit_code = 2


def laboratory(module: str, what: str) -> ModuleType:
    """A module of the laboratory by its name there; AbsentError, what to install, where there is none.
    ``what`` needs it, as the user calls it.
    """
    try:
        return import_module(f"{PACKAGE}.{module}")
    except ModuleNotFoundError as error:
        if error.name != PACKAGE:
            raise
        raise AbsentError(
            f"{what} is in the laboratory, the package {PACKAGE}, which is not installed: pip install ./{PACKAGE}, or make "
            "setup, from the project's folder"
        ) from None
