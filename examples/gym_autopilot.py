# SPDX-License-Identifier: MIT OR Apache-2.0
"""An autopilot in a loop with the environment of Gymnasium: hover held with four gains a stick, against a hand that lets go.

An environment's step takes an action, sticks between their stops, and gives an observation; whatever learns or steers stands in
between. Here it is position and attitude fed back; `wakeflight[gym]` must be installed.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf
from wakeflight.gym import OBSERVED


def autopilot(seen: dict[str, float], trim: dict[str, float]) -> np.ndarray:
    """Sticks, 0 at trim and ±1 at the stops: attitude asked for by the distance from the place, rates damped."""
    ahead, right = -seen["north"], -seen["east"]
    pitch = trim["pitch"] + np.clip(-0.008 * ahead + 0.02 * seen["u"], -0.2, 0.2)
    roll = trim["roll"] + np.clip(0.008 * right - 0.02 * seen["v"], -0.2, 0.2)
    lateral = 1.0 * (roll - seen["roll"]) - 0.4 * seen["p"]
    longitudinal = 1.5 * (pitch - seen["pitch"]) - 1.0 * seen["q"]
    collective = -0.03 * seen["height"] - 0.08 * seen["climb_rate"]
    pedal = 1.0 * (trim["yaw"] - seen["yaw"]) - 1.0 * seen["r"]
    sticks: np.ndarray = np.clip([lateral, longitudinal, collective, pedal], -1.0, 1.0).astype(np.float32)
    return sticks


def main(out: Path = Path("runs/examples"), seconds: float = 20.0) -> Path:
    """Fly from one seed with sticks at trim and with the autopilot, draw where it goes; returns the figure's path."""
    env = wf.gym.HelicopterEnv("hover", aircraft="bo105", seconds=seconds, upset=0.5)
    trim = dict(zip(OBSERVED, env.reset(seed=1, options={"upset": 0.0})[0], strict=True))
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for label, flown in (("sticks at trim", False), ("autopilot", True)):
        observation, info = env.reset(seed=1)
        times, away, reward, over = [0.0], [0.0], 0.0, False
        while not over:
            seen = dict(zip(OBSERVED, observation, strict=True))
            action = autopilot(seen, trim) if flown else np.zeros(4, dtype=np.float32)
            observation, gained, terminated, truncated, info = env.step(action)
            over, reward = terminated or truncated, reward + gained * env.dt
            times.append(info["t"])
            away.append(float(np.linalg.norm(observation[9:12])))
        axes.plot(times, away, label=label)
        print(
            f"{label:<16} {times[-1]:5.1f} s flown, {away[-1]:6.2f} m away at the end, reward {reward / seconds:.2f} of 1"
        )
    axes.set(xlabel="time [s]", ylabel="distance from the place [m]", ylim=(0.0, 30.0))
    axes.legend()
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "gym_autopilot.png", dpi=130)
    plt.close(figure)
    return out / "gym_autopilot.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
