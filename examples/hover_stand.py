# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor of one's own on a stand: thrust and power of a two-bladed model rotor in hover.

The rotor stands in `data/model-rotor.toml`, forty lines. Blade elements with annular momentum take a moment each; the wake of
tip vortices that relaxes in hover shows what the momentum theory of rings leaves out.
"""

from pathlib import Path

import matplotlib.pyplot as plt

import wakeflight as wf

ROTOR = Path(__file__).parent / "data" / "model-rotor.toml"


def main(
    out: Path = Path("runs/examples"), collectives: tuple[int, ...] = (4, 6, 8, 10), wake_at: int | None = 8
) -> Path:
    """Sweep the collective on annuli, repeat one with a free wake, draw figure of merit over thrust; returns its path."""
    rotor = wf.load_rotor(ROTOR)
    sweep = [wf.tunnel(rotor, collective=f"{angle} deg", inflow="annular") for angle in collectives]
    for angle, stand in zip(collectives, sweep, strict=True):
        print(f"{angle:2d} deg  C_T {stand.ct:.5f}  C_Q {stand.cq:.6f}  figure of merit {stand.figure_of_merit:.3f}")

    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    axes.plot([stand.ct for stand in sweep], [stand.figure_of_merit for stand in sweep], "o-", label="annular momentum")
    if wake_at is not None:
        free = wf.tunnel(rotor, collective=f"{wake_at} deg", inflow="relaxation")
        print(f"free wake at {wake_at} deg: C_T {free.ct:.5f}, figure of merit {free.figure_of_merit:.3f}")
        axes.plot([free.ct], [free.figure_of_merit], "s", label=f"free wake, {wake_at} deg")
    axes.set(xlabel="thrust coefficient [1]", ylabel="figure of merit [1]", ylim=(0.0, 0.8))
    axes.legend(loc="lower right")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "hover_stand.png", dpi=130)
    plt.close(figure)
    return out / "hover_stand.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
