"""Handling qualities against closed forms; a quantity that does not exist says why."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.handling import attitude_metrics, limits, quickness

EXACT = tomllib.loads(
    (Path(__file__).resolve().parents[2] / "validation" / "d16-handling-metrics" / "ads33_metrics.toml").read_text()
)["exact_check"]


def lag_and_delay(w):
    """a/(s (s + a)) e^(-tau s)."""
    a, tau, s = EXACT["a_rad_s"], EXACT["tau_s"], 1j * w
    return a / (s * (s + a)) * np.exp(-tau * s)


def test_bandwidth_and_phase_delay_of_an_integrator_with_lag_and_delay():
    found = attitude_metrics(lag_and_delay).values
    assert found["w_180"] == pytest.approx(EXACT["w180_rad_s"], abs=5e-9)
    assert found["bandwidth_phase"] == pytest.approx(EXACT["bandwidth_phase_rad_s"], abs=5e-9)
    # 6.0 dB, not the factor 2, which gives 4.13956865
    assert found["bandwidth_gain"] == pytest.approx(EXACT["bandwidth_gain_rad_s"], abs=5e-9)
    assert found["phase_delay"] == pytest.approx(EXACT["phase_delay_s"], abs=5e-9)
    assert found["bandwidth"] == found["bandwidth_phase"]


def test_the_line_through_the_phase_gives_half_its_slope():
    # a pure delay behind an integrator has a phase that is a line
    found = attitude_metrics(lambda w: np.exp(-0.2j * w) / (1j * w)).values
    assert found["phase_delay_fit"] == pytest.approx(0.1, rel=1e-3)
    assert found["phase_delay"] == pytest.approx(0.1, rel=1e-6)


def test_no_crossing_is_no_number():
    found = attitude_metrics(lambda w: 1.0 / (1j * w))
    assert np.isnan(found.values["bandwidth"]) and "-180" in found.reasons["bandwidth"]
    # an attitude that is unstable begins at -180 deg: 1/(s^2 - 1) with a delay
    unstable = attitude_metrics(lambda w: np.exp(-0.05j * w) * (0.3j * w + 1) / ((1j * w) ** 2 - 1))
    assert np.isnan(unstable.values["bandwidth"]) and "-135" in unstable.reasons["bandwidth_phase"]
    assert np.isfinite(unstable.values["phase_delay"])


@pytest.mark.parametrize(("width", "known"), [(0.2, 2.25594), (0.5, 1.55374), (1.0, 0.95021)])
def test_quickness_of_a_first_order_roll(width, known):
    roll = wf.LinearModel.of([[-3.0, 0.0], [1.0, 0.0]], [[1.0], [0.0]], states=("p", "roll"), inputs=("lateral",))
    time = np.linspace(0.0, 12.0, 120001)
    answer = roll.response(time, {"lateral": np.where(time < width - 1e-9, 1.0, 0.0)})
    found, peak, least = quickness(time, answer["p"], answer["roll"])
    assert found == pytest.approx((1 - np.exp(-3 * width)) / width, rel=2e-4) == pytest.approx(known, rel=2e-4)
    # a pulse that ends between two times is a step shorter
    assert peak == pytest.approx(width / 3, rel=1e-3) and least == pytest.approx(peak)


def test_quickness_does_not_mind_a_divergence_that_follows():
    time = np.linspace(0.0, 6.0, 6001)
    later = np.maximum(time - np.pi, 0.0)
    roll = np.where(later == 0.0, 0.5 * (1.0 - np.cos(2 * time)), -(later**2))
    p = np.where(later == 0.0, np.sin(2 * time), -2.0 * later)
    found, peak, least = quickness(time, p, roll)
    assert peak == pytest.approx(1.0, abs=1e-6) and found == pytest.approx(1.0, abs=1e-6) and least < 0.0


def test_histories_of_other_lengths_and_at_rest_are_refused():
    with pytest.raises(wf.InputError, match="equally long"):
        quickness([0.0, 1.0, 2.0], [0.0, 1.0], [0.0, 1.0, 2.0])
    with pytest.raises(wf.InputError, match="does not move"):
        quickness(np.arange(5.0), np.zeros(5), np.zeros(5))


@pytest.fixture(scope="module")
def hover_and_forward():
    found = []
    for speed in ("1 kt", "80 kt"):
        condition = wf.FlightCondition(speed=speed, flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
        model = wf.linearize(wf.trim(wf.load_aircraft("uh60a"), condition, inflow="dynamic"))
        found.append((model, wf.handling_qualities(model)))
    return found


def test_every_quantity_is_a_number_or_has_a_reason(hover_and_forward):
    for _, found in hover_and_forward:
        for name, values in found.data.data_vars.items():
            for axis in found.data["axis"].values if values.dims == ("axis",) else [""]:
                full = f"{axis}.{name}" if axis else name
                if not values.dims or values.dims == ("axis",):
                    assert np.isfinite(found[full]) != (full in found.reasons), full
        assert "roll.bandwidth" in found.table() and found.data["w_180"].attrs["units"] == "rad/s"
        for each in (*found.data.data_vars.values(), *found.responses.data_vars.values()):
            assert each.attrs["units"] and each.attrs["long_name"]


def test_the_bare_uh60a_rolls_as_it_should(hover_and_forward):
    (_, hover), (_, forward) = hover_and_forward
    # a published value of a bare airframe near this one; the pitch of an unstable aircraft has no bandwidth
    assert forward["roll.bandwidth_phase"] == pytest.approx(2.5, abs=0.2)
    assert np.isnan(forward["pitch.bandwidth"]) and "-135" in forward.reasons["pitch.bandwidth"]
    # heave in hover: first order with the time constant -1/Z_w
    damping = float(hover_and_forward[0][0].reduce(8).A.sel(state="w", state_="w"))
    assert hover["heave_time"] == pytest.approx(-1.0 / damping, rel=0.25)
    assert 0.97 <= hover["heave_fit"] <= 1.03
    assert hover["roll.peak_rate"] > 0.0 and forward["yaw.attitude_1s"] > 0.0


def test_pictures_are_drawn_from_numbers_that_may_not_exist(hover_and_forward):
    from wakeflight.plotting import handling as drawing
    from wakeflight.plotting import linear

    (model, hover), (_, forward) = hover_and_forward
    figure = drawing.bandwidth({"hover": hover.data, "80 kt": forward.data}, limits())
    assert len(figure.axes) == 3
    assert len(drawing.attitudes(forward.responses, forward.data).axes) == 6
    assert linear.modes(model.modes()).axes
    assert linear.responses(model.frequency_response(np.geomspace(0.3, 20, 20), "lateral", ["p", "q"])).axes


def test_models_without_sticks_or_motion_are_refused():
    small = wf.LinearModel.of([[-1.0]], [[1.0]], states=("p",), inputs=("lateral",))
    with pytest.raises(wf.InputError, match="collective"):
        wf.handling_qualities(small)
    with pytest.raises(wf.InputError, match="model"):
        wf.handling_qualities("uh60a")
