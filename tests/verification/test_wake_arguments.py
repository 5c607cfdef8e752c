# SPDX-License-Identifier: MIT OR Apache-2.0
"""Options of a wake typed in Python and in the command line are the same options, and give the same thrust."""

import pytest
import xarray as xr

import wakeflight as wf
from wakeflight import cli
from wakeflight.condition import condition_for
from wakeflight.flight_start import flight_model
from wakeflight.model import Model

TYPED = {"tip_strength": "max", "inboard_wake": "sheet"}
COARSE = {"azimuth_step": "30 deg", "n_stations": 10}


def test_a_user_in_hover_gets_the_settings_of_hover_on_stand_trim_and_flight_as_the_command_line_does(uh60a, tmp_path):
    # settings of forward flight in hover would give another thrust (7 % on the rotor of Caradonna and Tung)
    typed = wf.RelaxationWake(**TYPED, **COARSE)
    stand = wf.tunnel("uh60a", "10 deg", inflow=typed)
    arguments = [f"--wake={name}={value}" for name, value in {**TYPED, **COARSE}.items()]
    with pytest.raises(SystemExit) as ended:
        cli.main(["tunnel", "--collective", "10 deg", "--inflow", "relaxation", "--out", str(tmp_path), *arguments])
    assert ended.value.code == 0
    assert float(xr.load_dataset(tmp_path / "tunnel.nc").ct) == float(stand.ct)
    forward = wf.tunnel("uh60a", "10 deg", inflow=typed.resolved("forward"))
    assert abs(float(forward.ct) / float(stand.ct) - 1.0) > 0.01

    hover = {"turns": 5.0, "far_wake_turns": 2, "sheet_factor": 1.4, "relaxation": 0.3}
    trimmed = Model.build(uh60a, condition_for(uh60a, speed="0 kt", flight_path="0 deg"), typed)
    assert {name: getattr(trimmed.inflow, name) for name in hover} == hover

    class Start:
        aircraft, condition, inflow, model = uh60a, trimmed.condition, trimmed.inflow, trimmed

    for flown in ("relaxation", "time-marching", wf.TimeMarchingWake(**TYPED, **COARSE)):
        wake = flight_model(Start(), flown).inflow
        assert (wake.turns, wake.far_wake_turns, wake.sheet_factor) == (5.0, 2, 1.4)
