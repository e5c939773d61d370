"""Paths of bodies that turn on one corner, by equations of motion of their own and scipy: the
reference of active contacts.

The ground is z = 0; gravity is the load of the body, which may lean. In the plane an angle turns x
towards z.
"""

import numpy
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

STICKS = 0  # a corner; +1 and -1: it slides along x or against it


def corner_arm(body, corner, angle):
    """From the centre of mass to a corner (plane)."""
    return (
        numpy.array([[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]]) @ body.points[corner]
    )


def corner_force(body, corner, mode, angle, spin):
    """Angular acceleration, and the force of the ground (x, z), of a body in the plane on one
    corner.

    Sticking: the compound pendulum. Sliding: ``z'' = -d2/dt2 (R p)_z`` with ``f_x = -mu f_z mode``.
    """
    m, inertia, load = body.mass, float(body.inertia[0]), body.load[:2]
    x, z = corner_arm(body, corner, angle)
    if mode == STICKS:
        turn = (-x * load[1] + z * load[0]) / (inertia + m * (x * x + z * z))
        return turn, m * (turn * z + spin**2 * x) - load[0], m * (-turn * x + spin**2 * z) - load[1]
    lever = x + body.friction * mode * z
    normal = (m * spin**2 * z - load[1]) / (1.0 + m * x * lever / inertia)
    return normal * lever / inertia, -body.friction * mode * normal, normal


def on_corner(body, corner, mode, angle, spin=0.0, slip=0.0):
    """State (x, z, angle, v_x, v_z, spin, impulse x, impulse z) of a body whose corner is at the
    origin and slips at ``slip``.
    """
    x, z = corner_arm(body, corner, angle)
    return numpy.array([-x, -z, angle, slip + spin * z, -spin * x, spin, 0.0, 0.0])


def slip_of_corner(body, corner, state):
    """Velocity of the corner along x."""
    return state[3] - state[5] * corner_arm(body, corner, state[2])[1]


def spare_of_corner(body, corner, mode, state):
    """What ends a mode where it falls to 0: the friction left of a corner that sticks, the slip of
    one that slides.
    """
    if mode != STICKS:
        return mode * slip_of_corner(body, corner, state)
    _turn, x, z = corner_force(body, corner, mode, state[2], state[5])
    return body.friction * z - abs(x)


def normal_force(body, corner, mode, state):
    """Of the ground; the corner leaves it where this falls to 0."""
    return corner_force(body, corner, mode, state[2], state[5])[2]


def planar_path(body, corner, mode, state, duration, ends_at=None):
    """Time and state after ``duration``, or where ``ends_at`` (`spare_of_corner`, `normal_force`)
    falls to 0 before.
    """

    def rate(_time, y):
        turn, x, z = corner_force(body, corner, mode, y[2], y[5])
        return [y[3], y[4], y[5], (x + body.load[0]) / body.mass, (z + body.load[1]) / body.mass, turn, x, z]

    def left(_time, y):
        return ends_at(body, corner, mode, y)

    left.terminal, left.direction = True, -1.0
    found = solve_ivp(
        rate, (0.0, duration), state, "DOP853", rtol=1e-13, atol=1e-15, max_step=duration / 200.0,
        events=[left] if ends_at else None,
    )  # fmt: skip
    assert found.status == (1 if ends_at else 0)
    return found.t[-1], found.y[:, -1]


def path_of_modes(body, corner, modes, state, duration):
    """The path through ``modes``, each to its end and the last up to ``duration``: the moments of
    change, and the state.
    """
    moments = [0.0]
    for mode in modes[:-1]:
        time, state = planar_path(body, corner, mode, state, duration - moments[-1], spare_of_corner)
        moments.append(moments[-1] + time)
    return moments[1:], planar_path(body, corner, modes[-1], state, duration - moments[-1])[1]


def turned_by(rate, duration, state):
    """A state that ends with a quaternion (x, y, z, w) and a spin in body axes, after ``duration``;
    ``rate(R, state)``.
    """

    def whole(_time, y):
        x, y_, z, w = y[-7:-3]
        a, b, c = y[-3:]
        quaternion = [w * a + y_ * c - z * b, w * b + z * a - x * c, w * c + x * b - y_ * a, -(x * a + y_ * b + z * c)]
        first, spin_rate = rate(Rotation.from_quat(y[-7:-3]).as_matrix(), y)
        return [*first, *(0.5 * numpy.array(quaternion)), *spin_rate]

    return solve_ivp(whole, (0.0, duration), state, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]


def top_path(body, tip, rotation, spin, duration):
    """Position, rotation and velocity (world axes) of a body that turns about its ``tip`` at the
    origin: Euler's equations.

    ``I_O w' = c x R' load - w x I_O w`` with the centre of mass at c and the inertia about the tip;
    ``spin`` in body axes.
    """
    c = -body.points[tip]
    about = numpy.diag(body.inertia) + body.mass * (c @ c * numpy.eye(3) - numpy.outer(c, c))

    def rate(R, y):
        return [], numpy.linalg.solve(about, numpy.cross(c, R.T @ body.load[:3]) - numpy.cross(y[-3:], about @ y[-3:]))

    end = turned_by(rate, duration, [*Rotation.from_matrix(rotation).as_quat(), *spin])
    R, w = Rotation.from_quat(end[:4]).as_matrix(), end[4:]
    return R @ c, R, numpy.concatenate([R @ numpy.cross(w, c), R @ w])


def sliding_tip_path(body, tip, rotation, velocity, spin, duration):
    """The same of a body whose ``tip`` starts at the origin and slides on z = 0 with friction ``-mu
    N s``.

    The centre of mass is at ``z = -(R p)_z``, which gives N. ``velocity`` (x, y) of the centre of
    mass.
    """
    m, inertia, p = body.mass, body.inertia, body.points[tip]

    def rate(R, y):
        w, arm, height_row = y[-3:], R @ p, R[2]
        rounding = -numpy.cross(w, inertia * w) / inertia  # spin rate without contact
        bend = numpy.cross(w, numpy.cross(w, p))
        slip = y[2:4] + (R @ numpy.cross(w, p))[:2]
        # force per N
        along = numpy.array([*(-body.friction * slip / numpy.linalg.norm(slip)), 1.0])
        push = R.T @ numpy.cross(arm, along) / inertia  # spin rate per N
        normal = (-body.load[2] / m - height_row @ (numpy.cross(rounding, p) + bend)) / (
            1.0 / m + height_row @ numpy.cross(push, p)
        )
        return [y[2], y[3], *((normal * along + body.load[:3]) / m)[:2]], rounding + normal * push

    start = [*(-(rotation @ p)[:2]), *velocity, *Rotation.from_matrix(rotation).as_quat(), *spin]
    end = turned_by(rate, duration, start)
    R, w = Rotation.from_quat(end[4:8]).as_matrix(), end[8:]
    height, rise = -(R @ p)[2], -(R @ numpy.cross(w, p))[2]
    return numpy.array([*end[:2], height]), R, numpy.concatenate([end[2:4], [rise], R @ w])
