# SPDX-License-Identifier: MIT OR Apache-2.0
"""Loading noise of a flown rotor: blades as lines of compact forces, Farassat's formulation 1A [farassat2007].

4 pi p = sum over the lines of  L_r'/(c r (1 - M_r)^2) + (L_r - L_M)/(r^2 (1 - M_r)^2)
                                + L_r (r M_r' + c (M_r - M^2))/(c r^2 (1 - M_r)^3),   all at the time of emission

L: force on the air along a line element, ' its rate; r: distance, _r along the direction to the observer, M: Mach number of the
element. Not modelled: thickness noise, quadrupoles, profile drag, chordwise extent, reflection, absorption, refraction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .arguments import checked
from .errors import InputError
from .results import frames
from .results.turns import revolutions as turns_of
from .units import number

if TYPE_CHECKING:
    import xarray as xr

FASTEST = 0.98
"""Largest Mach number of a source towards an observer for which the formulation holds."""
COARSEST = np.radians(5.0)
"""Largest step of azimuth of a record that is taken without being asked to: blade-vortex noise needs 1 to 2 deg."""
REFERENCE_PRESSURE = 2e-5  # Pa, of sound pressure levels


@dataclass(frozen=True)
class Sources:
    """Compact forces that move: time (n,) [s], position (n, sources, 3) [m], force on the air (n, sources, 3) [N], earth axes.

    Earth axes are north, east, down from the start of the flight. speed_of_sound [m/s].
    """

    time: np.ndarray
    position: np.ndarray
    force: np.ndarray
    speed_of_sound: float


@checked
def noise(
    run: xr.Dataset, observers: Any, revolutions: tuple[float, float] | None = None, force: bool = False
) -> xr.Dataset:
    """Sound pressure of the blades' lift at observers that stand on the ground.

    run: Dataset of a flight. observers (n, 3) [m]: north, east, down from the start of the flight. revolutions: first and last
    that are heard, by default the whole flight. force: take a record that is coarser than 5 deg of azimuth.

    Dataset with `pressure(time, observer)` [Pa] about its mean, `level(observer)` [dB re 20 uPa] over the whole time, and the
    attribute `resolved_frequency` [Hz], half the rate of the record. The times are those at which all sources are heard.
    """
    import xarray as xr

    places = np.atleast_2d(np.asarray(observers, dtype=float))
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise InputError.of("observers", observers, "must be points (n, 3) [m]: north, east, down")
    found = sources(run, revolutions, force)
    heard = [pressure(found, place) for place in places]
    begin, end = max(t[0] for t, _ in heard), min(t[-1] for t, _ in heard)
    step = float(np.median(np.diff(found.time)))
    if end - begin < 4 * step:
        raise InputError.of(
            "observers", observers, "stand so far apart that they hear no moment of the flight together"
        )
    time = np.arange(begin, end, step)
    values = np.stack([np.interp(time, t, p) for t, p in heard], axis=1)
    values -= values.mean(axis=0)
    level = 20.0 * np.log10(np.sqrt(np.mean(values**2, axis=0)) / REFERENCE_PRESSURE + 1e-30)
    return xr.Dataset(
        {
            "pressure": (
                ("time", "observer"),
                values,
                {"units": "Pa", "long_name": "sound pressure of the blades' lift"},
            ),
            "level": (("observer",), level, {"units": "dB", "long_name": "sound pressure level re 20 uPa"}),
            "place": (("observer", "xyz"), places, {"units": "m", "long_name": "observer: north, east, down"}),
        },
        {
            "time": ("time", time, {"units": "s", "long_name": "time at the observer from the start of the flight"}),
            "observer": ("observer", np.arange(1, len(places) + 1), {"units": "1", "long_name": "observer"}),
        },
        {"resolved_frequency": 0.5 / step, "formulation": "Farassat 1A, compact loading, lift alone"},
    )


def sources(run: xr.Dataset, revolutions: tuple[float, float] | None = None, force: bool = False) -> Sources:
    """The blades' lift as compact forces: a source in the middle of every blade element, blade after blade.

    Lift is c_l M^2 of the record times density, chord and squared speed of sound over two, over the span that lifts in the model
    flown, at right angles to the flow that the section meets: its own motion along the path recorded and the induced velocity.
    """
    if "cl_m2" not in run or "time" not in run.dims or "flap" not in run:
        raise InputError.of("run", run.attrs.get("maneuver", "result"), "must be the Dataset of a flight")
    try:
        shape = frames.geometry(run)
    except ValueError as reason:
        raise InputError.of("run", run.attrs.get("maneuver", "flight"), str(reason)) from reason
    step = 2.0 * np.pi * float(np.median(np.diff(turns_of(run))))
    if step > COARSEST and not force:
        allowed = (
            f"is recorded every {np.degrees(step):.3g} deg of azimuth, which resolves {np.pi / step:.3g} harmonics of the rotor; "
            'fly with azimuth_step="2 deg", or ask with force=True'
        )
        raise InputError.of("run", run.attrs.get("maneuver", "flight"), allowed)
    radius = float(run.attrs["radius"])
    turned, hub = frames.hub_in_earth(run)
    azimuth, flap, lead = (run[name].values for name in ("azimuth", "flap", "lead"))
    r = run["station"].values * radius
    in_hub = frames.blade_points(shape, azimuth, flap, lead, r, np.zeros_like(r))  # (time, blade, station, 3)
    place = np.einsum("tij,tbsj->tbsi", turned, in_hub) + hub[:, None, None, :]
    along = np.gradient(place, axis=2) / np.gradient(r)[:, None]
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    time = run["time"].values
    velocity = np.gradient(place, time, axis=0)
    down = -turned[:, :, 2]
    induced = run["inflow"].values[..., None] * float(run.attrs["omega"]) * radius * down[:, None, None, :]
    wind = induced - velocity
    up = shape["rotation"] * np.cross(wind, along)
    up /= np.linalg.norm(up, axis=-1, keepdims=True)
    half = 0.5 * shape["density"] * shape["speed_of_sound"] ** 2
    lift = half * run["cl_m2"].values * np.array(shape["chords"]) * np.array(shape["lifting"])
    kept = _kept(run, revolutions)
    n = int(kept.sum())
    return Sources(
        time[kept],
        place[kept].reshape(n, -1, 3),
        -(lift[..., None] * up)[kept].reshape(n, -1, 3),
        shape["speed_of_sound"],
    )


def _kept(run: xr.Dataset, revolutions: tuple[float, float] | None) -> np.ndarray:
    """Records of the revolutions asked for; negative ones count from the end."""
    flown = turns_of(run)
    if revolutions is None:
        return np.ones(flown.size, dtype=bool)
    first, last = (number("revolutions", each) for each in revolutions)
    first, last = (each + flown[-1] if each < 0.0 else each for each in (first, last))
    kept: np.ndarray = (flown >= first - 1e-9) & (flown <= last + 1e-9)
    if kept.sum() < 8:
        raise InputError.of("revolutions", revolutions, f"must be a first and a last one of the {flown[-1]:.2f} flown")
    return kept


def pressure(given: Sources, observer: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times at which an observer (3,) [m] hears all sources, equally spaced as the sources are, and the pressure there [Pa]."""
    from scipy.interpolate import CubicSpline

    c, tau = given.speed_of_sound, given.time
    path, forces = CubicSpline(tau, given.position), CubicSpline(tau, given.force)
    mach, mach_rate = path(tau, 1) / c, path(tau, 2) / c
    towards = observer - given.position
    r = np.linalg.norm(towards, axis=-1)
    towards = towards / r[..., None]

    def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        found: np.ndarray = np.einsum("tsi,tsi->ts", a, b)
        return found

    m_r = dot(mach, towards)
    if float(m_r.max()) > FASTEST:
        raise InputError.of(
            "run", f"Mach {m_r.max():.3f}", f"sources move towards an observer faster than Mach {FASTEST}"
        )
    l_r, l_m, l_rate = dot(forces(tau), towards), dot(forces(tau), mach), dot(forces(tau, 1), towards)
    near = (l_r - l_m) / (r**2 * (1.0 - m_r) ** 2)
    far = l_rate / (c * r * (1.0 - m_r) ** 2)
    far += l_r * (r * dot(mach_rate, towards) + c * (m_r - dot(mach, mach))) / (c * r**2 * (1.0 - m_r) ** 3)
    heard = tau[:, None] + r / c
    step = float(np.median(np.diff(tau)))
    time = np.arange(float(heard[0].max()), float(heard[-1].min()), step)
    total = np.zeros(time.size)
    for source, values in zip(heard.T, (near + far).T, strict=True):
        total += CubicSpline(source, values)(time)
    return time, total / (4.0 * np.pi)
