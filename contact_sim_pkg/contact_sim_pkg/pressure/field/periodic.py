"""The pressure field of a contact that repeats along both sides of its grid: an endless rough
surface, one period of it.

The displacement of a periodic pressure is a product of transforms, `u(q) = 2 p(q) / (E* |q|)`,
without padding. The mean displacement of an endless surface has no bound, so `u(0) = 0`: the
approach is that of the *mean* planes. Free contacts, which is what a patch of a tire is, belong to
`pressure/field/rolling.py`: images in a period four contact radii wide cost 3.4 % of its pressure.

The solver is that of `pressure/field/solver.py`; it starts from the field on a grid of half as many
cells each way.

Source: Westergaard (1939), J. Appl. Mech. 6, A49; Johnson, Contact Mechanics (1985), eq. 13.1 ff.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.pressure.field.filtering import filter_of, good_shape
from contact_sim_pkg.pressure.field.halfspace import Field, HalfSpace, make_half_space
from contact_sim_pkg.pressure.field.nested import double, halve
from contact_sim_pkg.pressure.field.rolling import LEAST_OF_HALF
from contact_sim_pkg.pressure.field.solver import CONVERGED, EDGE, FieldResult, make_workspace, solve_at_load

__all__ = ["PeriodicField", "make_periodic_half_space"]

TOLERANCE_OF_HALF = 1e-2
"""Of the field on the coarser grid; the grids differ by more."""


def make_periodic_half_space(rows: int, cols: int, cell_x: float, cell_y: float, modulus: float) -> HalfSpace:
    """As `make_half_space` for one period of a surface that repeats after `rows` and `cols` cells.

    Errors as there; also a ValueError for sides that are no products of 2, 3 and 5, and for an odd
    number of rows.

    cell_x, cell_y: [m]; modulus: E* [Pa].
    """
    free = make_half_space(rows, cols, cell_x, cell_y, modulus)
    if good_shape(rows, cols) != (rows, cols):
        raise ValueError(
            f"periodic half-space: {rows} rows, {cols} cols; both must be products of 2, 3 and 5, the rows even"
        )
    wave_x = 2.0 * numpy.pi * numpy.fft.fftfreq(rows, cell_x)[:, None]
    wave_y = 2.0 * numpy.pi * numpy.fft.rfftfreq(cols, cell_y)[None, :]
    wave = numpy.hypot(wave_x, wave_y)
    compliance = numpy.divide(2.0, modulus * wave, out=numpy.zeros_like(wave), where=wave > 0.0)
    # Even along both sides, as the solver's direct sums require
    influence = numpy.fft.irfft2(compliance, (rows, cols))
    mirrored = numpy.concatenate([influence[:, :0:-1], influence], axis=1)
    return free._replace(
        influence=numpy.ascontiguousarray(influence),
        transfer=filter_of(compliance / (rows * cols), rows, cols),
        mirrored=numpy.ascontiguousarray(mirrored),
    )


class PeriodicField:
    """One pressure field [Pa] on one period; `solve_at_load` starts from nothing each time."""

    def __init__(self, half_space: HalfSpace) -> None:
        """Take what `make_periodic_half_space` made."""
        self.half_space = half_space
        self.pressure: Field = numpy.zeros((half_space.rows, half_space.cols))
        self._workspace = make_workspace(half_space)
        self._half = _half_of(half_space)
        self._gap_of_half: Field = numpy.zeros((half_space.rows // 2, half_space.cols // 2))

    def solve_at_load(self, gap: Field, load: float, tolerance: float, max_iterations: int) -> FieldResult:
        """As `field_solver.solve_at_load`, into `pressure`. A period has no edge, so the status
        EDGE does not occur.

        gap: [rows, cols] [m]; load: [N] a period; tolerance: [1].
        """
        self._start(gap, load, max_iterations)
        result = solve_at_load(
            self.half_space, self._workspace, gap, load, tolerance, max_iterations, self.pressure
        )  # refuses what is not acceptable
        return result._replace(status=CONVERGED) if result.status == EDGE else result

    def _start(self, gap: Field, load: float, max_iterations: int) -> None:
        self.pressure.fill(0.0)
        if self._half is None or gap.shape != self.pressure.shape:
            return
        halve(gap, self._gap_of_half)
        self._half.solve_at_load(self._gap_of_half, load, TOLERANCE_OF_HALF, max_iterations)
        double(self._half.pressure, self.pressure)


def _half_of(whole: HalfSpace) -> PeriodicField | None:
    """A period with cells of twice the size; None where it would be too coarse to help."""
    rows, cols = whole.rows // 2, whole.cols // 2
    if min(rows, cols) < LEAST_OF_HALF or whole.rows % 2 or whole.cols % 2 or good_shape(rows, cols) != (rows, cols):
        return None
    return PeriodicField(make_periodic_half_space(rows, cols, 2.0 * whole.cell_x, 2.0 * whole.cell_y, whole.modulus))
