"""Tip-vortex path of the rotor of Caradonna and Tung."""

import numpy as np
from settings import FULL_SPAN, HOVER_WAKES, full_span_hover, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("path.csv")
    rotor = case.path("rotors/caradonna-tung.toml")
    points = ~np.char.startswith(table["age_deg"], "slope")
    age = table["age_deg"][points].astype(float)
    radius, descent = table["r_over_R"][points], table["minus_z_over_R"][points]
    first, second = table["minus_z_over_R"][~points]
    checks, found = [], {}
    for name in [*HOVER_WAKES, FULL_SPAN]:
        if name == FULL_SPAN:
            stand = full_span_hover(rotor, collective="8 deg", rpm=1250.0)
        else:
            stand = hover(rotor, name, collective="8 deg", rpm=1250)
        at = np.degrees(stand.data.age.values)
        r = stand.data.tip_vortex_radius.values
        below = -(stand.data.tip_vortex_height.values - stand.data.tip_vortex_height.values[0])
        found[name] = (at, r, below)
        default = name.startswith("default")
        note = "" if default else name
        for a, mr, mz in zip(age, radius, descent):
            gated = default and a >= 180
            checks.append(Check(f"radius at {a:g} deg", np.interp(a, at, r), mr, 0.025, "R", gate=gated, note=note))
            checks.append(
                Check(f"descent at {a:g} deg", np.interp(a, at, below), mz, 0.025, "R", gate=gated, note=note)
            )

        def slope(a, b, at=at, below=below):
            return (np.interp(b, at, below) - np.interp(a, at, below)) / np.radians(b - a)

        checks.append(
            Check(
                "descent per radian before the other blade",
                slope(60, 170),
                first,
                0.12,
                "R/rad",
                "relative",
                default,
                note,
            )
        )
        checks.append(
            Check("descent per radian after it", slope(200, 350), second, 0.12, "R/rad", "relative", default, note)
        )
    return Outcome(checks, draw(age, radius, descent, found))


@style.styled
def draw(age, radius, descent, found):
    figure = style.blank(3.4)
    left, right = figure.subplots(1, 2)
    for (name, (at, r, below)), color in zip(found.items(), style.COLORS):
        keep = at <= 400
        left.plot(at[keep], r[keep], color=color, label=name)
        right.plot(at[keep], -below[keep], color=color)
    left.errorbar(age, radius, 0.025, fmt="ko", ms=4, lw=0.8, label="measured")
    right.errorbar(age, -descent, 0.025, fmt="ko", ms=4, lw=0.8)
    left.set_ylabel("radius of the tip vortex [R]")
    right.set_ylabel("height above the tip [R]")
    for axes in (left, right):
        axes.set_xlabel("age [deg]")
        axes.axvline(180, color=style.GREY, lw=0.7, ls=":")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center")
    return figure
