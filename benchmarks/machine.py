"""What the machine around the rotor adds to a flight: controllers, engines, wind, turbulence, ground, the stabilator's schedule.

    python benchmarks/machine.py [--rounds N] [--rigid] [--wake] [CASE ...]

One process, one flight per case, all flown side by side: a revolution of each in turn, recorded as `wf.fly` records it, so that
whatever else the machine does falls on all alike. Processor time, and its ratio to the bare flight of the same round. Flights
are flown anew from where they began after each fourth round: all fly the same four revolutions again and again.
"""

import argparse
import statistics
import time

import measure

import wakeflight as wf
from wakeflight.flight import Sticks
from wakeflight.recorder import Recorder

HELD = (
    wf.RateDamping(roll="0.05 in/(deg/s)", pitch="0.05 in/(deg/s)", yaw="0.05 in/(deg/s)", lag="0.05 s", washout="5 s"),
    wf.AttitudeHold(roll="3 in/rad", pitch="3 in/rad", heading="2 in/rad", lag="0.05 s"),
    wf.AltitudeHold(altitude="0.01 in/ft", climb_rate="0.02 in/(ft/s)"),
)
CONTROL = {"control": list(HELD), "actuators": "generic"}
GOVERNED = {"rotor_speed": "governed"}
STEADY = wf.SteadyWind("10 kt", from_="30 deg")
TURBULENCE = {"wind": [STEADY, wf.Dryden("1.5 m/s", "150 m", seed=1)]}
SCHEDULED = {"stabilator": "scheduled"}
CASES = {
    "bare": {},
    "controllers and servos": CONTROL,
    "rotor speed governed": GOVERNED,
    "steady wind": {"wind": STEADY},
    "1-cosine gust": {"wind": wf.Gust()},
    "steady wind and turbulence": TURBULENCE,
    "stabilator scheduled": SCHEDULED,
    "all of it": {**CONTROL, **GOVERNED, **TURBULENCE, **SCHEDULED},
}
"""What is on, by name; the first is what the others are measured against."""
REVOLUTIONS = 4


class Flown:
    """A flight of which a revolution is flown at a time."""

    def __init__(self, start: wf.Trim, inflow: str, given: dict):
        self.sim = wf.Simulation(start, inflow=inflow, integrator="fixed", **given)
        self.maneuver, self.begin = wf.arrested_descent(), self.sim.snapshot()
        self.sticks = Sticks(self.maneuver, start.stick_si)
        self.recorder = None

    def revolution(self, number: int) -> float:
        """Processor time of a revolution a step [us]."""
        steps = self.sim.model.steps_per_revolution
        if number % REVOLUTIONS == 0:
            self.sim.restore(self.begin)
            self.recorder = Recorder(self.sim, self.maneuver, REVOLUTIONS * steps)
        begun = time.process_time()
        for _ in range(steps):
            self.sim.follow(self.sticks, self.recorder.record)
        return (time.process_time() - begun) / steps * 1e6


def quickest(spent: list[float]) -> float:
    """Mean over the revolutions of the quickest time that each of them took."""
    return statistics.mean(min(spent[k::REVOLUTIONS]) for k in range(REVOLUTIONS))


def main() -> None:
    """Fly the cases asked for beside the bare flight."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--rounds", type=int, default=40)
    parser.add_argument("--rigid", action="store_true")
    parser.add_argument("--wake", action="store_true")
    options = parser.parse_args()
    condition = wf.FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")
    aircraft = wf.load_aircraft("uh60a")
    aircraft = aircraft.with_rigid_blades() if options.rigid else aircraft
    near = wf.FlightCondition(
        speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf", height="300 ft"
    )
    inflow, flown = ("relaxation", "time-marching") if options.wake else ("dynamic", "dynamic")
    names = ["bare", *(options.cases or [name for name in CASES if name != "bare"])]
    start = wf.trim(aircraft, condition, inflow=inflow)
    flights = {name: Flown(start, flown, CASES[name]) for name in names}
    if not options.cases:
        close = wf.trim(aircraft, near, inflow=inflow)
        flights["ground"] = Flown(close, flown, {})
        flights["all of it, ground too"] = Flown(close, flown, CASES["all of it"])
    times = {name: [] for name in flights}
    for number in range(-REVOLUTIONS, options.rounds):
        for name, flight in flights.items():
            spent = flight.revolution(number % REVOLUTIONS)
            if number >= 0:
                times[name].append(spent)
    rows = []
    for name, spent in times.items():
        ratios = [a / b for a, b in zip(spent, times["bare"], strict=True)]
        least, median = quickest(spent), statistics.median(spent)
        cells = [
            f"{least:.0f}",
            f"{median:.0f}",
            f"{least / quickest(times['bare']):.3f}",
            f"{statistics.median(ratios):.3f}",
        ]
        rows.append([name, *cells])
    print(f"Measured on: {measure.machine()}.\n")
    print(measure.table(["on", "least us a step", "median", "ratio of the least", "median of ratios"], rows))


if __name__ == "__main__":
    main()
