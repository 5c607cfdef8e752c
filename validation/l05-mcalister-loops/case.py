"""Peaks of lift and moment of a pitching NACA 0012 by `wf.airfoil_loop` against measured cycles."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

MODELS = ("quasi-steady", "attached", "oye", "hgm")
JUDGED = "hgm"
SHOWN = 9217
"""Frame whose cycle is drawn."""


def loop(case, row, model):
    return wf.airfoil_loop(
        case.path("rotors/caradonna-tung.toml"),
        mean=f"{row['mean']} deg",
        amplitude=f"{row['amplitude']} deg",
        k=row["k"],
        mach=row["mach"],
        model=model,
    )


def peaks(found):
    return float(found.cl.max()), float(found.cm.min())


def run(case):
    table = case.table("loops.csv")
    rows = [{name: float(table[name][i]) for name in table.columns} for i in range(len(table))]
    measured = np.array([(row["cl_max"], row["cm_min"]) for row in rows])
    ours = {model: np.array([peaks(loop(case, row, model)) for row in rows]) for model in MODELS}
    checks, notes = [], []
    for row, (lift, moment) in zip(rows, ours[JUDGED]):
        text = f"frame {row['frame']:.0f}, {row['mean']:g} +- {row['amplitude']:g} deg, k = {row['k']:g}"
        checks.append(Check(f"largest lift, {text}", lift, row["cl_max"], 0.10, kind="relative"))
        allowed = max(0.06, 0.25 * abs(row["cm_min"]))
        checks.append(Check(f"least moment, {text}", moment, row["cm_min"], allowed))
    for model in MODELS:
        lift = np.sqrt(np.mean((ours[model][:, 0] / measured[:, 0] - 1) ** 2))
        moment = np.sqrt(np.mean((ours[model][:, 1] - measured[:, 1]) ** 2))
        notes.append(
            f"Root mean square over {len(rows)} frames, {model}: largest lift {lift:.1%}, least moment {moment:.3f}."
        )
    shown = next(row for row in rows if row["frame"] == SHOWN)
    cycles = {model: loop(case, shown, model) for model in ("quasi-steady", JUDGED)}
    return Outcome(checks, draw(cycles, ours[JUDGED], measured), notes)


@style.styled
def draw(cycles, ours, measured):
    figure = style.blank(2.9)
    axes = figure.subplots(1, 3)
    for (model, cycle), color in zip(cycles.items(), (style.GREY, style.COLORS[0])):
        alpha = np.degrees(cycle.alpha)
        axes[0].plot(alpha, cycle.cl, color=color, label=model)
        axes[1].plot(alpha, cycle.cm, color=color)
    axes[2].plot(measured[:, 0], ours[:, 0], "o", color=style.COLORS[0], label="lift")
    axes[2].plot(-5 * measured[:, 1], -5 * ours[:, 1], "s", color=style.COLORS[1], label="-5 x moment")
    axes[2].plot([0, 2.3], [0, 2.3], "--", color=style.GREY)
    for each, x, y in zip(axes, ("angle, deg", "angle, deg", "peak measured"), ("lift", "moment", "peak computed")):
        each.set_xlabel(x)
        each.set_ylabel(y)
    axes[0].legend()
    axes[2].legend()
    return figure
