# SPDX-License-Identifier: MIT OR Apache-2.0
"""Collective that moves in time on the stand: blades, circulation and inflow followed step by step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from ..errors import InputError, NumericalFailure
from ..integrators import FixedIntegrator
from ..monitors import Places, failures, rotor
from ..progress import Progress, Silent
from ..units import quantity
from .condition import within
from .solved import Solved

if TYPE_CHECKING:
    import xarray as xr


LONGEST = 1000.0
"""Revolutions that a transient may last at most."""


@dataclass(frozen=True)
class History:
    """Change of collective over time, linear between its points and held after the last; it begins as the stand was.

    time [s], ascending from the start of the transient; collective at the root [rad].
    """

    time: np.ndarray
    collective: np.ndarray

    def at(self, t: float) -> float:
        """Collective [rad] at time `t` [s]."""
        return float(np.interp(t, self.time, self.collective))


def history(points: Sequence[Any], start: float) -> History:
    """From pairs (time, collective), text with units; the first point is the stand's own collective at time zero."""
    form = 'must be pairs (time, collective) such as [("0 s", "5 deg"), ("0.035 s", "12 deg")]'
    if isinstance(points, str) or not isinstance(points, Sequence):
        raise InputError.of("collective", points, form)
    time, angle = [0.0], [start]
    for pair in points:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise InputError.of("collective", pair, form)
        t = quantity(pair[0], "s", "collective time")
        theta = within("collective", pair[1], "rad", -0.5 * np.pi, 0.5 * np.pi, "deg")
        if t < time[-1] or (t == time[-1] and len(time) > 1):
            raise InputError.of("collective time", pair[0], "must ascend from 0 s")
        if t == 0.0 and abs(theta - start) > 1e-9:
            raise InputError.of(
                "collective",
                pair[1],
                f"must be that of the stand, {np.degrees(start):.6g} deg, at 0 s: pitch does not jump",
            )
        if t > 0.0:
            time.append(t)
            angle.append(theta)
    return History(np.array(time), np.array(angle))


class Recorder:
    """What a transient leaves at every step."""

    def __init__(self) -> None:
        self.rows: dict[str, list[np.ndarray]] = {}

    def add(self, **values: Any) -> None:
        """Append one value of each."""
        for name, value in values.items():
            self.rows.setdefault(name, []).append(np.asarray(value))

    @property
    def n_recorded(self) -> int:
        """Instants kept."""
        return len(self.rows.get("time", ()))

    def arrays(self) -> dict[str, np.ndarray]:
        """Everything along time first."""
        return {name: np.array(rows) for name, rows in self.rows.items()}


def transient(
    stand: Solved,
    attributes: dict[str, Any],
    collective: Sequence[Any],
    duration: Any,
    progress: Progress | Silent | None = None,
) -> xr.Dataset:
    """See `Tunnel.transient`."""
    from ..results import assemble_transient

    solution, model = stand.solution, stand.model
    if solution.march is None and not model.is_dynamic:
        raise InputError.of("inflow", model.inflow.name, "a transient needs inflow time-marching or dynamic")
    if model.aircraft.discretisation.n_modes and not model.n_harmonics:
        raise InputError.of("n_harmonics", model.n_harmonics, "must be above 0")
    moved = history(collective, float(solution.x[0]))
    step = 2 * np.pi / model.omega / model.steps_per_revolution
    length = within("duration", duration, "s", step, LONGEST * 2 * np.pi / model.omega, "s")
    n_steps = int(np.ceil(length / step - 1e-9))
    if moved.time[-1] > n_steps * step * (1.0 + 1e-9):
        allowed = f"must not lie after the end of the transient at {n_steps * step:.6g} s: it would not be reached"
        raise InputError.of("collective time", f"{moved.time[-1]:.12g} s", allowed)
    progress = progress or Silent()
    progress.phase("transient", n_steps)
    kept = Recorder()
    failure = ""
    try:
        for _ in _march(stand, moved, step, n_steps, kept):
            progress.advance(1, "")
    except ArithmeticError as reason:
        failure = f"transient on the stand, t = {step * kept.n_recorded:.4f} s: {reason}"
        if not kept.n_recorded:
            raise NumericalFailure(failure) from reason
    arrays = {**kept.arrays(), "station": model.stations / stand.radius}
    if "wake" in arrays:
        arrays["age"] = 2 * np.pi / model.steps_per_revolution * np.arange(arrays["wake"].shape[2])
    data = assemble_transient(arrays, {**attributes, "failure": failure, "step": step})
    if failure:
        raise NumericalFailure(failure, partial=data)
    return data


def _march(stand: Solved, moved: History, step: float, n_steps: int, kept: Recorder) -> Iterator[int]:
    """March `n_steps`, recording the start and every step."""
    solution, model = stand.solution, stand.model
    core, x = model.core, solution.x
    wake = None if model.is_dynamic else solution.march.copy()
    # the clock that azimuths are read from goes on from the wake's
    first = 0 if wake is None else wake.step_index
    y, _ = core.trim_state(solution.problem, x, first * step)
    solver = FixedIntegrator(model)
    for k in range(n_steps + 1):
        t = (first + k) * step
        # the collective is linear over a step: corners of the history are met where steps end
        now, ahead, later = (moved.at((k + i) * step) for i in range(3))
        held, mean = (None, 0.0) if wake is None else wake.held(first + k)
        inputs = _core.Inputs([now, *x[1:3], 0.0], [(ahead - now) / step, 0.0, 0.0, 0.0], t, held, mean, 0.0)
        y_dot = solver.consistent(t, y, inputs)
        _record(kept, stand, core.outputs(t, y, y_dot, inputs), k * step, now, model.modal(y)[0])
        if wake is not None:
            kept.add(wake=wake.position(), tip_circulation=wake.marker_circulation())
        if k == n_steps:
            return
        solver.advance_to((first + k + 1) * step, inputs)
        y = solver.state
        if wake is not None:
            wake.reach(first + k + 1, y, np.array([ahead, *x[1:3]]), np.array([(later - ahead) / step, 0.0, 0.0]))
        yield k


def _record(
    kept: Recorder, stand: Solved, seen: dict[str, Any], t: float, collective: float, coordinates: np.ndarray
) -> None:
    model = stand.model
    # on the stand y points to the advancing side, whichever way the rotor turns
    hand = model.rotor["hand"]
    thrust, torque = seen["aero_force"][2], -seen["aero_moment"][2] * hand
    flap, lead = model.core.equivalent_angles(np.ascontiguousarray(coordinates))
    psi = np.asarray(seen["azimuth"])
    _check(stand, seen["inflow"], seen["mach"], psi, collective)
    scale = model.dynamic_pressure_area
    kept.add(
        time=t,
        azimuth=psi,
        theta_0=collective,
        ct=thrust / scale,
        cq=torque / (scale * stand.radius),
        thrust=thrust,
        torque=torque,
        hub_force=np.array(seen["hub_force"]) * [1.0, hand, 1.0],
        hub_moment=np.array(seen["hub_moment"]) * [hand, 1.0, hand],
        flap=flap,
        lead=lead,
        beta_0=np.mean(flap),
        inflow_mean=model.disk_mean(seen["inflow"]),
        **{name: seen[name] for name in ("inflow", "circulation", "cl", "alpha")},
    )


def _check(stand: Solved, inflow: np.ndarray, mach: np.ndarray, psi: np.ndarray, collective: float) -> None:
    """End where an instant is beyond what the motion of the rotor can give."""
    model, condition = stand.model, stand.model.condition
    velocity = np.asarray(condition.velocity) / model.tip_speed
    theta = [collective, stand.theta_1c, stand.theta_1s]
    usual, bound = model.bounds.inflow(velocity, theta)
    section = model.bounds.section(velocity, theta)
    fastest = model.bounds.mach(np.linalg.norm(condition.velocity), np.linalg.norm(condition.rates), section)
    places = Places(model.stations / stand.radius, psi)
    watched = (
        rotor.induced_velocity(inflow, usual, bound, places),
        rotor.mach_number(mach, fastest, np.inf, places),
    )
    if failed := failures(watched):
        raise ArithmeticError("; ".join(failed))
