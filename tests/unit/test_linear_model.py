"""Linear models by themselves: modes by name, reduction, responses, what is refused."""

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.linear.build import between
from wakeflight.linear.periodic import PeriodicSystem
from wakeflight.linear.reduction import balanced

TABLE = Path(__file__).resolve().parents[2] / "validation" / "d10-bo105-derivatives" / "bo105_helisim.csv"
COLUMNS = ("u", "w", "q", "theta", "v", "p", "phi", "r")
STATES = ("u", "w", "q", "pitch", "v", "p", "roll", "r")
NAMED = {
    0: {
        "roll": -14.2112,
        "pitch": -3.8365,
        "heave - yaw": -0.3246 + 0.0053j,
        "phugoid - dutch roll": -0.2098 + 0.5992j,
        "phugoid": 0.2361 + 0.5248j,
    },
    40: {
        "roll": -13.9469,
        "pitch": -3.9371,
        "heave": -0.5724,
        "dutch roll": -0.4000 + 1.5961j,
        "spiral": -0.0014,
        "phugoid": 0.0101 + 0.3550j,
    },
    80: {
        "roll": -13.7201,
        "pitch": -4.2542,
        "heave": -0.6534,
        "dutch roll": -0.5648 + 2.6406j,
        "spiral": -0.0243,
        "phugoid": 0.0162 + 0.3053j,
    },
    120: {
        "roll": -13.6137,
        "pitch": -4.8598,
        "dutch roll": -0.6376 + 3.5055j,
        "heave": -0.5126,
        "spiral": -0.0293,
        "phugoid": 0.0769 + 0.3232j,
    },
}
"""Modes of the published matrices of a BO-105, eigenvalues as listed with them [1/s]."""


def published(speed):
    with TABLE.open() as stream:
        rows = [r for r in csv.DictReader(x for x in stream if not x.startswith("#")) if float(r["V_kt"]) == speed]
    a = np.array([[float(row[c]) for c in COLUMNS] for row in rows])
    b = np.array([[float(row[c]) for c in ("d_theta0", "d_theta1s", "d_theta1c", "d_theta0T")] for row in rows])
    return a, b


def of_flight(speed):
    a, b = published(speed)
    return wf.LinearModel.of(a, b, states=STATES, inputs=("collective", "longitudinal", "lateral", "pedal"))


@pytest.mark.parametrize("speed", NAMED)
def test_modes_of_a_published_helicopter_are_named_by_what_takes_part_in_them(speed):
    found = of_flight(speed).modes()
    named = dict(zip(found["name"].values.tolist(), found["eigenvalue"].values, strict=True))
    assert named.keys() == NAMED[speed].keys()
    for name, value in NAMED[speed].items():
        assert abs(named[name] - value) < 1e-4, name
    assert np.allclose(found["participation"].sum("state"), 1.0)


def test_names_do_not_depend_on_units_or_on_the_order_of_states():
    a, _ = published(80)
    scale, order = np.geomspace(0.01, 100.0, 8), [5, 2, 7, 0, 3, 1, 6, 4]
    turned = (scale[:, None] * a / scale)[np.ix_(order, order)]
    other = wf.LinearModel.of(turned, states=[STATES[i] for i in order]).modes()
    assert sorted(other["name"].values) == sorted(of_flight(80).modes()["name"].values)


def test_matrices_carry_names_and_units():
    model = wf.LinearModel.of([[-1.0]], [[2.0]], states=[("p", "rad/s")], inputs=[("lateral", "in")])
    assert model.A.dims == ("state", "state_") and model.B.dims == ("state", "input")
    assert model.C.dims == ("output", "state") and model.D.dims == ("output", "input")
    assert model.B["input"].values.tolist() == ["lateral"] and model.B["input_units"].values.tolist() == ["in"]
    for each in (model.A, model.B, model.C, model.D, *model.to_dataset().data_vars.values()):
        assert each.attrs["long_name"], each.name
    answer = model.response([0.0, 1.0], {"lateral": [0.0, 1.0]})
    assert all(each.attrs["units"] and each.attrs["long_name"] for each in answer.variables.values())


def test_a_lag_answers_as_it_must():
    model = wf.LinearModel.of([[-3.0]], [[6.0]], states=("p",), inputs=("lateral",))
    w = np.array([0.5, 3.0, 10.0])
    assert np.allclose(model.frequency_response(w, "lateral", "p")["response"].values[:, 0, 0], 6 / (1j * w + 3))
    time = np.linspace(0.0, 2.0, 11)
    # a ramp: y = 2 (t - (1 - e^-3t)/3), exact at any step
    assert np.allclose(
        model.response(time, {"lateral": time})["p"], 2 * (time - (1 - np.exp(-3 * time)) / 3), atol=1e-12
    )


def test_states_that_follow_at_once_keep_the_steady_response():
    a, b = published(80)
    whole = of_flight(80)
    small = whole.reduce(("w", "q"))
    fast = [i for i, name in enumerate(STATES) if name not in ("w", "q")]
    kept = [STATES.index(name) for name in ("w", "q")]
    by_hand = a[np.ix_(kept, kept)] - a[np.ix_(kept, fast)] @ np.linalg.solve(
        a[np.ix_(fast, fast)], a[np.ix_(fast, kept)]
    )
    assert np.allclose(small.A, by_hand)
    steady = [m.C.values @ np.linalg.solve(m.A.values, m.B.values) - m.D.values for m in (whole, small)]
    assert np.allclose(*steady, rtol=1e-8, atol=1e-9)
    assert [name for name, _ in small.states] == ["w", "q"] and np.shape(small.B) == np.shape(b[:2])


def test_balanced_reduction_keeps_what_is_unstable_and_what_acts():
    rng = np.random.default_rng(1)
    a = np.diag([0.4, -0.5, -1.0, -40.0, -60.0])
    a[0, 1:], b, c = 0.1, rng.normal(size=(5, 2)), rng.normal(size=(3, 5))
    b[3:] *= 1e-3
    system = a, b, c, np.zeros((3, 2))
    small = balanced(system, 3, np.arange(3))
    assert np.min(np.abs(np.linalg.eigvals(small[0]) - 0.4)) < 1e-9
    w = 1j * 2.0
    one, other = (m[2] @ np.linalg.solve(w * np.eye(m[0].shape[0]) - m[0], m[1]) for m in (system, small))
    assert np.abs(one - other).max() < 1e-3
    same = balanced(system, 5, np.arange(3))
    assert np.allclose(np.sort(np.linalg.eigvals(same[0]).real), np.sort(np.diag(a)))
    with pytest.raises(wf.InputError, match="unstable"):
        balanced(system, 0, np.arange(3))


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"states": ("p", "q"), "a": [[1.0]]}, "A"),
        ({"states": ("p",), "a": [[np.nan]]}, "finite"),
        ({"states": ("p",), "a": [[1.0]], "b": [[1.0, 2.0]], "inputs": ("lateral",)}, "B"),
    ],
)
def test_matrices_that_do_not_fit_their_names_are_refused(asked, said):
    with pytest.raises(wf.InputError, match=said):
        wf.LinearModel.of(asked.pop("a"), asked.pop("b", None), **asked)


def test_what_cannot_be_answered_is_refused_by_name():
    model = of_flight(80)
    for refused, said in (
        (lambda: model.frequency_response([1.0], "rudder"), "rudder"),
        (lambda: model.frequency_response([0.0]), "w = "),
        (lambda: model.frequency_response([2.0, 1.0]), "ascending"),
        (lambda: model.response([0.0, 1.0, 3.0], {}), "equally spaced"),
        (lambda: model.response([0.0, 1.0], {"lateral": [1.0]}), "lateral"),
        (lambda: model.response([0.0, 1.0], np.zeros((2, 4))), "inputs = 'ndarray': must be histories by name"),
        (lambda: model.reduce("small"), "order"),
        (lambda: model.reduce(10), "lie between"),
        (lambda: model.reduce(("u", "beta")), "beta"),
        (lambda: model.reduce(2.5), "whole"),
    ):
        with pytest.raises(wf.InputError, match=said):
            refused()


def test_without_python_control_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(wf.InputError, match="pip install control"):
        of_flight(80).to_control()


def test_python_control_gets_matrices_and_names():
    control = pytest.importorskip("control")
    model = of_flight(80)
    found = model.to_control()
    assert isinstance(found, control.StateSpace)
    assert np.array_equal(found.A, model.A) and found.state_labels == list(STATES)
    assert found.input_labels == ["collective", "longitudinal", "lateral", "pedal"]


def test_what_is_known_at_some_azimuths_is_linear_between_them():
    values = np.random.default_rng(7).normal(size=(6, 3, 2))
    fine = between(values, 24)
    assert np.array_equal(fine[::4], values) and np.array_equal(between(values, 6), values)
    assert np.allclose(fine[1::4], 0.75 * values + 0.25 * np.roll(values, -1, axis=0))


@pytest.mark.parametrize("n", [12, 9])
def test_a_periodic_system_keeps_the_harmonics_that_fewer_azimuths_can_tell(n):
    psi, rng = 2 * np.pi * np.arange(36) / 36, np.random.default_rng(8)

    def periodic(orders, psi, seed):
        parts = np.random.default_rng(seed).normal(size=(len(orders), 2, 2, 2))
        return sum(
            parts[i, 0] * np.cos(k * psi)[:, None, None] + parts[i, 1] * np.sin(k * psi)[:, None, None]
            for i, k in enumerate(orders)
        )

    told, beyond = range((n + 1) // 2), (n // 2 + 1, n // 2 + 4)
    known = [periodic(told, psi, seed) for seed in range(5)]
    names = (("x", "m"), ("y", "m"))
    full = PeriodicSystem(
        psi,
        27.0,
        *(each + periodic(beyond, psi, int(rng.integers(99))) for each in known),
        names,
        names,
        names,
        3,
        np.eye(2),
    )
    less = full.coarser(n)
    at = 2 * np.pi * np.arange(n) / n
    for seed, each in enumerate((less.a, less.b, less.b_rate, less.c, less.d)):
        assert np.allclose(each, periodic(told, at, seed))
    assert np.allclose(less.psi, at) and full.coarser(36) is full
