"""The paper's set-up against the shipped aircraft and manoeuvres."""

import numpy as np

import wakeflight as wf
from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.units import STANDARD_GRAVITY
from wakeflight.validate import Check, Outcome


def run(case):
    paper = case.toml("timeline.toml")
    aircraft = wf.load_aircraft("uh60a")
    descent, reversal = wf.arrested_descent(), wf.roll_reversal()
    omega = float(aircraft.rotor.omega)
    period = 2 * np.pi / omega
    turn, up, side = paper["rotor"], paper["arrested_descent"], paper["roll_reversal"]
    corners, back = np.array(descent.corners()), np.array(reversal.corners())
    still = np.zeros(4)

    def moved(maneuver, t, axis):
        return float(maneuver.stick(t, still)[axis])

    condition = wf.condition_for(aircraft)
    density, _, _ = _core.standard_atmosphere(condition.altitude)
    radius = float(aircraft.rotor.radius)
    tip_speed = omega * radius
    loading = condition.gross_mass * STANDARD_GRAVITY / (density * np.pi * radius**2 * tip_speed**2) / aircraft.solidity
    flight = paper["flight"]
    checks = [
        Check("rotor speed", omega, turn["omega_rad_s"], 0.005, "rad/s"),
        Check("a revolution", period, turn["revolution_s"], 5e-7, "s"),
        Check("36 revolutions", 36 * period, turn["check_36_rev_s"], 5e-5, "s"),
        Check("collective rises by", moved(descent, corners[1], 2), up["collective_step_in"], 1e-9, "in"),
        Check("collective rises in", corners[1] - corners[0], up["ramp_s"], 1e-9, "s"),
        Check("collective rises after two revolutions", corners[0], 2 * period, 1e-4, "s"),
        Check("first step right", moved(reversal, back[1], 0), side["step1_in"], 1e-9, "in"),
        Check("first step at", back[0], side["step1_start_s"], 0.005, "s"),
        Check("ramp of the first step", back[1] - back[0], side["step1_ramp_s"], 1e-9, "s"),
        Check(
            "travel of the step left",
            moved(reversal, back[1], 0) - moved(reversal, back[3], 0),
            side["step2_total_in"],
            1e-9,
            "in",
        ),
        Check("step left at", back[2], side["step2_start_s"], 1e-9, "s"),
        Check("ramp of the step left", back[3] - back[2], side["step2_ramp_s"], 1e-9, "s"),
        Check("step right at", back[4], side["step3_start_s"], 1e-9, "s"),
        Check("advance ratio V/(omega R)", condition.speed / tip_speed, flight["mu_total"], 5e-5),
        Check("weight over rho A (omega R)^2 sigma", loading, flight["CT_over_sigma_isa_5250ft"], 6e-4),
        Check("the same beside the printed C_T/sigma", loading, flight["CT_over_sigma_paper"], gate=False),
    ]
    return Outcome(checks, draw(descent, reversal, still, period))


@style.styled
def draw(descent, reversal, still, period):
    figure = style.blank(2.8)
    for axes, maneuver, axis, turns in zip(figure.subplots(1, 2), (descent, reversal), (2, 0), (12, 36)):
        t = np.linspace(0, turns * period, 2000)
        axes.plot(t, [maneuver.stick(each, still)[axis] for each in t])
        axes.set_xlabel("time [s]")
        axes.set_ylabel(("collective, up" if axis == 2 else "lateral stick, right") + " from trim [in]")
        axes.set_title(maneuver.name)
    return figure
