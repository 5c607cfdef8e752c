"""Infinite lines by very long segments, and what cutting them leaves out."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

FAR = 1e7


def velocity(point, *filaments):
    n = sum(len(f) - 1 for f in filaments)
    return wf.induced_velocity(
        [point], [np.array(f, float) for f in filaments], np.ones(n), np.zeros(n), core="singular"
    )[0]


def truncation(s):
    """Relative error of a line cut at +-s, seen at unit distance."""
    return 1.0 - velocity((1, 0, 0), [(0, 0, -s), (0, 0, s)])[1] * 2 * np.pi


def run(case):
    exact = case.toml("lines.toml")
    d = exact["infinite_line"]["d"]
    half = exact["semi_infinite_line"]
    shoe = exact["horseshoe"]
    legs = ([(FAR, -1, 0), (0, -1, 0)], [(0, 1, 0), (FAR, 1, 0)])
    whole = [(FAR, -1, 0), (0, -1, 0), (0, 1, 0), (FAR, 1, 0)]
    s = exact["segment_to_line_limit"]
    one = "Gamma/l"
    checks = [
        Check(
            "infinite line",
            velocity((d, 0, 0), [(0, 0, -FAR), (0, 0, FAR)])[1],
            exact["infinite_line"]["v"],
            1e-12,
            one,
            "relative",
        ),
        Check(
            "half line, at its end",
            velocity((d, 0, 0), [(0, 0, 0), (0, 0, FAR)])[1],
            half["v_foot"],
            1e-12,
            one,
            "relative",
        ),
        Check(
            "half line, inside its end",
            velocity((d, 0, 0), [(0, 0, -half["offset_inside"]), (0, 0, FAR)])[1],
            half["v_offset"],
            1e-12,
            one,
            "relative",
        ),
        Check(
            "horseshoe, legs at the middle of the bound vortex",
            abs(velocity((0, 0, 0), *legs)[2]),
            shoe["w_origin_legs_only"],
            1e-12,
            one,
            "relative",
        ),
        Check(
            "horseshoe, unit distance behind",
            abs(velocity((1, 0, 0), whole)[2]),
            shoe["w_at_1_0_0_total"],
            1e-12,
            one,
            "relative",
        ),
    ]
    # the error is a difference of nearly equal numbers: rounding of the velocity itself is what is allowed
    checks += [
        Check(f"what a line cut at {x:g} lacks", truncation(x), e, 1e-12) for x, e in zip(s["S"], s["rel_error"])
    ]
    return Outcome(checks, draw(s))


@style.styled
def draw(s):
    figure = style.blank(2.8)
    axes = figure.subplots()
    x = np.geomspace(1, 1000, 60)
    axes.loglog(x, [truncation(each) for each in x], label="program")
    axes.loglog(s["S"], s["rel_error"], "o", color=style.COLORS[1], label="exact")
    axes.set_xlabel("half length over distance of the point")
    axes.set_ylabel("share of the velocity left out")
    axes.legend()
    return figure
