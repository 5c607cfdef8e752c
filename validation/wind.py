"""Wake settings of the measured cases in a wind: the same for every case.

The default is what `wf.tunnel` takes by itself for the name of an inflow model; a variation changes one thing and is shown beside
it, never instead of it.
"""

import wakeflight as wf

DEFAULT = "default: three trailers and shed vorticity"
SHEET = "tip vortex of the largest circulation, inboard sheet"
MAXIMUM = "tip vortex of the largest circulation alone"

MARCHED = "default wake, marched in time"

IN_TIME = {
    "one tip vortex": {"trailers": "tip"},
    "one tip vortex, sections attached in time": {"trailers": "tip", "unsteady": "attached"},
    "one tip vortex, sections hgm": {"trailers": "tip", "unsteady": "hgm"},
}
"""Sections in time, and the same wake without; never in a score."""

WAKES = {
    DEFAULT: {},
    SHEET: {"tip_strength": "max", "inboard_wake": "sheet"},
    MAXIMUM: {"tip_strength": "max"},
}


def wind(rotor, wake=DEFAULT, *, speed, shaft_angle, options=None, **arguments):
    """Rotor in a wind from the front with a relaxation wake of one of `WAKES`, the wake `MARCHED`, or dynamic inflow (None)."""
    if wake is None:
        inflow = "dynamic"
    else:
        kind = wf.TimeMarchingWake if wake == MARCHED else wf.RelaxationWake
        inflow = kind(**(WAKES | IN_TIME).get(wake, {}), **(options or {}))
    return wf.tunnel(rotor, inflow=inflow, speed=speed, shaft_angle=shaft_angle, **arguments)
