"""What the impact model refuses, each with its sentence."""

from __future__ import annotations

__all__ = ["FoldError", "ImpactError"]


class ImpactError(ValueError):
    """An input outside the model; the message names the value and what is allowed."""


class FoldError(ImpactError):
    """With the end rule `gap` no consistent frequency exists above a loss tangent: the solution
    folds back there.
    """

    def __init__(self, loss_tangent: float, bound: float) -> None:
        super().__init__(
            f"loss tangent {loss_tangent:.6g}: with the end rule gap the model has a solution up to {bound:.6g} only; "
            "take the end rule force"
        )
        self.loss_tangent = loss_tangent
        self.bound = bound
