# SPDX-License-Identifier: MIT OR Apache-2.0
"""A section in pitch, through stall and back: the loop of lift, and how a model remembers.

The table of a section is steady; a blade that pitches through stall at every turn keeps its lift longer and finds it back
later. `wf.airfoil_loop` shows the cycle that repeats, with models of growing memory.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), steps: int = 720) -> Path:
    """Loops of lift of the UH-60A's section with three models, drawn over the angle; returns the figure's path."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for model in ("quasi-steady", "oye", "hgm"):
        loop = wf.airfoil_loop("uh60a", mean="10 deg", amplitude="8 deg", k=0.1, mach=0.3, model=model, steps=steps)
        alpha = np.degrees(loop.alpha.values)
        axes.plot(np.append(alpha, alpha[0]), np.append(loop.cl, loop.cl[0]), label=model)
        print(
            f"{model:<14} largest lift coefficient {float(loop.cl.max()):.3f}, work of the air {float(loop.work):+.4f}"
        )
    axes.set(xlabel="angle of attack [deg]", ylabel="lift coefficient [1]")
    axes.legend(loc="upper left")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "dynamic_stall.png", dpi=130)
    plt.close(figure)
    return out / "dynamic_stall.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
