# SPDX-License-Identifier: MIT OR Apache-2.0
"""The flying blades once more, from positions alone: particles, strain energy and section loads on their paths.

Nothing here is taken from the equations of motion. Places of particles follow from geometry (lag, then flap, then pitch);
velocities and accelerations are differences of places along the path y + y_dot s + y_ddot s^2/2; loads of sections follow
from the tables and those velocities. Momentum and energy balances then give hub loads and shaft power a second time.
"""

import json
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from wakeflight import _core
from wakeflight.units import STANDARD_GRAVITY

STEP = 2e-4  # s, of the differences in time
FIRST = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12 * STEP)
SECOND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / (12 * STEP**2)
INSTANTS = STEP * np.arange(-2, 3)
DOWN = np.array([0.0, 0.0, 1.0])


@dataclass
class Balance:
    """Loads of the blades on the hub, inertial axes about the hub centre, and powers [W] of one instant."""

    force: np.ndarray
    moment: np.ndarray
    hub_axes: np.ndarray  # columns are x_h, y_h, z_h in inertial axes
    body: np.ndarray  # columns are the body axes in inertial axes
    hub_velocity: np.ndarray
    air: float
    gravity: float
    kinetic: float  # rate of kinetic energy
    strain: float  # rate of strain energy, control system included
    damper: float
    structure: float  # structural damping
    control: float  # work of the swashplate on the blades, against the damper too

    def shaft(self, omega_b: np.ndarray) -> float:
        """Shaft power from energy: what is stored, dissipated and given to the airframe, less what air and controls give.

        omega_b: angular velocity of the airframe, inertial axes.
        """
        airframe = float(self.force @ self.hub_velocity + self.moment @ omega_b)
        stored = self.kinetic + self.strain + self.damper + self.structure
        return stored + airframe - self.air - self.gravity - self.control


class Blades:
    """Blades of a model, with their own quadrature."""

    def __init__(self, model, tip_loss):
        self.model, self.data = model, model.data["rotor"]
        self.blade = self.data["blade"]
        assert self.blade["precone"] == 0.0 and self.blade["delta3"] == 0.0
        assert self.data["lag_damper"]["spring_rate"] == 0.0
        d = model.aircraft.discretisation
        self.modes = _core.BladeModes(
            json.dumps(self.blade), self.data["omega"], d.reference_pitch, d.n_elements, d.n_modes
        )
        self.ends = np.linspace(self.blade["root_station"], self.blade["radius"], d.n_elements + 1)
        self._mass_points()
        self._stations(model.stations.size, tip_loss)
        airfoil = self.data["airfoil"]["tables"][0]
        self.tables = {
            name: RegularGridInterpolator((airfoil[name]["x"], airfoil[name]["y"]), airfoil[name]["values"])
            for name in ("cl", "cd", "cm")
        }

    def _segment(self, x):
        """Property segment of every station, and whether it holds mass: a gap at the hinge is massless."""
        s = self.blade["structure"]
        segment = np.minimum(np.searchsorted(s["r_out"], x, side="right"), len(s["r_out"]) - 1)
        return segment, x >= np.asarray(s["r_in"])[segment]

    def _mass_points(self):
        """Gauss points of every piece of constant property within an element, with mass and stiffness."""
        self.structure = s = {name: np.asarray(values) for name, values in self.blade["structure"].items()}
        edges = np.concatenate([s["r_in"], s["r_out"], self.ends, self.blade["twist"]["x"]])
        self.edges = np.unique(np.clip(edges, self.blade["root_station"], self.blade["radius"]))
        self.x, dx = gauss(self.edges)
        segment, there = self._segment(self.x)
        self.mass = np.where(there, s["mass"][segment], 0.0) * dx
        per_mass = np.where(there, s["i_theta"][segment], 0.0) / s["mass"][segment]
        share = self.blade["km1_over_ktheta"] ** 2
        self.x_cg = s["x_cg"][segment]
        self.spread = np.sqrt((1 - share) * per_mass), np.sqrt(share * per_mass)
        self.stiffness = [s[name][segment] * dx for name in ("ei_flap", "ei_lag", "gj")]
        self.shapes = self._shapes(self.x)

    def _modal(self, x):
        return {name: np.asarray(values) for name, values in self.modes.shapes(list(x)).items()}

    def _shapes(self, x):
        """Modal shapes at stations, with the forms of the foreshortening inboard: slopes squared, and twist coupling."""
        shapes = self._modal(x)
        forms = [self._shortening(station) for station in x]
        shapes["U"], shapes["c"] = (np.array(form) for form in zip(*forms, strict=True))
        return shapes

    def _shortening(self, station):
        x, dx = gauss(np.append(self.edges[self.edges < station], station))
        segment, there = self._segment(x)
        gyration2 = np.where(there, self.structure["i_theta"][segment], 0.0) / self.structure["mass"][segment]
        stretched = dx * self.blade["ka_over_ktheta"] ** 2 * gyration2
        twist, m = self.blade["twist"], self._modal(x)
        interval = np.clip(np.searchsorted(twist["x"], x, side="right"), 1, len(twist["x"]) - 1)
        slope = np.diff(twist["y"])[interval - 1] / np.diff(twist["x"])[interval - 1]
        quadratic = sum(
            np.einsum("p,pi,pj->ij", weight, m[name], m[name])
            for weight, name in ((dx, "dv"), (dx, "dw"), (stretched, "dphi"))
        )
        return quadratic, (stretched * slope) @ m["dphi"]

    def _stations(self, n, tip_loss):
        cutout, radius = self.blade["root_cutout"], self.blade["radius"]
        edges = cutout + (radius - cutout) * np.sin(np.pi * np.arange(n + 1) / (2 * n))
        self.r = 0.5 * (edges[:-1] + edges[1:])
        self.width = np.diff(edges)
        self.lift_width = np.clip(np.minimum(edges[1:], tip_loss * radius) - edges[:-1], 0.0, None)
        self.chord = np.interp(self.r, self.blade["chord"]["x"], self.blade["chord"]["y"])
        self.station_shapes = self._shapes(self.r)

    def twist(self, x):
        """Built-in twist [rad]."""
        return np.interp(x, self.blade["twist"]["x"], self.blade["twist"]["y"])

    @staticmethod
    def section(shapes, x, length, q, theta):
        """Place of the elastic axis (n, 3) and triad t, c, n in blade axes, for modal coordinates and total root pitch."""
        shortened = np.einsum("pij,i,j->p", shapes["U"], q, q)
        u = length * (1 - np.sqrt(1 - shortened / length)) + shapes["c"] @ q
        place = np.column_stack([x - u, shapes["v"] @ q, shapes["w"] @ q])
        sin_b = shapes["dw"] @ q
        cos_b = np.sqrt(1 - sin_b**2)
        sin_l = shapes["dv"] @ q / cos_b
        cos_l = np.sqrt(1 - sin_l**2)
        t = np.column_stack([cos_b * cos_l, cos_b * sin_l, sin_b])
        c0 = np.column_stack([-sin_l, cos_l, np.zeros_like(sin_l)])
        n0 = np.cross(t, c0)
        pitch = (theta + shapes["phi"] @ q)[:, None]
        return place, t, c0 * np.cos(pitch) + n0 * np.sin(pitch), n0 * np.cos(pitch) - c0 * np.sin(pitch)

    def strain_energy(self, q, theta):
        """Strain energy of a blade and its control system [J], curvatures of the pitched section."""
        s = self.shapes
        sin_b = s["dw"] @ q
        cos_b = np.sqrt(1 - sin_b**2)
        b_s = (s["ddw"] @ q) / cos_b
        sin_l = (s["dv"] @ q) / cos_b
        l_s = ((s["ddv"] @ q) / cos_b + sin_l * sin_b / cos_b * b_s) / np.sqrt(1 - sin_l**2)
        pitch = theta + self.twist(self.x) + s["phi"] @ q
        edge = l_s * cos_b
        flap = b_s * np.cos(pitch) - edge * np.sin(pitch)
        lag = edge * np.cos(pitch) + b_s * np.sin(pitch)
        torsion = s["dphi"] @ q + l_s * sin_b
        bent = sum(float(k @ e**2) for k, e in zip(self.stiffness, (flap, lag, torsion), strict=True))
        wound = float(self._root()["phi"][0] @ q)
        return 0.5 * (bent + self.blade["control_stiffness"] * wound**2)

    def _root(self):
        return self._modal([self.blade["root_station"]])

    def damper_length(self, q, theta):
        """Length of the lag damper [m], letters of the aircraft data."""
        g, root = self.data["lag_damper"], self._root()
        flap = np.arcsin(float(root["dw"][0] @ q))
        lead = np.arcsin(float(root["dv"][0] @ q) / np.cos(flap))
        pitch = theta + float(root["phi"][0] @ q) + g["theta_geo"]
        s = lead + g["zeta_geo"]
        arm = g["b"] * np.cos(s) + g["d"] * np.sin(s)
        return np.linalg.norm(
            [
                g["a"] * np.sin(flap) + g["c"] + arm * np.cos(flap),
                -g["r"] * np.cos(pitch) - g["b"] * np.sin(s) + g["d"] * np.cos(s),
                g["a"] * np.cos(flap) - g["r"] * np.sin(pitch) - arm * np.sin(flap),
            ]
        )

    def balance(self, t, y, y_dot, stick, stick_rate, inflow, disk=None):
        """Balance at an instant; inflow (n_blades, n_stations), or `disk` (lambda_0, lambda_s, lambda_c) of dynamic inflow."""
        path = Path(self, t, y, y_dot, stick, stick_rate)
        total = Balance(np.zeros(3), np.zeros(3), path.hub_axes[2], path.body, path.hub_velocity, *np.zeros(7))
        for b in range(self.data["n_blades"]):
            self._add_masses(total, path, b)
            self._add_air(total, path, b, None if inflow is None else inflow[b], disk)
            self._add_springs(total, path, b)
        return total

    def _particles(self, path, b, k, q=None, theta=None):
        """Places of the particles (n, 4, 3) in inertial axes at instant `k`."""
        q, theta = path.q[b][k] if q is None else q, path.theta[b][k] if theta is None else theta
        place, _, c, n = self.section(
            self.shapes, self.x, self.x - self.blade["root_station"], q, theta + self.twist(self.x)
        )
        chordwise, normal = self.spread
        corners = [
            place + c * (self.x_cg + i * chordwise)[:, None] + n * (j * normal)[:, None]
            for i in (1, -1)
            for j in (1, -1)
        ]
        return path.inertial(np.stack(corners, axis=1), b, k)

    def _add_masses(self, total, path, b):
        places = np.array([self._particles(path, b, k) for k in range(5)])
        velocity = np.tensordot(FIRST, places, 1)
        acceleration = np.tensordot(SECOND, places, 1)
        mass = (self.mass / 4)[:, None, None]
        inertia = -mass * acceleration + mass * STANDARD_GRAVITY * DOWN
        total.force += inertia.sum(axis=(0, 1))
        total.moment += np.cross(places[2] - path.hub[2], inertia).sum(axis=(0, 1))
        total.kinetic += float(np.sum(mass * acceleration * velocity))
        total.gravity += float(np.sum(mass * velocity * STANDARD_GRAVITY * DOWN))
        # work of inertia and gravity on a change of root pitch alone
        h = 1e-5
        turned = [self._particles(path, b, 2, theta=path.theta[b][2] + s * h) for s in (1, -1)]
        total.control -= path.theta_dot[b] * float(np.sum(inertia * (turned[0] - turned[1]) / (2 * h)))

    def _add_air(self, total, path, b, inflow, disk):
        r, root = self.r, self.blade["root_station"]
        triads, places = [], []
        for k in range(5):
            place, *triad = self.section(
                self.station_shapes, r, r - root, path.q[b][k], path.theta[b][k] + self.twist(r)
            )
            places.append(path.inertial(place, b, k))
            triads.append([path.turned(v, b, k) for v in triad])
            if k == 2 and disk is not None:
                at = path.azimuthal(place, b, k)
                radius = self.blade["radius"]
                inflow = disk[0] + (disk[2] * at[:, 0] + disk[1] * at[:, 1]) / radius
        places, triads = np.array(places), np.array(triads)
        t, c, n = triads[2]
        velocity, c_dot = np.tensordot(FIRST, places, 1), np.tensordot(FIRST, triads[:, 1], 1)
        up = path.hub_axes[2][:, 2]
        wind = -velocity - np.outer(inflow * self.data["omega"] * self.blade["radius"], up)
        pitch_rate = np.sum(c_dot * n, axis=1)
        fraction = self.blade["pitch_axis_chord_fraction"]
        quarter, three_quarter = (fraction - 0.25) * self.chord, (fraction - 0.75) * self.chord
        wind_c, wind_n = np.sum(wind * c, axis=1), np.sum(wind * n, axis=1)
        at_quarter, at_three = wind_n - pitch_rate * quarter, wind_n - pitch_rate * three_quarter
        alpha, speed = np.arctan2(at_three, -wind_c), np.hypot(wind_c, at_quarter)
        where = np.column_stack([alpha, speed / self.model.speed_of_sound])
        cl, cd, cm = (self.tables[name](where) for name in ("cl", "cd", "cm"))
        cd = cd + self.data["airfoil"]["tables"][0]["cd_increment"]
        pressure = 0.5 * self.model.density * self.chord * speed
        lift, drag = pressure * self.lift_width * cl, pressure * self.width * cd
        force = c * (lift * at_quarter + drag * wind_c)[:, None] + n * (drag * at_quarter - lift * wind_c)[:, None]
        damping = -np.pi / 16 * self.model.density * self.chord**3 * self.lift_width * pitch_rate * speed
        couple = pressure * speed * self.chord * self.lift_width * cm + damping
        moment = t * couple[:, None] + np.cross(c * quarter[:, None], force)
        total.force += force.sum(axis=0)
        total.moment += (np.cross(places[2] - path.hub[2], force) + moment).sum(axis=0)
        # angular velocity of the section from the motion of its triad
        spin = 0.5 * sum(np.cross(e, np.tensordot(FIRST, triads[:, i], 1)) for i, e in enumerate((t, c, n)))
        total.air += float(np.sum(force * velocity) + np.sum(moment * spin))
        # a change of root pitch turns the section about its tangent
        total.control -= path.theta_dot[b] * float(np.sum(np.sum(moment * t, axis=1)))

    def _add_springs(self, total, path, b):
        q, theta = path.q[b], path.theta[b]
        energy = [self.strain_energy(q[k], theta[k]) for k in range(5)]
        total.strain += float(FIRST @ energy)
        h = 1e-5
        by_pitch = (self.strain_energy(q[2], theta[2] + h) - self.strain_energy(q[2], theta[2] - h)) / (2 * h)
        total.control += path.theta_dot[b] * by_pitch
        # the damper resists its whole stroke, the part the control moves too
        rate = float(FIRST @ [self.damper_length(q[k], theta[k]) for k in range(5)])
        table = self.data["lag_damper"]["force"]
        force = np.sign(rate) * np.interp(abs(rate), table["x"], table["y"])
        total.damper += force * rate
        stroke = (self.damper_length(q[2], theta[2] + h) - self.damper_length(q[2], theta[2] - h)) / (2 * h)
        total.control += force * stroke * path.theta_dot[b]
        frequency = np.asarray(self.modes.frequencies)[: path.q_dot.shape[1]]
        damped = np.where(frequency > 1.5 * self.data["omega"], frequency, 0.0)
        total.structure += float(2 * self.blade["structural_damping_ratio"] * damped @ path.q_dot[b] ** 2)


class Path:
    """Motion through a state at the five instants around it: hub, blades' azimuths, modal coordinates, root pitch."""

    def __init__(self, blades, t, y, y_dot, stick, stick_rate):
        model, data = blades.model, blades.data
        s = INSTANTS
        w, x, yq, z = y[6:10] / np.linalg.norm(y[6:10])
        body = np.array(
            [
                [1 - 2 * (yq * yq + z * z), 2 * (x * yq - w * z), 2 * (x * z + w * yq)],
                [2 * (x * yq + w * z), 1 - 2 * (x * x + z * z), 2 * (yq * z - w * x)],
                [2 * (x * z - w * yq), 2 * (yq * z + w * x), 1 - 2 * (x * x + yq * yq)],
            ]
        )
        v, rates, v_dot, rates_dot = y[0:3], y[3:6], y_dot[0:3], y_dot[3:6]
        origin = np.outer(s, body @ v) + 0.5 * np.outer(s**2, body @ (v_dot + np.cross(rates, v)))
        attitude = [body @ rotation(rates * h + 0.5 * rates_dot * h**2) for h in s]
        i = data["shaft_tilt_forward"]
        assert data["shaft_tilt_lateral"] == 0.0
        axes = np.array([[-np.cos(i), 0, np.sin(i)], [0, 1, 0], [-np.sin(i), 0, -np.cos(i)]])
        self.hub = origin + np.array([a @ np.asarray(data["position"]) for a in attitude])
        self.hub_axes = [a @ axes for a in attitude]
        self.hub_velocity = FIRST @ self.hub
        self.body = body
        self.psi = [data["omega"] * (t + s) + 2 * np.pi * b / data["n_blades"] for b in range(data["n_blades"])]
        layout = model.layout
        spans = list(zip(layout["modal"], layout["modal_rate"], strict=True))
        self.q_dot = np.array([y[c:d] for _, (c, d) in spans])
        self.q = [y[a:b] + np.outer(s, y[c:d]) + 0.5 * np.outer(s**2, y_dot[c:d]) for (a, b), (c, d) in spans]
        rigging = model.data["rigging"]
        moved = np.asarray(stick) + np.outer(s, stick_rate)
        controls = np.asarray(rigging["offset"]) + moved @ np.asarray(rigging["matrix"]).T
        self.theta = [
            controls[:, 2]
            + controls[:, 0] * np.cos(psi + rigging["phase"])
            + controls[:, 1] * np.sin(psi + rigging["phase"])
            for psi in self.psi
        ]
        self.theta_dot = [float(FIRST @ theta) for theta in self.theta]

    def azimuthal(self, v, b, k):
        """Vectors of blade axes (..., 3) in hub axes."""
        c, s = np.cos(self.psi[b][k]), np.sin(self.psi[b][k])
        return v @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])

    def turned(self, v, b, k):
        """Vectors of blade axes in inertial axes."""
        return self.azimuthal(v, b, k) @ self.hub_axes[k].T

    def inertial(self, v, b, k):
        """Places of blade axes in inertial axes."""
        return self.hub[k] + self.turned(v, b, k)


def gauss(edges):
    """Stations and weights of five Gauss points in every interval."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    a, b = edges[:-1, None], edges[1:, None]
    return (0.5 * (a + b) + 0.5 * (b - a) * nodes).ravel(), (0.5 * (b - a) * weights).ravel()


def rotation(phi):
    """Rotation by the vector `phi` [rad]."""
    angle = np.linalg.norm(phi)
    if angle < 1e-300:
        return np.eye(3)
    x, y, z = phi / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
