"""Velocity of a helix at one of its own nodes, extrapolated to fine segments and many turns."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def self_velocity(n, pitch, mu, turns, per_turn):
    """Azimuthal and axial velocity at the node s = 0 of the first helix."""
    s = np.arange(-turns * per_turn, turns * per_turn + 1) * 2 * np.pi / per_turn
    helices = [
        np.column_stack([np.cos(s + 2 * np.pi * k / n), np.sin(s + 2 * np.pi * k / n), pitch * s]) for k in range(n)
    ]
    n_segments = n * (s.size - 1)
    core = np.full(n_segments, mu)
    v = wf.induced_velocity([(1.0, 0, 0)], helices, np.ones(n_segments), core, core="rosenhead_moore")[0]
    return v[1:]


def limit(n, pitch, mu):
    def fine(turns):
        # second order in the segments
        a, b = self_velocity(n, pitch, mu, turns, 360), self_velocity(n, pitch, mu, turns, 720)
        return (4 * b - a) / 3

    # the far turns act like a vortex tube's two ends: their share falls with the square of the number of turns
    a, b = fine(30), fine(60)
    return (4 * b - a) / 3


def run(case):
    table = case.table("motion.csv")
    checks, rows = [], []
    for n, pitch, mu, around, along in zip(*(table[k] for k in ("N", "l", "mu", "uphi", "uz"))):
        ours = limit(int(n), pitch, mu)
        text = f"{int(n)} helices, pitch {pitch:g}, core {mu:g}"
        checks += [
            Check(f"azimuthal velocity, {text}", ours[0], around, 1e-5, "Gamma/R"),
            Check(f"axial velocity, {text}", ours[1], along, 1e-5, "Gamma/R"),
        ]
        rows.append((int(n), pitch, mu, along))
    return Outcome(checks, draw(rows))


@style.styled
def draw(rows):
    figure = style.blank(2.8)
    axes = figure.subplots()
    per_turn = np.array([18, 36, 72, 144, 288])
    for (n, pitch, mu, along), color in zip(rows, style.COLORS):
        error = [abs(self_velocity(n, pitch, mu, 30, int(k))[1] / along - 1) for k in per_turn]
        axes.loglog(per_turn, error, "o-", color=color, label=f"{n} helices, pitch {pitch:g}, core {mu:g}")
    axes.set_xlabel("segments of a turn (36: the default wake)")
    axes.set_ylabel("relative error of the axial velocity, 30 turns")
    axes.legend()
    return figure
