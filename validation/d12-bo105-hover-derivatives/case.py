"""BO-105C in hover: derivatives with blades and inflow quasi-static, and the trim, beside CR-3144."""

import numpy as np
from derivatives import gross_inertia, linear_model

import wakeflight as wf
from wakeflight.validate import Check, Outcome

TOLERANCES = {"Zw": 0.25, "Mq": 0.25, "Lp": 0.25, "Yv": 0.40, "Nr": 0.40}
SIGNS = ("Xu", "Mu", "Lv", "Nv")


def run(case):
    published = case.toml("bo105_cr3144_hover.toml")["hover"]
    aircraft = wf.load_aircraft("bo105", loading="cr3144")
    start = wf.trim(aircraft, wf.FlightCondition(speed="0 kt", altitude="0 m"), inflow="dynamic")
    model = linear_model(start, inertia=gross_inertia(start))
    checks = [
        Check(name, model[f"{name[0]}_{name[1]}"], published[name], tolerance, kind="relative")
        for name, tolerance in TOLERANCES.items()
    ]
    checks += [Check(name, model[f"{name[0]}_{name[1]}"], published[name], gate=False) for name in SIGNS]
    small = wf.linearize(start, order=8).A
    rows = {"X": "u", "Z": "w", "M": "q", "Y": "v", "L": "p", "N": "r"}
    for name in (*TOLERANCES, *SIGNS):
        mine = float(small.sel(state=rows[name[0]], state_=name[1]))
        checks.append(
            Check(
                f"{name}, wf.linearize", mine, published[name], gate=False, note="eight states, the aircraft's inertia"
            )
        )
    for key, ours in (("main", start.theta_0), ("tail", start.theta_tr)):
        name = f"{key} rotor collective"
        checks.append(Check(name, np.degrees(ours), published[f"{key}_rotor_collective_deg"], 1.5, "deg"))
    agree = [name for name in SIGNS if model[f"{name[0]}_{name[1]}"] * published[name] > 0.0]
    return Outcome(checks, notes=[f"Signs that agree of {', '.join(SIGNS)}: {', '.join(agree)}."])
