# SPDX-License-Identifier: MIT OR Apache-2.0
"""Noise of a flown rotor: blades as lines of compact forces and of compact volumes, Farassat's formulation 1A [farassat2007].

Loading, 4 pi p = sum over the lines of  L_r'/(c r (1 - M_r)^2) + (L_r - L_M)/(r^2 (1 - M_r)^2)
                                + L_r (r M_r' + c (M_r - M^2))/(c r^2 (1 - M_r)^3),   all at the time of emission

Thickness, 4 pi p = d^2/dt^2 sum over the lines of  rho V/(r (1 - M_r)),  V at the time of emission, t that of the observer

L: force on the air along a line element, ' its rate; V: volume of the element, which displaces air of the density rho; r:
distance, _r along the direction to the observer, M: Mach number of the element. Not modelled: quadrupoles, profile drag,
chordwise extent, reflection, absorption, refraction.
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

# half thickness of the NACA four-digit sections over their thickness: coefficients of the powers of x / c [abbott1959]
_POWERS = np.array([0.5, 1.0, 2.0, 3.0, 4.0])
_FOUR_DIGITS = 5.0 * np.array([0.2969, -0.1260, -0.3516, 0.2843, -0.1015])
FULLNESS = float(2.0 * np.sum(_FOUR_DIGITS / (_POWERS + 1.0)))
"""Area of a section over its thickness and chord, that of the NACA four-digit sections: 0.685."""
THICKEST = 0.5
"""Largest thickness over the chord that is taken."""
CENTROID = float(2.0 * np.sum(_FOUR_DIGITS / (_POWERS + 2.0))) / FULLNESS
"""Where the area of a section has its middle, over the chord from the nose: 0.420."""


@dataclass(frozen=True)
class Sources:
    """Compact forces that move: time (n,) [s], position (n, sources, 3) [m], force on the air (n, sources, 3) [N], earth axes.

    Earth axes are north, east, down from the start of the flight. speed_of_sound [m/s].
    """

    time: np.ndarray
    position: np.ndarray
    force: np.ndarray
    speed_of_sound: float


@dataclass(frozen=True)
class Volumes:
    """Compact volumes that move: time (n,) [s], position (n, volumes, 3) [m] in earth axes, volume (volumes,) [m3].

    Earth axes as those of `Sources`. density [kg/m3] and speed_of_sound [m/s] of the air.
    """

    time: np.ndarray
    position: np.ndarray
    volume: np.ndarray
    density: float
    speed_of_sound: float


@checked
def noise(
    run: xr.Dataset,
    observers: Any,
    revolutions: tuple[float, float] | None = None,
    force: bool = False,
    thickness_ratio: float | None = None,
) -> xr.Dataset:
    """Sound pressure of the blades' lift, and of their thickness where it is given, at observers that stand on the ground.

    run: Dataset of a flight. observers (n, 3) [m]: north, east, down from the start of the flight. revolutions: first and last
    that are heard, by default the whole flight. force: take a record that is coarser than 5 deg of azimuth. thickness_ratio: of
    all sections, over the chord, their shape that of the NACA four-digit sections; aircraft files do not say it. Without it the
    thickness is silent.

    Dataset with `pressure(time, observer)` [Pa] about its mean, `level(observer)` [dB re 20 uPa] over the whole time, and the
    attribute `resolved_frequency` [Hz], half the rate of the record; with a thickness, `pressure` is the sum of `loading` and
    `thickness`. The times are those at which all sources are heard.
    """
    import xarray as xr

    places = np.atleast_2d(np.asarray(observers, dtype=float))
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise InputError.of("observers", observers, "must be points (n, 3) [m]: north, east, down")
    if thickness_ratio is not None and not 0.0 < thickness_ratio <= THICKEST:
        raise InputError.of("thickness_ratio", thickness_ratio, f"must lie above 0 and at most {THICKEST:g}")
    found = sources(run, revolutions, force)
    heard = [pressure(found, place) for place in places]
    begin, end = max(t[0] for t, _ in heard), min(t[-1] for t, _ in heard)
    displaced = None if thickness_ratio is None else volumes(run, thickness_ratio, revolutions)
    if displaced is not None:
        spans = [_heard_whole(displaced, place) for place in places]
        begin, end = max(begin, *(first for first, _ in spans)), min(end, *(last for _, last in spans))
    step = float(np.median(np.diff(found.time)))
    if end - begin < 4 * step:
        raise InputError.of(
            "observers", observers, "stand so far apart that they hear no moment of the flight together"
        )
    time = np.arange(begin, end, step)
    values = np.stack([np.interp(time, t, p) for t, p in heard], axis=1)
    values -= values.mean(axis=0)
    parts, of_what = {}, "lift"
    if displaced is not None:
        thick = np.stack([thickness_pressure(displaced, place, time) for place in places], axis=1)
        thick -= thick.mean(axis=0)
        parts = {"loading": values, "thickness": thick}
        values, of_what = values + thick, "lift and thickness"
    level = 20.0 * np.log10(np.sqrt(np.mean(values**2, axis=0)) / REFERENCE_PRESSURE + 1e-30)
    return xr.Dataset(
        {
            "pressure": (
                ("time", "observer"),
                values,
                {"units": "Pa", "long_name": f"sound pressure of the blades' {of_what}"},
            ),
            **{
                name: (("time", "observer"), part, {"units": "Pa", "long_name": f"sound pressure of {name}"})
                for name, part in parts.items()
            },
            "level": (("observer",), level, {"units": "dB", "long_name": "sound pressure level re 20 uPa"}),
            "place": (("observer", "xyz"), places, {"units": "m", "long_name": "observer: north, east, down"}),
        },
        {
            "time": ("time", time, {"units": "s", "long_name": "time at the observer from the start of the flight"}),
            "observer": ("observer", np.arange(1, len(places) + 1), {"units": "1", "long_name": "observer"}),
        },
        {
            "resolved_frequency": 0.5 / step,
            "formulation": "Farassat 1A, compact loading, lift alone"
            if thickness_ratio is None
            else f"Farassat 1A, compact loading, lift alone, and compact thickness of {thickness_ratio:g} of the chord",
        },
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
    r = run["station"].values * radius
    turned, place = _placed(run, shape, np.zeros_like(r))
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


def volumes(run: xr.Dataset, thickness_ratio: float, revolutions: tuple[float, float] | None = None) -> Volumes:
    """What the blades displace: the volume of every blade element, at the middle of the area of its sections, blade after blade.

    It has the width of the element whole: what does not lift at root and tip displaces air as well.
    """
    shape = frames.geometry(run)
    chord, width = np.array(shape["chords"]), np.array(shape["widths"])
    _, place = _placed(run, shape, (CENTROID - 0.25) * chord)
    kept = _kept(run, revolutions)
    volume = np.tile(FULLNESS * thickness_ratio * chord**2 * width, place.shape[1])
    time = run["time"].values[kept]
    return Volumes(
        time, place[kept].reshape(time.size, -1, 3), volume, float(shape["density"]), float(shape["speed_of_sound"])
    )


def _placed(run: xr.Dataset, shape: dict[str, Any], behind: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Matrices from hub to earth axes (time, 3, 3), and points `behind` (station,) [m] the quarter chord in earth axes
    (time, blade, station, 3) [m]."""
    turned, hub = frames.hub_in_earth(run)
    azimuth, flap, lead = (run[name].values for name in ("azimuth", "flap", "lead"))
    r = run["station"].values * float(run.attrs["radius"])
    in_hub = frames.blade_points(shape, azimuth, flap, lead, r, behind)
    return turned, np.einsum("tij,tbsj->tbsi", turned, in_hub) + hub[:, None, None, :]


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


def _heard_whole(given: Volumes, observer: np.ndarray) -> tuple[float, float]:
    """From when to when an observer (3,) [m] hears all volumes [s]."""
    first, last = (
        given.time[k] + np.linalg.norm(observer - given.position[k], axis=-1) / given.speed_of_sound for k in (0, -1)
    )
    return float(first.max()), float(last.min())


def thickness_pressure(given: Volumes, observer: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Pressure [Pa] of the air that volumes displace, for an observer (3,) [m] at `time` (n,) [s], at which all are heard."""
    from scipy.interpolate import CubicSpline, make_interp_spline

    c, tau = given.speed_of_sound, given.time
    mach = CubicSpline(tau, given.position)(tau, 1) / c
    towards = observer - given.position
    r = np.linalg.norm(towards, axis=-1)
    m_r = np.einsum("tsi,tsi->ts", mach, towards) / r
    if float(m_r.max()) > FASTEST:
        raise InputError.of(
            "run", f"Mach {m_r.max():.3f}", f"sources move towards an observer faster than Mach {FASTEST}"
        )
    heard = tau[:, None] + r / c
    displaced = given.density * given.volume / (r * (1.0 - m_r))
    total = np.zeros(time.size)
    for at, values in zip(heard.T, displaced.T, strict=True):
        # of the fifth degree: its second derivative is still smooth
        total += make_interp_spline(at, values, k=5)(time, nu=2)
    return total / (4.0 * np.pi)
