"""Thrust of the rotor of Caradonna and Tung."""

from functools import partial

from settings import BASELINE, FULL_SPAN, HOVER_WAKES, baseline, full_span_hover, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("thrust.csv")
    rotor = case.path("rotors/caradonna-tung.toml")
    checks, found = [], {}
    for name in [*HOVER_WAKES, FULL_SPAN, BASELINE]:
        solved = {BASELINE: partial(baseline, rotor), FULL_SPAN: partial(full_span_hover, rotor)}.get(
            name, partial(hover, rotor, name)
        )
        runs = zip(table["theta_deg"], table["rpm"])
        ours = [solved(collective=f"{theta:g} deg", rpm=float(rpm)).ct for theta, rpm in runs]
        found[name] = ours
        default = name.startswith("default")
        for theta, mach, ct, measured in zip(table["theta_deg"], table["Mtip"], ours, table["CT"]):
            text = f"C_T at {theta:g} deg, tip Mach number {mach:g}"
            checks.append(Check(text, ct, measured, 0.07, kind="relative", gate=default, note="" if default else name))
    return Outcome(checks, draw(table, found))


@style.styled
def draw(table, found):
    figure = style.blank(4.6)
    axes = figure.subplots()
    axes.plot(table["Mtip"], table["CT"], "ko", label="measured")
    for (name, ours), color in zip(found.items(), style.COLORS):
        for theta in (5, 8):
            rows = table["theta_deg"] == theta
            axes.plot(
                table["Mtip"][rows],
                [c for c, r in zip(ours, rows) if r],
                "o-",
                mfc="none",
                color=color,
                label=name if theta == 8 else None,
            )
    for theta in (5, 8):
        rows = table["theta_deg"] == theta
        axes.annotate(f"{theta}°", (table["Mtip"][rows][-1] + 0.01, table["CT"][rows][-1]), va="center")
    axes.set_ylim(0, None)
    axes.set_xlabel("tip Mach number")
    axes.set_ylabel("thrust coefficient C_T")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center")
    return figure
