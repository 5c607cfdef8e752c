"""Lift of a plate in harmonic motion by `wf.airfoil_loop` against Theodorsen's function."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

MACH = 0.1
"""Mach number at which the compressible constants meet incompressible theory."""


def harmonic(loop, name):
    """First harmonic of a variable over the amplitude of the angle, complex: X of Im(X exp(i phase))."""
    phase = loop.phase.values
    return 2.0 * np.mean(loop[name].values * (np.sin(phase) + 1j * np.cos(phase))) / np.radians(1.0)


def loop(case, k, mach, model, motion):
    return wf.airfoil_loop(
        case.path("plate.toml"), mean="0 deg", amplitude="1 deg", k=k, mach=mach, model=model, motion=motion
    )


def pitching(k, lift):
    """Lift of a plate turning about its quarter chord over 2 pi alpha, from the lift deficiency [theodorsen1935]."""
    return lift * (1 + 1j * k) + 0.5j * k - 0.25 * k**2


def run(case):
    table = case.table("functions.csv")
    rows = table.where(function="theodorsen_C")
    checks, shed, whole = [], [], []
    for k, re, im in zip(rows["k_or_s"], rows["re"], rows["im"]):
        exact = complex(re, im)
        ours = harmonic(loop(case, k, 0.001, "hgm", "plunge"), "alpha_effective")
        shed.append((k, ours, exact))
        for part, mine, theirs in (("real", ours.real, re), ("imaginary", ours.imag, im)):
            name = f"lift of the shed wake, {part} part, k = {k:g}"
            checks.append(Check(name, mine, theirs, 0.015, "of steady lift"))
        cn = harmonic(loop(case, k, MACH, "attached", "pitch"), "cn") * np.sqrt(1 - MACH**2) / (2 * np.pi)
        full = pitching(k, exact)
        whole.append((k, cn, full))
        # the constants are fitted to compressible flow: shown, with a verdict where rotors need it
        name = f"pitching plate, all terms at Mach {MACH:g}, k = {k:g}: error over the exact lift"
        checks.append(Check(name, abs(cn - full) / abs(full), 0.0, 0.06, gate=bool(k <= 0.2)))
    notes = [
        "Wagner's function, of which Theodorsen's is the transform, is kept within 1.5 per cent in the core's own tests; Sears's "
        "gust function needs a gust that travels along the chord, which a section of a blade does not see."
    ]
    return Outcome(checks, draw(shed, whole), notes)


@style.styled
def draw(shed, whole):
    figure = style.blank(2.9)
    left, right = figure.subplots(1, 2)
    for axes, points, title in ((left, shed, "shed wake, C(k)"), (right, whole, "pitch about the quarter chord")):
        exact = np.array([each[2] for each in points])
        ours = np.array([each[1] for each in points])
        axes.plot(exact.real, exact.imag, "ko", ms=4, label="exact")
        axes.plot(ours.real, ours.imag, "o-", color=style.COLORS[0], ms=3, label="wakeflight")
        axes.set_xlabel("real part")
        axes.set_title(title)
    left.set_ylabel("imaginary part")
    left.legend()
    return figure
