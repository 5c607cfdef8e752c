"""Residual, Jacobian, revolutions and whole manoeuvres."""

import numpy as np
from measure import seconds, table

import wakeflight as wf
from wakeflight.flight_start import flight_model
from wakeflight.integrators import consistent_rate

PHASES = ("seconds_trim", "seconds_convergence", "seconds_wake", "seconds_dynamics")


FLOWN = (
    ("dynamic inflow", "dynamic", "dynamic", "rigid"),
    ("dynamic inflow", "dynamic", "dynamic", "flexible"),
    ("paper", wf.RelaxationWake.preset("paper"), wf.TimeMarchingWake.preset("paper"), "flexible"),
    ("standard", "relaxation", "time-marching", "flexible"),
)
"""What is flown: name, inflow model of the trim and of the flight, blades."""


def start(inflow: "str | wf.RelaxationWake", blades: str = "flexible") -> "wf.Trim":
    """Descent of the arrested-descent manoeuvre, trimmed."""
    condition = wf.FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")
    aircraft = wf.load_aircraft("uh60a")
    return wf.trim(aircraft.with_rigid_blades() if blades == "rigid" else aircraft, condition, inflow=inflow)


def dynamics(quick: bool) -> str:
    """Residual, Jacobian and mass matrix of F(y_dot, y, u, t), beside the Jacobian by differences of the residual."""
    rows = [row for blades in ("flexible", "rigid") for row in derivatives(blades, 50 if quick else 300)]
    return table(["blades", "what", "microseconds", "in residuals"], rows)


def derivatives(blades: str, repetitions: int) -> list[list[str]]:
    """Rows of `dynamics` for one kind of blades."""
    trimmed = start("dynamic", blades)
    model = flight_model(trimmed, None)
    inputs, y = trimmed.inputs(), trimmed.state(0.0)
    y_dot = consistent_rate(model, 0.0, y, inputs)
    n = y.size
    out, matrix, room = np.empty(n), np.empty((n, n)), model.linearised()

    def by_differences() -> None:
        for i in range(n):
            shifted = y.copy()
            shifted[i] += 1e-7 * max(1.0, abs(y[i]))
            model.core.residual(0.0, shifted, y_dot, inputs, out)

    timed = {
        f"residual of {n} states": lambda: model.core.residual(0.0, y, y_dot, inputs, out),
        "exact Jacobian": lambda: model.core.jacobian(0.0, y, y_dot, inputs, (1.0, 100.0), matrix),
        "dF/dy_dot alone": lambda: room.renew(model.core, (0.0, y), y_dot, inputs, False),
    }
    medians = {name: seconds(call, repetitions)[0] for name, call in timed.items()}
    medians["the Jacobian by one-sided differences"] = seconds(by_differences, max(3, repetitions // 20))[0]
    residual = next(iter(medians.values()))
    return [[blades, name, f"{value * 1e6:.1f}", f"{value / residual:.1f}"] for name, value in medians.items()]


def maneuvers(quick: bool, ns_per_evaluation: float) -> str:
    """Each phase of a flight against the time flown; the floor is the segment evaluations at the kernel's speed."""
    rows = []
    revolutions = 2.0 if quick else None
    for name, inflow, marched, blades in FLOWN:
        trimmed = start(inflow, blades)
        for maneuver in (wf.roll_reversal(),) if quick else (wf.roll_reversal(), wf.arrested_descent()):
            for integrator in ("ida", "fixed"):
                given = {"inflow": marched, "revolutions": revolutions, "integrator": integrator}
                flights = [wf.fly(trimmed, maneuver, **given) for _ in range(3)]
                # the median flight: short ones feel whatever else the machine does
                flight = sorted(flights, key=lambda each: float(each.data.attrs["seconds_dynamics"]))[1]
                attributes = flight.data.attrs
                phases = [float(attributes[name]) for name in PHASES]
                flown = float(flight.data.time[-1])
                in_flight = phases[2] + phases[3]
                floor = float(attributes.get("segment_evaluations", 0)) * ns_per_evaluation * 1e-9
                cells = [f"{value:.3g}" for value in (flown, *phases)]
                names = [maneuver.name, blades, name, integrator]
                rows.append([*names, *cells, f"{flown / in_flight:.3g}", f"{floor:.2f}"])
    head = ["manoeuvre", "blades", "inflow", "integrator", "flown [s]", "trim [s]", "convergence [s]"]
    return table([*head, "wake [s]", "dynamics [s]", "real-time factor", "wake's floor [s]"], rows)


def import_time() -> str:
    """Start-up of the package in a fresh interpreter."""
    import subprocess
    import sys

    median, best = seconds(lambda: subprocess.run([sys.executable, "-c", "import wakeflight"], check=True), 7)
    empty, _ = seconds(lambda: subprocess.run([sys.executable, "-c", "pass"], check=True), 7)
    return f"`import wakeflight`: {median:.2f} s (best {best:.2f}), of which an empty interpreter {empty:.2f} s.\n"
