"""Field of long helices of straight segments against the infinite ones."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

TURNS, STEP = 40, np.radians(5.0)


def helices(n, pitch, step=STEP):
    s = np.arange(-round(TURNS * 2 * np.pi / step), round(TURNS * 2 * np.pi / step) + 1) * step
    return [
        np.column_stack([np.cos(s + 2 * np.pi * k / n), np.sin(s + 2 * np.pi * k / n), pitch * s]) for k in range(n)
    ]


def field(n, pitch, r, angle, step=STEP):
    """Radial, azimuthal and axial velocity at r (cos, sin)(angle)."""
    filaments = helices(n, pitch, step)
    n_segments = sum(len(f) - 1 for f in filaments)
    points = np.column_stack([r * np.cos(angle), r * np.sin(angle), 0 * r])
    v = wf.induced_velocity(points, filaments, np.ones(n_segments), np.zeros(n_segments), core="singular")
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([v[:, 0] * c + v[:, 1] * s, v[:, 1] * c - v[:, 0] * s, v[:, 2]])


def run(case):
    table = case.table("helix.csv")
    checks, errors = [], []
    for n, pitch in sorted(set(zip(table["N"].astype(int), table["l"]))):
        rows = table.where(N=n, l=pitch)
        exact = np.column_stack([rows["ur"], rows["uphi"], rows["uz"]])
        angle = rows["chi_over_pi_by_N"] * np.pi / n
        ours = field(n, pitch, rows["r"], angle)
        scale = np.abs(exact).max()
        error = np.linalg.norm(ours - exact, axis=1) / scale
        errors.append((n, pitch, rows["r"], error))
        checks.append(
            Check(f"largest error, {n} helices, pitch {pitch:g}", error.max(), 0.0, 0.005, "of the largest velocity")
        )
    # halving the segments: what is left of the chord error, the truncation being the same
    r, angle = np.array([0.9]), np.array([0.0])
    coarse, middle, fine = (field(1, 0.1, r, angle, np.radians(d)) for d in (10.0, 5.0, 2.5))
    order = np.log2(np.linalg.norm(coarse - middle) / np.linalg.norm(middle - fine))
    checks.append(Check("order in the segment length, 0.1 R from a filament", order, 2.0, 0.1))
    return Outcome(checks, draw(errors))


@style.styled
def draw(errors):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for (n, pitch, r, error), color in zip(errors, style.COLORS):
        axes.semilogy(r, error, "o", color=color, label=f"{n} helices, pitch {pitch:g}")
    axes.axhline(0.005, color=style.GREY, ls="--")
    axes.set_xlabel("radius [R]")
    axes.set_ylabel("error over the largest velocity")
    axes.legend(title="5-degree segments, 40 turns each way", ncols=2)
    return figure
