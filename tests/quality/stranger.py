"""What a stranger writes with the public interface: read by type checkers, never run."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

import wakeflight as wf


class Damper:
    """A controller of the stranger's own."""

    name = "damper"
    rate: str | None = None

    def reset(self, start: object) -> None:
        """Nothing to remember."""

    def step(self, t: float, sensors: wf.Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Half an inch of lateral stick per radian a second."""
        return {"lateral": -0.5 * float(sensors.p)}


def flights(folder: Path) -> dict[str, xr.Dataset]:
    """Trim, fly with every inflow model, look."""
    aircraft: wf.Aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="80 kt", altitude="5250 ft", weight="16000 lbf")
    found: dict[str, xr.Dataset] = {}
    for inflow in (wf.RelaxationWake(turns=6, near_wake_angle="45 deg"), wf.TimeMarchingWake.preset("paper")):
        start = wf.trim(aircraft, condition, inflow=inflow)
        sticks: dict[str, float] = start.stick
        angles: tuple[float, float, float] = (start.roll, start.pitch, start.yaw)
        flight = wf.fly(start, wf.arrested_descent(), inflow=inflow, revolutions=2.5, progress=True)
        print(sum(sticks.values()), np.degrees(angles), start.warnings, flight.citation())
        found[inflow.name] = flight.data
        wf.export(flight.data, folder / inflow.name, to="mat")
    return found


def steps() -> float:
    """A manoeuvre of one's own, and a loop over steps."""
    pulse = {"lateral": [(0.2, 0.0), (0.4, 1.0)]}
    own = wf.Maneuver("pulse", pulse, seconds=2.0)
    start = wf.trim(wf.load_aircraft("bo105"), inflow="dynamic")
    flight: wf.Flight = wf.fly(start, own, inflow="dynamic")
    sim = wf.Simulation(start, control=wf.RateDamping(roll="0.5 in s/rad"))
    kept: wf.Snapshot = sim.snapshot()
    state = sim.state
    for _ in range(10):
        state = sim.step({"lateral": 0.1})
    sim.restore(kept)
    roll: float = float(state.attitude[0])
    return roll + float(flight.data["roll"][-1])


def others(folder: Path) -> wf.LinearModel | None:
    """Stand, linear model, handling qualities, sound; what may go wrong."""
    try:
        stand: wf.Tunnel = wf.tunnel(wf.load_rotor("uh60a"), inflow=wf.DynamicInflow(), thrust="70 kN")
        start = wf.trim(wf.load_aircraft("uh60a"), wf.FlightCondition(speed="80 kt"), inflow="dynamic")
        model = wf.linearize(start)
    except wf.InputError as reason:
        print(reason)
        return None
    except wf.NumericalFailure as failure:
        print(failure, failure.partial)
        return None
    print(f"{stand.ct:.5f}", stand.data.attrs["aircraft"], model.A.shape, wf.bibtex(["ribera2004"]), wf.__version__)
    heard: xr.Dataset = wf.noise(wf.open_run(folder / "run.nc"), [(0.0, 0.0, 100.0)])
    print(float(heard["level"].max()), wf.handling_qualities(model))
    return model
