"""Flap equation of the program's blade in forward flight: multipliers and periodic motion."""

import copy
import json

import beams
import numpy as np
from scipy.integrate import solve_ivp

import wakeflight as wf
from wakeflight import _core
from wakeflight.model import setting
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SMALL, SLOPE, CHORD, STATIONS, AZIMUTHS = 1e-4, 5.7, 1e-7, 1000, 24
INFLOW, PITCH = 0.03, np.radians([8.0, 1.0, -3.0])
DATA = wf.load_aircraft("bo105").core_data()


class FlapEquation:
    """beta'' = a + b beta + c beta' of azimuth, from the residual of the program's blade."""

    def __init__(self, gamma, nu, mu):
        blade = beams.uniform("hinged", ei_flap=1e6, ei_lag=1e6, gj=[1e6], control_stiffness=1e6)
        blade |= {"chord": {"x": [0.0], "y": [CHORD]}}
        data = copy.deepcopy(DATA)
        data["rotor"] |= {
            "blade": blade,
            "airfoil": linear(),
            "omega": 1.0,
            "shaft_tilt_forward": 0.0,
            "tip_loss_factor": 1.0,
        }
        data["rigging"] = {"matrix": np.eye(4).tolist(), "offset": [0.0] * 4, "phase": 0.0}
        data["mass"]["gross_mass"] = 1e6
        for part in ("fuselage", "stabilator", "stabilator_schedule", "fin", "tail_rotor", "interference"):
            data[part] = None
        density = gamma / (3.0 * SLOPE * CHORD)  # inertia 1/3 of a blade of 1 kg/m and 1 m
        fine = {"n_elements": 1, "n_modes": 2, "n_gauss": 8, "n_stations": STATIONS, "reference_pitch": 0.0}
        self.core = _core.System.aircraft(json.dumps(data), setting((density, 1e9), True, fine, 0.0))
        self.layout, rotor = self.core.layout(), self.core.rotor()
        self.flap, self.per_coordinate = rotor["flap_mode"], rotor["flap_per_coordinate"]
        self.stick = SMALL * np.array([PITCH[1], PITCH[2], PITCH[0], 0.0])
        self.spring, self.mu, self.mass = nu**2 - 1.0, mu, None
        psi = 2 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS
        self.coefficients = [self.harmonics(row) for row in self.sampled(psi)]

    def sampled(self, psi):
        """a, b, c at equally spaced azimuths (3, n)."""
        tilt = SMALL * 0.1
        rest, up, rising = (
            np.concatenate([self.acceleration(p, beta, rate) for p in psi[: len(psi) // 4]], axis=1).ravel()
            for beta, rate in ((0.0, 0.0), (tilt, 0.0), (0.0, tilt))
        )
        return rest / SMALL, (up - rest) / tilt - self.spring, (rising - rest) / tilt

    def acceleration(self, psi, beta, rate):
        """Second derivatives of the flap angle of the four blades, a quarter turn apart, the first at azimuth psi (4, 1)."""
        n = self.layout["size"]
        y, f = np.zeros(n), np.empty(n)
        y[0], y[6] = self.mu, 1.0
        q, v = (np.array([a + self.flap for a, _ in self.layout[part]]) for part in ("modal", "modal_rate"))
        y[q], y[v] = beta / self.per_coordinate, rate / self.per_coordinate
        inflow = np.full((self.layout["n_blades"], STATIONS), SMALL * INFLOW)
        inputs = _core.Inputs(self.stick, [0.0] * 4, 0.0, inflow, SMALL * INFLOW, 0.0)
        self.core.residual(psi, y, np.zeros(n), inputs, f)
        if self.mass is None:
            matrix = np.empty((n, n))
            self.core.jacobian(psi, y, np.zeros(n), inputs, (0.0, 1.0), matrix)
            # the hub is held: of the residual's matrix only the mode's own entry counts
            self.mass = matrix[v[0], v[0]]
        return (-f[v] / self.mass * self.per_coordinate)[:, None]

    @staticmethod
    def harmonics(values):
        """Trigonometric polynomial through equally spaced values: mean, cosines, sines."""
        spectrum = np.fft.rfft(values) / len(values)
        keep = min(8, len(spectrum) - 1)
        return spectrum[0].real, 2 * spectrum[1 : keep + 1].real, -2 * spectrum[1 : keep + 1].imag

    def at(self, psi):
        """a, b, c at any azimuth."""
        k = np.arange(1, len(self.coefficients[0][1]) + 1)
        cosine, sine = np.cos(k * psi), np.sin(k * psi)
        return [mean + c @ cosine + s @ sine for mean, c, s in self.coefficients]

    def revolution(self, start, forced=True):
        """Motion over one revolution from (beta, beta')."""

        def rates(psi, x):
            a, b, c = self.at(psi)
            return [x[1], a * forced + b * x[0] + c * x[1]]

        return solve_ivp(rates, (0.0, 2 * np.pi), start, rtol=1e-11, atol=1e-13, dense_output=True).sol

    def transition(self):
        """Transition matrix over one revolution."""
        return np.column_stack([self.revolution(e, forced=False)(2 * np.pi) for e in np.eye(2)])


def linear():
    """Section tables of lift slope only; reversed flow as a linear flap equation has it."""
    alpha = [-np.pi, -np.pi + 0.2, -0.2, 0.2, np.pi - 0.2, np.pi]
    lift = [0.0, -0.2 * SLOPE, -0.2 * SLOPE, 0.2 * SLOPE, 0.2 * SLOPE, 0.0]

    def table(values):
        return {"x": alpha, "y": [0.0, 1.0], "values": [[v, v] for v in values]}

    section = {"cl": table(lift), "cd": table([0.0] * 6), "cm": table([0.0] * 6), "cd_increment": 0.0}
    return {"stations": [0.0], "stepwise": False, "tables": [section]}


def run(case):
    checks, drawn = [], []
    for row in case.toml("flapping_floquet.toml")["case"]:
        name = f"γ = {row['gamma']:g}, ν = {row['nu']:g}, µ = {row['mu']:g}"
        equation = FlapEquation(row["gamma"], row["nu"], row["mu"])
        matrix = equation.transition()
        found = sorted(np.linalg.eigvals(matrix), key=lambda m: (m.imag, m.real))
        exact = sorted(
            np.array(row["multipliers_re"]) + 1j * np.array(row["multipliers_im"]), key=lambda m: (m.imag, m.real)
        )
        checks.append(Check(f"{name}: multipliers, error", np.max(np.abs(np.array(found) - exact)), 0.0, 1e-6))
        product = np.exp(-np.pi * row["gamma"] / 4)
        checks.append(Check(f"{name}: product of multipliers", np.linalg.det(matrix), product, 1e-6))
        start = np.linalg.solve(np.eye(2) - matrix, equation.revolution([0.0, 0.0])(2 * np.pi))
        checks.append(
            Check.largest(f"{name}: state at azimuth 0", start, row["beta_and_rate_at_psi0_rad"], 1e-6, "rad")
        )
        psi = 2 * np.pi * np.arange(720) / 720
        beta = np.degrees(equation.revolution(start)(psi)[0])
        ours = [beta.mean()] + [2 * np.mean(beta * f(k * psi)) for k in (1, 2) for f in (np.cos, np.sin)]
        reference = row["beta0_1c_1s_2c_2s_deg"]
        checks.append(Check.largest(f"{name}: harmonics", ours, reference, np.degrees(1e-6), "deg"))
        drawn.append((name, np.degrees(psi), beta, reference))
    return Outcome(checks, draw(drawn))


@style.styled
def draw(drawn):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for (name, psi, beta, h), color in zip(drawn, style.COLORS):
        axes.plot(psi, beta, color=color, label=name)
        at = np.radians(psi[::60])
        series = h[0] + h[1] * np.cos(at) + h[2] * np.sin(at) + h[3] * np.cos(2 * at) + h[4] * np.sin(2 * at)
        axes.plot(psi[::60], series, "o", mfc="none", color=color)
    axes.plot([], [], "o", mfc="none", color=style.GREY, label="reference, two harmonics")
    axes.set_xlabel("azimuth [deg]")
    axes.set_ylabel("flap angle [deg]")
    axes.set_xticks(range(0, 361, 90))
    figure.legend(loc="outside lower center", ncols=2)
    return figure
