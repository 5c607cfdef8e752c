# SPDX-License-Identifier: MIT OR Apache-2.0
"""Six-degree-of-freedom derivatives of an aircraft about a trim with dynamic inflow, the rotor quasi-static.

The trim equations are averages over a revolution: six balances, and what rotor and inflow need to be periodic. Perturb speed,
rates, attitude and controls, let blades and inflow find their new periodic state, and the balances say how the body accelerates:

    df = (F_b - F_s S_s^-1 S_b) d(u, w, q, theta, v, p, phi, r, controls),    x_dot = M^-1 df,

F the balances, S the equations of rotor and inflow, index s their own unknowns, b those of the body. Blades and inflow follow at
once: what they need a few tenths of a second for (flap regression, lag) is not in it. M is the mass matrix that goes with it:
the gross aircraft, blades as a point mass at the hub, and about the shaft the blades' whole polar inertia, because rotor speed
is constant against the airframe.

A stabilizer with a schedule follows it at once, as in trim.

States and controls are those of HELISIM's matrices: u, w, q, theta, v, p, phi, r [m/s, rad/s, rad]; theta_0, theta_1s, theta_1c,
theta_tr [rad at the blade].
"""

from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from wakeflight.trim import Trim
from wakeflight.trim.equations import trim_problem

STATES = ("u", "w", "q", "theta", "v", "p", "phi", "r")
CONTROLS = ("theta_0", "theta_1s", "theta_1c", "theta_tr")
SPEED_STEP = 0.2  # m/s
RATE_STEP = 0.01  # rad/s
ANGLE_STEP = 0.005  # rad


@dataclass(frozen=True)
class LinearModel:
    """x_dot = a x + b u about a trim: a (8, 8), b (8, 4), in the order of `STATES` and `CONTROLS`."""

    a: np.ndarray
    b: np.ndarray

    def __getitem__(self, name: str) -> float:
        """A derivative by row and column, `"N_v"` or `"M_theta_1s"`."""
        row, column = name.split("_", 1)
        i = {"X": 0, "Z": 1, "M": 2, "Y": 4, "L": 5, "N": 7}[row]
        if column in STATES:
            return float(self.a[i, STATES.index(column)])
        return float(self.b[i, CONTROLS.index(column)])

    @property
    def eigenvalues(self) -> np.ndarray:
        """Roots [1/s], by real part."""
        return sorted_roots(np.linalg.eigvals(self.a))


def sorted_roots(roots: np.ndarray) -> np.ndarray:
    """Roots by real part, then by imaginary part."""
    return np.array(sorted(roots, key=lambda s: (round(s.real, 9), s.imag)))


def rotation(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """Body to inertial axes (3, 3)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return np.array(
        [
            [cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
            [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy],
            [-sp, sr * cp, cr * cp],
        ]
    )


def balances(
    trim: Trim, velocity: np.ndarray, roll: float, pitch: float, turn_rate: float = 0.0, x: np.ndarray | None = None
) -> np.ndarray:
    """Residual of all trim equations at a body velocity [m/s] and attitude [rad], turning about the vertical [rad/s].

    The flight path and the heading against it are those that give the body velocity.
    """
    north, east, down = rotation(roll, pitch, 0.0) @ velocity
    speed = float(np.linalg.norm(velocity))
    climb = float(np.arctan2(-down, np.hypot(north, east)))
    condition = copy(trim.condition)
    for name, value in (("speed", speed), ("flight_path", climb), ("turn_rate", turn_rate)):
        object.__setattr__(condition, name, value)
    problem = trim_problem(replace(trim.model, condition=condition), None)
    y = trim.x.copy() if x is None else x.copy()
    y[4:7] = roll, pitch, -np.arctan2(east, north)
    return trim.model.core.trim_residual(problem, y)


def linear_model(
    trim: Trim, step: float = 1.0, inertia: np.ndarray | None = None, hold_harmonics: bool = False
) -> LinearModel:
    """Derivatives about a wings-level `trim` with dynamic inflow.

    step: scales the differences in the body's states. inertia: matrix (3, 3) [kg m2] instead of the model's own.
    hold_harmonics: the inflow's harmonics stay as trimmed, its mean alone follows.
    """
    core, x = trim.model.core, trim.x
    jacobian = np.asarray(core.trim_jacobian(trim.problem, x)).reshape(x.size, x.size)
    body, controls = np.arange(6), np.arange(4)
    inflow = core.trim_layout(trim.problem).inflow
    rotor = np.setdiff1d(np.arange(7, x.size), (inflow + 1, inflow + 2) if hold_harmonics else ())
    # how the balances answer what the equations of rotor and inflow lack
    passed_on = -np.linalg.solve(jacobian[np.ix_(rotor, rotor)].T, jacobian[np.ix_(body, rotor)].T).T

    def accelerations(residual: np.ndarray) -> np.ndarray:
        return residual[body] + passed_on @ residual[rotor]

    velocity = np.asarray(trim.state()[:3])
    columns = {name: accelerations(difference) for name, difference in _body_differences(trim, velocity, step).items()}
    a = np.zeros((6, 8))
    for i, name in enumerate(STATES):
        a[:, i] = columns[name]
    sticks = jacobian[np.ix_(body, controls)] + passed_on @ jacobian[np.ix_(rotor, controls)]
    # theta_1c, theta_1s, theta_0, theta_tr by the sticks, into the order of CONTROLS
    b = (sticks @ np.linalg.inv(np.asarray(trim.model.data["rigging"]["matrix"])))[:, [2, 1, 0, 3]]
    return _assembled(trim, a, b, model_inertia(trim) if inertia is None else inertia)


def _body_differences(trim: Trim, velocity: np.ndarray, step: float) -> dict[str, np.ndarray]:
    """Central differences of the residual by u, w, q, theta, v, p, phi, r."""
    roll, pitch = trim.roll, trim.pitch
    differences = {}
    for name, i in (("u", 0), ("v", 1), ("w", 2)):
        d = np.zeros(3)
        d[i] = h = step * SPEED_STEP
        plus, minus = (balances(trim, velocity + s * d, roll, pitch) for s in (1, -1))
        differences[name] = (plus - minus) / (2 * h)
    h = step * ANGLE_STEP
    for name, d in (("phi", (h, 0.0)), ("theta", (0.0, h))):
        plus, minus = (balances(trim, velocity, roll + s * d[0], pitch + s * d[1]) for s in (1, -1))
        differences[name] = (plus - minus) / (2 * h)
    # a turn about the vertical with the body's x, y or z axis along it is a rate about that axis alone; what gravity does there
    # is the same on both sides of the difference
    h = step * RATE_STEP
    for name, attitude in (("p", (0.0, -0.5 * np.pi)), ("q", (0.5 * np.pi, 0.0)), ("r", (0.0, 0.0))):
        plus, minus = (balances(trim, velocity, *attitude, turn_rate=s * h) for s in (1, -1))
        differences[name] = (plus - minus) / (2 * h)
    return differences


def polar_inertia(trim: Trim) -> float:
    """Moment of inertia of all blades about the shaft [kg m2]."""
    blade = trim.model.data["rotor"]["blade"]["structure"]
    one = sum(m * (b**3 - a**3) / 3 for m, a, b in zip(blade["mass"], blade["r_in"], blade["r_out"], strict=True))
    return trim.model.n_blades * one


def gross_inertia(trim: Trim) -> np.ndarray:
    """Inertia matrix (3, 3) about the centre of gravity [kg m2], blades as a point mass at the hub."""
    ixx, iyy, izz, ixz = trim.model.data["mass"]["inertia"]
    mass = trim.model.data["mass"]["gross_mass"]
    hub = np.asarray(trim.model.data["rotor"]["position"])
    blades = trim.model.n_blades * trim.model.rotor["blade_mass"]
    airframe = mass - blades
    inertia = np.array([[ixx, 0.0, -ixz], [0.0, iyy, 0.0], [-ixz, 0.0, izz]])
    for m, r in ((blades, hub), (airframe, -blades / airframe * hub)):
        inertia += m * (r @ r * np.eye(3) - np.outer(r, r))
    return inertia


def model_inertia(trim: Trim) -> np.ndarray:
    """What the model carries: the gross inertia and, about the shaft, the blades' polar inertia."""
    tilt = trim.model.data["rotor"]["shaft_tilt_forward"]
    shaft = np.array([np.sin(tilt), 0.0, -np.cos(tilt)])
    return gross_inertia(trim) + polar_inertia(trim) * np.outer(shaft, shaft)


def _assembled(trim: Trim, a: np.ndarray, b: np.ndarray, inertia: np.ndarray) -> LinearModel:
    """Rows of accelerations by the mass matrix, rows of kinematics added."""
    reference = np.asarray(trim.model.data["mass"]["inertia"][:3])
    solve = np.linalg.inv(inertia) * reference
    roll, pitch = trim.roll, trim.pitch
    whole_a, whole_b = np.zeros((8, 8)), np.zeros((8, 4))
    for whole, part in ((whole_a, a), (whole_b, b)):
        whole[[0, 4, 1]] = part[:3]
        whole[[5, 2, 7]] = solve @ part[3:]
    whole_a[3, 2], whole_a[3, 7] = np.cos(roll), -np.sin(roll)
    whole_a[6, [5, 2, 7]] = 1.0, np.sin(roll) * np.tan(pitch), np.cos(roll) * np.tan(pitch)
    return LinearModel(whole_a, whole_b)


def periodic_roots(trim: Trim, steps: int = 360) -> np.ndarray:
    """Characteristic exponents [1/s] of the whole aircraft about its trim with dynamic inflow, largest real part first.

    The other way to the same modes: every blade, the inflow and the body, linearised along the trimmed revolution and carried
    over it by the trapezoidal rule. Four exponents are zero (position and heading) and a fifth (length of the quaternion).
    """
    core, n = trim.model.core, trim.model.layout["size"]
    period = 2 * np.pi / trim.model.omega
    h = period / steps
    transition, stiffness, mass = np.eye(n), np.empty((n, n)), np.empty((n, n))
    for k in range(steps):
        t = (k + 0.5) * h
        y, y_dot = core.trim_state(trim.problem, trim.x, t)
        inputs = trim.inputs(t)
        core.jacobian(t, y, y_dot, inputs, (1.0, 0.0), stiffness)
        core.jacobian(t, y, y_dot, inputs, (0.0, 1.0), mass)
        half = 0.5 * h * stiffness
        transition = np.linalg.solve(mass + half, (mass - half) @ transition)
    exponents = np.log(np.linalg.eigvals(transition).astype(complex)) / period
    return exponents[np.argsort(-exponents.real)]
