"""The building stones of sections under their earlier name, for packages of others: see `records.fields`."""

from contact_sim_pkg.records.fields import LEAST, TOO_NEAR_ZERO, Section, choice, given, number, numbers, text

__all__ = ["LEAST", "TOO_NEAR_ZERO", "Section", "choice", "given", "number", "numbers", "text"]
