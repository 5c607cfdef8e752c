"""Convection of the wake in a prescribed field of contraction and descent, by relaxation and every time-marching scheme."""

import json
from functools import cache

import numpy as np

import wakeflight as wf
from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

STEPS = (36, 72, 144)
"""Steps in a revolution: 10, 5 and 2.5 degrees."""
TURNS = 3
AIRCRAFT = wf.load_aircraft("uh60a")
"""Whose wake options are taken; its rotor is replaced."""
STILL = ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])

SCHEMES = ("bdf2", "pc2b", "pcc", "path2")
SOLVERS = {
    "relaxation": None,
    **{
        f"{scheme}, {form}s": {"scheme": scheme, "form": form}
        for scheme in SCHEMES
        for form in ("displacement", "position")
    },
}


@cache
def options(steps, scheme="bdf2", form="displacement"):
    """Rotor of unit radius and speed whose wake is long enough for the table; relaxed fully in every sweep."""
    wake = wf.TimeMarchingWake(
        trailers="tip",
        turns=TURNS,
        azimuth_step=f"{360 / steps} deg",
        near_wake_angle="0 deg",
        scheme=scheme,
        form=form,
        evaluation="pece",
    )
    wake = wake.resolved("forward").core_options(AIRCRAFT)
    wake["rotor"] = {"n_blades": 1, "radius": 1.0, "root_cutout": 0.2, "hinge_offset": 0.0, "chord": 0.05, "omega": 1.0}
    wake["wake"]["n_stations"] = 5
    wake["relaxation"] = {"relaxation": 1.0}
    return json.dumps(wake)


@cache
def relaxed(form, steps, contraction, descent):
    """Periodic wake of the field V/(Omega R) = (-s x, -s y, -lambda), swept until it rests."""
    s = contraction
    field = ([0.0, 0.0, -descent], [[-s, 0.0, 0.0], [0.0, -s, 0.0], [0.0, 0.0, 0.0]])
    wake = _core.RelaxationWake(options(steps, form=form), STILL, 0.0, field)
    wake.set_state(STILL, np.zeros((steps, 2)), np.zeros((steps, 5)))
    change, sweeps = 1.0, 0
    while change > 1e-13:
        change = wake.sweep(5)[-1, 0]
        sweeps += 5
        if sweeps > 100:
            raise ArithmeticError(f"sweeps did not settle: {change}")
    return wake


def marched(text, steps, start):
    """Tip vortex of the blade at psi = 0, marched for longer than its own length from the periodic one."""
    wake = _core.TimeMarchingWake(start, 0, text)
    for n in range(1, (TURNS + 1) * steps + 1):
        wake.step(STILL, np.array([[2 * np.pi * (n % steps) / steps, 0.0, 0.0]]), np.zeros((1, 5)))
    return wake.lattice()[:, -1], np.zeros(1)


def exact(psi, zeta, contraction, descent):
    """r = (e^(-s zeta) cos(psi - zeta), e^(-s zeta) sin(psi - zeta), -lambda zeta)."""
    radius = np.exp(-contraction * zeta)
    return np.stack([radius * np.cos(psi - zeta), radius * np.sin(psi - zeta), -descent * zeta + 0.0 * psi], axis=-1)


def errors(name, steps, contraction, descent):
    """Errors (n, n_ages, 3) of the markers of a solver, over R, and the markers themselves."""
    solver = SOLVERS[name] or {}
    start = relaxed(solver.get("form", "displacement"), steps, contraction, descent)
    if not solver:
        position, psi = start.lattice()[:, -1], 2 * np.pi * np.arange(steps) / steps
    else:
        position, psi = marched(options(steps, **solver), steps, start)
    zeta = 2 * np.pi / steps * np.arange(position.shape[1])
    return position - exact(psi[:, None], zeta, contraction, descent), position


def at_points(position, steps, table):
    """Markers at the azimuths and ages of the table (n, 3), of a wake by relaxation."""
    rows, ages = (np.round(table[name] * steps / 360).astype(int) for name in ("psi_deg", "zeta_deg"))
    return position[rows, ages]


def points_of(table):
    """Points of the table (n, 3)."""
    return np.column_stack([table[name] for name in "xyz"])


def run(case):
    table = case.table("solution.csv")
    psi, zeta = np.radians(table["psi_deg"]), np.radians(table["zeta_deg"])
    ours = exact(psi, zeta, table["s"], table["lambda"])
    checks = [
        Check(
            "solution as this case states it, at the table's points",
            np.abs(ours - points_of(table)).max(),
            0.0,
            1e-12,
            "R",
        )
    ]
    found = {}
    for s, descent in sorted(set(zip(table["s"].tolist(), table["lambda"].tolist()))):
        rows = table.where(s=s).where(**{"lambda": descent})
        field = f"s = {s:g}, lambda = {descent:g}"
        at = []
        for name in SOLVERS:
            largest = []
            for steps in STEPS if s else STEPS[:1]:
                error, position = errors(name, steps, s, descent)
                largest.append(np.abs(error if s else error[..., 2]).max())
                if name == "relaxation":
                    at.append(at_points(position, steps, rows))
            if not s:
                # without contraction the height is exact along characteristics
                checks.append(Check(f"{name}: error of the height, {field}", largest[0], 0.0, 1e-12, "R"))
                continue
            found[field, name] = largest
            for i, halved in enumerate(("10 to 5", "5 to 2.5")):
                order = np.log2(largest[i] / largest[i + 1])
                checks.append(Check(f"{name}: order from {halved} deg, {field}", order, 2.0, 0.15))
        if s:
            limit = (4 * at[2] - at[1]) / 3
            off = np.abs(limit - points_of(rows)).max()
            checks.append(
                Check(f"relaxation without the error of second order, {field}", off, 0.0, unit="R", gate=False)
            )
    return Outcome(checks, draw(found))


@style.styled
def draw(found):
    figure = style.blank(3.6)
    step = 360 / np.array(STEPS)
    fields = sorted({field for field, _ in found})
    panels = figure.subplots(1, len(fields), sharey=True)
    markers = dict(zip(SOLVERS, "osd^v+x<>"))
    for axes, field in zip(panels, fields):
        for i, name in enumerate(SOLVERS):
            color = style.COLORS[i % len(style.COLORS)]
            axes.loglog(step, found[field, name], markers[name] + "-", color=color, lw=1.0, ms=4, label=name)
        guide = found[field, "relaxation"][0] * 0.4 * (step / step[0]) ** 2
        axes.loglog(step, guide, "--", color=style.GREY, label="second order")
        axes.set_title(field.replace("lambda", "λ"))
        axes.set_xticks(step, [f"{each:g}" for each in step])
        axes.minorticks_off()
        axes.set_xlabel("step of azimuth and age [deg]")
    panels[0].set_ylabel("largest error of a marker [R]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure
