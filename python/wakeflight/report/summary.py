# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a reader wants to know of a run first, as rows of text: flight, trim, cost, counters, warnings."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..condition import described
from ..plotting.disk import revolutions_flown
from ..plotting.histories import one_revolution_mean
from ..plotting.shown import shown
from ..results.schema import ATTRIBUTES
from .load_factor import load_factor

if TYPE_CHECKING:
    import xarray as xr

COUNTERS = (
    "residual_evaluations",
    "jacobians",
    "relaxation_iterations",
    "unconverged_revolutions",
    "segment_evaluations",
)
NAMES = {attribute.name: attribute.long_name for attribute in ATTRIBUTES}


@dataclass(frozen=True)
class Row:
    """A line of a table: label with unit, and value as text."""

    label: str
    value: str


def physics(run: xr.Dataset, units: str = "si") -> list[Row]:
    """What was flown, first of all: loads, attitudes, rates, path, power, stall and stick margins; loads over one revolution."""
    rows = []
    rows.append(_range("load factor [–]", run, _smooth(run, load_factor(run)), ".2f"))
    for name in ("roll", "pitch"):
        rows.append(_range(f"{name} [deg]", run, np.rad2deg(run[name].values), ".1f"))
    for name, label in (("p", "roll"), ("q", "pitch"), ("r", "yaw")):
        rows.append(_range(f"{label} rate [deg/s]", run, np.rad2deg(run[name].values), ".1f"))
    label, factor = shown("airspeed [m/s]", units)
    speed = factor * np.sqrt(sum(run[name].values ** 2 for name in "uvw"))
    rows.append(Row(label, f"{speed[0]:.1f} at the start, {speed[-1]:.1f} at the end"))
    label, factor = shown("height gained [m]", units)
    rows.append(Row(label, f"{factor * float(run['down'][0] - run['down'][-1]):+.1f}"))
    if "power" in run:
        label, factor = shown("power [kW]", units)
        rows.append(_range(label, run, factor * _smooth(run, run["power"].values) / 1e3, ".0f"))
    if "stalled_share" in run:
        rows.append(_range("disk beyond stall [%]", run, 100.0 * run["stalled_share"].values, ".1f"))
    if "stick_margin" in run:
        rows.append(_range("stick from a stop [in]", run, run["stick_margin"].values, ".2f"))
    return rows


def _smooth(run: xr.Dataset, values: np.ndarray) -> np.ndarray:
    """The mean over one revolution where there is one."""
    mean = one_revolution_mean(run, values)
    return values if mean is None else mean


def _range(label: str, run: xr.Dataset, values: np.ndarray, form: str) -> Row:
    """Least and largest value, each with its time."""
    least, most = int(np.argmin(values)), int(np.argmax(values))
    # no zero below zero
    low, high = (format(float(values[k]), f"z{form}") for k in (least, most))
    if low == high:
        return Row(label, low)
    return Row(label, f"{low} at {float(run.time[least]):.2f} s to {high} at {float(run.time[most]):.2f} s")


def summary(run: xr.Dataset, units: str = "si") -> list[Row]:
    """Flight, trim and wall clock of one run."""
    attrs = run.attrs
    rows = [Row(NAMES[name], str(attrs[name])) for name in ("aircraft", "maneuver") if name in attrs]
    if "condition" in attrs:
        rows.append(Row(NAMES["condition"], _condition(str(attrs["condition"]), units)))
    if attrs.get("maneuver_adapted"):
        rows.append(Row(NAMES["maneuver_adapted"], str(attrs["maneuver_adapted"])))
    rows.append(Row(NAMES["inflow_model"], str(attrs.get("inflow_model", "–"))))
    rows.append(Row("flown", f"{float(run.time[-1]):.2f} s, {revolutions_flown(run):.2f} revolutions"))
    rows.append(Row("finished", "yes" if attrs.get("finished", 1) else "no"))
    for name, label, factor, digits in (
        ("ct", "thrust coefficient C_T at trim", 1.0, 5),
        ("ct_sigma", "blade loading C_T/σ at trim", 1.0, 4),
        ("mu", "advance ratio µ at trim", 1.0, 4),
        ("power", "power at trim [kW]", 1e-3, 0),
    ):
        if name in attrs:
            said, more = shown(label, units)
            rows.append(Row(said, f"{more * factor * float(attrs[name]):.{digits}f}"))
    for stick in ("collective", "longitudinal", "lateral", "pedal"):
        rows.append(Row(f"{stick} at trim [in]", f"{float(run[stick][0]):.2f}"))
    for angle in ("pitch", "roll"):
        rows.append(Row(f"{angle} at trim [deg]", f"{np.rad2deg(float(run[angle][0])):.2f}"))
    for attribute in ATTRIBUTES:
        if attribute.name.startswith("seconds_") and attribute.name in attrs:
            rows.append(Row(attribute.long_name, f"{float(attrs[attribute.name]):.2f}"))
    return rows


def counters(run: xr.Dataset) -> list[Row]:
    """What the run did, counted: independent of the machine it ran on."""
    return [Row(NAMES[name], f"{int(run.attrs[name]):,}") for name in COUNTERS if name in run.attrs]


WATCHED = (
    ("inflow_max", "largest induced inflow [–]", np.max, 1.0),
    ("mach_max", "largest section Mach number [–]", np.max, 1.0),
    ("alpha_min", "smallest angle of attack [deg]", np.min, 180.0 / np.pi),
    ("alpha_max", "largest angle of attack [deg]", np.max, 180.0 / np.pi),
    ("stalled_share", "largest share of the disk beyond stall [%]", np.max, 100.0),
    ("reversed_share", "largest share of the disk in reversed flow [%]", np.max, 100.0),
    ("mu_z", "fastest descent down the shaft, over the tip speed [–]", np.max, 1.0),
    ("stick_margin", "smallest distance of a stick from a stop [in]", np.min, 1.0),
    ("power", "largest power [kW]", np.max, 1e-3),
    ("height", "smallest height above the ground [m]", np.min, 1.0),
    ("vortex_blade_distance", "closest tip vortex to a blade [core radii]", np.min, 1.0),
    ("max_displacement", "largest step of a wake node [m]", np.max, 1.0),
)
"""Monitors of a run: variable, label, which end of it is told, factor of its unit."""


def watched(run: xr.Dataset, units: str = "si") -> list[Row]:
    """The extremes of everything that is monitored, and when."""
    rows = []
    for name, label, extreme, factor in WATCHED:
        if name not in run:
            continue
        values = run[name].values
        worst = extreme(values)
        said, more = shown(label, units)
        rows.append(
            Row(said, f"{more * factor * float(worst):.4g} at {float(run.time[int(np.argmax(values == worst))]):.2f} s")
        )
    return rows


def warnings(run: xr.Dataset) -> list[str]:
    """Warnings of one run, one text each."""
    kept = run.attrs.get("warnings", "")
    if isinstance(kept, str) and kept.startswith("["):
        kept = json.loads(kept)
    elif isinstance(kept, str):
        kept = kept.splitlines() if kept != "none" else []
    return [str(text) for text in kept]


def configuration(run: xr.Dataset) -> str:
    """The whole configuration as indented JSON text; long tables of numbers on one line each."""
    text = str(run.attrs.get("configuration", "{}"))
    try:
        return _indented(json.loads(text))
    except json.JSONDecodeError:
        return text


def trim_table(trim: xr.Dataset) -> list[Row]:
    """Every scalar of the trim and its residuals, angles in degrees as well."""
    rows = []
    for name, variable in trim.data_vars.items():
        label = f"{variable.attrs['long_name']} [{variable.attrs['units']}]"
        if variable.ndim == 0:
            value = float(variable)
            degrees = (
                f" ({np.rad2deg(value):.2f}°)" if variable.attrs["units"] == "rad" and "resid" not in str(name) else ""
            )
            rows.append(Row(label, f"{value:.6g}{degrees}"))
        elif variable.dims == ("xyz",):
            rows.append(Row(label, ", ".join(f"{value:.3g}" for value in variable.values)))
    return rows


def _condition(kept: str, units: str) -> str:
    """The condition, kept as JSON, in words with its units; what somebody else wrote there, as it stands."""
    try:
        values = json.loads(kept)
        return described(values, units) if isinstance(values, dict) else kept
    except (ValueError, TypeError, RecursionError):
        return kept


def _indented(value: object, depth: int = 0) -> str:
    """JSON with mappings indented and lists on one line."""
    if not isinstance(value, dict) or not value:
        return json.dumps(value, ensure_ascii=False)
    inner = "  " * (depth + 1)
    rows = (f"{inner}{json.dumps(key)}: {_indented(item, depth + 1)}" for key, item in value.items())
    return "{\n" + ",\n".join(rows) + "\n" + "  " * depth + "}"
