"""Statements about wakes in transients: a ramp of collective in hover, and what becomes of a hovering wake's period."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RATES = (200.0, 20.0)
"""Rates of the collective [deg/s]."""
AFTER, RAMPED = 24, 10
"""Revolutions followed, and of them the last ones that give the new means."""
TURN_LIMIT = 0.1
"""RMS distance from the mean path over R at which a turn of the wake counts as not periodic."""


class Ramp:
    """Thrust, inflow and wake of a rotor in hover from one collective to another at a rate [deg/s]."""

    def __init__(self, stand, end, rate):
        self.turn = 2 * np.pi / stand.model.omega
        self.n = stand.model.steps_per_revolution
        self.before, self.radius, self.rate = stand, stand.radius, rate
        start = np.degrees(stand.theta_0)
        length = float((end - start) / rate)
        self.data = stand.transient([(f"{length!r} s", f"{float(end)!r} deg")], f"{float(AFTER * self.turn)!r} s")
        self.revolutions = self.data.time.values / self.turn
        self.ct = self.by_revolution("ct")
        self.inflow = self.by_revolution("inflow_mean")

    def by_revolution(self, name):
        """Means of each revolution."""
        return self.data[name].values[1:].reshape(-1, self.n).mean(axis=1)

    @property
    def overshoot(self):
        """Largest thrust over the new mean."""
        return float(self.data.ct.max()) / self.ct[-RAMPED:].mean()

    @property
    def scatter(self):
        """Largest excess of the thrust in the last revolutions over their mean, of it: what hover does by itself."""
        late = self.data.ct.values[-RAMPED * self.n :]
        return float(late.max() / late.mean()) - 1.0

    @property
    def arrival(self):
        """Revolutions until the mean inflow first has 95 per cent of its change; after that it wanders."""
        old, new = self.data.inflow_mean.values[0], self.inflow[-RAMPED:].mean()
        return float(self.revolutions[np.argmax(self.data.inflow_mean.values > old + 0.95 * (new - old))])

    def bundling(self):
        """Height from half a turn to one turn of age one revolution after the start, and the same in the last ones, over R."""
        height = self.data.wake.values[..., 2].mean(axis=1) / self.radius
        apart = height[:, self.n // 2] - height[:, self.n]
        return apart[self.n], apart[-RAMPED * self.n :].mean()


def lost_period(stand):
    """Wake age [turns] at which the marched wake strays from its mean path."""
    spread = stand.data.wake_path_std.values.mean(axis=0) / stand.radius
    ages = stand.data.age.values / (2 * np.pi)
    beyond = np.flatnonzero(spread > TURN_LIMIT)
    return ages[beyond[0]] if beyond.size else ages[-1]


def run(case):
    rotors = {
        "Caradonna-Tung": (case.path("rotors/caradonna-tung.toml"), {"collective": "5 deg"}, 10.0),
        "UH-60A": ("uh60a", {"ct": 0.004}, None),
    }
    checks, drawn = [], {}
    for name, (rotor, condition, end) in rotors.items():
        stand = wf.tunnel(rotor, inflow="time-marching", **condition)
        target = end if end is not None else np.degrees(stand.theta_0) + 5.0
        ramps = [Ramp(stand, target, rate) for rate in RATES]
        # the same thrust and the same change of collective with three states of inflow, for scale
        states = wf.tunnel(rotor, inflow="dynamic", ct=stand.ct)
        change = target - np.degrees(stand.theta_0)
        simple = [Ramp(states, np.degrees(states.theta_0) + change, rate) for rate in RATES]
        fast = ramps[0]
        drawn[name] = ramps, simple
        beyond = (fast.overshoot - 1.0) / fast.scatter
        first, later = fast.bundling()
        checks += [
            Check(f"{name}: thrust overshoots the ramp by more than hover scatters (1: yes)", float(beyond > 1.5), 1.0, 0.5,
                  note=f"{100 * (fast.overshoot - 1):.0f} % at 200 deg/s, scatter {100 * fast.scatter:.0f} %"),
            Check(f"{name}: new vortices bundle (1: yes)", float(first < 0.5 * later), 1.0, 0.5,
                  note=f"from half a turn to a turn {first:.3f} R after one revolution, later {later:.3f} R"),
            Check(f"{name}: revolutions until the inflow has its new value", fast.arrival, 7.5, 2.5),
            Check(f"{name}: turns after which the hovering wake is not periodic", lost_period(stand), 3.0, 1.0),
            *(Check(f"{name}: peak over new thrust at {ramp.rate:g} deg/s, beside dynamic inflow", ramp.overshoot,
                    other.overshoot, gate=False) for ramp, other in zip(ramps, simple)),
        ]  # fmt: skip
    return Outcome(checks, draw(drawn))


@style.styled
def draw(drawn):
    figure = style.blank(2.7 * len(drawn) + 0.4)
    panels = figure.subplots(len(drawn), 3, squeeze=False)
    for row, (name, (ramps, simple)) in zip(panels, drawn.items()):
        left, middle, right = row
        for ramp, color in zip(ramps, style.COLORS):
            label = f"{ramp.rate:g}°/s"
            left.plot(ramp.revolutions, 1e3 * ramp.data.ct, color=color, lw=1.0, label=label)
            middle.plot(ramp.revolutions, ramp.data.inflow_mean, color=color, lw=1.0)
        for other, color in zip(simple, style.COLORS):
            left.plot(other.revolutions, 1e3 * other.data.ct, "--", color=color, lw=0.8)
            middle.plot(other.revolutions, other.data.inflow_mean, "--", color=color, lw=0.8)
        fast = ramps[0]
        for k, color, label in ((0, style.GREY, "before"), (fast.n, style.COLORS[0], "1 revolution"),
                                (3 * fast.n, style.COLORS[1], "3 revolutions")):  # fmt: skip
            wake = fast.data.wake.values[k] / fast.radius
            for i, path in enumerate(wake):
                right.plot(np.hypot(path[:, 0], path[:, 1]), path[:, 2], ".", ms=1.5, color=color,
                           label=label if i == 0 else None)  # fmt: skip
        left.set_title(name)
        left.set_ylabel("thrust coefficient × 1000")
        middle.set_ylabel("mean inflow, down [ΩR]")
        right.set_xlabel("distance from the shaft [R]")
        right.set_ylabel("height [R]")
        right.set_xlim(0, 1.3)
        right.set_ylim(-1.5, 0.2)
        for axes in (left, middle):
            axes.set_xlabel("revolutions")
            axes.set_ylim(0, None)
    panels[0][0].plot([], [], "--", color=style.GREY, lw=0.8, label="dynamic inflow")
    panels[0][0].legend()
    panels[0][2].legend(markerscale=4)
    return figure
