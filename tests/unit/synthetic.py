"""A run that was never flown, but looks like one: closed forms in place of physics, by the schema."""

import numpy as np

RADIUS = 8.1778
OMEGA = 27.0
N_BLADES = 4
STEPS = 36
TURN = 2 * np.pi


def pulse(time, start=0.47, rise=0.5):
    """Triangle of height one: up over `rise`, down over `rise`."""
    return np.clip(1 - np.abs(time - start - rise) / rise, 0, None)


def stations(n=20, cutout=0.13):
    edges = cutout + (1 - cutout) * np.sin(0.5 * np.pi * np.arange(n + 1) / n)
    return (edges[1:] + edges[:-1]) / 2


def inflow_field(psi, station, mean=0.012, front=1.1, side=-0.1):
    """Mean and first harmonics, with a bump on the advancing tip as a passing vortex leaves it."""
    bump = 0.012 * np.exp(-(((station - 0.9) / 0.08) ** 2) - (np.angle(np.exp(1j * (psi - 1.2))) / 0.35) ** 2)
    return mean * (1 + station * (front * np.cos(psi) + side * np.sin(psi))) + bump


def wake_geometry(revolution, turns=4, step=TURN / 36, mu=0.185, sink=0.03):
    """Skewed helices of all blades in hub axes [m] (blade, age, xyz), rolled up a little at the sides."""
    age = np.arange(0, turns * TURN + step / 2, step)
    nodes = []
    for blade in range(N_BLADES):
        psi = TURN * (revolution + blade / N_BLADES) - age
        y = np.sin(psi)
        x = np.cos(psi) + mu * age
        z = 0.02 * np.cos(psi) - sink * age * (1 - 0.6 * np.abs(y) ** 3) + 0.01 * np.sin(3 * psi)
        nodes.append(RADIUS * np.stack([x, y, z], axis=1))
    return age, np.stack(nodes)


def run_arrays(revolutions=12, wake=True, strength=1.0):
    """Arrays of an arrested descent by the names of the run's schema; `strength` scales the response."""
    time = np.arange(revolutions * STEPS + 1) * TURN / (STEPS * OMEGA)
    azimuth = OMEGA * time[:, None] + TURN * np.arange(N_BLADES) / N_BLADES
    push = pulse(time)
    late = strength * pulse(time, 0.6, 0.8)
    steady = np.ones_like(time)
    station = stations()
    psi = azimuth[:, :, None]
    mean = 0.012 * (1 + 0.8 * late)[:, None, None]
    inflow = inflow_field(psi, station, mean)
    mach = OMEGA * RADIUS / 331.0 * np.abs(station + 0.185 * np.sin(psi))
    cl = 0.45 * (1 - 0.6 * np.sin(psi)) * (1 + 0.5 * late)[:, None, None] * np.sqrt(1.01 - station**2)
    pitch = 0.02 + 0.12 * late
    north = 41.0 * time
    w = 4.0 - 6.0 * late
    weight = 71171.0
    force_z = -weight * (1 + 0.6 * push + 0.01 * np.cos(4 * azimuth[:, 0]))
    n_modes = 5
    modal = np.stack([(0.05 / (k + 1)) * np.cos((k % 2) * azimuth + k) for k in range(n_modes)], axis=-1)
    # fmt: off
    arrays = {
        "time": time,
        "station": station,
        "u": 41.0 - 2 * late, "v": 0.2 * late, "w": w,
        "p": 0.02 * late, "q": 0.25 * np.gradient(late, time), "r": -0.01 * late,
        "roll": 0.02 * late, "pitch": pitch, "yaw": 0.005 * late,
        "north": north, "east": 0.3 * time * late, "down": 4.3 * time - 6 * late,
        "collective": 4.6 + 3.7 * push, "longitudinal": 5.2 * steady,
        "lateral": 5.0 * steady, "pedal": 2.6 * steady,
        "force_x": -2000 + 4000 * late, "force_y": 500 * steady, "force_z": force_z,
        "moment_x": 300 * late, "moment_y": 9000 * push, "moment_z": -2000 * push,
        "beta_1c": np.deg2rad(1.2 - 2.5 * late), "beta_1s": np.deg2rad(-0.5 + 1.0 * push),
        "hub_force": np.stack([2000 * steady, 500 * steady, -force_z], axis=1),
        "hub_moment": np.stack([500 * steady, 9000 * push, -38000 * (1 + push)], axis=1),
        "modal": modal,
        "azimuth": azimuth % TURN,
        "inflow": inflow,
        "circulation": 0.5 * OMEGA * RADIUS * (station + 0.185 * np.sin(psi)) * 0.53 * cl,
        "cl": cl,
        "cl_m2": cl * mach**2,
        "alpha": cl / 6.0,
        "mach": mach,
        "power": 9.0e5 * (1 + 0.8 * push),
        "ct": 0.0066 * (1 + 0.6 * push),
    }
    # fmt: on
    if wake:
        marks = np.array([n for n in (0, 5, 8, 10) if n <= revolutions], dtype=float)
        shapes = [wake_geometry(n, sink=0.03 + 0.01 * k) for k, n in enumerate(marks)]
        grid = TURN * np.arange(STEPS) / STEPS
        disk = inflow_field(grid[:, None], station)
        arrays |= {
            "age": shapes[0][0],
            "wake": np.stack([nodes for _, nodes in shapes]),
            "wake_circulation": np.broadcast_to(25.0, (len(marks), N_BLADES, shapes[0][0].size)).copy(),
            "wake_core": np.broadcast_to(0.02 * RADIUS, (len(marks), N_BLADES, shapes[0][0].size)).copy(),
            "snapshot_revolution": marks,
            "psi": grid,
            "inflow_trim": disk,
            "inflow_start": disk + 0.003 * np.sin(2 * grid[:, None]) * station**4,
            "odd_even": 1e-4 * steady,
            "max_displacement": 0.8 * steady,
        }
    return arrays


def attributes(model="time-marching", **more):
    """Attributes of such a run."""
    return {
        "aircraft": "uh60a",
        "inflow_model": model,
        "maneuver": "arrested-descent",
        "condition": "80 kt, flight path -6 deg, 5250 ft, 16000 lbf",
        "radius": RADIUS,
        "omega": OMEGA,
        "configuration": {
            "condition": {"speed": 41.16, "flight_path": -0.1047},
            "wake": {"turns": 4, "scheme": "bdf2", "azimuth_step": 0.1745, "far_wake": None},
            "tables": {"alpha": [0.0, 1.0]},
        },
        "ct": 0.0066, "ct_sigma": 0.08, "mu": 0.185, "power": 9.0e5,
        "seconds_trim": 8.1, "seconds_convergence": 1.2, "seconds_wake": 3.4, "seconds_dynamics": 9.9,
        "seconds_total": 23.0,
        "residual_evaluations": 21000, "jacobians": 900, "segment_evaluations": 240000000,
        "warnings": ["collective: 11.0 in/s against 10 in/s"],
        **more,
    }  # fmt: skip


def run(model="time-marching", revolutions=12, strength=1.0, **more):
    """The dataset."""
    from wakeflight.results import assemble

    wake = model != "dynamic"
    return assemble(run_arrays(revolutions, wake, strength), attributes(model, **more))


def trim_arrays():
    """Arrays of a trim by the names of its schema."""
    psi = TURN * np.arange(STEPS) / STEPS
    station = stations()
    return {
        "azimuth": psi, "station": station,
        "collective": 4.6, "longitudinal": 5.2, "lateral": 5.0, "pedal": 2.6,
        "pitch": 0.05, "roll": -0.02, "theta_0": 0.24, "theta_1c": 0.02, "theta_1s": -0.08,
        "ct": 0.0066, "ct_sigma": 0.08, "mu": 0.185, "power": 9.0e5,
        "inflow": inflow_field(psi[:, None], station),
        "modal": 0.05 * np.cos(psi)[:, None] * np.ones(5),
        "residual_linear": np.full(3, 1e-6), "residual_angular": np.full(3, 1e-6), "residual_blade": 1e-8,
    }  # fmt: skip
