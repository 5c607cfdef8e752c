# SPDX-License-Identifier: MIT OR Apache-2.0
"""The runs a study can repeat, each giving samples of the quantities that are compared and what it cost."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np

from ...condition import FlightCondition
from ...flight import Flight, flown_steps, fly
from ...inflow import DynamicInflow, trim_model
from ...maneuvers import Maneuver
from ...model import Model, flight_regime
from ...modes import blade_modes
from ...progress import Progress, Silent
from ...trim import Trim, trim
from ...trim_results import HORSEPOWER, first_harmonics
from ...tunnel import check as check_stand
from ...tunnel import tunnel
from .parameters import Case, Parameter, tightened


class Quantity(NamedTuple):
    """What is compared: name, unit it is shown in, and the factor from SI to that unit."""

    name: str
    unit: str
    factor: float = 1.0


DEGREES = 180.0 / np.pi

TRIM_QUANTITIES = (
    Quantity("power", "hp", 1.0 / HORSEPOWER),
    Quantity("ct", "1"),
    Quantity("lambda_0", "1"),
    Quantity("lambda_1c", "1"),
    Quantity("lambda_1s", "1"),
    Quantity("lateral", "in"),
    Quantity("longitudinal", "in"),
    Quantity("collective", "in"),
    Quantity("pedal", "in"),
    Quantity("pitch", "deg", DEGREES),
    Quantity("roll", "deg", DEGREES),
    Quantity("yaw", "deg", DEGREES),
    Quantity("beta_0", "deg", DEGREES),
    Quantity("beta_1c", "deg", DEGREES),
    Quantity("beta_1s", "deg", DEGREES),
)

FLIGHT_QUANTITIES = (
    Quantity("u", "m/s"),
    Quantity("v", "m/s"),
    Quantity("w", "m/s"),
    Quantity("p", "deg/s", DEGREES),
    Quantity("q", "deg/s", DEGREES),
    Quantity("r", "deg/s", DEGREES),
    Quantity("roll", "deg", DEGREES),
    Quantity("pitch", "deg", DEGREES),
    Quantity("force_z", "kN", 1e-3),
    Quantity("moment_x", "kN m", 1e-3),
    Quantity("moment_y", "kN m", 1e-3),
    Quantity("beta_1c", "deg", DEGREES),
    Quantity("beta_1s", "deg", DEGREES),
    Quantity("ct", "1"),
    Quantity("inflow_mean", "1"),
)


@dataclass(frozen=True)
class Outcome:
    """One run: samples (n_instants, n_quantities) in the units shown, their times [s], and counted and clocked cost."""

    samples: np.ndarray
    times: np.ndarray
    seconds: float
    cpu_seconds: float
    counters: dict[str, int] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


class Run(Protocol):
    """A run that can be repeated with other discretisations."""

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """What is compared."""

    @property
    def title(self) -> str:
        """What is run, in a few words."""

    def check(self, case: Case) -> None:
        """Everything that can be refused before anything starts."""

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Run it."""


class Trimming:
    """A trim, remembered for settings that do not change it."""

    def __init__(self, varied: Parameter, condition: FlightCondition):
        self.varied, self.condition = varied, condition
        self._known: list[tuple[tuple[Any, ...], Trim, Outcome]] = []

    def start(self, case: Case, inflow: Any, progress: Progress | Silent) -> tuple[Trim, Outcome]:
        """Trim of the case with an inflow model, and what it cost when it was made."""
        inflow = tightened(self.varied, inflow)
        key = (case.flying.discretisation, inflow, case.n_harmonics, case.control_tolerance)
        for known, start, cost in self._known:
            if known == key:
                return start, cost
        clock = _Clock()
        start = trim(
            case.flying,
            self.condition,
            inflow=inflow,
            progress=progress,
            n_harmonics=case.n_harmonics,
            control_tolerance=case.control_tolerance,
        )
        values = np.array([[q.factor * value for q, value in zip(TRIM_QUANTITIES, trim_values(start), strict=True)]])
        cost = Outcome(values, np.zeros(1), *clock.read(), dict(start.counters))
        self._known.append((key, start, cost))
        return start, cost


class TrimRun:
    """Trim in a condition: sticks, attitude, power, inflow and flapping."""

    quantities = TRIM_QUANTITIES

    def __init__(self, varied: Parameter, condition: FlightCondition):
        self.trimming = Trimming(varied, condition)

    @property
    def title(self) -> str:
        """What is run."""
        return "trim"

    def check(self, case: Case) -> None:
        """Compile the aircraft."""
        build(case, self.trimming.condition)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Values of the trim."""
        return self.trimming.start(case, case.inflow, progress)[1]


TUNNEL_QUANTITIES = (
    Quantity("ct", "1"),
    Quantity("cq", "1"),
    Quantity("power", "hp", 1.0 / HORSEPOWER),
    Quantity("lambda_0", "1"),
    Quantity("lambda_1c", "1"),
    Quantity("lambda_1s", "1"),
    Quantity("theta_0", "deg", DEGREES),
    Quantity("theta_1c", "deg", DEGREES),
    Quantity("theta_1s", "deg", DEGREES),
    Quantity("beta_0", "deg", DEGREES),
    Quantity("beta_1c", "deg", DEGREES),
    Quantity("beta_1s", "deg", DEGREES),
)


class TunnelRun:
    """An isolated rotor on a stand: thrust, torque, inflow, controls and flapping."""

    quantities = TUNNEL_QUANTITIES

    def __init__(self, varied: Parameter, stand: Mapping[str, Any]):
        self.varied, self.stand = varied, dict(stand)

    @property
    def title(self) -> str:
        """What is run."""
        given = ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in self.stand.items())
        return f"tunnel, {given}" if given else "tunnel"

    def check(self, case: Case) -> None:
        """What the stand refuses."""
        check_stand(case.aircraft, case.inflow, n_harmonics=case.n_harmonics, **self.stand)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Means of the solved rotor; what it says of itself where its wake does not rest."""
        clock = _Clock()
        inflow = tightened(self.varied, case.inflow)
        found = tunnel(case.aircraft, inflow=inflow, n_harmonics=case.n_harmonics, progress=progress, **self.stand)
        seconds, cpu = clock.read()
        harmonics = dict(zip(("lambda_0", "lambda_1c", "lambda_1s"), found.inflow_harmonics(), strict=True))
        values = [q.factor * harmonics.get(q.name, getattr(found, q.name, 0.0)) for q in self.quantities]
        counted = {"segment_evaluations": int(found.data.attrs.get("segment_evaluations", 0))}
        notes = () if found.settled else tuple(found.notes)
        return Outcome(np.array([values]), np.zeros(1), seconds, cpu, counted, notes)


class ModesRun:
    """Frequencies of the rotating blade's modes: the finite elements alone."""

    def __init__(self, n_modes: int):
        self.n_modes = n_modes
        self.quantities = tuple(Quantity(f"mode_{i}", "1/rev") for i in range(1, n_modes + 1))

    @property
    def title(self) -> str:
        """What is run."""
        return "blade modes"

    def check(self, case: Case) -> None:
        """As many modes as the elements can carry."""
        blade_modes(case.flying, self.n_modes, case.flying.discretisation.n_elements)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Frequencies per revolution, ascending."""
        clock = _Clock()
        found = blade_modes(case.flying, self.n_modes, case.flying.discretisation.n_elements)
        return Outcome(found.frequencies[None, :], np.zeros(1), *clock.read())


class FlightRun:
    """A manoeuvre from its trim: histories at the instants that all settings share."""

    quantities = FLIGHT_QUANTITIES

    def __init__(
        self,
        varied: Parameter,
        condition: FlightCondition,
        maneuver: Maneuver,
        revolutions: float | None,
        integrator: str,
    ):
        self.trimming = Trimming(varied, condition)
        self.maneuver, self.revolutions, self.integrator = maneuver, revolutions, integrator

    @property
    def title(self) -> str:
        """What is run."""
        flown = f", {self.revolutions:g} revolutions" if self.revolutions is not None else ""
        return f"{self.maneuver.name}{flown}"

    def check(self, case: Case) -> None:
        """Compile the aircraft; the manoeuvre must fit its sticks."""
        model = build(case, self.trimming.condition)
        flown = self.maneuver.for_aircraft(case.flying.stick_travel_in, model.omega)
        flown.check_span(case.flying.stick_travel_in)
        flown_steps(model, flown, self.revolutions)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Histories of the flight."""
        start, cost = self.trimming.start(case, trim_model(case.inflow), progress)
        clock = _Clock()
        flight: Flight = fly(
            start,
            self.maneuver,
            inflow=start.inflow if isinstance(start.inflow, DynamicInflow) else case.inflow,
            revolutions=self.revolutions,
            integrator=self.integrator,
            progress=progress,
            rtol=case.rtol,
        )
        seconds, cpu = clock.read()
        data = flight.data
        samples = np.column_stack([q.factor * data[q.name].values for q in self.quantities])
        counted = {
            name: int(data.attrs[name])
            for name in (
                "residual_evaluations",
                "jacobians",
                "segment_evaluations",
                "relaxation_iterations",
                "circulation_followed",
            )
            if name in data.attrs
        }
        trimmed = {f"trim_{name}": n for name, n in cost.counters.items()}
        return Outcome(
            samples,
            data["time"].values,
            seconds + cost.seconds,
            cpu + cost.cpu_seconds,
            {**counted, **trimmed},
        )


def build(case: Case, condition: FlightCondition) -> Model:
    """The compiled model; what the physics core refuses becomes an error of the input."""
    from ...errors import InputError

    inflow = case.inflow.resolved(flight_regime(case.flying, condition))
    inflow.step(case.flying)
    if not isinstance(inflow, DynamicInflow):
        inflow.core_options(case.flying)
    try:
        return Model.build(case.flying, condition, inflow)
    except ValueError as reason:
        raise InputError(f"{case.flying.path}: {reason}") from None


def trim_values(start: Trim) -> list[float]:
    """Values of `TRIM_QUANTITIES`, SI and radians, sticks in inches."""
    mean = start.mean_outputs()
    values: dict[str, float] = {
        **start.stick,
        **dict(zip(("lambda_0", "lambda_1c", "lambda_1s"), first_harmonics(start), strict=True)),
        **{name: float(mean[name]) for name in ("power", "ct", "beta_0", "beta_1c", "beta_1s")},
        "pitch": start.pitch,
        "roll": start.roll,
        "yaw": start.yaw,
    }
    return [values[q.name] for q in TRIM_QUANTITIES]


def warm() -> None:
    """Load what runs load when they first need it: the first setting must not pay for it."""
    from importlib import import_module

    for name in ("scipy.optimize", "scipy.signal", "sksundae.ida", "xarray"):
        import_module(name)


class _Clock:
    """Wall clock and time of the processor, all threads."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()

    def read(self) -> tuple[float, float]:
        return time.perf_counter() - self._wall, time.process_time() - self._cpu
