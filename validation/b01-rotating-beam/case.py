"""Frequencies of rotating uniform beams."""

import beams
import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

TOLERANCE = (1e-3, 5e-3, 2e-2)
ELEMENTS = np.array([4, 6, 8, 12, 16, 24])


def flap(rotor, eta, n_elements, n):
    """First flap frequencies of the beam of a rotor file at rotor speed `eta`."""
    # stiff in the plane: but for a lag hinge the first modes are flap
    found = wf.blade_modes(rotor, n_modes=n + 1, n_elements=n_elements, rotor_speed=eta, reference_pitch=0.0)
    return found.natural_frequencies[found.shares[:, beams.FLAP] > 0.5][:n]


def run(case):
    table = case.table("rotating_beam.csv")
    rotors = {root: wf.load_rotor(case.path(f"{root}.toml")) for root in ("clamped", "hinged")}
    checks, ours = [], {}
    for root in ("clamped", "hinged"):
        rows = table.where(root=root)
        found = np.array([flap(rotors[root], eta, 4, 3) for eta in rows["eta"]])
        ours[root] = found
        for i, tolerance in enumerate(TOLERANCE):
            reference = rows[f"mu{i + 1}"]
            at_rest = reference == 0.0  # the rigid mode of a hinged beam that does not turn
            quantity = f"{root}, flap {i + 1}"
            checks.append(Check.largest(quantity, found[~at_rest, i], reference[~at_rest], tolerance, "-", "relative"))
            if at_rest.any():
                checks.append(Check.largest(f"{quantity} at rest", found[at_rest, i], reference[at_rest], 1e-6))
    for eta in (1.0, 6.0, 12.0):
        lag = beams.mostly(beams.modes(beams.uniform(ei_flap=1e4, ei_lag=1.0), eta, 2), beams.LAG)[0]
        exact = np.sqrt(flap(rotors["clamped"], eta, 4, 1)[0] ** 2 - eta**2)
        checks.append(Check(f"lag 1 from flap 1 at eta = {eta:g}", lag, exact, 1e-9, kind="relative"))
    row = table.where(root="clamped", eta=6.0)
    exact = np.array([row[f"mu{i + 1}"][0] for i in range(4)])
    error = np.array([flap(rotors["clamped"], 6.0, n, 4) / exact - 1.0 for n in ELEMENTS])
    for i in range(4):
        order = np.log2(error[1, i] / error[3, i])
        checks.append(Check(f"order of convergence, clamped flap {i + 1}", order, 4.0, 0.35))
    return Outcome(checks, draw(table, ours, error))


@style.styled
def draw(table, ours, error):
    figure = style.blank(3.2)
    left, right = figure.subplots(1, 2)
    for root, color in zip(("clamped", "hinged"), style.COLORS):
        rows = table.where(root=root)
        for i in range(3):
            left.plot(rows["eta"], rows[f"mu{i + 1}"], "-", color=color, label=f"{root}, exact" if i == 0 else None)
            left.plot(rows["eta"], ours[root][:, i], "o", ms=3, color=color, label="4 elements" if i == 0 else None)
    left.set_xlabel(r"rotor speed $\Omega\sqrt{mL^4/EI}$")
    left.set_ylabel(r"flap frequency $\omega\sqrt{mL^4/EI}$")
    left.legend()
    for i in range(4):
        right.loglog(ELEMENTS, np.abs(error[:, i]), "-", marker=".", color=style.COLORS[i], label=f"flap {i + 1}")
    right.loglog(ELEMENTS, error[0, 3] * (ELEMENTS / 4.0) ** -4.0, "--", color=style.GREY, label="fourth order")
    right.set_xlabel("elements")
    right.set_ylabel("relative error, clamped, speed 6")
    right.set_xticks(ELEMENTS, [str(n) for n in ELEMENTS])
    right.minorticks_off()
    right.legend()
    return figure
