# SPDX-License-Identifier: MIT OR Apache-2.0
"""PSU-WOPWOP: blades as lifting lines with the force they exert on the air, aperiodic and in ground axes.

Ground axes of the files: x north, y west, z up from the start of the flight [m]. Little-endian, 4-byte integers, single
precision.
One geometry and one loading file a blade, a namelist, a README. The layout follows public readers of the format; the program
itself was not at hand.
"""

from __future__ import annotations

import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..acoustics import Sources, sources
from ..arguments import checked
from ..atomic import write_bytes, write_text
from ..errors import InputError
from ..results import frames

if TYPE_CHECKING:
    import xarray as xr

MAGIC, VERSION = 42, (1, 0)
APERIODIC, STRUCTURED, NODES, SINGLE = 3, 1, 1, 1
LOADING_VECTOR, GROUND = 2, 1
COMMENT = "wakeflight: lifting lines at the quarter chord, ground axes x north y west z up, SI"


@checked
def export_wopwop(
    run: xr.Dataset,
    folder: str | Path,
    revolutions: tuple[float, float] | None = None,
    observers: Any = ((0.0, 0.0, 100.0),),
    force: bool = False,
) -> Path:
    """Write the lift of a flight's blades as PSU-WOPWOP files into `folder`; returns the path of the namelist `case.nam`.

    run: Dataset of a flight. revolutions: first and last, negative ones from the end; by default all. observers (n, 3) [m]:
    north, east, down from the start. force: take a record coarser than 5 deg of azimuth. Loading alone: no thickness, no drag.
    """
    folder = Path(folder)
    places = np.atleast_2d(np.asarray(observers, dtype=float))
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise InputError.of("observers", observers, "must be points (n, 3) [m]: north, east, down")
    found = sources(run, revolutions, force)
    n_blades, n_stations = run.sizes["blade"], run.sizes["station"]
    shape = frames.geometry(run)
    widths = np.array(shape["widths"])
    for blade in range(n_blades):
        part = slice(blade * n_stations, (blade + 1) * n_stations)
        place, load = _ground(found.position[:, part]), _ground(found.force[:, part])
        # any direction serves: only the length of a normal counts, the span that a node stands for
        normal = np.zeros_like(place)
        normal[..., 2] = widths
        write_bytes(folder / f"blade_{blade + 1}_geometry.dat", _geometry(found.time, place, normal, blade))
        write_bytes(folder / f"blade_{blade + 1}_loading.dat", _loading(found.time, load / widths[:, None], blade))
    write_text(folder / "README.txt", _readme(run, found, n_blades, n_stations))
    names = _namelist(found, shape["density"], n_blades, _ground(places))
    return write_text(folder / "case.nam", names, encoding="ascii")


def _ground(earth: np.ndarray) -> np.ndarray:
    """North, east, down as north, west, up."""
    found: np.ndarray = earth * np.array([1.0, -1.0, -1.0])
    return found


def _text(text: str, length: int) -> bytes:
    return text.encode("ascii")[:length].ljust(length)


def _zone(blade: int, shape: tuple[int, ...]) -> bytes:
    """Header of the one zone of a file: name, times, nodes chordwise and along the span."""
    return _text(f"blade {blade + 1}", 32) + struct.pack("<3i", shape[0], 1, shape[1])


def _records(time: np.ndarray, *fields: np.ndarray) -> bytes:
    """For each time the time, then every component of every field (time, nodes, 3) over the nodes."""
    parts = [np.moveaxis(field, 2, 1).reshape(time.size, -1) for field in fields]
    return np.concatenate([time[:, None], *parts], axis=1).astype("<f4").tobytes()


def _geometry(time: np.ndarray, place: np.ndarray, normal: np.ndarray, blade: int) -> bytes:
    head = struct.pack("<3i", MAGIC, *VERSION) + _text("Pa", 32) + _text(COMMENT, 1024)
    head += struct.pack("<8i", 1, 1, STRUCTURED, APERIODIC, NODES, SINGLE, 0, 0)
    return head + _zone(blade, place.shape) + _records(time, place, normal)


def _loading(time: np.ndarray, load: np.ndarray, blade: int) -> bytes:
    head = struct.pack("<3i", MAGIC, *VERSION) + _text(COMMENT, 1024)
    head += struct.pack("<10i", 2, 1, STRUCTURED, APERIODIC, NODES, LOADING_VECTOR, GROUND, SINGLE, 0, 0)
    # zones with data; negative: a lifting line has no thickness
    head += struct.pack("<2i", 1, -1)
    return head + _zone(blade, load.shape) + _records(time, load)


def _namelist(found: Sources, density: float, n_blades: int, places: np.ndarray) -> str:
    """The case: environment, an observer for each place, a container of blades."""
    begin, end = float(found.time[0]), float(found.time[-1])
    flags = {
        "loadingNoiseFlag": True,
        "thicknessNoiseFlag": False,
        "totalNoiseFlag": True,
        "acousticPressureFlag": True,
    }
    groups = [
        _group("EnvironmentIn", nbSourceContainers=1, nbObserverContainers=len(places), ASCIIOutputFlag=True, **flags),
        _group("EnvironmentConstants", rho=density, c=found.speed_of_sound),
    ]
    for k, (x, y, z) in enumerate(places):
        late = float(np.linalg.norm(_ground(found.position[0]) - places[k], axis=1).max()) / found.speed_of_sound
        soon = float(np.linalg.norm(_ground(found.position[-1]) - places[k], axis=1).min()) / found.speed_of_sound
        title = f"observer {k + 1}"
        groups.append(
            _group(
                "ObserverIn",
                Title=title,
                xLoc=x,
                yLoc=y,
                zLoc=z,
                nt=found.time.size,
                tMin=begin + late,
                tMax=end + soon,
            )
        )
    groups.append(_group("ContainerIn", Title="rotor", nbContainer=n_blades, nbBase=0))
    groups += [
        _group(
            "ContainerIn",
            Title=f"blade {blade}",
            nbBase=0,
            patchGeometryFile=f"blade_{blade}_geometry.dat",
            patchLoadingFile=f"blade_{blade}_loading.dat",
        )
        for blade in range(1, n_blades + 1)
    ]
    return "\n".join(groups)


def _group(name: str, **values: Any) -> str:
    """One group of a Fortran namelist."""
    shown = {True: ".true.", False: ".false."}
    rows = [
        f"  {key} = {shown[value] if isinstance(value, bool) else repr(value) if isinstance(value, str) else f'{value:.9g}'}"
        for key, value in values.items()
    ]
    return "\n".join([f"&{name}", *rows, "/"])


def _readme(run: xr.Dataset, found: Sources, n_blades: int, n_stations: int) -> str:
    step = float(np.median(np.diff(found.time)))
    return f"""{run.attrs["aircraft"]}, {run.attrs.get("maneuver", "flight")}, {run.attrs["inflow_model"]} inflow,
wakeflight {run.attrs.get("program_version", "")}

{n_blades} blades of {n_stations} elements, {found.time.size} times from {found.time[0]:.4f} to {found.time[-1]:.4f} s:
frequencies up to {0.5 / step:.0f} Hz are resolved.
Ground axes: x north, y west, z up from the start of the flight [m]. Loads: force on the air per span [N/m].
Lift alone: no thickness noise, no profile drag. Layout of the binary files by public readers of the format; keys of case.nam are
to be held against the manual of your version.
"""
