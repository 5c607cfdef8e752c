"""Roll rate by a lateral sweep: the flown wake beside linear models of it."""

import numpy as np

import wakeflight as wf
from wakeflight.linear.response import time_response
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

LOW, HIGH, SECONDS, BEGIN, INCHES = 0.25, 18.0, 40.0, 0.5, 0.15
HOLD = {"pitch": "10 in/rad", "pitch_rate": "6 in/(rad/s)", "roll": "2 in/rad", "yaw_rate": "4 in/(rad/s)"}
GAINS = {("longitudinal", "pitch"): 10.0, ("longitudinal", "q"): 6.0, ("lateral", "roll"): 2.0, ("pedal", "r"): 4.0}
"""The same [in/rad, in s/rad], stick by output."""
FREQUENCIES = np.geomspace(0.3, 15.0, 25)
MODELS = ("states", "quasi-static", "frozen")


def sweep(inches):
    """The manoeuvre."""
    return wf.frequency_sweep(
        "lateral", f"{inches} in", f"{LOW} rad/s", f"{HIGH} rad/s", f"{SECONDS} s", f"{BEGIN} s", "2 s"
    )


def closed(model):
    """Roll rate by the pilot's lateral stick with attitudes held: A, B, C, D."""
    a, b, c, d = model.matrices
    inputs, outputs = ([name for name, _ in named] for named in (model.inputs, model.outputs))
    k = np.zeros((len(inputs), len(outputs)))
    for (stick, y), gain in GAINS.items():
        k[inputs.index(stick), outputs.index(y)] = gain
    inner = np.linalg.inv(np.eye(len(inputs)) + k @ d)
    i, p = inputs.index("lateral"), outputs.index("p")
    return a - b @ inner @ k @ c, b @ inner[:, [i]], (c - d @ inner @ k @ c)[[p]], (d @ inner)[[p]][:, [i]]


def about(time, stick, values):
    """Response at each frequency by the part of the record in which the sweep goes through it."""
    w = FREQUENCIES[:, None]
    passed = BEGIN + np.log(w / LOW) / np.log(HIGH / LOW) * (SECONDS - BEGIN)
    width = np.maximum(1.6 * 2 * np.pi / w, 0.6)
    window = np.exp(-0.5 * ((time - passed) / width) ** 2 - 1j * w * time)
    return (window @ values) / (window @ stick)


def run(case):
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    start = wf.trim(wf.load_aircraft("uh60a"), condition, inflow=wf.TimeMarchingWake.preset("paper"))
    hold = wf.AttitudeHold(**HOLD)
    both = [wf.fly(start, sweep(side * INCHES), integrator="fixed", control=[hold]).data for side in (1.0, -1.0)]
    time = both[0]["time"].values
    fine = np.linspace(0.0, time[-1], 2 * time.size - 1)
    stick = np.interp(fine, *np.array(dict(sweep(INCHES).corners_of)["lateral"]).T)
    flown = about(time, stick[::2], 0.5 * (both[0]["p"].values - both[1]["p"].values))
    checks, found = [], {}
    for wake in MODELS:
        model = wf.linearize(start, wake=wake)
        found[wake] = about(time, stick[::2], time_response(closed(model), fine, stick[:, None])[0][::2, 0])
        ratio = found[wake] / flown
        gain = np.abs(20 * np.log10(np.abs(ratio))).max()
        phase = np.abs(np.degrees(np.angle(ratio))).max()
        gate = wake == "states"
        checks += [
            Check(f"{wake}: largest difference in gain", gain, 0.0, 1.0, "dB", gate=gate),
            Check(f"{wake}: largest difference in phase", phase, 0.0, 5.0, "deg", gate=gate),
        ]
        if gate:
            told = model.attributes
            note = f"{told['wake_order_1e-02']} to 1e-2, {told['wake_order_1e-04']} to 1e-4"
            checks.append(Check("states of the wake to 1e-3", told["wake_order"], 170.0, gate=False, note=note))
        if wake == "frozen":
            fails = float(gain > 1.0 and phase > 5.0)
            checks.append(Check("frozen inflow fails the same test (1: yes)", fails, 1.0, 0.5))
    return Outcome(checks, draw(flown, found))


@style.styled
def draw(flown, found):
    figure = style.blank(3.4)
    gain, phase = figure.subplots(2, 1, sharex=True)
    for name, color in zip(found, style.COLORS):
        ratio = found[name] / flown
        gain.semilogx(FREQUENCIES, 20 * np.log10(np.abs(ratio)), color=color, label=name)
        phase.semilogx(FREQUENCIES, np.degrees(np.angle(ratio)), color=color)
    for axes, limit in ((gain, 1.0), (phase, 5.0)):
        axes.axhspan(-limit, limit, color=style.GREY, alpha=0.2, lw=0)
    gain.set_ylabel("gain over flown [dB]")
    phase.set_ylabel("phase beyond flown [deg]")
    phase.set_xlabel("frequency [rad/s]")
    gain.legend()
    return figure
