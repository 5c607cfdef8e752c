# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a trim says: loads and power averaged over a revolution, its Dataset, its table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .model import flight_regime
from .modes import mode_labels
from .monitors import lines, variables
from .regime import REGIMES

if TYPE_CHECKING:
    import xarray as xr

    from .trim import Trim

HORSEPOWER = 745.6998715822702  # W
FIELDS = ("cl", "cl_m2", "alpha", "mach")


def instants(start: Trim) -> list[tuple[list[int], dict[str, Any]]]:
    """Outputs over the angle between two blades: every azimuth is passed once; with the azimuth index of every blade."""
    model, core = start.model, start.model.core
    n = start.inflow_map.shape[0]
    records = []
    for k in range(n // model.n_blades):
        t = 2 * np.pi * k / n / model.omega
        y, y_dot = core.trim_state(start.problem, start.x, t)
        rows = [(k + b * n // model.n_blades) % n for b in range(model.n_blades)]
        records.append((rows, core.outputs(t, y, y_dot, start.inputs(t))))
    return records


def mean_outputs(start: Trim) -> dict[str, Any]:
    """Averages over a revolution: ct, advance ratio, power [W], hub and airframe loads, flapping [rad], mean inflow."""
    records = [out for _, out in instants(start)]
    mean = {
        name: np.mean([out[name] for out in records], axis=0)
        for name in ("force", "moment", "hub_force", "hub_moment", "ct", "beta_1c", "beta_1s", "power")
    }
    model = start.model
    y = start.state()
    hub_velocity, _ = model.core.hub(y)
    modes = model.core.trim_layout(start.problem).modes
    return {
        **{name: value for name, value in mean.items() if name not in ("ct", "power", "beta_1c", "beta_1s")},
        "ct": float(mean["ct"]),
        "beta_1c": float(mean["beta_1c"]),
        "beta_1s": float(mean["beta_1s"]),
        "beta_0": float(start.x[modes[model.rotor["flap_mode"]]] * model.rotor["flap_per_coordinate"]),
        "power_main": float(mean["power"][0]),
        "power_tail": float(mean["power"][1]),
        "power": float(mean["power"].sum()),
        "mu": float(np.hypot(hub_velocity[0], hub_velocity[1]) / model.tip_speed),
        "inflow_mean": model.disk_mean(start.inflow_map),
    }


def first_harmonics(start: Trim) -> tuple[float, float, float]:
    """lambda_0, lambda_1c, lambda_1s of the inflow map: see `disk.first_harmonics`."""
    return start.model.first_harmonics(start.inflow_map)


def to_dataset(start: Trim) -> xr.Dataset:
    """The trim by the schema of results."""
    from .results import assemble_trim

    model, mean = start.model, mean_outputs(start)
    n = start.inflow_map.shape[0]
    q, _ = model.core.trim_motion(start.problem, start.x, n)
    residual = model.core.trim_residual(start.problem, start.x)
    y = start.state()
    maps = {name: np.empty_like(start.inflow_map) for name in FIELDS}
    for rows, out in instants(start):
        for name, values in maps.items():
            values[rows] = out[name]
    modes = model.core.trim_layout(start.problem).modes
    scale = np.asarray(model.rotor["angle_per_coordinate"])
    harmonics = np.array([start.x[modes[i] : modes[i + 1]] * scale[i] for i in range(len(modes) - 1)])
    controls = start.pitch_controls
    arrays = {
        **start.stick,
        "pitch": start.pitch,
        "roll": start.roll,
        "theta_0": controls["theta_0"],
        "theta_1c": controls["theta_1c"],
        "theta_1s": controls["theta_1s"],
        "theta_tail": controls["theta_tr"],
        "ct": mean["ct"],
        "ct_sigma": mean["ct"] / start.aircraft.solidity,
        "mu": mean["mu"],
        "power": mean["power"],
        "power_main": mean["power_main"],
        "power_tail": mean["power_tail"],
        "azimuth": 2 * np.pi * np.arange(n) / n,
        "station": model.stations / model.rotor["radius"],
        "inflow": start.inflow_map,
        "circulation": start.circulation,
        "modal": q * scale,
        "modal_harmonics": harmonics,
        "residual_linear": residual[:3],
        "residual_angular": residual[3:6],
        "residual_blade": float(np.abs(residual[modes[0] :]).max()),
        "beta_0": mean["beta_0"],
        "beta_1c": mean["beta_1c"],
        "beta_1s": mean["beta_1s"],
        "stabilator": start.stabilator_incidence,
        "inflow_mean": mean["inflow_mean"],
        "velocity_b": y[:3],
        "rates_b": y[3:6],
        **maps,
        **variables(start.monitors),
    }
    if start.history:
        arrays["residual_inflow"] = start.history[-1]["inflow_change"]
    attributes = {
        "aircraft": start.aircraft.name,
        "inflow_model": start.inflow.name,
        "radius": model.rotor["radius"],
        "omega": model.omega,
        "blade_modes": mode_labels(start.aircraft),
        "yaw": start.yaw,
        "rate_of_descent": start.rate_of_descent,
        "load_factor": start.load_factor,
        "configuration": {
            "aircraft": start.aircraft.name,
            "condition": start.condition.as_attributes(),
            "inflow": {"model": start.inflow.name, **start.inflow.as_attributes()},
            "discretisation": start.aircraft.discretisation._asdict(),
        },
        "condition": start.condition.as_attributes(),
        "seconds_trim": start.seconds,
        "warnings": "\n".join(start.warnings),
        "failure": "; ".join(start.failures),
        **start.counters,
    }
    return assemble_trim({k: np.asarray(v) for k, v in arrays.items()}, attributes)


def table(start: Trim) -> str:
    """Sticks, attitude, pitch controls, power, inflow, residuals: one line each."""
    mean, residuals, deg = mean_outputs(start), start.residuals, np.degrees
    stick, c = start.stick, start.pitch_controls
    travel = start.aircraft.stick_travel_in
    lam = first_harmonics(start)
    condition = start.condition
    precone = float(start.aircraft.rotor.blade.precone)
    beyond = f" beyond {deg(precone):.1f} deg precone" if precone else ""
    turning = f", turn {deg(start.turn_rate):.2f} deg/s, load factor {start.load_factor:.3f}" if start.turn_rate else ""
    rows = [
        (
            "condition",
            f"{condition.speed / 0.514444:.1f} kt, flight path {deg(condition.flight_path):.2f} deg, "
            f"{condition.altitude / 0.3048:.0f} ft, {condition.gross_mass / 0.45359237:.0f} lb{turning}",
        ),
        *_found(start),
        ("inflow model", start.inflow.name + _wake_length(start)),
        *[
            (f"{name} stick", f"{stick[name]:7.3f} in of {full:.2f}")
            for name, full in zip(("lateral", "longitudinal", "collective", "pedal"), travel, strict=True)
        ],
        ("roll, pitch", f"{deg(start.roll):7.3f} deg, {deg(start.pitch):.3f} deg"),
        ("heading against track", f"{deg(start.yaw):7.3f} deg (nose right +)"),
        (
            "theta_0, 1c, 1s, tail",
            ", ".join(f"{deg(c[k]):.3f}" for k in ("theta_0", "theta_1c", "theta_1s", "theta_tr")) + " deg",
        ),
        (
            f"coning{beyond}, beta_1c, beta_1s",
            ", ".join(f"{deg(mean[k]):.3f}" for k in ("beta_0", "beta_1c", "beta_1s")) + " deg",
        ),
        ("stabilator", f"{deg(start.stabilator_incidence):7.3f} deg"),
        ("lambda_0, 1c, 1s", ", ".join(f"{v:.5f}" for v in lam)),
        (
            "C_T, C_T/sigma, mu",
            f"{mean['ct']:.6f}, {mean['ct'] / start.aircraft.solidity:.4f}, {mean['mu']:.4f}",
        ),
        (
            "power",
            f"{mean['power'] / HORSEPOWER:.1f} hp (main {mean['power_main'] / HORSEPOWER:.1f}, "
            f"tail {mean['power_tail'] / HORSEPOWER:.1f})",
        ),
        (
            "residuals",
            f"linear {residuals['linear']:.1e} m/s2, angular {residuals['angular']:.1e} rad/s2, "
            f"blade harmonics {residuals['harmonics']:.1e} rad",
        ),
    ]
    if not start.inflow.is_dynamic and start.history:
        last = start.history[-1]
        rows.append(
            (
                "wake",
                f"inflow changes by {last['inflow_change']:.1e} of the tip speed per iteration, first turn by "
                f"{last['first_turn_change']:.1e} R, pitch controls by {last['control_change']:.1e} rad",
            )
        )
    rows += lines(start.monitors)
    rows += [("warning", text) for text in start.warnings]
    width = max(len(name) for name, _ in rows)
    return "\n".join(f"{name:<{width}}  {value.strip()}" for name, value in rows)


def _found(start: Trim) -> list[tuple[str, str]]:
    """What trim found of the path for what it was asked to meet."""
    asked = start.model.target
    if asked is None:
        return []
    descent = start.rate_of_descent
    return [
        (
            "found",
            f"{asked.free.replace('_', ' ')} for {asked.name} {asked.shown(asked.value)}: "
            f"{'descent' if descent >= 0.0 else 'climb'} at {abs(descent):.2f} m/s ({abs(descent) / 0.00508:.0f} ft/min)",
        )
    ]


def _wake_length(start: Trim) -> str:
    """Regime and length of a free wake, to follow its name."""
    if start.inflow.is_dynamic:
        return ""
    regime = flight_regime(start.aircraft, start.condition)
    return f", {start.inflow.turns:g} turns free, {start.inflow.far_wake_turns} repeated ({REGIMES[regime]})"
