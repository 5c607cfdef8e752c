"""What the kinds of input have in common: a folder to work in, what is made once, values of every type, what is absurd."""

import os
import reprlib
import shutil
from pathlib import Path

import numpy as np

import wakeflight as wf

CORPUS = Path(__file__).parent / "corpus"
HOME = Path(wf.__file__).parent

JUNK = (
    *(
        None,
        3,
        3.5,
        float("nan"),
        float("inf"),
        True,
        b"80 kt",
        [],
        {},
        (),
        ["80 kt"],
        "x",
        "\x00",
        "80 kt\n",
        "a" * 200000,
    ),
    *(
        complex(1, 2),
        -1,
        0,
        1 << 70,
        10**5000,
        ...,
        object(),
        np.array(3.0),
        np.zeros((3, 3)),
        np.float32("nan"),
        "\ud800",
    ),
    *(
        Path("x"),
        range(3),
        {"a": 1},
        {1, 2},
        iter(()),
        int,
        len,
        "80 m**9**9**9",
        "1 km^99999/s",
        1e9,
        "uh60a",
        [[1], [2, 3]],
    ),
)


class Absurd(Exception):
    """What was accepted is no number, or no physics."""


def finite(*values):
    for value in values:
        if not np.all(np.isfinite(np.asarray(value, dtype=float))):
            raise Absurd(f"not finite: {np.asarray(value).ravel()[:4]}")


def whole(data):
    for name, variable in data.variables.items():
        if variable.dtype.kind == "f":
            finite(variable.values)
        if not name:
            raise Absurd("a variable without a name")


class Bench:
    """A folder to work in, and what is made once: an aircraft, a trim, a flight in a file."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.uh60a = wf.load_aircraft("uh60a")
        self.rigid = self.uh60a.with_rigid_blades()
        self.start = wf.trim(self.rigid, wf.FlightCondition(), inflow="dynamic")
        self.flight = wf.fly(self.start, wf.arrested_descent(), revolutions=0.25, integrator="fixed")
        self.run = self.flight.save(self.folder / "base.nc").read_bytes()
        self.snapshot = wf.Simulation(self.start, inflow="dynamic").snapshot().to_bytes()
        self._prepare()

    def _prepare(self):
        outside = self.folder / "outside"
        outside.mkdir(exist_ok=True)
        (outside / "secret.csv").write_text("alpha_deg,M0\n-180,0.123456\n180,0.123456\n")
        self.decks = sorted(CORPUS.glob("*.c81"))
        self.rotors = sorted(CORPUS.glob("rotor-*.toml"))
        self.maneuvers = [*sorted(CORPUS.glob("maneuver-*.toml")), *sorted((HOME / "maneuver_data").glob("*.toml"))]

    def at(self, name):
        """An empty folder, with what a name in a file may lead to."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "folder").mkdir(parents=True)
        os.mkfifo(folder / "pipe")
        (folder / "loop").symlink_to(folder / "loop")
        (folder / "out.csv").symlink_to(self.folder / "outside" / "secret.csv")
        return folder


def told(given):
    """Arguments as text, shortened."""
    return ", ".join(f"{name}={brief(value)}" for name, value in given.items())


def brief(value):
    """A value as text, shortened; a whole number of five thousand digits does not show itself."""
    try:
        return reprlib.repr(value)
    except ValueError:
        return f"<{type(value).__name__}>"
