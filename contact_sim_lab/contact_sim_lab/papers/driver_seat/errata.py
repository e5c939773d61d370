"""Errata of *Driver and Seat*: printed, corrected, how it was found, and its effect."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = (
    Erratum(
        "2",
        "scalar g compared with a unit vector; p1, p2 independent",
        "g_i(p) ≤ -d/2 for every constraint function of body i, one common p",
        "units",
        ('as printed the two bodies decouple and d is twice the smaller body depth; the "vectors" are columns of ones'),
    ),
    Erratum(
        "4, 5",
        "no absolute values",
        "signed powers",
        "a limit",
        "outside the first quadrant real powers of negative numbers are undefined for non-even n",
    ),
    Erratum(
        "6",
        "contact force added to the director (moment) equation; no N3",
        "F_c as traction in the first bracket, transverse shear N3 in the second",
        "units",
        (
            "first bracket N/m², second N/m; a force in N fits neither without the Dirac distribution, and "
            "a normal force does work on u, not on the director at mid-surface"
        ),
    ),
    Erratum("8", "δ̇^q", "sgn(δ̇)|δ̇|^q", "a limit", "q = 2 would push during restitution; non-integer q gives NaN"),
    Erratum(
        "8",
        'B "from restitution", no formula',
        "d(1+e) = ln[(1+d)/(1-de)], d = λ v0",
        "a number",
        "the usual 1.5(1-e)/v0 gives e = 0.663 when 0.5 is requested",
    ),
    Erratum("9", "unbounded F_t", "Coulomb limit", "a limit", "otherwise a slip phase cannot exist"),
    Erratum(
        "10",
        'integral over "the collision"',
        "restitution phase only (and W_c over compression)",
        "a limit",
        "over the whole collision -∫Fδ̇dt = W_c+W_r < 0 and eq 11 would take the root of a negative number",
    ),
    Erratum(
        "12, 13",
        "S_lin has a factor 2 and k = 0..n; A5 has neither",
        "A5 convention, α absorbs the factor, k = 1..N",
        "derivation",
        "the two cannot both hold",
    ),
    Erratum("13", "argument ω_k ζ", "ω_k t + phase", "derivation", "ζ is already the thickness coordinate"),
    Erratum("A3", "index runs to N", "to n", "reading", "n is the number of phases in A1 and A2; no number changes"),
    Erratum(
        "A4, A6",
        "second derivative in t, A1 in x",
        "the derivative of the chosen phase variable",
        "derivation",
        "one phase: rescales by (ω/k)²; several: k_i k_j → ω_i ω_j term by term",
    ),
    Erratum(
        "A5",
        "Σ α cn² with no constant",
        "add Σ 2k²(K/π)²(1-m-E/K)",
        "a number",
        "a second derivative of a periodic log has zero mean, Σ α cn² has positive mean; checked to 30 digits",
    ),
    Erratum("A5", "K = K(m) + ∫…", "K = K(m) = ∫…", "derivation", "a plus for an equals sign"),
    Erratum(
        "A5",
        "K'(m1) = K(m)",
        "K'(m) = K(m1), m1 = 1-m",
        "derivation",
        "true as an identity, but q needs K' at m; q = exp(-πK'/K) then matches q = exp(B/2)",
    ),
    Erratum(
        "A6",
        "equality ≈ for one k",
        "sum over k, ansatz with fitted coefficients; report residual",
        "a limit",
        "exact only for one phase or zero off-diagonal B",
    ),
    Erratum(
        "text/fig",
        "captions of figures 5 and 6 identical",
        "F_t(δ_t) at 0.5 g in figure 5, at 1.5 g in figure 6",
        "comparison with the text",
        "no number changes",
    ),
)
