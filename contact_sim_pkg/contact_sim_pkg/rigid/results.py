"""How a contact solve ended, and in which mode each contact is."""

from __future__ import annotations

SOLVED = 0
RAY = 1
NOT_CONVERGED = 2
CONTACT_NOT_FINITE = 3
TOO_MANY_IMPACTS = 4
SPIN_TOO_FAST = 5
TOO_MANY_EVENTS = 6

SENTENCES = {
    SOLVED: "the contact conditions hold",
    RAY: "the contact conditions have no solution that pivoting can reach (as of a body wedged by friction or by restitution): "
    "state unchanged",
    NOT_CONVERGED: "the iteration ended before the requested residual; the residual is returned",
    CONTACT_NOT_FINITE: "an input of the contact solve is not finite: state unchanged",
    TOO_MANY_IMPACTS: "more than 100000 impacts in one call: raise the rest speed or lower the restitution",
    TOO_MANY_EVENTS: "more than 100000 events in one output sample hardly bring the motion on: take compliant_contact, or a "
    "ground with fewer heights",
    SPIN_TOO_FAST: "the body turns by more than 100000 radians in an output sample: take samples closer together, or a smaller "
    "torque",
}

# Mode of a contact over one solve.
SEPARATE = 0
STICK = 1
SLIDE = 2  # keeps the direction of slip it came with
REVERSE = 3  # slip stopped and started the other way

# Flags, added up: what a caller may want to know about a solved contact.
UNIQUE = 0
# the impulses share the load in more than one way; the one of least norm is returned
SPLIT_NOT_UNIQUE = 1
