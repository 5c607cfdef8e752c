# SPDX-License-Identifier: MIT OR Apache-2.0
"""An environment of Gymnasium: the helicopter for controllers that learn, or that somebody writes.

    env = wf.gym.HelicopterEnv("hover")         # or gymnasium.make("wakeflight.gym:wakeflight/Helicopter-v0", task="hover")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(action)

An observation holds `OBSERVED` in order, SI and radians. An action holds where lateral, longitudinal, collective and pedal are to
be: 0 at trim, -1 and 1 at the stops, linear between; sticks get there no faster than the aircraft's may move. One step flies the
whole number of exchanges nearest to `dt`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .aircraft import Aircraft, load_aircraft
from .arguments import checked
from .attitude import euler_angles
from .condition import FlightCondition, condition_for
from .errors import InputError, NumericalFailure
from .inflow import InflowModel, inflow_model, trim_model
from .simulation import Simulation
from .snapshot import Snapshot
from .sticks import INCH, STICKS
from .trim import trim
from .units import number, quantity

try:
    import gymnasium
    from gymnasium import spaces
except ImportError as reason:
    raise ImportError("wakeflight.gym needs Gymnasium: pip install wakeflight[gym]") from reason

OBSERVED = {
    "u": ("m/s", 150.0),
    "v": ("m/s", 150.0),
    "w": ("m/s", 150.0),
    "p": ("rad/s", 6.0),
    "q": ("rad/s", 6.0),
    "r": ("rad/s", 6.0),
    "roll": ("rad", np.pi),
    "pitch": ("rad", np.pi / 2),
    "yaw": ("rad", np.pi),
    "north": ("m", 1e6),
    "east": ("m", 1e6),
    "height": ("m", 1e5),
    "climb_rate": ("m/s", 150.0),
    "beta_1c": ("rad", 1.0),
    "beta_1s": ("rad", 1.0),
    **{name: ("in", 30.0) for name in STICKS},
}
"""What is observed: unit and the largest size. Velocity and rates in body axes; north, east, height from where the flight began;
beta_1c, beta_1s: flapping of the rotor; sticks: inches about trim, right, aft, up, right pedal."""

LARGEST = np.array([most for _, most in OBSERVED.values()], dtype=np.float32)
"""The largest size of what is observed; what would be larger is observed as that."""

PLACE = {name: k for k, name in enumerate(OBSERVED)}
"""Where in an observation."""

OPTIONS = ("condition", "upset")
"""What `reset` takes."""
UPSET = {"u": 2.0, "v": 2.0, "w": 2.0, "p": 0.1, "q": 0.1, "r": 0.1, "roll": 0.1, "pitch": 0.1, "yaw": 0.1}
"""What a flight may begin away from its trim by, times the environment's `upset` [m/s, rad/s, rad]."""

LIMITS = {"roll": 1.2, "pitch": 1.0, "p": 4.0, "q": 4.0, "r": 4.0}
"""Beyond these an episode is over [rad, rad/s]."""


@dataclass(frozen=True)
class Task:
    """What is rewarded: staying near the trim. speed [m/s]: None is the aircraft's own; scales: how near, by what is observed."""

    speed: float | None
    scales: dict[str, float]


TASKS = {
    "hover": Task(0.0, {"north": 5.0, "east": 5.0, "height": 5.0, "roll": 0.2, "pitch": 0.2, "yaw": 0.3}),
    "cruise": Task(None, {"u": 4.0, "v": 4.0, "climb_rate": 2.0, "roll": 0.2, "pitch": 0.2, "yaw": 0.3}),
}
"""Tasks by name."""


class HelicopterEnv(gymnasium.Env[np.ndarray, np.ndarray]):
    """A helicopter in flight.

    task: `hover` or `cruise`, whose reward is exp(-1/2 sum (deviation from trim / scale)^2) of `TASKS`: 1 at trim, 0 far from it
    and where a flight has failed. aircraft: name or Aircraft. inflow: name or model as for `fly`; dynamic inflow flies about nine
    times as fast as time on one core, the marching wake of the preset paper three times. dt: between actions. seconds: length of
    an episode, which is then truncated; beyond `LIMITS`, or where the numbers end it, it is terminated and `info` says why.
    upset: share of `UPSET` that a flight may begin with. conditions: flights that are drawn from, each trimmed once, here; by
    default level flight at the speed of the task. control: between sticks and blades, as for `fly`.

    `reset(seed=..., options={"condition": k})` chooses the k-th condition, `{"upset": 0.0}` another upset. Of the same seed
    follow the same bits.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012

    @checked
    def __init__(
        self,
        task: str = "hover",
        aircraft: str | Aircraft = "uh60a",
        inflow: str | InflowModel = "dynamic",
        dt: Any = "20 ms",
        seconds: float = 20.0,
        upset: float = 1.0,
        conditions: Sequence[FlightCondition] | None = None,
        control: Any = None,
    ):
        if task not in TASKS:
            raise InputError.choice("task", task, TASKS)
        self.task = TASKS[task]
        loaded = load_aircraft(aircraft) if isinstance(aircraft, str) else aircraft
        self.aircraft = loaded
        self.seconds, self.upset = number("seconds", seconds, 0.01, 1e5), number("upset", upset, 0.0, 10.0)
        length = quantity(dt, "s", "dt")
        if not length > 0.0:
            raise InputError.of("dt", dt, "must be above 0 s")
        given: dict[str, Any] = {} if self.task.speed is None else {"speed": f"{self.task.speed} m/s"}
        chosen = [FlightCondition(flight_path="0 deg", **given)] if conditions is None else list(conditions)
        if not chosen:
            raise InputError.of("conditions", chosen, "must hold at least one")
        model = inflow_model(inflow)
        self._bank: list[tuple[Simulation, Snapshot]] = []
        for each in chosen:
            start = trim(loaded, condition_for(loaded, each), inflow=trim_model(model))
            sim = Simulation(start, inflow=model, control=control)
            self._bank.append((sim, sim.snapshot()))
        self._take(0)
        self.exchanges = max(1, round(length / self.sim.delta_t))
        """Exchanges of a step."""
        self.dt = self.exchanges * self.sim.delta_t
        """Length of a step [s]."""
        self.observation_space = spaces.Box(-LARGEST, LARGEST, dtype=np.float32)
        self.action_space = spaces.Box(-1.0, 1.0, (4,), dtype=np.float32)

    def _take(self, k: int) -> None:
        """The k-th condition of the bank."""
        self.sim, self._kept = self._bank[k]
        travel = np.asarray(self.aircraft.stick_travel_in, dtype=float)
        self._trim_in = self.sim.start.stick_si / INCH
        self._up, self._down = travel - self._trim_in, self._trim_in
        limits = self.aircraft.stick_rate_limit_in or self.aircraft.stick_travel_in
        self._reach = np.asarray(limits, dtype=float) * self.sim.delta_t
        self._inches = np.zeros(4)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begin a flight, upset from its trim as the seed has it."""
        super().reset(seed=seed)
        options = options or {}
        for name in options:
            if name not in OPTIONS:
                raise InputError.choice("options", name, OPTIONS)
        k = options.get("condition", int(self.np_random.integers(len(self._bank))))
        if k not in range(len(self._bank)):
            raise InputError.of("condition", k, f"must lie between 0 and {len(self._bank) - 1}")
        self._take(k)
        share = number("upset", options.get("upset", self.upset), 0.0, 10.0)
        drawn = {name: share * most * float(self.np_random.uniform(-1.0, 1.0)) for name, most in UPSET.items()}
        self.sim.restore(_upset(self._kept, drawn))
        self._reference = self._observe(_state(self._kept))
        return self._observe(self.sim.y), {"t": self.sim.t, "condition": k}

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Fly `dt` with the sticks on their way to `action`."""
        try:
            shares = np.asarray(action, dtype=float)
        except (TypeError, ValueError):
            shares = np.empty(0)
        if shares.shape != (4,) or not np.isfinite(shares).all():
            raise InputError.of("action", action, "must be four finite numbers between -1 and 1")
        shares = np.clip(shares, -1.0, 1.0)
        wanted = np.where(shares > 0.0, self._up, self._down) * shares
        info: dict[str, Any] = {}
        try:
            for _ in range(self.exchanges):
                self._inches = self._inches + np.clip(wanted - self._inches, -self._reach, self._reach)
                self.sim.step(self._inches.tolist())
            observation = self._observe(self.sim.y)
        except NumericalFailure as reason:
            info["failure"] = str(reason)
            observation = self._last
        beyond = [name for name, most in LIMITS.items() if abs(observation[PLACE[name]]) > most]
        if beyond:
            info["beyond"] = beyond
        failed = "failure" in info
        info["t"] = self.sim.t
        reward = 0.0 if failed else self._reward(observation)
        over = failed or bool(beyond)
        return observation, reward, over, not over and self.sim.t >= self.seconds - 1e-9, info

    def _reward(self, observation: np.ndarray) -> float:
        """1 at trim, 0 far from it."""
        names = list(self.task.scales)
        places = [PLACE[name] for name in names]
        missing = (observation[places] - self._reference[places]).astype(float) / np.array(
            list(self.task.scales.values())
        )
        return float(np.exp(-0.5 * missing @ missing))

    def _observe(self, y: np.ndarray) -> np.ndarray:
        """What is observed of the states `y`."""
        angles = np.array([float(each[0]) for each in euler_angles(y[None, 6:10])])
        u, v, w = y[:3]
        (sr, sp, _), (cr, cp, _) = np.sin(angles), np.cos(angles)
        climb = u * sp - cp * (v * sr + w * cr)
        beta = self._flapping(y)
        flown = np.concatenate([y[:6], angles, y[10:12], [-y[12], climb], beta, self._inches])
        found: np.ndarray = np.clip(flown, -LARGEST, LARGEST).astype(np.float32)
        self._last = found
        return found

    def _flapping(self, y: np.ndarray) -> np.ndarray:
        """Cosine and sine of the blades' flap angles over the disk (2,) [rad]."""
        model = self.sim.model
        flap = np.asarray(model.core.equivalent_angles(model.modal(y)[0])[0])
        psi = 2.0 * np.pi * np.array(self.sim.exchange.rows(self.sim.steps)) / model.steps_per_revolution
        scale = 2.0 / model.n_blades
        return np.array([scale * flap @ np.cos(psi), scale * flap @ np.sin(psi)])


def _state(snapshot: Snapshot) -> np.ndarray:
    return np.frombuffer(snapshot.parts["y"], "<f8").copy()


def _upset(snapshot: Snapshot, away: dict[str, float]) -> Snapshot:
    """A moment with its velocity, rates and attitude moved `away`."""
    y = _state(snapshot)
    y[:6] += [away[name] for name in "uvwpqr"]
    # small turns about the body's own axes, one after the other: yaw, pitch, roll
    for axis, name in ((3, "yaw"), (2, "pitch"), (1, "roll")):
        turn = np.zeros(4)
        turn[0], turn[axis] = np.cos(0.5 * away[name]), np.sin(0.5 * away[name])
        y[6:10] = _product(y[6:10], turn)
    return replace(snapshot, parts={**snapshot.parts, "y": y.astype("<f8").tobytes()})


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of two quaternions, scalar first."""
    w, v = a[0] * b[0] - a[1:] @ b[1:], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([w, *v])


gymnasium.register(id="wakeflight/Helicopter-v0", entry_point="wakeflight.gym:HelicopterEnv")
