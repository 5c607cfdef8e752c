"""The aircraft as a rigid body, by the program's residual and solver."""

import copy
import json
from types import SimpleNamespace

import numpy as np

import wakeflight as wf
from wakeflight import _core
from wakeflight.integrators import IdaIntegrator, consistent_rate
from wakeflight.model import setting
from wakeflight.plotting import style
from wakeflight.recorder import euler_angles
from wakeflight.validate import Check, Outcome

FOOT, SLUG_FT2, MASS = 0.3048, 1.3558179483314004, 7257.5


def body(inertia, gravity):
    """The UH-60A with the inertia of the case and blades that weigh nothing to speak of, one mode each."""
    data = copy.deepcopy(wf.load_aircraft("uh60a").core_data())
    blade = data["rotor"]["blade"]["structure"]
    for key in ("mass", "i_theta", "ei_flap", "ei_lag", "gj"):
        blade[key] = [1e-10 * each for each in blade[key]]
    data["rotor"]["lag_damper"] = None
    data["mass"] |= {"gross_mass": MASS, "inertia": [inertia[k] * SLUG_FT2 for k in ("Ix", "Iy", "Iz", "Ixz")]}
    for part in ("fuselage", "stabilator", "stabilator_schedule", "fin", "tail_rotor", "interference"):
        data[part] = None
    coarse = {"n_elements": 4, "n_modes": 2, "n_gauss": 8, "n_stations": 2, "reference_pitch": 0.3}
    core = _core.System.aircraft(json.dumps(data), setting((1.0, 340.0), True, coarse, gravity))
    rotor = core.rotor()
    room = {"linearised": lambda: _core.Linearised(core)}
    return SimpleNamespace(
        core=core, layout=core.layout(), rotor=rotor, omega=rotor["omega"], has_free_speed=False, **room
    )


INPUTS = _core.Inputs([0.0] * 4, [0.0] * 4, 0.0, None, 0.0, 0.0, vacuum=True)


def fly(model, y, times):
    """States at `times` [s] from `y`."""
    solver = IdaIntegrator(model, rtol=1e-9, atol_scale=1e-4)
    # what the weightless blades do is felt by nobody
    solver.atol[13:] *= 1e5
    solver.start(0.0, y, consistent_rate(model, 0.0, y, INPUTS))
    states, now = [], 0.0
    for t in times:
        # in parts, for the limit on the number of steps in one
        for part in np.linspace(now, t, 2 + int(t - now))[1:]:
            solver.advance_to(part, INPUTS)
        states.append(solver.state)
        now = t
    return np.array(states)


def start(model, rates, velocity=(0.0, 0.0, 0.0)):
    y = np.zeros(model.layout["size"])
    y[:3], y[3:6], y[6] = velocity, rates, 1.0
    return y


def run(case):
    data = case.toml("rigid_body.toml")
    inertia = data["inertia_slug_ft2"]
    free = body(inertia, 0.0)
    times = [row["t"] for row in data["torque_free"]]
    found = fly(free, start(free, data["pqr0"]), times)
    angles = np.degrees(np.array(euler_angles(found[:, 6:10])).T)
    checks = []
    for row, state, angle in zip(data["torque_free"], found, angles, strict=True):
        checks.append(Check.largest(f"p, q, r at {row['t']:g} s", state[3:6], row["pqr"], 1e-6, "rad/s"))
        turned = (angle - row["euler_deg"] + 180.0) % 360.0 - 180.0
        checks.append(
            Check(f"attitude at {row['t']:g} s, largest error", np.max(np.abs(turned)), 0.0, np.degrees(1e-6), "deg")
        )
    g = data["g_ft_s2"] * FOOT
    falling = body(inertia, g)
    rows = data["gravity_only"]
    y = start(falling, data["pqr0"], np.array(data["uvw0_ft_s"]) * FOOT)
    fallen = fly(falling, y, [row["t"] for row in rows])
    for row, state in zip(rows, fallen, strict=True):
        u = state[:3] / FOOT
        checks.append(Check.largest(f"u, v, w falling, at {row['t']:g} s", u, row["uvw"], 1e-6 * 135, "ft/s"))
    checks += turns(falling, data["level_turn"], g)
    return Outcome(checks, draw(free, data))


def turns(model, rows, g):
    """Force that a coordinated turn needs: along the body's z axis alone, load factor times weight."""
    checks = []
    for row in rows:
        phi = np.radians(row["phi_deg"])
        y = start(model, (0.0, row["q_rad_s"], row["r_rad_s"]), (row["V_ft_s"] * FOOT, 0.0, 0.0))
        y[6:10] = np.cos(phi / 2), np.sin(phi / 2), 0.0, 0.0
        rate = consistent_rate(model, 0.0, y, INPUTS)
        # without forces the body accelerates by what the turn would have to provide
        needed = -rate[:3] / g
        name = f"turn at {row['phi_deg']:g} deg of bank"
        checks.append(Check(f"{name}: load factor", -needed[2], row["load_factor"], 1e-6))
        checks.append(Check(f"{name}: force across", np.max(np.abs(needed[:2])), 0.0, 1e-6, "weight"))
    return checks


@style.styled
def draw(model, data):
    figure = style.blank(2.8)
    axes = figure.subplots()
    t = np.linspace(0.05, 10.0, 200)
    rates = fly(model, start(model, data["pqr0"]), t)[:, 3:6]
    for i, name in enumerate("pqr"):
        axes.plot(t, rates[:, i], color=style.COLORS[i], label=name)
        axes.plot(
            [row["t"] for row in data["torque_free"]],
            [row["pqr"][i] for row in data["torque_free"]],
            "o",
            color=style.COLORS[i],
        )
    axes.plot([], [], "o", color=style.GREY, label="reference")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("body rates [rad/s]")
    axes.legend(ncols=4)
    return figure
