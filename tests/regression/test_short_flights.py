"""Did the answer move: short flights against stored values. A value changes only with a line in the changelog.

`python tests/regression/test_short_flights.py` writes the values anew.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.integrators import FixedIntegrator

STORED = Path(__file__).parent / "short_flights.json"
# relative to the largest magnitude in the flight; loads at an instant feel the solver's own steps most
TOLERANCE = {"force_z": 1e-4, "moment_y": 1e-3}
NAMES = ("u", "w", "p", "q", "pitch", "roll", "beta_1c", "beta_1s", "ct", "force_z", "moment_y", "inflow_mean")


FLOWN = {
    "dynamic": ("dynamic", "dynamic"),
    "relaxation": (wf.RelaxationWake.preset("paper"), wf.RelaxationWake.preset("paper")),
    "time-marching": (wf.RelaxationWake.preset("paper"), wf.TimeMarchingWake.preset("paper")),
    "standard": ("relaxation", "time-marching"),
}
"""Inflow model of trim and flight by the name of the stored values."""


def sampled(start, inflow):
    # the fixed step: IDA chooses its steps by error estimates, and the last bit of a residual moves its answer by its tolerance
    data = wf.fly(start, wf.arrested_descent(), inflow=inflow, revolutions=3, integrator="fixed", rtol=1e-7).data
    values = {name: data[name].values[::36].tolist() for name in NAMES}
    values["circulation"] = data["circulation"].values[-1, 0].tolist()
    if "wake" in data:
        values["wake"] = data["wake"].values[-1, 0, ::36].ravel().tolist()
    return values


@pytest.fixture(autouse=True)
def derivatives_of_every_step(monkeypatch):
    # dF/dy kept over several steps moves what Newton's iteration leaves, 1e-4 of a roll rate that hardly differs from zero
    monkeypatch.setattr(FixedIntegrator, "KEPT", 0.0)


@pytest.mark.parametrize("flown", FLOWN)
def test_an_arrested_descent_of_three_revolutions_is_unchanged(flown, uh60a):
    trimmed, inflow = FLOWN[flown]
    stored = json.loads(STORED.read_text())[flown]
    for name, values in sampled(wf.trim(uh60a, inflow=trimmed), inflow).items():
        scale = np.max(np.abs(stored[name]))
        assert np.max(np.abs(np.subtract(values, stored[name]))) < TOLERANCE.get(name, 1e-5) * scale, name


if __name__ == "__main__":
    FixedIntegrator.KEPT = 0.0
    aircraft = wf.load_aircraft("uh60a")
    found = {name: sampled(wf.trim(aircraft, inflow=trimmed), inflow) for name, (trimmed, inflow) in FLOWN.items()}
    STORED.write_text(json.dumps(found, indent=1) + "\n")
