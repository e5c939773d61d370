"""Errata of *Identifiability*: printed, corrected, how it was found, and its effect."""

from __future__ import annotations

from contact_sim_lab.records.paper import Erratum

__all__ = ["ERRATA"]

ERRATA: tuple[Erratum, ...] = (
    Erratum(
        "2", "0 = z g(z)", "zᵀg(z) = 0", "derivation", "z and g(z) are vectors: only their scalar product is a number"
    ),
    Erratum("4, 8", "+k(q,v)", "-k with k = (0, ω×Iω)", "derivation", "eqs 9, 14, 15 use minus; Euler's equation"),
    Erratum(
        "5",
        "ψ(c_t) ≤ μ c_n, FC0 with ψ ≤ μ",
        "ψ(c_t/c_n) ≤ μ in FC0",
        "derivation",
        "ψ is homogeneous of degree one: both agree once c_t is divided by c_n",
    ),
    Erratum(
        "6, 7",
        "μDᵀv⁺ + λ∂ψ/∂c_t",
        "Dᵀv⁺ + λ∂ψ/∂c_t",
        "derivation",
        (
            "gradient of the Lagrangian printed just before; a factor μ only rescales λ, but kills the condition "
            "at μ = 0"
        ),
    ),
    Erratum("7, 8", "∂ψ(c_t)/∂ψ", "∂ψ/∂c_t", "derivation", "no number changes"),
    Erratum("8", "J_nᵀv⁺ = 0 whenever φ = 0", "0 ≤ J_nᵀv⁺ ⊥ c_n ≥ 0", "derivation", "forbids separation and rebound"),
    Erratum("text", "d_i = -d_j for any pair", "for each i there is one j", "derivation", "no number changes"),
    Erratum(
        "9",
        "no position term",
        "add φ_n/h for contacts within reach that do not bounce",
        "derivation",
        "velocity-only rows drift into penetration",
    ),
    Erratum(
        "8, 9",
        "dq/dt = v, q⁺ = q + hv⁺",
        "rotation by the exponential map",
        "derivation",
        "v holds ω, which is no derivative of coordinates in space",
    ),
    Erratum("9", "ε J_nᵀv_k", "ε min(0, J_nᵀv_k)", "derivation", "a contact that separates would be allowed to close"),
    Erratum(
        "13",
        "right side -J_nᵀb",
        "-(J_nᵀb + εJ_nᵀv_k)",
        "derivation",
        "eq 9 has the second term, by which the bounce enters",
    ),
    Erratum(
        "17",
        "c_n = +[…]/[…]",
        "minus sign, (1+ε)",
        "derivation",
        "approaching gives J_nᵀv_k < 0 and c_n must be positive",
    ),
    Erratum(
        "18, 26, 28, 30, 39",
        "plus sign before the fraction, no ε",
        "minus sign, (1+ε), as in eq 17",
        "derivation",
        "they are made from eq 17 and take over its sign",
    ),
    Erratum(
        "23, 26, 38, 39",
        "lower block without the gyroscopic change of ω",
        "add hΠ(ω×Π⁻¹ω) on the left",
        "a limit",
        "eq 18 contains it; zero only in the plane",
    ),
    Erratum("30", "J̌n without transpose", "J̌nᵀ", "derivation", "no number changes"),
    Erratum(
        "35",
        '+ h∂H, factor m, no k, "check H"',
        "-h∂H, 1/m, include -hM⁻¹k, hat H",
        "derivation",
        "what eq 14 gives for these rows",
    ),
    Erratum(
        "32",
        "0 < c_t",
        "c_t of either sign or 0, abs(c_t) ≤ μc_n; λ = 0",
        "derivation",
        "eq 33 solves for one signed c_t",
    ),
    Erratum(
        "33-38",
        "no ε",
        "first component J_nᵀb + εJ_nᵀv_k",
        "derivation",
        "eq 9 has it: without, every bounce is perfectly plastic",
    ),
    Erratum(
        "33-38", "one J_t", "in space two columns, 3×3 system", "derivation", "one column leaves the slip across it"
    ),
    Erratum("35, 36, 38, 39", "RᵀmI0⁻¹R", "R mI0⁻¹Rᵀ", "derivation", "R turns from body to world in eq 19"),
    Erratum(
        "38", "J (6 entries) with a 3x3 matrix", "J̌ (3 entries)", "units", "6 entries do not multiply a 3×3 matrix"
    ),
    Erratum(
        "38", "1/Δ", "1/(m²Δ)", "a number", "its products are m times those in Δ; checked: error 0 against order 1"
    ),
    Erratum(
        "39",
        "h RᵀmI0⁻¹R τ",
        "h(1/m)Π τ",
        "units",
        "unit; exactly this 1/m lets a torque determine m, with two different steps",
    ),
    Erratum(
        "29",
        "signs of ξ3 and h, no (1+ε)",
        "correct after ξ3 → -ξ3 and h → -h in the right sides, (1+ε) in ξ3, and Ξ̌ with the gyroscopic term",
        "a number",
        "numerator of eq 17 changes sign as a whole; residual 1e-16, with ξ3 alone 1e-4",
    ),
    Erratum("42", "sign from x and θ", "opposite to the slip velocity J_tᵀv⁺", "derivation", "maximum dissipation"),
    Erratum(
        "44",
        "third line a product",
        "plus sign between v_θ and the rest",
        "units",
        "an angular velocity times an impulse over an inertia is no angular velocity",
    ),
    Erratum("45 and text", "β", "c_t", "reading", "β is defined nowhere in the section; no number changes"),
    Erratum(
        "conclusion",
        'Π "uniquely"',
        "where no component of Rᵀ(J̌n + μď) vanishes in the body frame",
        "derivation",
        "e.g. impulse through the centre of mass: u = 0",
    ),
    Erratum(
        "VI",
        "sliding and sticking alike",
        "one sticking step with a known force does not separate m and J",
        "derivation",
        "two unknowns, one equation: the tangential velocity is zero whatever they are",
    ),
    Erratum(
        "II",
        "event-driven = penalty",
        "penalty methods penalise penetration, event-driven ones find the instants of contact",
        "reading",
        "no number changes",
    ),
)
