"""A contact of a rig, all of its effects together; an absent one (``None``) carries nothing.

``contact``: ``laws/parameters.Contact`` or None; approach in [m], its rate in [m/s], closing
positive; state and derivative: [states] of the rig, which hold the hysteresis variable of a foam.

Source: Driver and Seat eqs 7 to 9.
"""

from __future__ import annotations

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws import normal_force as law
from contact_sim_pkg.laws.elastic_law import elastic_energy, elastic_force
from contact_sim_pkg.laws.foam_hysteresis import (
    hysteresis_energy,
    hysteresis_factor,
    hysteresis_factor_rate,
    hysteresis_rate,
    reversal_event,
)


@borrowing_kernel
def contact_force(contact, approach, approach_rate, state):
    """Normal force of a contact in [N]; 0 where the contact is absent."""
    if contact is None:
        return 0.0
    factor = hysteresis_factor(contact.hysteresis, state)
    return law.normal_force(contact.elastic, contact.dissipative, approach, approach_rate, factor)


@borrowing_kernel
def contact_lost_power(contact, approach, approach_rate, force, state, out):
    """Power in [W] that the loss of a contact takes: (F - F_elastic) x'. Writes the rate of the
    hysteresis variable.
    """
    if contact is None:
        return 0.0
    carried = elastic_force(contact.elastic, approach)
    hysteresis_rate(contact.hysteresis, carried * approach_rate, state, out)
    return (force - carried) * approach_rate


@borrowing_kernel
def contact_force_rate(contact, approach, approach_rate, approach_acceleration, state, derivative):
    """Rate of the normal force in [N/s]; 0 where the bodies part faster than the material
    recovers.
    """
    factor = hysteresis_factor(contact.hysteresis, state)
    force_rate = law.normal_force_rate(
        contact.elastic, contact.dissipative, approach, approach_rate, approach_acceleration, factor
    )
    return force_rate + hysteresis_factor_rate(contact.hysteresis, derivative) * elastic_force(
        contact.elastic, approach
    )


@borrowing_kernel
def contact_tension_event(contact, approach, approach_rate, state):
    """Event function of the loss of contact before the gap opens; constant without a contact."""
    if contact is None:
        return 1.0
    factor = hysteresis_factor(contact.hysteresis, state)
    return law.tension_event(contact.elastic, contact.dissipative, approach, approach_rate, factor)


@borrowing_kernel
def contact_reversal_event(contact, approach, approach_rate):
    """Event function of the reversals of a foam; constant without a contact or hysteresis."""
    if contact is None:
        return 1.0
    return reversal_event(contact.hysteresis, approach, approach_rate)


@borrowing_kernel
def contact_energy(contact, approach, state):
    """Energies in [J] of the elastic law and beside it of the hysteresis."""
    if contact is None:
        return 0.0, 0.0
    return elastic_energy(contact.elastic, approach), hysteresis_energy(contact.hysteresis, state)
