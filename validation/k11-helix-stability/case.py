"""Growth of waves on helices, from the program's induction linearised by differences."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

TURNS, PER_TURN, STEP = 20, 600, 1e-4


class Helices:
    """N helices of unit radius, and the velocity at the marker s = 0 of the first."""

    def __init__(self, n, pitch, mu):
        self.n, self.pitch, self.mu = n, pitch, mu
        self.s = np.arange(-TURNS * PER_TURN, TURNS * PER_TURN + 1) * 2 * np.pi / PER_TURN
        self.angle = self.s[None, :] + 2 * np.pi * np.arange(n)[:, None] / n
        c, s, zero = np.cos(self.angle), np.sin(self.angle), 0 * self.angle
        self.nodes = np.stack([c, s, zero + pitch * self.s], axis=2)
        # unit vectors outward, around, along at every node
        self.frame = np.stack(
            [np.stack([c, s, zero], 2), np.stack([-s, c, zero], 2), np.stack([zero, zero, zero + 1], 2)], axis=2
        )

    def velocity(self, displacement):
        """Velocity outward, around, along, with displacement (n, nodes, 3) in the local axes."""
        nodes = self.nodes + np.einsum("hkc,hkcx->hkx", displacement, self.frame)
        n_segments = self.n * (self.s.size - 1)
        here = nodes[0, self.s.size // 2]
        core = np.full(n_segments, self.mu)
        return wf.induced_velocity([here], list(nodes), np.ones(n_segments), core, core="rosenhead_moore")[0]

    def growth(self, omega, q):
        """Largest real part of the eigenvalues for waves exp(i (omega s + 2 pi j q / N))."""
        phase = omega * self.s[None, :] + 2 * np.pi * q * np.arange(self.n)[:, None] / self.n
        answer = np.empty((3, 3), complex)
        for axis in range(3):
            for wave, factor in ((np.cos(phase), 1.0), (np.sin(phase), 1j)):
                displacement = np.zeros((*phase.shape, 3))
                displacement[:, :, axis] = STEP * wave
                # the response to sin is minus the imaginary part with exp(i s): Re(-i A) = Im(A)
                response = (self.velocity(displacement) - self.velocity(-displacement)) / (2 * STEP)
                if factor == 1.0:
                    answer[:, axis] = response
                else:
                    answer[:, axis] += 1j * response
        # seen from axes that turn with the helix about its axis
        around = self.velocity(np.zeros((*phase.shape, 3)))[1]
        turning = np.array([[0, -around, 0], [around, 0, 0], [0, 0, 0]])
        return np.linalg.eigvals(answer - turning).real.max()


def run(case):
    table = case.table("growth.csv")
    checks, curves = [], []
    for n, pitch, mu, q in sorted(set(zip(*(table[k] for k in ("N", "l", "mu", "q"))))):
        rows = table.where(N=n, l=pitch, mu=mu, q=q)
        helices = Helices(int(n), pitch, mu)
        ours = np.array([helices.growth(omega, q) for omega in rows["omega"]])
        largest = rows["sigma"].max()
        text = f"{int(n)} helices, pitch {pitch:g}" + (
            ", in phase" if n > 1 and q == 0 else ", alternating" if n > 1 else ""
        )
        checks.append(Check.largest(f"growth rate, {text}", ours, rows["sigma"], 0.02 * largest, "Gamma/R^2"))
        peak = rows["omega"][int(np.argmax(ours))]
        checks.append(
            Check(f"waves per turn that grow fastest, {text}", peak, rows["omega"][int(np.argmax(rows["sigma"]))], 0.0)
        )
        curves.append((text, rows, ours))
    return Outcome(checks, draw(curves))


@style.styled
def draw(curves):
    figure = style.blank(3.0)
    axes = figure.subplots()
    for (text, rows, ours), color in zip(curves, style.COLORS):
        spacing = 2 * np.pi * rows["l"] / rows["N"]
        axes.plot(rows["omega"], ours * spacing**2, color=color, label=text)
        axes.plot(rows["omega"], rows["sigma_d2_over_Gamma"], "o", color=color, ms=4)
    axes.axhline(np.pi / 4, color=style.GREY, ls="--")
    axes.text(4.0, np.pi / 4 + 0.01, "row of line vortices, pi/4", fontsize=8, color=style.GREY, ha="right")
    axes.set_xlabel("waves per turn")
    axes.set_ylabel("growth rate x spacing^2 / circulation")
    axes.legend(title="points: exact", loc="lower right")
    return figure
