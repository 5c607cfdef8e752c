"""Wake settings of the measured cases: the same for every case of a kind.

The default of a kind is what `wf.tunnel` takes by itself for the name of an inflow model; a variation changes one thing and is
shown beside it, never instead of it.
"""

from functools import cache

import wakeflight as wf

DEFAULT = "default: three trailers and shed vorticity, two turns free and six carried"

HOVER_WAKES = {
    DEFAULT: {},
    "default, second-order lifting line": {"blade_model": "second-order"},
    "tip vortex of the equivalent strength": {"trailers": "tip"},
    "tip vortex of the largest circulation, inboard sheet": {"tip_strength": "max", "inboard_wake": "sheet"},
    "tip vortex of the mean outboard circulation": {"tip_strength": "mean"},
    "largest circulation, sheet, Weissinger-L blade": {
        "tip_strength": "max",
        "inboard_wake": "sheet",
        "blade_model": "weissinger",
    },
}


def hover(rotor, wake=DEFAULT, **arguments):
    """Rotor in hover with a relaxation wake of one of `HOVER_WAKES`."""
    options = dict(HOVER_WAKES[wake])
    blade_model = options.pop("blade_model", "lifting-line")
    return wf.tunnel(rotor, inflow=wf.RelaxationWake(**options), blade_model=blade_model, **arguments)


FULL_SPAN = "full-span wake, means in time, second-order lifting line"
"""The internal truth in hover: every trailer free. Ten turns, 10 trailers at 15 deg; too slow for more than a few cases."""


@cache
def full_span_hover(rotor, collective, rpm):
    """Rotor in hover with a marching full-span wake: means of revolutions 7 to 18."""
    wake = wf.TimeMarchingWake.preset("reference", evaluation="pece")
    return wf.tunnel(
        rotor,
        collective=collective,
        rpm=rpm,
        inflow=wake,
        blade_model="second-order",
        revolutions=18,
        averaged=12,
    )


BASELINE = "baseline: blade elements and annular momentum, Prandtl's tip loss"
"""No wake: what a user would compute first, to see the wakes against; never gated."""


def baseline(rotor, **arguments):
    """Rotor in hover with annular momentum inflow."""
    return wf.tunnel(rotor, inflow="annular", **arguments)
