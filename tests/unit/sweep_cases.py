"""Functions of a case for the tests of sweeps: spawned processes find them in this module."""

import os
import signal
from pathlib import Path

import numpy as np

import wakeflight as wf


def doubled(x, y=0.0, flavour=""):
    """A number and a text by name."""
    return {"z": 2.0 * x + y, "taste": flavour}


def moody(x, **rest):
    """Fails where x is 2, by an error of its own."""
    if x == 2:
        raise ValueError(f"no answer at {x}")
    return {"z": float(x)}


def history(x):
    """A Dataset whose times depend on the case, with names along another dimension."""
    import xarray as xr

    time = np.arange(x + 2) / 10.0
    names = ["a", "b"] if x < 2 else ["b", "c"]
    return xr.Dataset(
        {"v": ("time", x * time), "m": (("name", "same"), np.full((2, 2), float(x)))},
        coords={"time": time, "name": names, "same": [0.5, 1.5]},
    )


def root(x):
    """A complex number."""
    return {"root": complex(x, 1.0), "n": int(x), "good": x > 1}


def murdered_once(x, folder):
    """Takes its process with it the first time."""
    mark = Path(folder) / f"{x}.mark"
    if x == 1 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return {"z": float(x)}


def murdered(x):
    """Takes its process with it."""
    if x == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"z": float(x)}


def threads(x):
    """What a worker's environment says."""
    return {name.lower(): os.environ.get(name, "") for name in ("WAKEFLIGHT_THREADS", "OPENBLAS_NUM_THREADS")}


def counted(x, folder):
    """Leaves a mark for every time that it is run."""
    with (Path(folder) / "runs.txt").open("a") as file:
        file.write(f"{x}\n")
    return {"z": float(x) ** 0.5}


def unusable(x):
    """Raises an error of the program's own."""
    raise wf.NumericalFailure("blade 2 left at psi = 90 deg")
