# SPDX-License-Identifier: MIT OR Apache-2.0
"""Turboshaft: an inch of collective in hover with the engines of the aircraft's file, and with a pair of T700 of one's own.

Linear model of gas generator (N_G) and power turbine (N_P) about hover [ballin1988]; the file's governor but for its rate term.
"""

import math
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

import wakeflight as wf

GEAR, INERTIA = 20900 / 257.9, (1 + 9.2503) * 0.062 * 1.35582  # turbine over rotor; with load [kg m2]
GAS, TURBINE = (-2.693, 0.1296e6), (0.3865, 0.2105e5, 0.3295 - 0.565)  # rates by N_G, fuel, N_P [rpm, lb/s]
GOVERNOR = (2000 / 7200, 2500 / 7200)  # fuel of an engine by rotor speed and its integral [lb/s; rad/s]


class T700(wf.Engine):
    """Two engines about the torque of the trim; `known`: N_G beyond its trim [rpm], integral [rad]."""

    def begin(self, torque: float, rotor_speed: float) -> None:
        self.known = {"torque": torque, "speed": rotor_speed, "gas": 0.0, "integral": 0.0}

    def torque(self, t: float, dt: float, rotor_speed: float, collective: float) -> float:
        known, slow = self.known, self.known["speed"] - rotor_speed
        fuel = GOVERNOR[0] * slow + GOVERNOR[1] * known["integral"]
        pace = (TURBINE[0] * known["gas"] + TURBINE[1] * fuel) * math.pi / 30 - TURBINE[2] * GEAR * slow
        toward = (1 - math.exp(GAS[0] * dt)) * (-GAS[1] / GAS[0] * fuel - known["gas"])
        self.known = known | {"gas": known["gas"] + toward, "integral": known["integral"] + slow * dt}
        return known["torque"] + 2 * GEAR * INERTIA * pace

    def memory(self) -> dict[str, float]:
        return self.known

    def recall(self, memory: Any) -> None:
        self.known = dict(memory)


def main(out: Path = Path("runs/examples"), seconds: float = 8.0) -> Path:
    """Fly both, draw speed of the rotor and power; returns the figure's path."""
    start = wf.trim(wf.load_aircraft("uh60a"), wf.FlightCondition(speed="0 kt"), inflow="dynamic")
    pull = wf.Maneuver("an inch", {"collective": [(0.3, 0.0), (0.8, 1.0)]}, seconds=seconds)
    figure, axes = plt.subplots(layout="constrained")
    hold = wf.AttitudeHold(roll="8 in/rad", pitch="8 in/rad", heading="8 in/rad", lag="0.05 s")
    for label, engines in (("the aircraft's file", "governed"), ("T700", T700())):
        run = wf.fly(start, pull, integrator="fixed", rotor_speed=engines, control=hold).data
        axes.plot(run.time, 100 * run.rotor_speed / float(run.rotor_speed[0]), label=label)
        print(f"{label}: {float(run.power_engine.max()) / 1e3:.0f} kW at most")
    axes.set(ylabel="rotor speed [%]", xlabel="time [s]")
    axes.legend()
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "turboshaft.png", dpi=130)
    plt.close(figure)
    return out / "turboshaft.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
