"""What an engineer waits for at the desk: a linear model, a reset of the learning environment, the sticks of a fine record."""

import numpy as np
from flight import start
from measure import seconds, table

import wakeflight as wf


def desk(quick: bool) -> str:
    """Median and best of each."""
    repetitions = 5 if quick else 21
    trimmed = start("dynamic")
    env = wf.gym.HelicopterEnv("cruise", seconds=1.0)
    times = np.arange(0.0, 10.0, 1e-4)
    corners = tuple((float(t), float(x)) for t, x in zip(times, 0.01 * np.sin(40.0 * times), strict=True))
    recorded = wf.Maneuver("recorded", (("lateral", corners),), seconds=10.0)
    recorded.stick(0.0, (5.0,) * 4)
    tasks = {
        "linear model, dynamic inflow, 36 azimuths": lambda: wf.linearize(trimmed, azimuths=36),
        "reset of the environment": env.reset,
        "sticks and their rates at one time of 10^5 samples": lambda: (
            recorded.stick(5.0, (5.0,) * 4),
            recorded.rate(5.0),
        ),
    }
    rows = [[name, *(f"{1e3 * value:.3g}" for value in seconds(task, repetitions))] for name, task in tasks.items()]
    return table(["what", "median [ms]", "best [ms]"], rows)
