"""Runs by the names of the paper's cases that were never flown: closed forms in place of physics."""

import numpy as np
import synthetic

from wakeflight.studies.paper.cases import base_cases, question_cases, reading_cases

COUNTED = {
    "segment_evaluations_trim": 40_000_000,
    "relaxation_iterations_trim": 6,
    "relaxation_iterations": 120,
    "seconds_processor": 9.0,
    "seconds_logged": 20.0,
    "configuration.trim_inflow": "relaxation",
    "phases": [["trim", None, 0.0], ["convergence of the wake", 10, 4.0], ["flight", 12, 7.0]],
    "convergence_change": [0.1 ** (k + 1) for k in range(10)],
    "segment_evaluations_convergence": 60_000_000,
    "configuration.inflow.convergence_revolutions": 10,
    "condition.altitude": 1600.2,
    "condition.gross_mass": 7257.5,
}


def runs():
    """Every case, an arrested descent in each."""
    made = {}
    for case in [*base_cases(), *question_cases(), *reading_cases()]:
        rolls = case.maneuver != "arrested-descent"
        revolutions = 36 if rolls else 12
        strength = {"dynamic": 0.8, "relaxation": 1.0}.get(case.inflow.name, 1.1)
        more = {**COUNTED, "relaxation_updates": revolutions, "unconverged_revolutions": 1}
        made[case.name] = synthetic.run(case.inflow.name, revolutions, strength, **more).assign_attrs(
            revolutions=revolutions
        )
        for name in ("flap", "lead", "inflow_mean"):
            shape = made[case.name]["azimuth"] if name != "inflow_mean" else made[case.name]["w"]
            made[case.name][name] = 0.01 * shape
        if case.inflow.name == "time-marching":
            made[case.name]["wake"] = made[case.name]["wake"] * 1.01
        if rolls:
            t = made[case.name].time.values
            for name in ("p", "roll", "v", "moment_x", "lateral", "sas_lateral"):
                # right, left, right again
                made[case.name][name] = ("time", strength * np.sin(t * 2.2) * (1 + 0.1 * t))
    return made
