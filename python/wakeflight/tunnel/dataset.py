# SPDX-License-Identifier: MIT OR Apache-2.0
"""Arrays and attributes of a rotor on a stand, by the names of the schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import known
from ..modes import mode_labels
from ..monitors import Monitor, variables
from ..results import assemble_tunnel
from .solve import Revolution, by_azimuth
from .solved import Solved

if TYPE_CHECKING:
    import xarray as xr


SECTION_FIELDS = ("cl", "cd", "cm", "alpha", "mach")


def dataset(stand: Solved, monitors: tuple[Monitor, ...], attributes: dict[str, Any]) -> xr.Dataset:
    """Everything the stand found, every variable with its unit and meaning."""
    arrays = {**_scalars(stand), **_maps(stand), **_motion(stand), **_wake_arrays(stand), **_histories(stand)}
    arrays |= variables(monitors)
    return assemble_tunnel({name: np.asarray(value) for name, value in arrays.items()}, attributes)


def _path(stand: Solved) -> tuple[np.ndarray, np.ndarray] | None:
    """Mean tip vortex by azimuth (n, n_ages, 3) [m] and the RMS distance from it (n, n_ages)."""
    s = stand.solution
    if s.wake is None:
        return None
    if not stand.turns_kept:
        position = s.wake.relaxation.lattice()[:, -1]
        return position, np.zeros(position.shape[:2])
    rows = np.concatenate([turn.rows for turn in stand.turns_kept])
    path = np.concatenate([turn.path for turn in stand.turns_kept])
    mean = by_azimuth(rows, path, len(stand.azimuth))
    squared = np.sum((path - mean[rows]) ** 2, axis=-1)
    return mean, np.sqrt(by_azimuth(rows, squared, len(stand.azimuth)))


def _wake_arrays(stand: Solved) -> dict[str, np.ndarray]:
    found = _path(stand)
    if found is None:
        return {}
    path, spread = found
    s, radius = stand.solution, stand.radius
    n = len(stand.azimuth)
    if s.march is not None:
        wake, strength = s.march.position(), s.march.marker_circulation().mean(axis=0)
    else:
        rows = [b * n // stand.model.n_blades for b in range(stand.model.n_blades)]
        wake = path[rows]
        strength = np.full(path.shape[1], np.mean(known(s.wake).relaxation.released_circulation()[:, -1]))
    return {
        "age": 2 * np.pi / n * np.arange(path.shape[1]),
        "wake": wake,
        "wake_path": path,
        "wake_path_std": spread,
        "tip_vortex_radius": np.hypot(path[..., 0], path[..., 1]).mean(axis=0) / radius,
        "tip_vortex_height": (path[..., 2] - _released(path)[..., 2]).mean(axis=0) / radius,
        "tip_vortex_circulation": strength,
    }


def _scalars(stand: Solved) -> dict[str, Any]:
    m, c = stand.model, stand.model.condition
    names: tuple[str, ...] = (
        "ct",
        "cq",
        "cp",
        "figure_of_merit",
        "thrust",
        "torque",
        "power",
        "beta_0",
        "beta_1c",
        "beta_1s",
    )
    names += ("theta_0", "theta_1c", "theta_1s", "hub_force", "hub_moment", "aero_force", "aero_moment")
    lam = stand.inflow_harmonics()
    ct_std, cq_std = scatter(stand)
    return {
        **{name: getattr(stand, name) for name in names},
        "ct_sigma": stand.ct / m.aircraft.solidity,
        "mu": c.mu(m.tip_speed),
        "mu_z": c.mu_z(m.tip_speed),
        "h_force": stand.aero_force[0],
        "side_force": stand.aero_force[1],
        "theta_75": stand.theta_0 + m.aircraft.twist(0.75 * stand.radius),
        "inflow_mean": lam[0],
        "inflow_1c": lam[1],
        "inflow_1s": lam[2],
        "ct_std": ct_std,
        "cq_std": cq_std,
        "velocity": np.asarray(c.velocity),
    }


def scatter(stand: Solved) -> tuple[float, float]:
    """Standard deviations of C_T and C_Q over the revolutions averaged; 0 where there are none."""
    ct, cq = _per_revolution(stand, stand.turns_kept)
    return (float(np.std(ct)), float(np.std(cq))) if ct else (0.0, 0.0)


def _per_revolution(stand: Solved, revolutions: list[Revolution]) -> tuple[list[float], list[float]]:
    """C_T and C_Q of each revolution."""
    thrust = [turn.passages["aero_force"][..., 2].sum(axis=1).mean() / stand.thrust_scale for turn in revolutions]
    torque = [
        -turn.passages["aero_moment"][..., 2].sum(axis=1).mean() / (stand.thrust_scale * stand.radius)
        for turn in revolutions
    ]
    return thrust, torque


def _histories(stand: Solved) -> dict[str, Any]:
    turns = stand.solution.revolutions
    if not turns:
        return {}
    ct, cq = _per_revolution(stand, turns)
    return {"ct_history": ct, "cq_history": cq, "theta_0_history": [turn.x[0] for turn in turns]}


def _maps(stand: Solved) -> dict[str, Any]:
    fields = {name: stand.mean_by_azimuth(name) for name in (*SECTION_FIELDS, "circulation", "inflow")}
    cn = fields["cl"] * np.cos(fields["alpha"]) + fields["cd"] * np.sin(fields["alpha"])
    m2 = fields["mach"] ** 2
    radial = {f"radial_{name}": fields[name].mean(axis=0) for name in ("cl", "circulation", "inflow", "alpha")}
    return {
        "azimuth": stand.azimuth,
        "station": stand.model.stations / stand.radius,
        **fields,
        "cn": cn,
        "cl_m2": fields["cl"] * m2,
        "cn_m2": cn * m2,
        "cm_m2": fields["cm"] * m2,
        "cl_std": stand.spread_by_azimuth("cl"),
        "inflow_std": stand.spread_by_azimuth("inflow"),
        **radial,
        "chord": stand.model.rotor["chords"],
        "width": stand.model.rotor["widths"],
    }


def _motion(stand: Solved) -> dict[str, Any]:
    core, rotor, psi = stand.model.core, stand.model.rotor, stand.azimuth
    q, _ = core.trim_motion(stand.solution.problem, stand.x, len(psi))
    flap, lead = core.equivalent_angles(q)
    theta = stand.theta_0 + stand.theta_1c * np.cos(psi) + stand.theta_1s * np.sin(psi)
    for order, cosine, sine in stand.model.condition.higher:
        theta = theta + cosine * np.cos(order * psi) + sine * np.sin(order * psi)
    tips = {f"tip_{name}": q @ np.asarray(rotor[f"tip_{name}"]) for name in ("flap", "lead", "twist")}
    modal = {"modal": q * np.asarray(rotor["angle_per_coordinate"])} if q.shape[1] else {}
    return {"theta": theta, "flap": flap, "lead": lead, **tips, **modal}


def attributes(stand: Solved, said: dict[str, str]) -> dict[str, Any]:
    """Attributes of the Dataset: rotor, condition, inflow, what was counted, and what is `said` of it."""
    m, s, c = stand.model, stand.solution, stand.model.condition
    evaluations = 0
    if s.march is not None:
        evaluations = s.march.segment_evaluations
    elif s.wake is not None:
        evaluations = s.wake.counters["wake_segment_evaluations"]
    return {
        "aircraft": m.aircraft.name,
        "inflow_model": m.inflow.name,
        "regime": c.regime(m.tip_speed),
        "radius": stand.radius,
        "omega": m.omega,
        "n_blades": m.n_blades,
        "solidity": m.aircraft.solidity,
        "density": c.density,
        "speed_of_sound": c.speed_of_sound,
        "blade_model": m.blade_model.removesuffix("-incompressible"),
        "prandtl_glauert": int(m.blade_model == "weissinger"),
        "blades": "flexible" if m.aircraft.flexible else "rigid",
        "n_modes": m.aircraft.discretisation.n_modes,
        "blade_modes": mode_labels(m.aircraft),
        "blade_frequencies_per_rev": [f / m.omega for f in m.rotor["frequencies"]],
        "revolutions": len(s.revolutions),
        "averaged": stand.averaged,
        "settled": int(stand.settled),
        **said,
        "residual": stand.residual,
        "seconds_total": stand.seconds,
        "segment_evaluations": evaluations,
        "configuration": {
            "rotor": m.aircraft.name,
            **({"varied": dict(m.aircraft.changes)} if m.aircraft.changes else {}),
            "condition": c.as_given,
            "inflow": {"model": m.inflow.name, **m.inflow.as_attributes()},
            "discretisation": m.aircraft.discretisation._asdict(),
            "n_harmonics": m.n_harmonics,
        },
    }


def _released(path: np.ndarray) -> np.ndarray:
    """Where each marker of a path (n, n_ages, 3) was released: the blade at the azimuth of its age."""
    n, ages = path.shape[:2]
    rows = (np.arange(n)[:, None] - np.arange(ages)[None, :]) % n
    found: np.ndarray = path[rows, 0]
    return found
