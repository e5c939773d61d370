"""Errata of *Rolling Contact*: printed, corrected, how it was found, and its effect."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = (
    Erratum(
        "2, 3, 4, 7",
        "∭T:E dV + ∬F·u dS = 0",
        "minus sign",
        "a limit",
        "both terms are positive; a sum of positives has no root",
    ),
    Erratum(
        "5",
        "u_c = k_cF_c^{3/2}",
        "k_cF_c^{2/3}",
        "derivation",
        (
            "Hertz. (Eq 6 is consistent with the wrong exponent: F_c^{5/2}; right: F_c^{5/3}, and k_bF_cF_b + "
            "k_cF_c^{2/3}F_b.)"
        ),
    ),
    Erratum(
        "5", '"linear dependence"', "Hertz is not linear; stored energy is (2/5)Fu", "derivation", "½∬p u dS = (2/5)Pδ"
    ),
    Erratum("6, 7", "E∭σ²", "(1/E)∭[(1+ν)σ_ijσ_ij - νσ_kk²]", "units", "unit: Eσ² is Pa³"),
    Erratum(
        "7",
        "fixes F_c",
        "does not",
        "derivation",
        (
            "with Betti's theorem for the cross terms the balance leaves (1/5)F_cu_c = 0, without them it has "
            "only F_c = 0: an energy identity holds for every split. The bench takes the least complementary "
            "energy"
        ),
    ),
    Erratum("8", "roman i", "inertia about the spin axis", "derivation", "looks like √-1"),
    Erratum(
        "8, 18", "no damping", "c_ψ, c_θ, ζ", "a limit", "unbounded at resonance and always unstable with friction"
    ),
    Erratum("10", "e²(Ω) = e(Ω(…))", "e² = polynomial", "derivation", "no number changes"),
    Erratum(
        "12",
        "two equations for x",
        "second is y",
        "derivation",
        (
            "as printed the ellipse turns by -θ and the yaw arm is +y; turning by +θ with M_z = -y t_x gives the "
            "same moments"
        ),
    ),
    Erratum(
        "12",
        "the ellipse turns by θ",
        (
            "by φ: tan 2φ = (k11-k12) sin2θ / [(k11-k12) cos2θ + k22-k21], take the root whose direction has the "
            "smaller total curvature; printed: φ = θ"
        ),
        "derivation",
        "only one of the two bodies turns; with the radii of the bench φ ≈ -θ/3",
    ),
    Erratum("16", "(2π/3)p0ab = F_N", "F_c", "derivation", "by eq 1; equal only in series"),
    Erratum(
        "17a",
        "(A - 1 + R cosψ), factor 1/2",
        "(A - l + R sinψ), factor 1",
        "units",
        "1 cannot be subtracted from a length (letter l); eq 12 puts the contact centre at R sinψ",
    ),
    Erratum(
        "17b",
        "factor 1/4",
        "1/8",
        "derivation",
        (
            "∬xy dS = -(πab/8)(a²-b²)sin2θ. The printed pair (1/2, 1/4) needs ∫w r³ = 2∫w r on [0,1], impossible "
            "for any traction weight w ≥ 0"
        ),
    ),
    Erratum(
        "17, 20",
        "ψ = θ = 0 is an equilibrium",
        "solve the static offset first, linearise there",
        "derivation",
        "M_ψ^σ(0) ≠ 0 unless A = l",
    ),
    Erratum("17c", "±", "sign of rolling", "derivation", "fixed for a run; flipping it every step injects energy"),
    Erratum(
        "sect. 5",
        "R11 in a plane along y, R21 along x",
        "as printed for figs 9-14; the bench takes x along the shaft",
        "derivation",
        "sect. 2 has R21 = 5 mm as the shaft radius, which curves along y",
    ),
    Erratum("24", "ω_ij for damage", "another letter", "derivation", "ω is the spin"),
    Erratum("22", "σ_ij - σ_lim > 0", "|σ_ij|", "a limit", "σ_zz is negative everywhere, the volume would be empty"),
    Erratum(
        "sect. 5",
        "max σ_zz = p0 = -1.4e8; max|σ_xz| = -2e7",
        "σ_zz(0,0,0) = -p0; magnitudes positive",
        "derivation",
        "sign",
    ),
    Erratum(
        "sect. 5",
        "|σ_xz| max 0.3 p0 at 0.27a",
        "0.19-0.25 p0",
        "a number",
        (
            "orthogonal shear: circle 0.2139 p0 at z = 0.351a; b/a = 0.65: 0.230 p0 at 0.265a (minor-axis plane), "
            "0.190 p0 at 0.287a (major-axis plane); line limit 0.25 p0. 0.30-0.31 p0 is the maximum principal "
            "shear, a different component at z ≈ 0.48a (circle, ν = 0.3)"
        ),
    ),
    Erratum(
        "sect. 5",
        "S(1) < S(4), p0(1) > p0(4) in a comparison of t = 0 and 4",
        "S(0), p0(0)",
        "derivation",
        "no number changes",
    ),
    Erratum(
        "24", "V_k not defined", "the box 4a × 4b × 3a under the contact at F_N", "derivation", "no number changes"
    ),
)
