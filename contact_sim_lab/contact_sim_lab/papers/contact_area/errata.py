"""Errata of *Contact Area*: printed, corrected, how it was found, and its effect."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = (
    Erratum(
        "1",
        "r² = 2Rx - x² for two spheres",
        "exact for sphere on plane; two spheres: r² = R1² - d1², d1=(D²+R1²-R2²)/(2D), D=R1+R2-x",
        "a number",
        (
            "series: second-order coefficient is -(R1²-R1R2+R2²)/(R1+R2)², i.e. -1 for a plane but -1/4 for equal "
            "spheres"
        ),
    ),
    Erratum(
        "2, 8",
        "r from rigid overlap, √2 times the elastic radius",
        "keep as k_p; k_p = 1 with E' → E* gives Hertz",
        "derivation",
        "at equal modulus the model is √2 stiffer than Hertz; the bench says which modulus is meant",
    ),
    Erratum("3", "(R2² - (x2+h_x))²", "(R2 - (x2+h_x))²", "units", "R2² is an area, x2 + h_x a length"),
    Erratum("19", "1/κ1'", "1/K1'", "reading", "κ1' is not defined; the bulk modulus K1' is meant, no number changes"),
    Erratum(
        "26 (numbers)", "α_h = 0.04186, h_x = 0.952 x1", "0.04180, 0.979 x1", "a number", "sqrt(1-0.0418) = 0.97888"
    ),
    Erratum(
        "27 with 29",
        "k_c ≈ k_p at D1 = 0.8",
        "allowed, as k_c = k_p",
        "a number",
        "eq 29 gives k_c = 1.120 k_p there: α_h = 0.03732, h_x = 0.9812 x1",
    ),
    Erratum(
        "after 40",
        '"Variant 1", α_h = 0.03739 ≈ 0.047',
        "variant 2, 0.0374; h_x = 0.9626 x1 is right",
        "a number",
        "0.0374 is not 0.047, and h_x belongs to the border of variant 2, by 26 % in α_h",
    ),
    Erratum(
        "34",
        "E1' missing in the last term, R1 for R",
        "as in eq 35",
        "units",
        "without E1' the last term has no unit of the others; one radius R is used throughout",
    ),
    Erratum("37 (text)", "S = πk_h²R x1", "πk_h²R h_x", "derivation", "the integral beside it uses h_x"),
    Erratum("45", "ρ_c = ρ0(1+1/K')", "ρ0(1+Δp/K')", "units", "a modulus cannot be added to 1"),
    Erratum(
        "48",
        "a_k = (K'+1)/(K'-1)",
        "(K'+p)/(K'-p), p = mean contact pressure",
        "units",
        "a modulus cannot be added to 1; in Pa the printed value is 1 to 7 digits, in GPa it is not; p ≥ K' is refused",
    ),
    Erratum(
        "56",
        "B_x = (16/5)…",
        "B_x = 2.4408 k_pE''√(R x_m)/ω_x",
        "a number",
        (
            "equal viscous work along the damped-sine velocity: 4·∫√s√(1-s²)ds/∫√(1-s²)ds; 16/5 supposes ẋ ∝ x, "
            "i.e. zero speed at first touch. Printed is 31 % high"
        ),
    ),
    Erratum("58, 70", "any tanβ", "real only for tanβ ≤ 1/3", "derivation", "δ/ω = s solves s = 1.5 tanβ (1+s²)"),
    Erratum("60", "τ_x = τ_x/2", "τ_x = T_x/2 = π/ω_x", "derivation", "no number changes"),
    Erratum(
        "61",
        "3tanβ",
        "6tanβ with the mean speed, 7.4 tanβ with the sine",
        "derivation",
        (
            "eq 57 with eq 56 gives B/C = 3tanβ/ω and viscous work B x_m²/τ (not half of it); the factor π²/4 is "
            "the whole gap between eq 66 and eq 58"
        ),
    ),
    Erratum(
        "62",
        "x_m = V0τ1/2",
        "2V0τ1/π (sine), 0.6795 V0τ1 (elastic 3/2 law)",
        "derivation",
        "uniform deceleration is not eq 58",
    ),
    Erratum(
        "66 (text)",
        "zero restitution at tanβ = π/2",
        "at tanβ = π/3 = 1.0472; valid range 0 ≤ tanβ < π/3",
        "a limit",
        "numerator π - 3tanβ",
    ),
    Erratum(
        "71",
        "(5m/8…)^{4/5}",
        "(15m/16…)^{4/5}",
        "a number",
        (
            "eqs 65, 67, 69, 70 combined give 2(15/16)^{4/5} = 1.899, printed 2(5/8)^{4/5} = 1.373; τ printed is "
            "15 % short of the paper's own system"
        ),
    ),
    Erratum("72", "amplitude x_m at t = τ1", "use e^{-δ(t-τ1)}", "derivation", "otherwise the wave starts below x_m"),
    Erratum(
        "73, 74",
        "speed from a geometric wave length",
        "keep, and report the ratio to the Rayleigh speed",
        "derivation",
        "a free surface wave cannot choose its speed; this is a forced near field",
    ),
    Erratum(
        "76, 89",
        "singular at t = 0",
        "the stress is limited at x_s and flagged; the total force stays zero because the area vanishes faster",
        "a limit",
        "F_b ∝ √x",
    ),
    Erratum(
        "82-85",
        "σ_c = 1.5 σ_m for a parabola",
        "2 σ_m",
        "a number",
        (
            "line average used instead of area average: the printed stress carries only 75 % of the force; 1.5 "
            "belongs to sqrt(1-ρ²)"
        ),
    ),
    Erratum("87*", "f = t τ_KE/τ_x", "argument ω(t - tτ_KE/τ_x) as in 88a", "derivation", "no number changes"),
    Erratum(
        "88b",
        "not the derivative of 88a",
        "factor (1-τ_KE/τ_x) on the cosine",
        "derivation",
        "the chain rule on the argument of 88a gives the factor",
    ),
    Erratum(
        "96, 98, 100",
        "+ tanβ sin",
        "- tanβ sin",
        "derivation",
        "real part of (E'+iE'')ε0e^{i(ωt-β)}; must equal σ0 cos ωt. Printed form gives σ0cos(ωt-2β)",
    ),
    Erratum("102", "ε* = ε'+iε''", "that sum is e^{iωt}, not ε*/ε0", "derivation", "contradicts eq 90"),
    Erratum(
        "103",
        "root of squares at every instant",
        "sum σ_cn+σ_bn is the instantaneous stress; the root is the amplitude in steady harmonic motion",
        "a limit",
        "eq 54 adds the forces",
    ),
    Erratum("103 (text)", "σ_bn = σ'", "σ_cn = σ'", "derivation", "the second σ_bn = σ'' is right"),
    Erratum(
        "104, 105",
        "5.03",
        "5.3033 = (15/16)2^{5/2}",
        "a number",
        (
            "eqs 62, 63, 67. Against the exact elastic impact the method overestimates E' by 2.15 because eq 62 "
            "is poor: the exact constant at k = 1 is 13.93/(τ^{5/2}…) instead of 30.0. The bench has all three"
        ),
    ),
    Erratum("107", "2.3, gas constant named twice", "ln 10, R_g", "a number", "2.3 is 0.11 % below ln 10"),
    Erratum(
        "108, 112, 113",
        "ε(t'), dF(t)/dt'",
        "ε(t), dF(t')/dt'",
        "derivation",
        "t' is the variable of integration: the strain left of the sign cannot hold it",
    ),
    Erratum(
        "112", "3(1-ν)/4 with J = 1/G + …", "3(1-ν)/8 with that J", "derivation", "at t = 0+ eq 112 gives twice eq 110"
    ),
    Erratum(
        "text after 113",
        "growing area means constant speed",
        "growing area only needs ẋ > 0",
        "derivation",
        "no number changes",
    ),
    Erratum(
        "118",
        "sqrt(1/(1+ω0²))",
        "τ_KE = τ_ω tanβ / sqrt((ω0τ_ω)²-1)",
        "units",
        "ω0 has a unit; δ/ω = 1/sqrt((ω0/δ)²-1)",
    ),
    Erratum(
        "120",
        "E'' = 3K''(1-2ν)",
        "only if ν is real and constant",
        "derivation",
        "with complex ν use the complex relation",
    ),
)
