# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight that can be stepped, kept and continued: one owner of everything that changes [ribera2004, Fig. 2].

1. Trim with the relaxation wake (`trim/`). 2. Convergence phase: states and controls frozen, the time-marching wake
advanced. 3. The wake gives the inflow at every blade station, held while the solver integrates F(y_dot, y, u; t) = 0 over
one step of azimuth; states, circulation and hub motion go to the wake; the wake advances by one step.
"""

from __future__ import annotations

import copy
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .arguments import checked
from .attitude import axes, euler_angles
from .control import Augmentation, Chain, Sensors, augmentation
from .engine import Engine, Turning, turning
from .errors import GroundContact, InputError, NumericalFailure, known
from .exchange import Exchange
from .flight_start import ConvergencePhase, begun, flight_model
from .inflow import InflowModel
from .integrators import INTEGRATORS, RTOL
from .model import Model
from .perturbation import Perturbation, offsets_of, perturbed
from .progress import Progress, Reported, Silent, heard
from .rotor_speed import CONSTANT, RotorSpeed, shares
from .snapshot import Snapshot
from .stepping import Instant, Stepping
from .sticks import STICKS, Ramp, StickPath
from .trim import INCH, Trim
from .units import number, quantity
from .views import html_table
from .wind import Surroundings, Wind, passing, wind_of

COLLECTIVE = STICKS.index("collective")
RTOLS = (1e-14, 0.1)
"""Least and largest relative tolerance that can be asked for."""


@dataclass(frozen=True)
class State:
    """What a flight is at, to look at; SI, angles in rad, body axes."""

    t: float
    y: np.ndarray
    velocity: np.ndarray
    """u, v, w [m/s]."""
    rates: np.ndarray
    """p, q, r [rad/s]."""
    attitude: np.ndarray
    """Roll, pitch, yaw [rad]."""
    position: np.ndarray
    """North, east, down [m]."""
    stick: dict[str, float]
    """Sticks of the pilot by name [inches about trim]."""


class Simulation(Stepping):
    """A flight from `start` that is flown step by step; owns states, wake, memory of the integrator, servo and clock.

    inflow: name or model as for `fly`, by default time-marching from a trim on a free wake, dynamic from a dynamic one; a
    marching wake goes through its convergence phase here. integrator: `fixed`, one step of order five per coupling step, or
    `ida`, variable in step and order. control, actuators: what is between sticks and blades, as for `fly`; None: nothing. rtol,
    stabilator, rotor_speed, wind, perturb: as for `fly`.

    `snapshot()` is everything that what comes depends on; after `restore(snapshot)` the same bits follow, here, in a copy or in
    another process. IDA hides its memory (history, order, step, derivatives): with `ida` a snapshot, and a restoration too,
    starts it anew at that moment, so that the flight that was kept and the one that goes on from it follow the same bits. They
    differ within the tolerances from a flight without a snapshot there. `fixed` does not notice.

    After a `NumericalFailure` a simulation is at no definite moment: restore a snapshot to go on.
    """

    model: Model

    wakes_per_revolution = 4
    """Wakes that a recorder keeps of a revolution."""

    @property
    def wake_steps(self) -> int:
        """Coupling steps from one kept wake to the next."""
        return max(1, self.model.steps_per_revolution // self.wakes_per_revolution)

    @checked
    def __init__(
        self,
        start: Trim,
        inflow: str | InflowModel | None = None,
        integrator: str = "fixed",
        control: Any = None,
        *,
        rtol: float = RTOL,
        stabilator: str = "held",
        rotor_speed: RotorSpeed | Engine = CONSTANT,
        actuators: Any = None,
        wind: Any = None,
        perturb: Any = None,
        progress: Reported = None,
    ):
        turned, made = turning(rotor_speed), augmentation(control, actuators)
        model = flight_model(start, inflow, turned)
        self._prepare(start, model, integrator, rtol, stabilator, turned, made, wind_of(wind))
        self._move(perturb)
        self.converge(heard(progress))

    @classmethod
    def prepared(
        cls,
        start: Trim,
        inflow: str | InflowModel | None,
        integrator: str,
        rtol: float,
        stabilator: str,
        rotor_speed: RotorSpeed | Engine = CONSTANT,
        control: Augmentation | None = None,
        wind: Wind | None = None,
        perturb: Perturbation = (),
    ) -> Simulation:
        """A simulation that has been checked; `converge` must follow."""
        sim = cls.__new__(cls)
        turned, made = turning(rotor_speed), augmentation(control)
        sim._prepare(start, flight_model(start, inflow, turned), integrator, rtol, stabilator, turned, made, wind)
        sim._move(perturb)
        return sim

    seconds_before: dict[str, float]

    def _move(self, perturb: Any) -> None:
        """Begin beside the trim."""
        self._y = perturbed(self._y, self.model.core.state_names(), offsets_of(perturb))

    def converge(self, progress: Progress | Silent) -> None:
        """Start the exchange; a marching wake goes through its convergence phase."""
        self.exchange, self.phase = begun(self.model, self.start, progress)

    def go_on(self, snapshot: Snapshot, phase: ConvergencePhase | None, seconds: dict[str, float]) -> None:
        """Go on from a moment of the same flight that was kept, in place of `converge` where its `phase` is given."""
        if phase is not None:
            self.phase = phase
        self.restore(snapshot)
        self.seconds = dict(seconds)
        self.seconds_before = {**seconds, "convergence": self.phase.seconds}

    def _prepare(
        self,
        start: Trim,
        model: Model,
        integrator: str,
        rtol: float,
        stabilator: str,
        turned: Turning,
        control: Augmentation,
        wind: Wind | None,
    ) -> None:
        """Everything but the exchange."""
        if integrator not in INTEGRATORS:
            raise InputError.choice("integrator", integrator, INTEGRATORS)
        if stabilator not in ("held", "scheduled"):
            raise InputError.of("stabilator", stabilator, "allowed: held, scheduled")
        rtol = number("rtol", rtol, *RTOLS)
        self.start = start
        self.integrator, self.rtol, self.stabilator = integrator, rtol, stabilator
        self.control = control
        self.chain = None if control.nothing else Chain(control, start)
        self.seconds_before = {}
        solver = INTEGRATORS[integrator](model, rtol, atol_scale=rtol / RTOL)
        # the states of a flight may be more than those of its trim
        y = model.core.trim_state(start.problem, start.x, 0.0)[0] if model.has_free_speed else start.state(0.0)
        self.wind = wind
        self.wind_told = None if wind is None else wind.described()
        self._surroundings = None if wind is None else Surroundings(model, wind)
        if self._surroundings is not None:
            # the trim's velocity is that through the air; over ground the air carries the aircraft
            y = passing(y, -self._surroundings.at(0.0, y, 0.0).origin)
        self._begin(model, solver, y, self._asked(None))
        self._blow()
        self._incidence = start.stabilator_incidence
        self.turning, self.engine = turned, copy.deepcopy(turned.engine)
        if self.engine is not None:
            self.engine.begin(start.mean_outputs()["power"] / model.omega, model.omega)
            self._drive()

    def _drive(self) -> None:
        """What the engines give over the step that begins."""
        collective = float(self._stick[COLLECTIVE])
        speed = float(self._y[self.model.layout["turn"][0] + 1])
        self._engine = known(self.engine).given(self.t, self.delta_t, speed, collective)

    def _blow(self) -> None:
        """Wind over the step that begins, where the aircraft is at its middle, half a step of azimuth on."""
        if self._surroundings is None:
            return
        half = 0.5 * self.delta_t
        azimuth = 2 * np.pi * (self._step + 0.5) / self.model.steps_per_revolution
        self._air = self._surroundings.at(self.t + half, self._y, azimuth, half)

    def _turned(self, t: float) -> None:
        """The clock follows the rotor, the engines it and the stick, the wind where all are."""
        self._follow_rotor(t)
        self._blow()
        height = self.model.core.least_height(self._y)
        if height is not None and height < 0.0:
            u, v, w, *_ = first = self._y[:10].tolist()
            x, y, z = axes(first[6:])[2]
            sinking = x * u + y * v + z * w
            raise GroundContact(f"contact with the ground at t = {t:.4f} s, sinking at {sinking:.2f} m/s")

    def _follow_rotor(self, t: float) -> None:
        if not self.model.has_free_speed:
            return
        azimuth = self.model.layout["turn"][0]
        turn = (float(self._y[azimuth]), float(self._y[azimuth + 1]), float(self.solver.rate[azimuth + 1]))
        self.clock.reach(self._step, t, turn)
        if self.engine is not None:
            self._drive()

    @property
    def state(self) -> State:
        """The states by name."""
        y = self.y
        angles = np.concatenate(euler_angles(y[None, 6:10]))
        about_trim = (self.hands - self._asked(None)) / INCH
        stick = dict(zip(STICKS, about_trim.tolist(), strict=True))
        return State(self.t, y, y[:3], y[3:6], angles, y[10:13], stick)

    @property
    def loads(self) -> dict[str, Any]:
        """Loads and section values at this moment with the sticks where they are, as a run records them."""
        inputs, _ = self._inputs(self.t, self._stick, np.zeros(4))
        y_dot = self.model.core.consistent_rate(self.t, self._y, inputs)
        return self.model.core.outputs(self.t, self._y, y_dot, inputs)

    def step(self, sticks: Mapping[str, float] | Sequence[float] | None = None, dt: Any = None) -> State:
        """Fly one coupling step, or the whole number of them nearest to `dt` (text with a unit).

        sticks: inches about trim, by name or all four (lateral, longitudinal, collective, pedal); None, and names that are
        absent: at trim. Each goes from where it is to the new place linearly within the first step and stays there.
        """
        target = self._asked(sticks)
        n = 1 if dt is None else max(1, round(self.clock.steps(self._step, quantity(dt, "s", "dt"))))
        try:
            for _ in range(n):
                self.follow(Ramp(self.t, self.clock.time(self._step + 1), self.hands, target))
        except (ArithmeticError, np.linalg.LinAlgError) as reason:
            raise NumericalFailure(f"simulation stopped at t = {self.t:.4f} s: {reason}") from reason
        return self.state

    @property
    def hands(self) -> np.ndarray:
        """Sticks (4,) [m from the stop] where the pilot has them."""
        return self._stick if self.chain is None else self.chain.hands

    def last(self, sticks: StickPath) -> Instant:
        """Where a flight along `sticks` ends."""
        return self.instant(sticks if self.chain is None else self.chain.rest(sticks, self.t), ends=True)

    def _pieces(self, sticks: StickPath, t0: float, t1: float) -> list[tuple[float, float]]:
        return sticks.pieces(t0, t1) if self.chain is None else self.chain.pieces(sticks, t0, t1)

    def _commanded(self, sticks: StickPath, piece: tuple[float, float], y: np.ndarray) -> StickPath:
        if self.chain is None:
            return sticks
        t = piece[0]
        return self.chain.path(sticks, piece, t == self.t, lambda: self._sensors(t, y))

    def _sensors(self, t: float, y: np.ndarray) -> Sensors:
        """What controllers may know at the states `y`, with the blades where they have been put so far."""
        model = self.model

        def measure() -> tuple[np.ndarray, dict[str, Any]]:
            inputs = self._inputs(t, known(self.chain).reached, np.zeros(4))[0]
            rate = model.core.consistent_rate(t, y, inputs)
            out = model.core.outputs(t, y, rate, inputs)
            return rate, out | {"torque": -model.hand * out["hub_moment"][2]}

        if model.has_free_speed:
            speed = float(y[model.layout["turn"][0] + 1])
        elif model.rotor_speed:
            speed = model.omega * float(shares(model.rotor_speed, np.asarray(t)))
        else:
            speed = model.omega
        return Sensors(y, self.start.condition.altitude, speed, measure, self._air)

    def _asked(self, sticks: Mapping[str, float] | Sequence[float] | None) -> np.ndarray:
        """Sticks [m from the stop] for what was asked [inches about trim]."""
        sticks = {} if sticks is None else sticks
        if isinstance(sticks, Mapping):
            for name in sticks:
                if name not in STICKS:
                    raise InputError.of("stick", name, f"allowed: {', '.join(STICKS)}")
            sticks = [sticks.get(name, 0.0) for name in STICKS]
        try:
            asked = np.array(sticks, dtype=float)
        except (TypeError, ValueError) as reason:
            raise InputError.of("sticks", sticks, "must be inches about trim, by name or all four") from reason
        if asked.shape != (4,) or not np.isfinite(asked).all():
            raise InputError.of("sticks", sticks, "must be four finite numbers, inches about trim")
        inches = self.start.stick_si / INCH + asked
        for name, moved, value, full in zip(STICKS, asked, inches, self.start.aircraft.stick_travel_in, strict=True):
            if moved and not -1e-9 <= value <= full + 1e-9:
                raise InputError.of(name, f"{value:.4g} in from the stop", f"must lie between 0 and {full:g} in")
        found: np.ndarray = INCH * inches
        return found

    def snapshot(self) -> Snapshot:
        """Everything that what comes depends on; with `ida` the integrator begins anew at this moment."""
        scalars: dict[str, Any] = {
            "step": self._step,
            "stick": self._stick.tolist(),
            "stabilator": self._incidence,
            **self.clock.memory(),
        }
        if self.engine is not None:
            scalars |= {"engine": list(known(self._engine)), "engine_memory": self.engine.memory()}
        parts = {
            "y": np.asarray(self._y, "<f8").tobytes(),
            "integrator": self.solver.memory(),
            "exchange": bytes(self.exchange.core.to_bytes()),
            **({} if self.chain is None else {"control": self.chain.memory()}),
        }
        return Snapshot(dict(self.configuration), scalars, parts)

    def restore(self, snapshot: Snapshot) -> None:
        """Go on from `snapshot`, of this simulation or of one of the same configuration from the same trim."""
        try:
            snapshot.check(self.configuration)
        except AttributeError as reason:
            kind = type(snapshot).__name__
            raise InputError.of("snapshot", kind, "must be what Simulation.snapshot returned") from reason
        exchange = Exchange.unpacked(self.model, snapshot.parts["exchange"])
        y = np.frombuffer(snapshot.parts["y"], "<f8").copy()
        self.clock.recall(snapshot.scalars)
        self.solver.recall(self.clock.time(snapshot.step), y, snapshot.parts["integrator"])
        self.exchange, self._y, self._step = exchange, y, snapshot.step
        self._stick = np.array(snapshot.scalars["stick"])
        self._incidence = snapshot.scalars["stabilator"]
        if self.engine is not None:
            torque, fuel = snapshot.scalars["engine"]
            self._engine = (torque, fuel)
            self.engine.recall(snapshot.scalars["engine_memory"])
        if self.chain is not None:
            self.chain.recall(snapshot.parts["control"])
        self._blow()

    @cached_property
    def configuration(self) -> dict[str, str]:
        """What a snapshot belongs to, by name: aircraft and its data, condition, inflow model, integrator, trim."""
        model, start = self.model, self.start
        data = json.dumps(model.data, sort_keys=True).encode()
        return {
            "aircraft": start.aircraft.name,
            "aircraft data": hashlib.sha256(data).hexdigest()[:16],
            "discretisation": str(start.aircraft.discretisation),
            "condition": str(start.condition),
            "inflow": str(model.inflow),
            "integrator": f"{self.integrator}, rtol {self.rtol!r}, {self.solver.schedule}",
            "stabilator": self.stabilator,
            "rotor speed": self.turning.name,
            "control": json.dumps(self.control.described(), sort_keys=True),
            "wind": json.dumps(self.wind_told, sort_keys=True),
            "trim": hashlib.sha256(np.asarray(start.x, "<f8").tobytes()).hexdigest()[:16],
        }

    def __reduce__(self) -> tuple[Any, ...]:
        """By value: the trim, the configuration and a snapshot."""
        own = (
            *(self.start, self.model, self.integrator, self.rtol),
            *(self.stabilator, self.turning, self.control, self.wind),
        )
        return _revived, (own, self.phase, self.seconds, self.snapshot())

    def _rows(self) -> list[tuple[str, str]]:
        state, deg = self.state, np.degrees
        roll, pitch, yaw = deg(state.attitude)
        p, q, r = deg(state.rates)
        return [
            ("aircraft", self.start.aircraft.name),
            ("inflow, integrator", f"{self.model.inflow.name}, {self.integrator}"),
            (
                "time",
                f"{self.t:.4f} s, {self._step} steps, {self._step / self.model.steps_per_revolution:.2f} revolutions",
            ),
            ("speed", f"{np.linalg.norm(state.velocity):.2f} m/s"),
            ("roll, pitch, yaw", f"{roll:.2f}, {pitch:.2f}, {yaw:.2f} deg"),
            ("p, q, r", f"{p:.2f}, {q:.2f}, {r:.2f} deg/s"),
            ("sticks about trim", ", ".join(f"{name} {value:+.2f}" for name, value in state.stick.items()) + " in"),
        ]

    def __repr__(self) -> str:
        """One line."""
        own = f"{self.start.aircraft.name}, {self.model.inflow.name}, {self.integrator}"
        return f"<Simulation: {own}, t = {self.t:.4f} s>"

    def _repr_html_(self) -> str:
        """A small table."""
        return html_table("Simulation", self._rows())


def _revived(
    own: tuple[Trim, Model, str, float, str, Turning, Augmentation, Wind | None],
    phase: ConvergencePhase,
    seconds: dict[str, float],
    snapshot: Snapshot,
) -> Simulation:
    """A simulation from its parts, without its convergence phase."""
    sim = Simulation.__new__(Simulation)
    sim._prepare(*own)
    sim.phase, sim.seconds = phase, dict(seconds)
    sim.restore(snapshot)
    return sim
