# SPDX-License-Identifier: MIT OR Apache-2.0
"""Loads along the blades of a flown rotor, and how the blades bend: from what a run keeps of every section, and its own aircraft.

Of a section with lift c_l, drag c_d, moment c_m at the angle of attack alpha and Mach number M of the record, chord c and
pitch theta, with q = rho (M a)^2/2 and the inflow angle phi = theta - alpha:

    c_n = c_l cos alpha + c_d sin alpha                    normal force = q c c_n, at right angles to the chord
    up = q c (c_l cos phi - c_d sin phi)                   along the shaft
    in plane = q c (c_l sin phi + c_d cos phi)             against the blade's motion
    moment = q c^2 c_m                                     about the quarter chord, nose up

Lift is that of the record, unsteady where the sections are; drag and moment are those of the section's tables at its angle,
steady.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .aircraft import Aircraft
from .arguments import checked
from .errors import InputError
from .flight_input import FlightInput
from .model import Model
from .modes import blade_modes
from .results import frames
from .sticks import INCH, STICKS

if TYPE_CHECKING:
    import xarray as xr

AT_SECTION = ("time", "blade", "station")
SAID = {
    "cn": ("1", "section normal-force coefficient, cl cos alpha + cd sin alpha"),
    "cd": ("1", "section drag coefficient of the tables at the angle of attack"),
    "cm": ("1", "section moment coefficient of the tables about the quarter chord, nose up positive"),
    "pitch_section": ("rad", "pitch of the section: controls, built-in and elastic twist"),
    "inflow_angle": ("rad", "pitch of the section less its angle of attack, positive with flow down through the disk"),
    "normal_force": ("N/m", "force per metre at right angles to the chord, up positive"),
    "up_force": ("N/m", "force per metre along the shaft, up positive"),
    "in_plane_force": ("N/m", "force per metre in the plane of the disk, against the blade's motion"),
    "section_moment": ("N", "moment per metre about the quarter chord, nose up positive"),
    "flap_displacement": ("m", "displacement from the preconed blade without deflection, up positive"),
    "lead_displacement": ("m", "displacement in the plane of the disk, in the direction of rotation positive"),
    "twist_elastic": ("rad", "elastic twist and pitch-flap coupling, nose up positive"),
}
"""Units and meanings of what is found."""


@checked
def blade_loads(run: xr.Dataset) -> xr.Dataset:
    """Loads per metre, coefficients, pitch and displacements of every section of every blade, of the Dataset of a flight.

    The aircraft is that of the run itself (its `input`). Mode shapes stand beside them, `shape(part, mode, station)`, per unit of
    `modal`: metres and radians.
    """
    import xarray as xr

    if not {"modal", "alpha", "mach", "cl"} <= set(run.data_vars) or "time" not in run.dims:
        raise InputError.of("run", run.attrs.get("maneuver", "result"), "must be the Dataset of a flight")
    if "input" not in run.attrs:
        raise InputError.of("run", run.attrs.get("maneuver", "flight"), "does not carry its input: fly it again")
    given = FlightInput.from_text(run.attrs["input"])
    given.asked.inflow.check_first_order("blade_loads")
    aircraft, shape = given.aircraft, frames.geometry(run)
    radius = float(run.attrs["radius"])
    r, alpha, mach = run["station"].values * radius, run["alpha"].values, run["mach"].values
    shapes, data = mode_shapes(aircraft, r), aircraft.core_data()
    bent = {part: np.einsum("tbk,ks->tbs", run["modal"].values, values) for part, values in shapes.items()}
    twist = data["rotor"]["blade"]["twist"]
    pitch = (
        _controls(run, data["rigging"], float(aircraft.rotor.swashplate_phase))[..., None]
        + np.interp(r, twist["x"], twist["y"])
        + bent["twist"]
    )
    cd, cm = section_coefficients(given, alpha, mach)[1:]
    cl, phi = run["cl"].values, pitch - alpha
    chord = np.asarray(shape["chords"])
    force = 0.5 * shape["density"] * (mach * shape["speed_of_sound"]) ** 2 * chord
    cn = cl * np.cos(alpha) + cd * np.sin(alpha)
    # nothing lifts beyond the tip-loss factor of dynamic inflow
    lift = cl * np.asarray(shape["lifting"]) / np.asarray(shape["widths"])
    found = {
        "cn": cn,
        "cd": cd,
        "cm": cm,
        "pitch_section": pitch,
        "inflow_angle": phi,
        "normal_force": force * (lift * np.cos(alpha) + cd * np.sin(alpha)),
        "up_force": force * (lift * np.cos(phi) - cd * np.sin(phi)),
        "in_plane_force": force * (lift * np.sin(phi) + cd * np.cos(phi)),
        "section_moment": force * chord * cm,
        "flap_displacement": bent["flap"],
        "lead_displacement": bent["lead"],
        "twist_elastic": bent["twist"],
    }
    arrays: dict[str, Any] = {
        name: (AT_SECTION, values, dict(zip(("units", "long_name"), SAID[name], strict=True)))
        for name, values in found.items()
    }
    said = {"units": "m/rad, rad/rad", "long_name": "mode shapes per unit of modal: flap and lead displacement, twist"}
    arrays["shape"] = (("part", "mode", "station"), np.stack(list(shapes.values())), said)
    arrays["chord"] = ("station", chord, {"units": "m", "long_name": "chord"})
    arrays["width"] = (
        "station",
        np.asarray(shape["widths"]),
        {"units": "m", "long_name": "width of the blade element"},
    )
    coordinates = {name: run[name] for name in ("time", "blade", "station", "mode", "azimuth") if name in run}
    kept = ("aircraft", "maneuver", "inflow_model", "radius", "omega")
    return xr.Dataset(arrays, {**coordinates, "part": list(shapes)}, {name: run.attrs[name] for name in kept})


def section_coefficients(given: FlightInput, alpha: np.ndarray, mach: np.ndarray) -> list[np.ndarray]:
    """Lift, drag and moment coefficients of the flight's section tables for alpha [rad] and mach (..., n_stations)."""
    model = Model.build(given.aircraft, given.asked.condition.completed(given.aircraft), given.asked.inflow)
    rows = [np.reshape(each, (-1, model.stations.size)) for each in (alpha, mach)]
    return [each.reshape(np.shape(alpha)) for each in model.core.section_coefficients(*rows)]


def mode_shapes(aircraft: Aircraft, r: np.ndarray) -> dict[str, np.ndarray]:
    """Flap and lead displacement [m] and twist [rad] of the modes (n_modes, n) at `r` [m], per unit of `modal`."""
    modes = blade_modes(aircraft)
    arm = float(aircraft.rotor.radius) - float(aircraft.rotor.blade.root_station)
    # a coordinate is counted by the largest of its tip's deflections over R - e and its tip's twist
    tips = {part: np.abs(values[:, -1]) for part, values in modes.shapes.items()}
    unit = 1.0 / np.maximum(np.maximum(tips["flap"], tips["lead"]) / arm, tips["twist"])
    return {
        part: unit[:, None] * np.stack([np.interp(r, modes.radius, each) for each in modes.shapes[part]])
        for part in ("flap", "lead", "twist")
    }


def _controls(run: xr.Dataset, rigging: dict[str, Any], phase: float) -> np.ndarray:
    """Pitch at the root (time, blade) [rad] from where the blades are put."""
    put = [run[f"actuator_{stick}" if f"actuator_{stick}" in run else stick].values for stick in STICKS]
    theta_1c, theta_1s, theta_0, _ = np.asarray(rigging["offset"])[:, None] + np.asarray(rigging["matrix"]) @ (
        INCH * np.array(put)
    )
    psi = run["azimuth"].values + phase
    theta: np.ndarray = theta_0[:, None] + theta_1c[:, None] * np.cos(psi) + theta_1s[:, None] * np.sin(psi)
    return theta


@checked
def wake_velocity(run: xr.Dataset, points: Any, axes: str = "hub", core: str = "vatistas2") -> xr.Dataset:
    """Velocity that the tip vortices of a flight induce at points that move with the aircraft, at every wake that the run keeps.

    points (n, 3) [m]: in `hub` axes (x aft, y right, z up, from the hub) or `body` axes (x forward, y right, z down, from the
    centre of gravity), the velocity likewise. Bound vortices and the near wake are left out: for points away from the blades.
    core: of `wf.induced_velocity`. How often wakes are kept: `wf.fly(..., wakes_per_revolution=)`.
    """
    import xarray as xr

    from .vortex import induced_velocity

    if "wake" not in run:
        raise InputError.of("run", run.attrs.get("inflow_model", "result"), "must be a flight with a free wake")
    if axes not in ("hub", "body"):
        raise InputError.choice("axes", axes, ("hub", "body"))
    try:
        places = np.atleast_2d(np.asarray(points, dtype=float))
    except (TypeError, ValueError):
        places = np.zeros((0, 0))
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise InputError.of("points", points, "must be finite numbers of shape (n, 3) [m]")
    shape = frames.geometry(run)
    turn = frames.body_of_hub(*shape["shaft_tilt"]) if axes == "body" else np.eye(3)
    origin = np.asarray(shape["hub"]) if axes == "body" else np.zeros(3)
    asked = (places - origin) @ turn
    found = np.empty((run.sizes["snapshot"], len(places), 3))
    for k in range(run.sizes["snapshot"]):
        wake = run.isel(snapshot=k)
        # what stands at nodes belongs to the segments between them
        strength, square = wake["wake_circulation"].values, wake["wake_core"].values ** 2
        circulation = (0.5 * (strength[:, 1:] + strength[:, :-1])).ravel()
        radius = np.sqrt(0.5 * (square[:, 1:] + square[:, :-1])).ravel()
        found[k] = induced_velocity(asked, list(wake["wake"].values), circulation, radius, core) @ turn.T
    said = {"units": "m/s", "long_name": f"velocity induced by the tip vortices, {axes} axes"}
    return xr.Dataset(
        {"velocity": (("snapshot", "point", "xyz"), found, said), "place": (("point", "xyz"), places, {"units": "m"})},
        {"snapshot_revolution": run["snapshot_revolution"], "xyz": ["x", "y", "z"]},
        {"axes": axes, "core": core},
    )
