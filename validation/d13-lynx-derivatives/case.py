"""Eigenvalues and modes of the published matrices of a Lynx."""

import numpy as np
from derivatives import STATES

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

NAMES = {"theta": "pitch", "phi": "roll"}
LISTED = {
    0: (-10.8741, -2.2192, -0.3110, -0.2449, -0.1705 + 0.6027j, 0.2394 + 0.5335j),
    40: (-10.7402, -2.6711, -0.3896, -0.3321 + 1.2241j, -0.0053, 0.0878 + 0.4135j),
    80: (-10.5556, -3.1938, -0.5151 + 1.9610j, -0.4066, -0.0333, 0.1371 + 0.3785j),
    120: (-10.4281, -3.8267, -0.6236 + 2.5707j, -0.3782, -0.0397, 0.2391 + 0.3577j),
}
"""As listed with the matrices [1/s], of conjugates the upper one."""


def run(case):
    table = case.table("lynx_helisim.csv")
    checks, notes, drawn = [], [], {}
    for speed, listed in LISTED.items():
        part = table.where(V_kt=speed)
        rows = {name: i for i, name in enumerate(part["row"])}
        a = np.array([[float(part[c][rows[f"{s}dot"]]) for c in STATES] for s in STATES])
        model = wf.LinearModel.of(a, states=[NAMES.get(name, name) for name in STATES])
        modes = model.modes()
        roots = modes["eigenvalue"].values
        for value in listed:
            i = int(np.argmin(np.abs(roots - value)))
            name = f"{speed} kt, {modes['name'].values[i]}"
            checks.append(Check(f"{name}, real", roots[i].real, np.real(value), 1e-4, "1/s"))
            if np.imag(value):
                checks.append(Check(f"{name}, imaginary", roots[i].imag, np.imag(value), 1e-4, "1/s"))
        notes.append(f"Modes at {speed} kt: {', '.join(modes['name'].values)}.")
        drawn[speed] = roots
    return Outcome(checks, draw(drawn), notes)


@style.styled
def draw(drawn):
    figure = style.blank(3.2)
    axes = figure.subplots(1, 1)
    for (speed, roots), color in zip(drawn.items(), style.COLORS, strict=False):
        axes.plot(roots.real, roots.imag, "x", color=color, label=f"{speed} kt")
    axes.axvline(0.0, color=style.GREY, lw=0.5)
    axes.set(xlim=(-4.5, 0.6), xlabel="real part [1/s]", ylabel="imaginary part [1/s]")
    figure.legend(loc="outside lower center", ncols=4)
    return figure
