# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim: the verb that finds sticks, attitude, periodic blade motion and inflow of a steady flight condition."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _core
from .aircraft import Aircraft
from .condition import FlightCondition, condition_for
from .errors import NumericalFailure
from .inflow import DynamicInflow, InflowModel, TimeMarchingWake, inflow_model, trim_model
from .model import Model, flight_regime
from .progress import Progress, Silent
from .regime import REVOLUTIONS
from .units import STANDARD_GRAVITY
from .wake_trim import PERIODIC, WakeInTrim, marching_map

INCH = 0.0254
LINEAR_TOLERANCE = 1e-4  # m/s2
ANGULAR_TOLERANCE = 1e-4  # rad/s2
HARMONIC_TOLERANCE = 1e-6  # rad, equivalent angle of a blade harmonic
CONTROL_TOLERANCE = 1e-3  # rad, change of a pitch control between trims on a free wake
MAX_OUTER = 30  # the last passes halve the change of the controls
MAX_REVOLUTIONS = 60  # of a marching wake in trim


@dataclass(frozen=True)
class Trim:
    """A trimmed flight; angles in rad, SI, sticks in inches from the stop."""

    model: Model
    problem: _core.TrimProblem
    x: np.ndarray
    inflow_map: np.ndarray  # (n_azimuths, n_stations), total induced inflow, positive down
    circulation: np.ndarray  # (n_azimuths, n_stations) [m2/s]
    wake: WakeInTrim | None
    seconds: float
    history: list[dict[str, float]] = field(default_factory=list)
    counters: dict[str, int] = field(default_factory=dict)

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft."""
        return self.model.aircraft

    @property
    def condition(self) -> FlightCondition:
        """The condition."""
        return self.model.condition

    @property
    def inflow(self) -> InflowModel:
        """The inflow model."""
        return self.model.inflow

    @property
    def stick_si(self) -> np.ndarray:
        """Lateral, longitudinal, collective, pedal [m from the stop]."""
        return self.x[:4].copy()

    @property
    def stick(self) -> dict[str, float]:
        """Sticks by name [inches from the stop]."""
        names = ("lateral", "longitudinal", "collective", "pedal")
        return dict(zip(names, (self.x[:4] / INCH).tolist(), strict=True))

    @property
    def roll(self) -> float:
        """Bank, right side down positive [rad]."""
        return float(self.x[4])

    @property
    def pitch(self) -> float:
        """Pitch attitude, nose up positive [rad]."""
        return float(self.x[5])

    @property
    def yaw(self) -> float:
        """Heading against the track, nose right positive [rad]."""
        return float(self.x[6])

    @property
    def pitch_controls(self) -> dict[str, float]:
        """Blade pitch theta_1c, theta_1s, theta_0 and tail-rotor pitch theta_tr [rad]."""
        return dict(zip(("theta_1c", "theta_1s", "theta_0", "theta_tr"), self._controls(), strict=True))

    def _controls(self) -> list[float]:
        return self.model.pitch_controls(self.x[:4]).tolist()

    @property
    def theta_1c(self) -> float:
        """Lateral cyclic [rad]."""
        return self._controls()[0]

    @property
    def theta_1s(self) -> float:
        """Longitudinal cyclic [rad]."""
        return self._controls()[1]

    @property
    def theta_0(self) -> float:
        """Collective pitch at the root [rad]."""
        return self._controls()[2]

    @property
    def theta_tr(self) -> float:
        """Tail-rotor pitch without bias [rad]."""
        return self._controls()[3]

    @property
    def residuals(self) -> dict[str, float]:
        """Largest residual of each kind: linear [m/s2], angular [rad/s2], blade harmonics [rad], inflow [-]."""
        return residual_norms(self.model, self.problem, self.x)

    @property
    def stabilator_incidence(self) -> float:
        """Incidence of the stabilator, trailing edge down positive [rad]."""
        return self.model.core.trim_stabilator(self.problem, self.x)

    def state(self, t: float = 0.0) -> np.ndarray:
        """State y of the trimmed revolution at time `t` [s]."""
        return self.model.core.trim_state(self.problem, self.x, t)[0]

    def inputs(self, t: float = 0.0) -> _core.Inputs:
        """Sticks and inflow that hold the trim, for the blades' azimuths at `t` [s]."""
        return trim_inputs(self, t)

    def mean_outputs(self) -> dict[str, Any]:
        """Loads, power and coefficients averaged over a revolution."""
        from .trim_results import mean_outputs

        return mean_outputs(self)

    def to_dataset(self):
        """The trim as an xarray Dataset."""
        from .trim_results import to_dataset

        return to_dataset(self)

    def table(self) -> str:
        """The trim as a table to print."""
        from .trim_results import table

        return table(self)


def trim(
    aircraft: Aircraft,
    condition: FlightCondition | None = None,
    inflow: str | InflowModel = "relaxation",
    progress: Progress | Silent | None = None,
    n_harmonics: int = 8,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> Trim:
    """Trim `aircraft` in `condition` (default: the aircraft's own) with an inflow model.

    n_harmonics: harmonics of the blades' periodic motion. control_tolerance: change of a pitch control [rad] between trims on a
    free wake at which they rest.

    Raises `InputError` for bad input and `NumericalFailure`, naming the equation that is not met, where no trim is found.
    """
    progress = progress or Silent()
    started = time.perf_counter()
    condition = condition_for(aircraft, condition)
    chosen = inflow_model(inflow)
    chosen.step(aircraft)
    progress.phase("trim", None)

    # dynamic inflow first: the result itself, or the start of the free wake
    dynamic = chosen if isinstance(chosen, DynamicInflow) else DynamicInflow(n_stations=chosen.n_stations)
    simple = Model.build(aircraft, condition, dynamic)
    problem = trim_problem(simple, None, n_harmonics)
    x = solve(simple, problem, first_guess(simple, problem))
    progress.advance(1, "dynamic inflow")
    if isinstance(chosen, DynamicInflow):
        inflow_map, circulation = dynamic_map(simple, problem, x)
        return Trim(simple, problem, x, inflow_map, circulation, None, time.perf_counter() - started)

    model = Model.build(aircraft, condition, trim_model(chosen))
    inflow_map, _ = dynamic_map(simple, problem, x, model.steps_per_revolution)
    x = np.delete(x, slice(7, 10))
    wake = WakeInTrim(model, inflow_map)
    problem, x, inflow_map, history = on_relaxation(
        model, wake, x, inflow_map, n_harmonics, progress, control_tolerance
    )
    circulation = wake.circulation
    if isinstance(chosen, TimeMarchingWake):
        model = Model.build(aircraft, condition, chosen)
        problem, x, inflow_map, circulation = on_marching(
            model, problem, x, wake, n_harmonics, progress, control_tolerance
        )
        history[-1] |= wake.last
    seconds = time.perf_counter() - started
    return Trim(model, problem, x, inflow_map, circulation, wake, seconds, history, dict(wake.counters))


def on_relaxation(
    model: Model,
    wake: WakeInTrim,
    x: np.ndarray,
    inflow_map: np.ndarray,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, list[dict[str, float]]]:
    """Trim and wake in turn until the pitch controls rest: problem, unknowns, inflow map, history."""
    history: list[dict[str, float]] = []
    for outer in range(MAX_OUTER):
        problem = trim_problem(model, inflow_map, n_harmonics)
        before = model.pitch_controls(x[:4])
        x = solve(model, problem, x)
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - before)))
        if outer > 0 and change < control_tolerance and wake.converged:
            history[-1]["control_change"] = change
            return problem, x, inflow_map, history
        wake.converge(problem, x)
        inflow_map = wake.inflow_map
        history.append({**wake.last, "control_change": change})
        progress.advance(1, f"inflow change {wake.last['inflow_change']:.1e}, controls {change:.1e} rad")
    raise NumericalFailure(
        f"trim on the free wake did not settle in {MAX_OUTER} passes: pitch controls still move {change:.2e} rad "
        f"(allowed {control_tolerance:g}), inflow {wake.last['inflow_change']:.2e} of the tip speed "
        f"(allowed {model.inflow.inflow_tolerance:g})"
    )


def convention(condition: FlightCondition) -> tuple[str, float]:
    """What fixes the lateral degree of freedom: bank, sideslip, or the heading where the aircraft hardly moves."""
    if condition.heading == "free":
        return "bank", condition.bank
    if condition.speed < 1.0:
        return "heading", -condition.sideslip
    return "sideslip", condition.sideslip


def trim_problem(model: Model, inflow_map: np.ndarray | None, n_harmonics: int = 8) -> _core.TrimProblem:
    """The trim equations of the model's condition, on a held inflow map or with dynamic inflow."""
    c = model.condition
    kind, angle = convention(c)
    n_azimuths = model.steps_per_revolution if inflow_map is None else inflow_map.shape[0]
    mean = 0.0
    if inflow_map is not None:
        mean = model.disk_mean(inflow_map)
    # at least four azimuths per highest harmonic
    fine = n_azimuths * int(np.ceil(4 * n_harmonics / n_azimuths))
    if inflow_map is not None and fine > n_azimuths:
        inflow_map = resample(inflow_map, fine)
    return _core.TrimProblem(c.speed, c.flight_path, c.turn_rate, kind, angle, n_harmonics, fine, inflow_map, mean)


def resample(inflow_map: np.ndarray, n: int) -> np.ndarray:
    """Trigonometric interpolation of a periodic map (n_azimuths, ...) to `n` azimuths."""
    from scipy.signal import resample as fourier_resample

    return np.ascontiguousarray(fourier_resample(inflow_map, n, axis=0))


def first_guess(model: Model, problem: _core.TrimProblem) -> np.ndarray:
    """Closed-form start: momentum inflow, linear blade-element thrust and flapping, sticks through the rigging.

    C_T = sigma a/2 [theta_75 (1/3 + mu^2/2) - lambda/2]; the cyclic holds two degrees of forward flapping against
    (8/3 theta_75 - 2 lambda) mu; drag of four per cent of the weight at 80 kt, growing with the square of the speed.
    """
    modes, inflow, tail = model.core.trim_layout(problem)
    x = np.zeros(modes[-1])
    c, rotor, data = model.condition, model.rotor, model.data
    area = np.pi * rotor["radius"] ** 2
    ct = c.gross_mass * STANDARD_GRAVITY / (model.density * area * model.tip_speed**2)
    mu = c.speed * np.cos(c.flight_path) / model.tip_speed
    lambda_0 = np.sqrt(ct / 2)
    for _ in range(50):
        lambda_0 = 0.5 * (lambda_0 + ct / (2 * np.hypot(mu, lambda_0)))
    drag = 0.04 * (c.speed / 41.0) ** 2
    through = lambda_0 + c.speed / model.tip_speed * (drag + np.sin(c.flight_path))
    loading = 2 * ct / (5.7 * model.aircraft.solidity)
    pitch_75 = (loading + 0.5 * through) / (1 / 3 + mu**2 / 2)
    twist = data["rotor"]["blade"]["twist"]
    theta_0 = pitch_75 - np.interp(0.75 * rotor["radius"], twist["x"], twist["y"])
    forward = np.radians(2.0)
    theta_1s = -(forward + mu * (8 / 3 * pitch_75 - 2 * through) / (1 - mu**2 / 2))

    # sticks that give this pitch, the pedal at mid travel
    matrix, offset = np.asarray(data["rigging"]["matrix"]), np.asarray(data["rigging"]["offset"])
    pedal = 0.5 * INCH * model.aircraft.stick_travel_in[3]
    wanted = np.array([np.radians(1.0), theta_1s, theta_0]) - offset[:3] - matrix[:3, 3] * pedal
    x[:3], x[3] = np.linalg.solve(matrix[:3, :3], wanted), pedal
    x[5] = forward + data["rotor"]["shaft_tilt_forward"] - drag
    kind, angle = convention(c)
    if kind == "sideslip":
        x[6] = -angle
    x[inflow] = lambda_0
    if tail < modes[0]:
        x[tail] = 0.02
    flap = modes[rotor["flap_mode"]]
    x[flap] = np.radians(3.0) / rotor["flap_per_coordinate"]
    x[flap + 1] = forward / rotor["flap_per_coordinate"]
    lag_mode = int(np.argmin(rotor["frequencies"]))
    lead = rotor["root_lead_slope"][lag_mode]
    if abs(lead) > 0:
        x[modes[lag_mode]] = -np.radians(3.0) / lead
    return x


def solve(model: Model, problem: _core.TrimProblem, x0: np.ndarray) -> np.ndarray:
    """Solve the trim equations with MINPACK's hybrid method and the exact Jacobian."""
    from scipy.optimize import root

    core = model.core
    result = root(
        lambda x: core.trim_residual(problem, x),
        x0,
        jac=lambda x: core.trim_jacobian(problem, x),
        method="hybr",
        options={"xtol": 1e-11, "maxfev": 400},
    )
    x = result.x
    if not np.all(np.isfinite(x)):
        raise NumericalFailure("trim failed: the iteration left the finite numbers")
    norms = residual_norms(model, problem, x)
    if (
        norms["linear"] > LINEAR_TOLERANCE
        or norms["angular"] > ANGULAR_TOLERANCE
        or norms["harmonics"] > HARMONIC_TOLERANCE
        or norms["other"] > 1e-6
    ):
        raise NumericalFailure(failure_text(model, problem, x))
    return x


def residual_norms(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> dict[str, float]:
    """Largest residuals by kind."""
    f = np.abs(model.core.trim_residual(problem, x))
    modes, _, _ = model.core.trim_layout(problem)
    return {
        "linear": float(f[:3].max()),
        "angular": float(f[3:6].max()),
        "other": float(f[6 : modes[0]].max()),
        "harmonics": float(f[modes[0] :].max()),
    }


def failure_text(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> str:
    """Which equation is not met, and where the iteration stopped."""
    f = model.core.trim_residual(problem, x)
    names = model.core.trim_equations(problem)
    modes, _, _ = model.core.trim_layout(problem)
    tolerance = np.full(f.size, HARMONIC_TOLERANCE)
    tolerance[:6] = LINEAR_TOLERANCE
    worst = int(np.nanargmax(np.abs(f) / tolerance))
    unit = "m/s2" if worst < 3 else "rad/s2" if worst < 6 else "rad" if worst >= modes[0] else "-"
    sticks = ", ".join(f"{v / INCH:.2f}" for v in x[:4])
    return (
        f"no trim found: equation {names[worst]} is not met (residual {f[worst]:.3g} {unit}); stopped at sticks "
        f"lateral, longitudinal, collective, pedal = {sticks} in, roll {np.degrees(x[4]):.1f} deg, "
        f"pitch {np.degrees(x[5]):.1f} deg, heading against track {np.degrees(x[6]):.1f} deg"
    )


def dynamic_map(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, n_azimuths: int | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Inflow and circulation maps (n_azimuths, n_stations) of a trim with dynamic inflow."""
    n = n_azimuths or model.steps_per_revolution
    _, i, _ = model.core.trim_layout(problem)
    mean, sine, cosine = x[i : i + 3]
    psi = 2 * np.pi * np.arange(n) / n
    r = model.stations / model.rotor["radius"]
    inflow_map = mean + np.outer(cosine * np.cos(psi) + sine * np.sin(psi), r)
    q, q_dot = model.core.trim_motion(problem, x, n)
    y, _ = model.core.trim_state(problem, x, 0.0)
    hub_velocity, hub_rates = model.core.hub(y)
    circulation = np.array(
        [
            model.core.section_circulation(hub_velocity, hub_rates, x[:4], psi[k], q[k], q_dot[k], inflow_map[k])[0]
            for k in range(n)
        ]
    )
    return inflow_map, circulation


def trim_inputs(start: Trim, t: float) -> _core.Inputs:
    """Inputs that hold the trim at time `t`: the map at each blade's azimuth, or the inflow states."""
    model = start.model
    if isinstance(model.inflow, DynamicInflow):
        return _core.Inputs(start.x[:4], np.zeros(4), 0.0, None, 0.0, start.stabilator_incidence)
    n = start.inflow_map.shape[0]
    first = round(model.omega * t / (2 * np.pi) * n)
    rows = [(first + b * n // model.n_blades) % n for b in range(model.n_blades)]
    mean = model.disk_mean(start.inflow_map)
    return _core.Inputs(start.x[:4], np.zeros(4), 0.0, start.inflow_map[rows], mean, start.stabilator_incidence)


def on_marching(
    model: Model,
    problem: _core.TrimProblem,
    x: np.ndarray,
    wake: WakeInTrim,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, np.ndarray]:
    """Trim on the time-marching wake: march a revolution at the trimmed motion, trim on its inflow, until controls rest.

    In hover and axial flight the wake does not become periodic: the trim is then on its mean inflow over the later half of the
    revolutions marched, once the trims on the two halves of that mean are as close as controls that rest.
    """
    march = wake.marching(model)
    regime = flight_regime(model.aircraft, model.condition)
    maps, held, change = [(wake.inflow_map, wake.circulation)], wake.inflow_map, np.inf
    for revolution in range(MAX_REVOLUTIONS):
        maps.append(marching_map(march, problem, x))
        latest = maps[-1][0]
        # as on the stand: the unsteadiness of an axial wake is not taken for a change of condition
        held = latest if regime == "forward" or revolution == 0 else 0.5 * (held + latest)
        before = model.pitch_controls(x[:4])
        problem = trim_problem(model, held, n_harmonics)
        x = solve(model, problem, x)
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - before)))
        progress.advance(1, f"marching wake: controls {change:.1e} rad")
        n = averaged_revolutions(model, regime, maps, change, control_tolerance)
        if n > 1:
            parts = [mean_trim(model, part, x, n_harmonics) for part in (maps[-n : -(n // 2)], maps[-(n // 2) :])]
            change = 0.5 * float(np.max(np.abs(np.subtract(*(model.pitch_controls(part[1][:4]) for part in parts)))))
        if n and change < control_tolerance:
            wake.counters["wake_segment_evaluations"] += march.segment_evaluations
            wake.last |= {"averaged": n, "control_change": change}
            return (problem, x, *maps[-1]) if n == 1 else mean_trim(model, maps[-n:], x, n_harmonics)
    raise NumericalFailure(
        f"trim on the time-marching wake did not settle in {MAX_REVOLUTIONS} revolutions: controls still move {change:.2e} rad "
        f"(allowed {control_tolerance:g})"
    )


def averaged_revolutions(
    model: Model, regime: str, maps: list[tuple[np.ndarray, np.ndarray]], change: float, control_tolerance: float
) -> int:
    """How many of the last revolutions of a marching wake a trim may rest on: none yet, the last, or a mean of several.

    Of a wake in axial flow a small change of the controls is not enough for the last alone: it leaves its periodic solution
    slowly. Its later half is taken from as many revolutions on as the stand marches.
    """
    revolution = len(maps) - 1
    if regime == "forward":
        return int(revolution > 3 and change < 0.1 * control_tolerance)
    moved = np.sqrt(np.mean((maps[-1][0] - maps[-2][0]) ** 2 @ model.area_weights))
    if revolution > 3 and change < 0.01 * control_tolerance and moved < PERIODIC * abs(model.disk_mean(maps[-1][0])):
        return 1
    return 2 * (revolution // 4) if revolution >= REVOLUTIONS[regime][0] else 0


def mean_trim(
    model: Model, maps: list[tuple[np.ndarray, np.ndarray]], x: np.ndarray, n_harmonics: int
) -> tuple[_core.TrimProblem, np.ndarray, np.ndarray, np.ndarray]:
    """Trim on the mean of inflow and circulation maps of several revolutions: problem, unknowns, both means."""
    inflow_map, circulation = (np.mean(each, axis=0) for each in zip(*maps, strict=True))
    problem = trim_problem(model, inflow_map, n_harmonics)
    return problem, solve(model, problem, x), inflow_map, circulation
