# SPDX-License-Identifier: MIT OR Apache-2.0
"""Handling qualities of a linear model: bandwidth and phase delay, quickness, control power, coupling, heave [ads33e2000].

The model is the bare airframe from the stick, without actuators or a control system unless it has them as states. A quantity that
does not exist is `nan`, with a reason.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..linear import LinearModel
from ..linear.response import harmonic_response, time_response
from ..views import html_table, text_table
from .attitude import NAMES, attitude_metrics
from .measured import Measured
from .quickness import quickness
from .steps import STEP_SECONDS, control_power, coupling, heave, stepped

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["HandlingQualities", "attitude_metrics", "handling_qualities", "limits", "quickness"]

AXES = {"roll": ("lateral", "p", "roll"), "pitch": ("longitudinal", "q", "pitch"), "yaw": ("pedal", "turn_rate", None)}
"""Stick, rate and attitude of every axis; the heading is the integral of its rate."""
PULSES = (0.2, 0.3, 0.5, 0.8, 1.2)
"""Widths of the pulses of lateral stick [s]."""
PULSE_SECONDS = 5.0
UNITS = {
    **dict.fromkeys(("bandwidth", "bandwidth_phase", "bandwidth_gain", "w_180"), "rad/s"),
    "phase_delay": "s",
    "phase_delay_fit": "s",
    "peak_rate": "rad/s/in",
    "attitude_1s": "rad/in",
    "heave_gain": "m/s/in",
    "heave_time": "s",
    "heave_delay": "s",
    "yaw_collective_1": "rad/m",
    "yaw_collective_3": "rad/m",
    "pitch_due_to_roll_average": "dB",
    "roll_due_to_pitch_average": "dB",
    "quickness": "1/s",
    "attitude_change": "rad/in",
}
"""Units of the quantities; 1 of those that are not here."""
MEANINGS = {
    "bandwidth": "bandwidth of the attitude by the stick, the smaller of those by phase and gain",
    "bandwidth_phase": "frequency at which the phase is -135 deg",
    "bandwidth_gain": "frequency at which the gain is 6 dB above that at w_180",
    "w_180": "frequency at which the phase is -180 deg",
    "phase_delay": "phase delay between w_180 and twice that",
    "phase_delay_fit": "phase delay by the slope of a line through the phase from w_180 to twice that",
    "peak_rate": f"largest rate within {STEP_SECONDS:g} s after a step of the stick",
    "attitude_1s": "change of attitude one second after a step of the stick",
    "quickness": "peak roll rate over peak change of roll after a pulse of lateral stick",
    "attitude_change": "peak change of roll after a pulse of lateral stick",
    "pitch_due_to_roll": f"largest pitch over the roll at {STEP_SECONDS:g} s after a lateral step",
    "roll_due_to_pitch": f"largest roll over the pitch at {STEP_SECONDS:g} s after a longitudinal step",
    "pitch_due_to_roll_average": "mean of q over p by lateral stick, from the bandwidth to w_180",
    "roll_due_to_pitch_average": "mean of p over q by longitudinal stick, from the bandwidth to w_180",
    "heave_fit": "sum of squares of the first-order fit of the rate of climb over that of the answer",
    "heave_gain": "rate of climb after a collective step",
    "heave_time": "time constant of the rate of climb after a collective step",
    "heave_delay": "delay of the rate of climb after a collective step",
    "yaw_collective_1": "first peak of the yaw rate over the rate of climb at 3 s after a collective step",
    "yaw_collective_3": "change of the yaw rate from there to 3 s over that rate of climb",
}
"""Meaning of the quantities, their `long_name`."""


@dataclass(frozen=True, repr=False)
class HandlingQualities:
    """Metrics of a linear model.

    data: by axis (`roll`, `pitch`, `yaw`) bandwidths, w_180 and phase delays; by pulse the quickness in roll; couplings,
    heave, yaw after collective. reasons: why a quantity is nan, by name, of those of an axis `roll.bandwidth`. responses:
    attitude by stick, by axis.
    """

    data: xr.Dataset
    reasons: dict[str, str]
    responses: xr.Dataset

    def __getitem__(self, name: str) -> float:
        """A number by name: `heave_time`, `roll.bandwidth`."""
        axis, _, metric = name.rpartition(".")
        return float(self.data[metric].sel(axis=axis) if axis else self.data[name])

    def _rows(self) -> list[tuple[str, str]]:
        rows = []
        for name, values in self.data.data_vars.items():
            unit = values.attrs.get("units", "1")
            if values.dims == ("axis",):
                rows += [
                    (f"{axis}.{name}", self._shown(f"{axis}.{name}", float(values.sel(axis=axis)), unit))
                    for axis in values.axis.values
                ]
            elif not values.dims:
                rows.append((str(name), self._shown(str(name), float(values), unit)))
        return rows

    def _shown(self, name: str, value: float, unit: str) -> str:
        return (
            f"{value:.4g} {'' if unit == '1' else unit}".strip()
            if np.isfinite(value)
            else f"none: {self.reasons[name]}"
        )

    def table(self) -> str:
        """All numbers to print; a quantity that does not exist with its reason."""
        return text_table(self._rows())

    def _repr_html_(self) -> str:
        """A small table."""
        return html_table("Handling qualities", self._rows())

    def __repr__(self) -> str:
        """One line."""
        return f"<HandlingQualities: {len(self.data.data_vars)} quantities, {len(self.reasons)} do not exist>"


def limits() -> dict[str, Any]:
    """Limits for plots, with their source."""
    return tomllib.loads((resources.files(__package__) / "limits.toml").read_text())


@checked
def handling_qualities(model: LinearModel) -> HandlingQualities:
    """Metrics of a linear model with the four sticks as inputs."""
    import xarray as xr

    try:
        inputs, outputs = ({name for name, _ in named} for named in (model.inputs, model.outputs))
    except AttributeError:
        raise InputError.of(
            "model", type(model).__name__, "must be a linear model, what wf.linearize returned"
        ) from None
    needed = {stick for stick, _, _ in AXES.values()} | {"collective"}
    shown = {"p", "q", "r", "roll", "pitch", "turn_rate", "climb_rate"}
    if missing := sorted((needed - inputs) | (shown - outputs)):
        raise InputError.of(
            "model", "without " + ", ".join(missing), "must have the four sticks as inputs, body motion as outputs"
        )
    reasons: dict[str, str] = {}
    by_axis: dict[str, list[float]] = {name: [] for name in (*NAMES, "peak_rate", "attitude_1s")}
    w = np.geomspace(0.1, 50.0, 400)
    attitudes = {axis: _attitude(model, axis) for axis in AXES}
    for axis, response in attitudes.items():
        stick, rate, attitude = AXES[axis]
        found = attitude_metrics(response)
        power = control_power(model, stick, rate, attitude) if attitude else _yaw_power(model)
        for name, value in (found.values | power.values).items():
            by_axis[name].append(value)
        reasons |= {f"{axis}.{name}": text for name, text in (found.reasons | power.reasons).items()}
    pulses = [quickness(*_pulse(model, width)) for width in PULSES]
    single = _single(model, by_axis)
    reasons |= single.reasons
    data: dict[str, Any] = {name: ("axis", values) for name, values in by_axis.items()}
    data["quickness"] = ("pulse", [each[0] for each in pulses])
    data["attitude_change"] = ("pulse", [each[1] for each in pulses])
    data |= {name: ((), value) for name, value in single.values.items()}
    pulse = ("pulse", list(PULSES), {"units": "s", "long_name": "width of the pulse"})
    whole = xr.Dataset(data, coords={"axis": list(AXES), "pulse": pulse})
    for name in map(str, whole.data_vars):
        whole[name].attrs |= {"units": UNITS.get(name, "1"), "long_name": MEANINGS[name]}
    told = {"units": "rad/in", "long_name": "attitude by the stick"}
    drawn = xr.Dataset(
        {axis: ("frequency", response(w), told) for axis, response in attitudes.items()},
        coords={"frequency": ("frequency", w, {"units": "rad/s", "long_name": "frequency"})},
    )
    return HandlingQualities(whole, reasons, drawn)


def _attitude(model: LinearModel, axis: str) -> Any:
    """Attitude by stick as a function of frequency."""
    stick, rate, attitude = AXES[axis]
    (row,), (column,) = model.places("output", attitude or rate), model.places("input", stick)
    a, b, c, d = model.matrices
    answer = harmonic_response((a, b[:, [column]], c[[row]], d[[row]][:, [column]]))

    def response(w: np.ndarray) -> np.ndarray:
        found = answer(w)[:, 0, 0]
        return found if attitude else found / (1j * w)

    return response


def _yaw_power(model: LinearModel) -> Measured:
    """Control power of the pedals: the heading is the integral of its rate."""
    found = Measured()
    t, y = stepped(model, "pedal", STEP_SECONDS)
    rate = y["turn_rate"]
    heading = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(t))])
    found.found("peak_rate", rate[np.argmax(np.abs(rate))])
    found.found("attitude_1s", np.interp(1.0, t, heading))
    return found


def _pulse(model: LinearModel, width: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, roll rate and roll after an inch of lateral stick for `width` [s]."""
    t = np.linspace(0.0, PULSE_SECONDS, 4001)
    u = np.zeros((t.size, len(model.inputs)))
    u[t < width - 1e-9, model.places("input", "lateral")[0]] = 1.0
    y, _ = time_response(model.matrices, t, u)
    p, roll = (y[:, model.places("output", name)[0]] for name in ("p", "roll"))
    return t, p, roll


def _single(model: LinearModel, by_axis: dict[str, list[float]]) -> Measured:
    """What is one number of the whole aircraft."""
    found = Measured()
    found.found("pitch_due_to_roll", coupling(model, "lateral", "roll", "pitch"))
    found.found("roll_due_to_pitch", coupling(model, "longitudinal", "pitch", "roll"))
    axes = list(AXES)
    for name, axis, stick, off, on in (
        ("pitch_due_to_roll_average", "roll", "lateral", "q", "p"),
        ("roll_due_to_pitch_average", "pitch", "longitudinal", "p", "q"),
    ):
        low, high = by_axis["bandwidth"][axes.index(axis)], by_axis["w_180"][axes.index(axis)]
        if not (np.isfinite(low) and np.isfinite(high)):
            found.none(f"there is no bandwidth in {axis}", name)
            continue
        w = np.geomspace(low, high, 50)
        answer = model.frequency_response(w, stick, [off, on])["response"].values[:, :, 0]
        found.found(name, 20 * np.log10(np.abs(answer[:, 0] / answer[:, 1])).mean())
    rest = heave(model)
    found.values |= rest.values
    found.reasons |= rest.reasons
    return found
