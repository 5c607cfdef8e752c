"""Wake settings of the measured cases: the same for every case of a kind.

The default of a kind is what `wf.tunnel` takes by itself for the name of an inflow model; a variation changes one thing and is
shown beside it, never instead of it.
"""

from wakeflight.tunnel import configured

import wakeflight as wf

HOVER = {"speed": "0 m/s", "shaft_angle": "0 deg", "climb": "0 m/s"}

HOVER_WAKES = {
    "default: one tip vortex of the equivalent strength": {},
    "tip vortex of the largest circulation, inboard sheet": {"tip_strength": "max", "inboard_wake": "sheet"},
    "tip vortex of the mean outboard circulation": {"tip_strength": "mean"},
}


def hover(rotor, wake="default: one tip vortex of the equivalent strength", **arguments):
    """Rotor in hover with a relaxation wake of one of `HOVER_WAKES`."""
    return wf.tunnel(rotor, inflow=configured(rotor, "relaxation", HOVER_WAKES[wake], HOVER), **arguments)
