"""Wake settings of the measured cases: the same for every case of a kind.

The default of a kind is what `wf.tunnel` takes by itself for the name of an inflow model; a variation changes one thing and is
shown beside it, never instead of it.
"""

import wakeflight as wf
from wakeflight.tunnel import configured

DEFAULT = "default: one tip vortex of the equivalent strength"

HOVER = {"speed": "0 m/s", "shaft_angle": "0 deg", "climb": "0 m/s"}

HOVER_WAKES = {
    DEFAULT: {},
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
    model = configured(rotor, "relaxation", options, HOVER)
    return wf.tunnel(rotor, inflow=model, blade_model=blade_model, **arguments)


BASELINE = "baseline: blade elements and annular momentum, Prandtl's tip loss"
"""No wake: what a user would compute first, to see the wakes against; never gated."""


def baseline(rotor, **arguments):
    """Rotor in hover with annular momentum inflow."""
    return wf.tunnel(rotor, inflow="annular", **arguments)
