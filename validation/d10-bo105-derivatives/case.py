"""BO-105 derivatives about level flight, blades and inflow quasi-static, beside HELISIM's; what the fuselage's moments do."""

import tempfile
from pathlib import Path

import numpy as np
from derivatives import STATES, gross_inertia, linear_model, periodic_roots, sorted_roots
from fuselage import general_pitch, general_yaw, printed_pitch, printed_yaw, slender_body, sloped, with_moments

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SPEEDS = (0, 40, 80, 120)
ROWS = {"X": "udot", "Z": "wdot", "M": "qdot", "Y": "vdot", "L": "pdot", "N": "rdot"}
TOLERANCES = {
    0.15: ("Z_w", "M_q", "L_p", "M_theta_1s", "L_theta_1c"),
    0.30: ("Y_v", "N_v", "N_r", "N_theta_tr"),
    0.40: ("X_u", "M_u"),
}
SHOWN = ("M_w", "L_v", "L_q", "M_p", "M_theta_1c", "L_theta_1s")
SLOW = 3.0  # 1/s
COLUMNS = {"theta_0": "d_theta0", "theta_1s": "d_theta1s", "theta_1c": "d_theta1c", "theta_tr": "d_theta0T"}
# area and length coefficients of the Puma's fuselage in the same appendix, on this one's
PUMA_PITCH, PUMA_YAW = 2.85, -7.04  # m3/rad
VARIANTS = {
    "as shipped": (general_pitch, general_yaw),
    "polynomials": (printed_pitch, printed_yaw),
    "a third of them": (lambda a: printed_pitch(a) / 3, lambda b: printed_yaw(b) / 3),
    "none": (sloped(0.0), sloped(0.0)),
    "slender-body theory": (sloped(slender_body()), sloped(-slender_body())),
    "the Puma's coefficients": (sloped(PUMA_PITCH), sloped(PUMA_YAW)),
}


def published(table, speed):
    """State matrix (8, 8), control matrix (8, 4) and a function that reads one derivative."""
    part = table.where(V_kt=speed)
    rows = {name: i for i, name in enumerate(part["row"])}
    names = [f"{s}dot" for s in STATES]
    a = np.array([[part[c][rows[r]] for c in STATES] for r in names], float)

    def read(name):
        row, column = name.split("_", 1)
        return float(part[COLUMNS.get(column, column)][rows[ROWS[row]]])

    return a, read


def level(aircraft, speed):
    return wf.trim(
        aircraft, wf.FlightCondition(speed=f"{speed} kt", flight_path="0 deg", altitude="0 m"), inflow="dynamic"
    )


def run(case):
    table = case.table("bo105_helisim.csv")
    aircraft = wf.load_aircraft("bo105")
    checks, notes, roots = [], [], {}
    for speed in SPEEDS:
        a, read = published(table, speed)
        start = level(aircraft, speed)
        # HELISIM's rotor has no inertia about its shaft
        model = linear_model(start, inertia=gross_inertia(start))
        held = linear_model(start, inertia=gross_inertia(start), hold_harmonics=True)
        for tolerance, names in TOLERANCES.items():
            for name in names:
                checks.append(Check(f"{name}, {speed} kt", model[name], read(name), tolerance, kind="relative"))
        for name in SHOWN:
            checks.append(Check(f"{name}, {speed} kt", model[name], read(name), gate=False))
        for name in ("M_q", "L_p", "L_q", "M_p", "M_w"):
            text = "the inflow's harmonics as trimmed"
            checks.append(
                Check(f"{name}, mean inflow alone, {speed} kt", held[name], read(name), gate=False, note=text)
            )
        small = wf.linearize(start, order=8)
        for name, row, column in (
            ("M_q", "q", "q"),
            ("L_p", "p", "p"),
            ("L_q", "p", "q"),
            ("M_p", "q", "p"),
            ("M_w", "q", "w"),
        ):
            mine = float(small.A.sel(state=row, state_=column))
            checks.append(Check(f"{name}, wf.linearize, {speed} kt", mine, read(name), gate=False, note="eight states"))
        checks += same_slow_roots(linear_model(start).eigenvalues, small.eigenvalues, speed)
        pitch = np.arctan2(-a[1, 3], -a[0, 3])
        checks.append(Check(f"pitch attitude, {speed} kt", np.degrees(start.pitch), np.degrees(pitch), 1.0, "deg"))
        roots[speed] = linear_model(start).eigenvalues, sorted_roots(np.linalg.eigvals(a))
    finer = linear_model(start, step=0.25)
    change = np.max(np.abs(finer.eigenvalues - roots[SPEEDS[-1]][0]))
    notes.append(f"Differences a quarter as large move no root at {speed} kt by more than {change:.1e} 1/s.")
    notes.append(
        f"The whole aircraft over a revolution, {speed} kt, slowest roots: {listed(slow(periodic_roots(start)))}."
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, moments in VARIANTS.items():
            notes += variant(name, with_moments(Path(folder), name.replace(" ", "-"), *moments))
    return Outcome(checks, draw(roots), notes)


def same_slow_roots(balances, verb, speed):
    """Two ways to one aircraft: averaged balances differenced, and the verb's exact derivatives reduced to eight states."""
    slow_ones = [r for r in balances if abs(r) < SLOW and r.imag >= 0.0]
    for i, root in enumerate(sorted(slow_ones, key=lambda r: (r.real, r.imag))):
        mine = verb[np.argmin(np.abs(verb - root))]
        name = f"slow root {i + 1}, wf.linearize, {speed} kt"
        yield Check(f"{name}, real", mine.real, root.real, 0.02, "1/s", note="averaged balances")
        if root.imag > 1e-9:
            yield Check(f"{name}, imaginary", mine.imag, root.imag, 0.02, "1/s", note="averaged balances")


def variant(name, aircraft):
    """Lines that say what a fuselage's moments do: derivatives with HELISIM's inertia, roots with the aircraft's own."""
    for speed in SPEEDS[1:]:
        start = level(aircraft, speed)
        model = linear_model(start)
        plain = linear_model(start, inertia=gross_inertia(start))
        held = linear_model(start, hold_harmonics=True)
        yield (
            f"Moments {name}, {speed} kt: N_v {plain['N_v']:.3f}, M_w {plain['M_w']:.3f} "
            f"({held['M_w']:.3f} with the inflow's harmonics held), "
            f"longitudinal cyclic {np.degrees(start.theta_1s):.2f} deg, pitch {np.degrees(start.pitch):.2f} deg; "
            f"roots {listed(model.eigenvalues[2:])}."
        )


def slow(exponents):
    """Roots of the body: slower than 5 rad/s and not the zeros of position, heading and quaternion."""
    return exponents[(np.abs(exponents) < 5.0) & (np.abs(exponents) > 1e-3)]


def listed(roots):
    kept = sorted((r for r in roots if r.imag > -1e-9), key=lambda r: -r.real)
    return ", ".join(f"{r.real:+.3f}" + (f" ± {r.imag:.3f}i" if r.imag > 1e-9 else "") for r in kept)


@style.styled
def draw(roots):
    figure = style.blank(3.4)
    axes = figure.subplots(1, 1)
    for (speed, (ours, theirs)), color in zip(roots.items(), style.COLORS, strict=False):
        axes.plot(ours.real, ours.imag, "x", color=color, label=f"{speed} kt")
        axes.plot(theirs.real, theirs.imag, "o", mfc="none", color=color)
    axes.set(xlim=(-1.0, 0.6), ylim=(-0.2, 4.2), xlabel="real part [1/s]", ylabel="imaginary part [1/s]")
    axes.axvline(0.0, color="grey", lw=0.5)
    axes.set_title("crosses: program, circles: HELISIM")
    figure.legend(loc="outside lower center", ncols=4)
    return figure
