"""How the load divides between the contact and the bending of the shaft.

Contact `u_c = k_c F_c^(2/3)`, cantilever `u_b = k_b F_b`. In *series* all of the load goes through
the contact and bends the shaft; in *parallel* there are two paths and the complementary energy
`(3/5) k_c F_c^(5/3) + k_b F_b^2 / 2` is least: `k_c F_c^(2/3) = k_b (F - F_c)`. The paper's energy
identity (eq 7) holds for every split and fixes none.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import entry, kernel

__all__ = ["load_of_approach", "parallel_contact_load"]


@entry
def parallel_contact_load(contact_coefficient: float, bending_compliance: float, load: float) -> float:
    """F_c [N] of the parallel split; contact_coefficient: k_c [m/N^(2/3)], bending_compliance: k_b
    [m/N], load >= 0 [N].

    k_c > 0, k_b >= 0; a rigid shaft, k_b = 0, takes all of it. Not checked.
    """
    if not bending_compliance * load > 0.0:
        return 0.0
    return _cube_root_load(contact_coefficient, bending_compliance, bending_compliance * load)


@entry
def load_of_approach(contact_coefficient: float, bending_compliance: float, approach: float) -> float:
    """F [N] of `k_c F^(2/3) + k_b F = approach` (series), 0 where the approach [m] is not above 0;
    k_c > 0, k_b >= 0.

    Not checked.
    """
    if not approach > 0.0:
        return 0.0
    return _cube_root_load(contact_coefficient, bending_compliance, approach)


@kernel
def _cube_root_load(contact_coefficient: float, bending_compliance: float, approach: float) -> float:
    """Newton for `u = F^(1/3)` on the convex `k_b u^3 + k_c u^2`, from above."""
    root = (approach / contact_coefficient) ** 0.5
    if bending_compliance * root > contact_coefficient:
        root = min(root, (approach / bending_compliance) ** (1.0 / 3.0))
    for _ in range(60):
        value = (bending_compliance * root + contact_coefficient) * root * root - approach
        step = value / ((3.0 * bending_compliance * root + 2.0 * contact_coefficient) * root)
        root -= step
        if not step > 1e-16 * root:
            break
    return float(root * root * root)
