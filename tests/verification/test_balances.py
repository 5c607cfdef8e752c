# SPDX-License-Identifier: MIT OR Apache-2.0
"""Hub loads and power a second way: from momentum and energy of the blades, counted by particles."""

import numpy as np
import pytest
from blade_particles import Blades

import wakeflight as wf
from wakeflight.inflow import DynamicInflow
from wakeflight.recorder import Recorder


def blades_of(model):
    free_wake = not isinstance(model.inflow, DynamicInflow)
    return Blades(model, 1.0 if free_wake else model.data["rotor"]["tip_loss_factor"])


def inflow_of(model, y, outputs):
    """Arguments of the balance: inflow held at the stations, or that of the states."""
    if isinstance(model.inflow, DynamicInflow):
        first = model.layout["inflow"][0]
        return None, y[first : first + 3]
    return outputs["inflow"], None


def trimmed_revolution(start):
    """Outputs and balances at every azimuth of a trim; the angle between two blades holds them all."""
    model, n = start.model, start.model.steps_per_revolution
    blades = blades_of(model)
    for k in range(n // model.n_blades):
        t = 2 * np.pi * k / n / model.omega
        y, y_dot = model.core.trim_state(start.problem, start.x, t)
        outputs = model.core.outputs(t, y, y_dot, start.inputs(t))
        yield (
            outputs,
            blades.balance(t, y, y_dot, start.stick_si, np.zeros(4), *inflow_of(model, y, outputs)),
        )


@pytest.mark.parametrize("name", ["baseline_dynamic", "baseline_relaxation"])
def test_shaft_torque_times_speed_is_the_energy_a_trimmed_revolution_takes(name, request):
    # torque never enters the equations of the blades: agreement says that air, damper, structure, controls and
    # the climb of airframe and blades together take what the shaft gives
    start = request.getfixturevalue(name)
    pairs = list(trimmed_revolution(start))
    torque = np.mean([outputs["power"][0] for outputs, _ in pairs])
    energy = np.mean([balance.shaft(np.zeros(3)) for _, balance in pairs])
    assert energy == pytest.approx(torque, rel=1e-6)
    # nothing is stored over a revolution, dampers and structure take, the air takes more than the shaft gives
    stored = np.mean([balance.kinetic + balance.strain for _, balance in pairs])
    assert abs(stored) < 1e-6 * torque
    assert min(np.mean([balance.damper for _, balance in pairs]), np.mean([b.structure for _, b in pairs])) > 0
    assert np.mean([balance.air for _, balance in pairs]) < -torque


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_in_a_manoeuvre_hub_loads_and_power_follow_from_momentum_and_energy_of_the_blades(inflow, request, monkeypatch):
    start = request.getfixturevalue("baseline_dynamic" if inflow == "dynamic" else "baseline_relaxation")
    kept = []
    original = Recorder.record

    def keep(self, instant):
        original(self, instant)
        kept.append((self.model, instant.t, instant.y.copy(), instant.y_dot.copy(), instant.inputs, instant.stick))

    monkeypatch.setattr(Recorder, "record", keep)
    maneuver = wf.arrested_descent(start="0.05 s")
    wf.fly(start, maneuver, inflow=inflow, revolutions=1.5)
    blades = blades_of(kept[0][0])
    for model, t, y, y_dot, inputs, stick in kept[20::11]:
        outputs = model.core.outputs(t, y, y_dot, inputs)
        rate = 0.0254 * maneuver.rate(t)
        assert rate[2] > 0.1  # the collective is moving
        balance = blades.balance(t, y, y_dot, stick, rate, *inflow_of(model, y, outputs))
        force, moment = balance.hub_axes.T @ balance.force, balance.hub_axes.T @ balance.moment
        assert np.max(np.abs(force - outputs["hub_force"])) < 2e-6 * np.linalg.norm(force)
        assert np.max(np.abs(moment - outputs["hub_moment"])) < 2e-5 * np.linalg.norm(moment)
        rates = y[3:6]
        assert balance.shaft(balance.body @ rates) == pytest.approx(outputs["power"][0], rel=2e-5)
