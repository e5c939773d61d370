"""The occupant inside the vehicle rig: masses on links, one of them, node 0, on the cushion.

``m_i z_i'' = -m_i g + sum over the links of node i of +-[k (z_u - z_l) + c (z_u' - z_l')]``, and the
force of the cushion on node 0.

A massless node 0 has no equation of motion: its velocity v_0 follows at every instant from the
balance ``F(x, r - v_0) + P - C v_0 = 0``, F the law of the cushion, r the velocity of the cushion,
``P = sum k (z_i - z_0) + c v_i`` over the node's links and ``C = sum c``. F does not fall with the
rate of the approach, so the root is single. The place of v_0 in the state is written before it is
used; its rate follows from the rate of the balance.

Where the scene calls for it the links soften (``Softening``) with the running mean square ``q' =
(a^2 - q)/tau`` of the seat's acceleration a: stiffness by ``s = q^-beta``, damping by ``s^1/2``,
about the deflections e at rest, ``F = k [e + s (d - e)] + c s^1/2 d'``. The springs' change brings
in ``1/2 k s' (d - e)^2``, positive where they stiffen.
"""

from __future__ import annotations

import math

from contact_sim_pkg.compiled.jit import borrowing_kernel
from contact_sim_pkg.laws.contact_force import contact_force, contact_force_rate
from contact_sim_pkg.rigs.vehicle.motion.ends import is_shaken

ROOT_STEPS = 60
ROUNDING = 1.0e-14  # of the force: nearer to 0 the balance cannot come


@borrowing_kernel
def seat_mass(seat):
    """Mass of the whole occupant in [kg]."""
    total = 0.0
    for i in range(seat.masses.shape[0]):
        total += seat.masses[i]
    return total


@borrowing_kernel
def slide_index(seat):
    """Index of the occupant's x in the state."""
    return seat.offset + 2 * seat.masses.shape[0]


@borrowing_kernel
def _softness(softening, state):
    """Factors [1] on stiffness and damping, and the derivative of the first by the mean square
    [s^4/m^2].
    """
    if softening is None:
        return 1.0, 1.0, 0.0
    square = state[softening.offset]
    low, high = softening.least**2, softening.most**2
    held = min(max(square, low), high)
    factor = held**-softening.exponent
    slope = -softening.exponent * factor / held if low < square < high else 0.0
    return factor, math.sqrt(factor), slope


@borrowing_kernel
def _rest_of(softening, number):
    if softening is None:
        return 0.0
    return softening.rest[number]


@borrowing_kernel
def _pull(seat, number, softness, state):
    """Force in [N] with which a link pulls its ends together, and the power in [W] that it loses."""
    count = seat.masses.shape[0]
    lower, upper = seat.offset + seat.ends[number, 0], seat.offset + seat.ends[number, 1]
    closing = state[upper + count] - state[lower + count]
    rest = _rest_of(seat.softening, number)
    stretch = rest + softness[0] * (state[upper] - state[lower] - rest)
    damping = softness[1] * seat.springs[1, number]
    return seat.springs[0, number] * stretch + damping * closing, damping * closing * closing


@borrowing_kernel
def pull_links(seat, state, out):
    """Add the forces [N] of all links in the places of the accelerations; returns the power [W] that they lose."""
    v = seat.offset + seat.masses.shape[0]
    lost = 0.0
    softness = _softness(seat.softening, state)
    for number in range(seat.ends.shape[0]):
        pull, taken = _pull(seat, number, softness, state)
        out[v + seat.ends[number, 0]] += pull
        out[v + seat.ends[number, 1]] -= pull
        lost += taken
    return lost


@borrowing_kernel
def _accelerated(node, field, force, mass):
    """Acceleration of node 0 in [m/s^2]; of a massless one ``node_rate`` writes it."""
    if node is None:
        return field + force / mass
    return 0.0


@borrowing_kernel
def accelerate_masses(seat, ground, state, out):
    """Turn the forces [N] in the places of the accelerations into rates; returns the power [W] that the floor's motion
    brings in.
    """
    # On no floor of its own the seat moves in the frame of the shaken one.
    field = -ground.gravity
    if is_shaken(seat.floor):
        field -= ground.acceleration_z
    count = seat.masses.shape[0]
    z = seat.offset
    v = seat.offset + count
    # The momentum that the floor accelerates
    momentum = seat.masses[0] * state[v]
    out[z] = state[v]
    out[v] = _accelerated(seat.node, field, out[v], seat.masses[0])
    for i in range(1, count):
        out[z + i] = state[v + i]
        out[v + i] = field + out[v + i] / seat.masses[i]
        momentum += seat.masses[i] * state[v + i]
    return -ground.acceleration_z * momentum if is_shaken(seat.floor) else 0.0


@borrowing_kernel
def _pull_on_still_node(seat, softness, state):
    """Force in [N] of the links on node 0, whose velocity is set to 0."""
    state[seat.offset + seat.masses.shape[0]] = 0.0
    force = 0.0
    for number in range(seat.ends.shape[0]):
        if seat.ends[number, 0] == 0 or seat.ends[number, 1] == 0:
            pull, _taken = _pull(seat, number, softness, state)
            force += pull if seat.ends[number, 0] == 0 else -pull
    return force


@borrowing_kernel
def settle_node(node, seat, contact, approach, velocity, cosine, state):
    """Write the velocity of a massless node 0 in contact at ``approach`` [m] with a cushion of
    ``velocity`` [m/s] that node 0 sees at rest; its normal has the vertical part ``cosine`` [1].

    Regula falsi (Illinois) between the velocity without contact force and the one under the force
    at that velocity; a law that is linear in the rate takes one step.
    """
    if node is None:
        return
    v = seat.offset + seat.masses.shape[0]
    softness = _softness(seat.softening, state)
    links, damping = _pull_on_still_node(seat, softness, state), softness[1] * node.damping
    one = links / damping
    above = cosine * contact_force(contact, approach, velocity - cosine * one, state)
    other = one + above / damping
    below = cosine * contact_force(contact, approach, velocity - cosine * other, state) - above
    size = abs(above)
    found = one
    for _step in range(ROOT_STEPS):
        if above == below or abs(above) <= ROUNDING * size:
            break
        found = one + (other - one) * above / (above - below)
        left = cosine * contact_force(contact, approach, velocity - cosine * found, state) + links - damping * found
        if abs(left) <= ROUNDING * size:
            break
        # The end on the same side moves; the other counts half where it has stayed.
        if (left > 0.0) == (above > 0.0):
            one, above, below = found, left, 0.5 * below
        else:
            other, below, above = found, left, 0.5 * above
    state[v] = found


@borrowing_kernel
def node_rate(node, seat, contact, approach, approach_rate, cushion_acceleration, cosine, state, out):
    """Write the acceleration of a massless node 0: the rate of its balance is 0.

    ``approach`` [m] and its rate [m/s] as settled, ``cushion_acceleration`` [m/s^2] as for
    ``settle_node``; the rates of the masses are in ``out``. The slow change of softening links is
    left out.
    """
    if node is None:
        return
    count = seat.masses.shape[0]
    softness = _softness(seat.softening, state)
    held = cosine * contact_force_rate(contact, approach, approach_rate, cushion_acceleration, state, out)
    moving = contact_force_rate(contact, approach, approach_rate, cushion_acceleration - cosine, state, out)
    falls = held - cosine * moving
    for number in range(seat.ends.shape[0]):
        lower, upper = seat.ends[number, 0], seat.ends[number, 1]
        if lower == 0 or upper == 0:
            other = seat.offset + count + (upper if lower == 0 else lower)
            damping = softness[1] * seat.springs[1, number]
            held += softness[0] * seat.springs[0, number] * (state[other] - state[seat.offset + count])
            held += damping * out[other]
            falls += damping
    out[seat.offset + count] = held / falls


@borrowing_kernel
def softening_rate(softening, seat, acceleration_z, state, out):
    """Write the rate of the mean square of the seat's acceleration; returns the power in [W] that
    the change of the springs brings in.

    ``acceleration_z`` [m/s^2] of the floor where that is the frame of reference.
    """
    if softening is None:
        return 0.0
    z = seat.offset
    acceleration = out[z + seat.masses.shape[0]]
    if is_shaken(seat.floor):
        acceleration += acceleration_z
    rate = (acceleration**2 - state[softening.offset]) / softening.time_constant
    out[softening.offset] = rate
    _stiffness, _damping, slope = _softness(softening, state)
    brought = 0.0
    for number in range(seat.ends.shape[0]):
        beyond = state[z + seat.ends[number, 1]] - state[z + seat.ends[number, 0]] - softening.rest[number]
        brought += 0.5 * seat.springs[0, number] * slope * rate * beyond**2
    return brought


@borrowing_kernel
def energies_of_seat(seat, gravity, state):
    """Kinetic and potential energy of the occupant in [J]."""
    count = seat.masses.shape[0]
    kinetic = 0.0
    potential = 0.0
    for i in range(count):
        kinetic += 0.5 * seat.masses[i] * state[seat.offset + count + i] ** 2
        potential += gravity * seat.masses[i] * state[seat.offset + i]
    return kinetic, potential


@borrowing_kernel
def energy_of_links(seat, state):
    """What the springs of all links hold in [J]."""
    # A softened spring holds less only beyond its rest: k e (d - e) + 1/2 s k (d - e)^2 + 1/2 k e^2.
    stored = 0.0
    factor, _damping, _slope = _softness(seat.softening, state)
    for number in range(seat.ends.shape[0]):
        rest = _rest_of(seat.softening, number)
        beyond = state[seat.offset + seat.ends[number, 1]] - state[seat.offset + seat.ends[number, 0]] - rest
        stored += seat.springs[0, number] * (0.5 * factor * beyond**2 + rest * beyond + 0.5 * rest**2)
    return stored
