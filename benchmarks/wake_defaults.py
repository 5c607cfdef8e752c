# SPDX-License-Identifier: MIT OR Apache-2.0
"""Which tip-vortex wake comes closest to the full-span wake: trims of the UH-60A, one file of numbers for each.

`python benchmarks/wake_defaults.py FOLDER [GROUP ...]` runs the cases of the groups (all without any) that FOLDER has no
file of, one after the other; `wake_defaults_table.py FOLDER` compares them and writes the tables.
Everything but the varied option is the same in all cases: 15 degrees, three turns, in hover three more of far wake. The
full-span wake has 12 trailers (hover: 7).

"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np

import wakeflight as wf
from wakeflight.model import Model
from wakeflight.progress import Silent
from wakeflight.trim import Trim
from wakeflight.trim.aircraft import AircraftOnWake
from wakeflight.trim.dataset import FIELDS
from wakeflight.trim.equations import dynamic_map
from wakeflight.trim.solve import solve_condition
from wakeflight.trim.wake import WakeInTrim

PASSES = 3
COMMON = {"trailers": "tip", "azimuth_step": "15 deg", "turns": 3.0, "far_wake_turns": 0, "max_loops": 15}
FULL_SPAN = {"trailers": "full-span", "n_trailers": 12, "trailer_core": 0.02}
CONDITIONS = {
    "baseline": {},
    "level": {"flight_path": "0 deg"},
    "hover": {"speed": "0 kt", "flight_path": "0 deg"},
}
HOVER = {"far_wake_turns": 3, "relaxation": 0.3}

JUDGES = {
    "full-span": {},
    "full-span, all shed": {"shed_wake": "all"},
    "full-span, no shed": {"shed_wake": "none"},
    "full-span, near wake 60 deg": {"near_wake_angle": "60 deg"},
    "full-span, core 0.04 R": {"trailer_core": 0.04, "core_radius": 0.04},
    "full-span, 18 trailers": {"n_trailers": 18},
}
CANDIDATES = {
    "equivalent": {},
    "mean": {"tip_strength": "mean"},
    "max": {"tip_strength": "max"},
    "equivalent, sheet": {"inboard_wake": "sheet"},
    "mean, sheet": {"tip_strength": "mean", "inboard_wake": "sheet"},
    "max, sheet": {"tip_strength": "max", "inboard_wake": "sheet"},
    "max, sheet of 8": {"tip_strength": "max", "inboard_wake": "sheet", "n_sheet": 8},
    "equivalent, near wake 15 deg": {"near_wake_angle": "15 deg"},
    "equivalent, near wake 60 deg": {"near_wake_angle": "60 deg"},
    "max, sheet, near wake 15 deg": {"tip_strength": "max", "inboard_wake": "sheet", "near_wake_angle": "15 deg"},
    "max, sheet, near wake 60 deg": {"tip_strength": "max", "inboard_wake": "sheet", "near_wake_angle": "60 deg"},
}
DEFAULT = {"standard": {"trailers": "full-span", "n_trailers": 3, "turns": 2.0, "far_wake_turns": 2}}
"""The wake that is the default, beside those of a lone tip vortex."""
VARIATIONS = {
    "core 0.01 R": {"core_radius": 0.01},
    "core 0.05 R": {"core_radius": 0.05},
    "growth 1e-4": {"core_growth": 1e-4},
    "growth 1e-3": {"core_growth": 1e-3},
    "core stretching": {"core_stretching": True},
    "curvature correction": {"curvature_correction": True, "core_distance": "segment"},
    "segment distance": {"core_distance": "segment"},
    "2 turns": {"turns": 2.0},
    "4 turns": {"turns": 4.0},
    "6 turns": {"turns": 6.0},
    "10 deg": {"azimuth_step": "10 deg"},
    "5 deg": {"azimuth_step": "5 deg"},
    "10 stations": {"n_stations": 10},
    "40 stations": {"n_stations": 40},
    "release at 0.98 R": {"release_radius": 0.98},
}


def groups() -> dict[str, list[tuple[str, str, dict]]]:
    """Cases (condition, name, options) by group; the dear ones last."""
    table: dict[str, list[tuple[str, str, dict]]] = {
        "candidates": [(c, name, options) for c in CONDITIONS for name, options in CANDIDATES.items()],
        "default": [("baseline", name, options) for name, options in DEFAULT.items()],
        "variations": [("baseline", name, options) for name, options in VARIATIONS.items()],
        "judges": [(c, "full-span", {}) for c in CONDITIONS],
        "judge": [("baseline", name, options) for name, options in JUDGES.items()],
    }
    fewer = {"hover": {"n_trailers": 7, "sweeps": 1, "max_loops": 25}}
    for name in ("judges", "judge"):
        table[name] = [(c, n, {**FULL_SPAN, **fewer.get(c, {}), **options}) for c, n, options in table[name]]
    return table


def options_of(condition: str, options: dict) -> dict:
    """All options of a case."""
    hover = HOVER if condition == "hover" else {}
    sheet = {"sheet_factor": 1.4} if condition == "hover" and options.get("inboard_wake") == "sheet" else {}
    return {**COMMON, **hover, **sheet, **options}


def tip_vortex(wake: wf._core.RelaxationWake, trailers: int) -> np.ndarray:
    """Path of the tip vortex (n_azimuths, n_ages, 3) [m]: of a full span the centroid of what rolls up into it.

    That is every trailer outboard of the crest of the circulation in the outboard half, weighted with its strength.
    """
    lattice, released = wake.lattice(), wake.released_circulation()
    if lattice.shape[1] == 1:
        return lattice[:, 0]
    n = lattice.shape[0]
    panel = -np.cumsum(released, axis=1)[:, :-1]
    outboard = panel.copy()
    outboard[:, : (trailers - 1) // 2] = -np.inf
    rolled = np.arange(lattice.shape[1]) > np.argmax(outboard, axis=1)[:, None]
    weight = np.where(rolled, np.maximum(released, 0.0), 0.0)
    path = np.empty((n, *lattice.shape[2:]))
    for k in range(lattice.shape[2]):
        born = weight[(np.arange(n) - k) % n]
        path[:, k] = np.einsum("nt,ntc->nc", born, lattice[:, :, k]) / born.sum(axis=1)[:, None]
    return path


def limited_trim(aircraft: wf.Aircraft, condition: wf.FlightCondition, inflow: wf.RelaxationWake) -> Trim:
    """Three turns of trim and wake whether or not the wake settles: in hover that of a full span does not in affordable time."""
    simple = Model.build(aircraft, condition, wf.DynamicInflow(n_stations=inflow.n_stations))
    problem, x = solve_condition(simple)
    model = Model.build(aircraft, condition, inflow)
    inflow_map, _ = dynamic_map(simple, problem, x, model.steps_per_revolution)
    x, wake, history = np.delete(x, slice(7, 10)), WakeInTrim(model, inflow_map), []
    trimming = AircraftOnWake(model, Silent())
    for _ in range(PASSES):
        problem, x = trimming.solve(inflow_map, x)
        wake.converge(problem, x)
        inflow_map = wake.inflow_map
        history.append(dict(wake.last))
    problem, x = trimming.solve(inflow_map, x)
    return Trim(model, problem, x, inflow_map, wake.circulation, wake, history)


def run(aircraft: wf.Aircraft, condition: str, options: dict) -> dict:
    """One trim as plain numbers and lists."""
    started = time.process_time()
    inflow = wf.RelaxationWake(**options_of(condition, options))
    flown = wf.condition_for(aircraft, **CONDITIONS[condition])
    try:
        dear = condition == "hover" and inflow.trailers == "full-span"
        start = limited_trim(aircraft, flown, inflow) if dear else wf.trim(aircraft, flown, inflow=inflow)
    except wf.NumericalFailure as failure:
        return {"failure": str(failure), "cpu_seconds": time.process_time() - started}
    mean, maps = start.mean_outputs(), start.maps(*FIELDS)
    turn = start.inflow_map.shape[0] + 1
    path = tip_vortex(start.wake.relaxation, options.get("n_trailers", 1))[:, :turn] / start.model.rotor["radius"]
    lambda_0, lambda_1c, lambda_1s = start.inflow_harmonics()
    return {
        "lambda_0": lambda_0,
        "lambda_1c": lambda_1c,
        "lambda_1s": lambda_1s,
        "power_main": mean["power_main"],
        "ct": mean["ct"],
        "mu": mean["mu"],
        "pitch_controls": start.pitch_controls,
        "flapping": [mean["beta_0"], mean["beta_1c"], mean["beta_1s"]],
        "history": start.history,
        "station": (start.model.stations / start.model.rotor["radius"]).tolist(),
        "area_weights": start.model.area_weights.tolist(),
        "inflow": start.inflow_map.tolist(),
        "circulation": start.circulation.tolist(),
        "cl_m2": maps["cl_m2"].tolist(),
        "tip_vortex": path.tolist(),
        "cpu_seconds": time.process_time() - started,
    }


def file_of(folder: Path, condition: str, name: str) -> Path:
    """Where the numbers of a case lie."""
    return folder / f"{condition}-{name.replace(', ', '-').replace(' ', '_')}.json"


def main(folder: Path, wanted: list[str]) -> None:
    """Run what is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    aircraft = wf.load_aircraft("uh60a")
    for group, cases in groups().items():
        if wanted and group not in wanted:
            continue
        for condition, name, options in cases:
            path = file_of(folder, condition, name)
            if not path.exists():
                numbers = run(aircraft, condition, options)
                path.write_text(json.dumps(numbers))
                shown = numbers.get("failure") or f"{numbers['lambda_0']:.5f} {numbers['power_main'] / 745.7:.0f} hp"
                print(f"{condition:<10}{name:<32}{numbers['cpu_seconds']:7.1f} s  {shown}", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
