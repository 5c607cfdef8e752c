"""Trim: the equations are met, published trims are met within what was asked, impossible flight is refused."""

import csv
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.trim.table import HORSEPOWER

DATA = Path(__file__).parent / "data"


@pytest.mark.parametrize("name", ["baseline_dynamic", "baseline_relaxation", "baseline_marching"])
def test_every_balance_of_the_baseline_is_met_with_every_inflow_model(name, request):
    residuals = request.getfixturevalue(name).residuals
    assert residuals["linear"] < 1e-4
    assert residuals["angular"] < 1e-4
    assert residuals["harmonics"] < 1e-6


def test_the_loads_recorded_over_a_trimmed_revolution_balance_the_weight(baseline_relaxation):
    # an independent way to the balance: loads of the recorded revolution against gravity on the airframe
    start = baseline_relaxation
    mean = start.mean_outputs()
    mass = start.condition.gross_mass - start.model.n_blades * start.model.rotor["blade_mass"]
    weight = mass * 9.80665
    expected = weight * np.array([np.sin(start.pitch), 0.0, -np.cos(start.pitch)])
    assert mean["force"] == pytest.approx(expected, abs=1e-3 * weight)


def test_level_flight_at_80_kt_is_that_of_the_genhel_port(uh60a):
    # rigid blades there, elastic ones here: attitude within 1 deg, sticks within half an inch
    with (DATA / "genhel_julia_trim_80kt.csv").open() as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        published = {row["quantity"].split(" (")[0]: float(row["value"]) for row in rows}
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    start = wf.trim(uh60a, condition, inflow="dynamic")
    mean, lam = start.mean_outputs(), start.inflow_harmonics()
    assert np.degrees(start.pitch) == pytest.approx(published["theta"], abs=1.0)
    assert np.degrees(start.roll) == pytest.approx(published["phi"], abs=1.0)
    travel = dict(zip(("lateral", "longitudinal", "collective", "pedal"), uh60a.stick_travel_in, strict=True))
    for stick in ("lateral", "longitudinal", "pedal"):
        inches = published[f"{stick} stick" if stick != "pedal" else "pedal"] / 100 * travel[stick]
        assert start.stick[stick] == pytest.approx(inches, abs=0.5), stick
    assert np.degrees(mean["beta_0"]) == pytest.approx(published["beta0 coning"], abs=0.2)
    assert lam[0] == pytest.approx(published["lambda0 inflow/(Omega R)"], rel=0.05)
    assert lam[1] == pytest.approx(published["lambda1c"], rel=0.05)


@pytest.mark.parametrize(
    ("case", "speed", "path"),
    [("hover", "0 kt", "0 deg"), ("level", "80 kt", "0 deg"), ("descent_1000fpm", "80 kt", "-7.08 deg")],
)
def test_power_is_that_of_the_engine_model_report(case, speed, path):
    aircraft = wf.load_aircraft("uh60a", loading="tm100991")
    with (DATA / "engine_power_tm100991_table_b1.csv").open() as stream:
        rows = {row["case"]: row for row in csv.DictReader(line for line in stream if not line.startswith("#"))}
    condition = wf.FlightCondition(speed=speed, flight_path=path, altitude="0 ft", weight="16825 lbf")
    power = wf.trim(aircraft, condition, inflow="dynamic").mean_outputs()["power"] / HORSEPOWER
    assert power == pytest.approx(float(rows[case]["shp_total"]), rel=0.05)


def test_a_steady_turn_banks_by_the_angle_of_a_coordinated_turn(uh60a):
    # tan(bank) = V rate / g for a body without side force; the tail rotor adds a few degrees
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", turn_rate="10 deg/s")
    start = wf.trim(uh60a, condition, inflow="dynamic")
    speed = 80 * 1852 / 3600
    assert np.degrees(start.roll) == pytest.approx(np.degrees(np.arctan(speed * np.radians(10.0) / 9.80665)), abs=4.0)


def test_wake_inflow_in_level_flight_and_hover_stands_to_momentum_theory_as_known(uh60a):
    # a single tip vortex with circulation fed back exceeds momentum theory; the ratio is a known bias, not noise
    for speed, low, high in (("80 kt", 1.0, 1.35), ("0 kt", 1.0, 1.3)):
        start = wf.trim(uh60a, wf.FlightCondition(speed=speed, flight_path="0 deg"), inflow="relaxation")
        mean = start.mean_outputs()
        hub, _ = start.model.core.hub(start.state())
        along = -hub[2] / start.model.tip_speed
        momentum = np.sqrt(mean["ct"] / 2)
        for _ in range(100):
            momentum = 0.5 * (momentum + mean["ct"] / (2 * np.hypot(mean["mu"], momentum - along)))
        assert low < mean["inflow_mean"] / momentum < high
