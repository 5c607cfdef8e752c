"""Free hover wake beside the prescribed geometries of Landgrebe and of Kocurek and Tangler."""

import numpy as np
from settings import HOVER_WAKES, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("geometry.csv")
    # the row whose rotor is in the collection: two untwisted blades at C_T = 0.0046
    rows = table.where(Nb=2.0)
    age = rows["age_deg"]
    checks, found = [], {}
    for k, name in enumerate(HOVER_WAKES):
        stand = hover(case.path("rotors/caradonna-tung.toml"), name, ct=0.0046)
        at = np.degrees(stand.data.age.values)
        height, radius = stand.data.tip_vortex_height.values, stand.data.tip_vortex_radius.values
        found[name] = (at, height, radius)
        z = dict(zip((180, 360, 720), np.interp((180, 360, 720), at, height)))
        far = (z[720] - z[360]) / (2 * np.pi)
        gate, note = k == 0, "" if k == 0 else name
        for source in ("landgrebe", "kocurek_tangler"):
            fit = dict(zip(age, rows[f"z_{source}"]))
            text = source.replace("_", " and ").title()
            slope = (fit[720] - fit[360]) / (2 * np.pi)
            checks += [
                Check(f"height at the first passage, {text}", z[180], fit[180], 0.15, "R", "relative", gate, note),
                Check(f"descent per radian after it, {text}", far, slope, 0.15, "R/rad", "relative", gate, note),
                Check(f"radius at 360 deg, {text}", np.interp(360, at, radius), dict(zip(age, rows[f"r_{source}"]))[360],
                      0.15, "R", "relative", gate, note),
            ]  # fmt: skip
    return Outcome(checks, draw(rows, found))


@style.styled
def draw(rows, found):
    figure = style.blank(3.4)
    left, right = figure.subplots(1, 2)
    for source, marker in (("landgrebe", "ko"), ("kocurek_tangler", "ks")):
        text = source.replace("_", " and ").title()
        left.plot(rows["age_deg"], rows[f"z_{source}"], marker, mfc="none", ms=4, label=text)
        right.plot(rows["age_deg"], rows[f"r_{source}"], marker, mfc="none", ms=4)
    for (name, (at, height, radius)), color in zip(found.items(), style.COLORS):
        left.plot(at[at <= 720], height[at <= 720], color=color, label=name)
        right.plot(at[at <= 720], radius[at <= 720], color=color)
    left.set_ylabel("height above the tip [R]")
    right.set_ylabel("radius of the tip vortex [R]")
    for axes in (left, right):
        axes.set_xlabel("age [deg]")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
