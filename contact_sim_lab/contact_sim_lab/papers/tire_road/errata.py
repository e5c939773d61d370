"""Errata of *Tire/Road Contact*: printed, corrected, how it was found, and its effect."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = (
    Erratum("2", "-P = ∬p", "+P", "derivation", "p > 0 in contact (eq 3) and P is a load"),
    Erratum(
        "3, 4",
        "-Δ",
        "+Δ when Δ is a penetration",
        "derivation",
        "u > 0 from eq 1 with p > 0; with -Δ more penetration would give less displacement",
    ),
    Erratum("text", 'conditions "(2)-(3)"', "(3)-(4)", "derivation", "no number changes"),
    Erratum("1", "D is the whole surface", "integrate over D_c, evaluate anywhere", "derivation", "p = 0 outside"),
    Erratum(
        "7, 8",
        "[3PH²E/(1-ν)]^{1/3}",
        "[3PH²E*²/(2π)]^{1/3} with E(k̄)^{-2/3} (equivalently [6PH²E*²/π]^{1/3}(2E)^{-2/3})",
        "units",
        (
            "unit of the printed bracket is Pa²; its cube root is Pa^{2/3}. The factors Ē^{-2/3}(1-k̄²)^{1/6} are "
            "exactly those of Hertz"
        ),
    ),
    Erratum(
        "8",
        "amplitude and shape at different r",
        "p0 at the centre",
        "derivation",
        "sets φ = π/2 (r = 0) and r = 1 together",
    ),
    Erratum(
        "7",
        "Ē(arcsin(1-r), r k̄)^{-2/3} as the shape, r undefined (only r = ρ makes sense)",
        "sqrt(1-ρ²) for n = 2",
        "a number",
        (
            "the printed shape grows like (1-r)^{-2/3} at the edge instead of vanishing and, with the right "
            "amplitude, carries 9.05 times the load (circle)"
        ),
    ),
    Erratum(
        "7",
        "k̄ = (n r̃ⁿ - 2bⁿ)^{1/n}/a, r̃ undefined",
        "r̃ⁿ = (aⁿ+bⁿ)/n, hence k̄ = (1-(b/a)ⁿ)^{1/n} for all n",
        "a limit",
        ("with r̃ⁿ=(aⁿ+bⁿ)/2 a square-symmetric domain (a=b) gives k̄ⁿ = n-2: imaginary for n < 2, above 1 for n > 3"),
    ),
    Erratum(
        "9",
        "E is Young's modulus",
        "E → shear modulus G (then it is exactly Hertz) or (3/2)²(1-ν²)²P²H/(π²E²)",
        "a number",
        "as printed with Young's modulus δ is low by (2(1+ν))^{-2/3}: 0.481 at ν = 0.5, 0.529 at 0.3",
    ),
    Erratum("9", "δ a function of position", "it is the approach Δ, one number", "derivation", "no number changes"),
    Erratum(
        "10",
        'n = int(L/Δx) although n is the summation index, m "simultaneous contacts" as upper limit',
        "N = int(L/Δx) as limit; simultaneous ones are those inside Π",
        "a limit",
        "no number changes",
    ),
    Erratum("10", "δ again", "Dirac, unit 1/m: F_c is a line density", "derivation", "no number changes"),
    Erratum(
        "H",
        '"mean curvature of the contact domain"',
        "of the gap surface, A+B",
        "units",
        "dimension 1/m, and reproduces Hertz",
    ),
)
