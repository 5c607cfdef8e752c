# SPDX-License-Identifier: MIT OR Apache-2.0
"""The runs a study can repeat, each giving samples of the quantities that are compared and what it cost."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple, Protocol

import numpy as np

from ...errors import InputError, NumericalFailure, known
from ...flight import flown_steps
from ...inflow import trim_model
from ...model import Model, flight_regime
from ...modes import blade_modes
from ...progress import Progress, Silent
from ...trim import Trim
from ...trim.table import HORSEPOWER
from ...tunnel import check as check_stand
from ..case import Case, Done, Trims, attempt, run
from .parameters import Parameter, tightened


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

COUNTED = (
    "residual_evaluations",
    "jacobians",
    "segment_evaluations",
    "relaxation_iterations",
    "circulation_followed",
)
"""What a flight counts."""


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

    def title(self, case: Case) -> str:
        """What is run, in a few words."""

    def check(self, case: Case) -> None:
        """Everything that can be refused before anything starts."""

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Run it; a failure is raised."""


class TrimRun:
    """Trim in a condition: sticks, attitude, power, inflow and flapping."""

    quantities = TRIM_QUANTITIES

    def __init__(self, varied: Parameter):
        self.varied, self.trims = varied, Trims()

    def title(self, _: Case) -> str:
        """What is run."""
        return "trim"

    def check(self, case: Case) -> None:
        """Compile the aircraft."""
        build(case)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Values of the trim."""
        done = finished(run(replace(case, inflow=tightened(self.varied, case.inflow)), progress, self.trims))
        values = [q.factor * value for q, value in zip(self.quantities, trim_values(done.answer), strict=True)]
        counted = dict(done.answer.counters)
        return Outcome(np.array([values]), np.zeros(1), done.seconds, done.cpu_seconds, counted)


class TunnelRun:
    """An isolated rotor on a stand: thrust, torque, inflow, controls and flapping."""

    quantities = TUNNEL_QUANTITIES

    def __init__(self, varied: Parameter):
        self.varied = varied

    def title(self, case: Case) -> str:
        """What is run."""
        given = ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in (case.stand or {}).items())
        return f"tunnel, {given}" if given else "tunnel"

    def check(self, case: Case) -> None:
        """What the stand refuses."""
        check_stand(case.aircraft, case.inflow, n_harmonics=case.n_harmonics, **(case.stand or {}))

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Means of the solved rotor; what it says of itself where its wake does not rest."""
        done = finished(run(replace(case, inflow=tightened(self.varied, case.inflow)), progress))
        found = done.answer
        means = {name: float(values) for name, values in found.data.data_vars.items() if values.ndim == 0}
        means |= dict(zip(("lambda_0", "lambda_1c", "lambda_1s"), found.inflow_harmonics(), strict=True))
        values = [q.factor * means[q.name] for q in self.quantities]
        counted = {"segment_evaluations": int(found.data.attrs.get("segment_evaluations", 0))}
        notes = () if found.settled else tuple(found.notes)
        return Outcome(np.array([values]), np.zeros(1), done.seconds, done.cpu_seconds, counted, notes)


class ModesRun:
    """Frequencies of the rotating blade's modes: the finite elements alone."""

    def __init__(self, n_modes: int):
        self.n_modes = n_modes
        self.quantities = tuple(Quantity(f"mode_{i}", "1/rev") for i in range(1, n_modes + 1))

    def title(self, _: Case) -> str:
        """What is run."""
        return "blade modes"

    def check(self, case: Case) -> None:
        """As many modes as the elements can carry."""
        blade_modes(case.aircraft, self.n_modes, case.aircraft.discretisation.n_elements)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Frequencies per revolution, ascending."""
        elements = case.aircraft.discretisation.n_elements
        done = finished(attempt(lambda: blade_modes(case.aircraft, self.n_modes, elements)))
        return Outcome(done.answer.frequencies[None, :], np.zeros(1), done.seconds, done.cpu_seconds)


class FlightRun:
    """A manoeuvre from its trim: histories at the instants that all settings share."""

    quantities = FLIGHT_QUANTITIES

    def __init__(self, varied: Parameter):
        self.varied, self.trims = varied, Trims()

    def title(self, case: Case) -> str:
        """What is run."""
        flown = f", {case.revolutions:g} revolutions" if case.revolutions is not None else ""
        return f"{known(case.maneuver).name}{flown}"

    def check(self, case: Case) -> None:
        """Compile the aircraft; the manoeuvre must fit its sticks."""
        model = build(case)
        travel = case.helicopter.stick_travel_in
        flown = known(case.maneuver).for_aircraft(travel, model.omega)
        flown.check_span(travel)
        flown_steps(model, flown, case.revolutions)

    def outcome(self, case: Case, progress: Progress | Silent) -> Outcome:
        """Histories of the flight."""
        trimmed_with = tightened(self.varied, trim_model(case.flown_inflow))
        done = finished(run(replace(case, trim_inflow=trimmed_with), progress, self.trims))
        data, start = done.data, known(done.start)
        samples = np.column_stack([q.factor * data[q.name].values for q in self.quantities])
        counted = {name: int(data.attrs[name]) for name in COUNTED if name in data.attrs}
        trimmed = {f"trim_{name}": n for name, n in start.answer.counters.items()}
        return Outcome(
            samples,
            data["time"].values,
            done.seconds + start.seconds,
            done.cpu_seconds + start.cpu_seconds,
            {**counted, **trimmed},
        )


def finished(done: Done) -> Done:
    """A run that must have ended well."""
    if done.failure:
        raise NumericalFailure(done.failure, partial=done.answer)
    return done


def build(case: Case) -> Model:
    """The compiled model; what the physics core refuses becomes an error of the input."""
    aircraft, condition = case.helicopter, known(case.condition)
    inflow = case.flown_inflow.resolved(flight_regime(aircraft, condition))
    inflow.check_on(aircraft)
    try:
        return Model.build(aircraft, condition, inflow)
    except ValueError as reason:
        raise InputError(f"{case.aircraft.path}: {reason}") from None


def trim_values(start: Trim) -> list[float]:
    """Values of `TRIM_QUANTITIES`, SI and radians, sticks in inches."""
    mean = start.mean_outputs()
    values: dict[str, float] = {
        **start.stick,
        **dict(zip(("lambda_0", "lambda_1c", "lambda_1s"), start.inflow_harmonics(), strict=True)),
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
