# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tables of the study of the wake's defaults, from the files that `wake_defaults.py` left in FOLDER."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
from wake_defaults import CANDIDATES, CONDITIONS, JUDGES, VARIATIONS, file_of
from wake_defaults_maneuver import WAKES

HORSEPOWER = 745.6998715822702  # W
HEAD = (
    "wake",
    "λ₀",
    "λ₁c",
    "λ₁s",
    "main rotor [hp]",
    "θ₀, θ₁c, θ₁s [deg]",
    "inflow RMS / λ₀",
    "load RMS",
    "tip vortex r, z [% R]",
)


def read(folder: Path, condition: str, name: str) -> dict | None:
    """Numbers of a case, None if it was not run."""
    path = file_of(folder, condition, name)
    return json.loads(path.read_text()) if path.exists() else None


def on_stations(case: dict, field: str, stations: list[float], azimuths: int) -> np.ndarray:
    """A map of a case at the stations and azimuths of another."""
    values, own = np.asarray(case[field]), case["station"]
    values = np.array([np.interp(stations, own, row) for row in values])
    n = len(values)
    ends = np.vstack([values, values[:1]])
    psi = np.arange(azimuths) / azimuths * n
    return np.array([np.interp(psi, np.arange(n + 1), column) for column in ends.T]).T


def disk_rms(values: np.ndarray, weights: list[float]) -> float:
    """Root of the area mean of the square."""
    return float(np.sqrt(np.mean(values**2 @ np.asarray(weights))))


def path_difference(case: dict, judge: dict) -> tuple[float, float]:
    """RMS difference of the tip vortex in the first turn, radially and vertically (both over R)."""
    path, reference = np.asarray(case["tip_vortex"]), np.asarray(judge["tip_vortex"])
    if path.shape != reference.shape:
        every = len(path) // len(reference)
        if every * len(reference) != len(path):
            return float("nan"), float("nan")
        path = path[::every, ::every]
    radius, reference_radius = (np.hypot(p[..., 0], p[..., 1]) for p in (path, reference))
    rms = [np.sqrt(np.mean(d**2)) for d in (radius - reference_radius, path[..., 2] - reference[..., 2])]
    return float(rms[0]), float(rms[1])


def row(name: str, case: dict | None, judge: dict | None) -> str:
    """One line of a table."""
    if case is None or "failure" in case:
        reason = "not run" if case is None else case["failure"].split(":")[0]
        return f"| {name} | {reason} |" + " |" * (len(HEAD) - 2)
    pitch = case["pitch_controls"]
    cells = [name, *(f"{case[key]:.4f}" for key in ("lambda_0", "lambda_1c", "lambda_1s"))]
    cells.append(f"{case['power_main'] / HORSEPOWER:.0f}")
    cells.append(", ".join(f"{np.degrees(pitch[key]):.2f}" for key in ("theta_0", "theta_1c", "theta_1s")))
    if judge is None or "failure" in judge or case is judge:
        cells += ["", "", ""]
    else:
        n, stations, weights = len(judge["inflow"]), judge["station"], judge["area_weights"]
        maps = {f: on_stations(case, f, stations, n) - np.asarray(judge[f]) for f in ("inflow", "cl_m2")}
        cells.append(f"{disk_rms(maps['inflow'], weights) / judge['lambda_0']:.2f}")
        cells.append(f"{disk_rms(maps['cl_m2'], weights) / disk_rms(np.asarray(judge['cl_m2']), weights):.3f}")
        cells.append(", ".join(f"{100 * d:.1f}" for d in path_difference(case, judge)))
    return "| " + " | ".join(cells) + " |"


def table(title: str, names: list[str], folder: Path, condition: str, judge_name: str) -> str:
    """A table of cases against one of them."""
    judge = read(folder, condition, judge_name)
    cases = {name: judge if name == judge_name else read(folder, condition, name) for name in names}
    lines = [f"**{title}**", "", "| " + " | ".join(HEAD) + " |", "|---" * len(HEAD) + "|"]
    lines += [row(name, case, judge) for name, case in cases.items()]
    return "\n".join(lines) + "\n"


def maneuver(folder: Path) -> str:
    """Largest changes from the start of the flight, and RMS differences of histories and of the last revolution's maps."""
    judge = read(folder, "maneuver", "full-span")
    if judge is None:
        return "manoeuvre: not run\n"
    columns = {
        "ct": ("C_T [%]", 100 / judge["ct"][0]),
        "inflow_mean": ("λ [%]", 100 / judge["inflow_mean"][0]),
        "beta_1c": ("β₁c [deg]", np.degrees(1)),
        "beta_1s": ("β₁s [deg]", np.degrees(1)),
        "q": ("q [deg/s]", np.degrees(1)),
        "p": ("p [deg/s]", np.degrees(1)),
    }
    head = ("wake", *(label for label, _ in columns.values()), "inflow RMS / λ₀", "load RMS")
    lines = ["**manoeuvre: largest change from the start (RMS difference of the change)**", ""]
    lines += ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    weights, mean = judge["area_weights"], float(np.mean(judge["inflow_mean"][-24:]))
    for name in WAKES:
        case = read(folder, "maneuver", name)
        if case is None:
            continue
        cells = [name]
        for key, (_, factor) in columns.items():
            change, reference = (factor * (np.asarray(c[key]) - c[key][0]) for c in (case, judge))
            peak = change[np.argmax(np.abs(change))]
            cells.append(f"{peak:.2f} ({np.sqrt(np.mean((change - reference) ** 2)):.2f})")
        for key, scale in (("inflow", mean), ("cl_m2", disk_rms(np.asarray(judge["cl_m2"]), weights))):
            cells.append(f"{disk_rms(np.asarray(case[key]) - np.asarray(judge[key]), weights) / scale:.2f}")
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main(folder: Path) -> None:
    """All tables."""
    for condition in CONDITIONS:
        print(table(f"{condition}, against `full-span`", ["full-span", *CANDIDATES], folder, condition, "full-span"))
    print(table("the judge itself, baseline", list(JUDGES), folder, "baseline", "full-span"))
    print(maneuver(folder))
    names = ["equivalent", *VARIATIONS]
    print(table("other defaults, baseline, against `equivalent`", names, folder, "baseline", "equivalent"))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
