"""One section in harmonic motion: what is asked is checked, what is given is labelled, a slow motion is the table."""

from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.errors import InputError

CARADONNA = Path(__file__).parent / "data" / "rotors" / "caradonna-tung.toml"
MODELS = ("quasi-steady", "attached", "oye", "hgm")

DECK = """PLATE                          2 3 2 2 2 2
        0.0000 1.0000
 -180.0  0.000  0.000
    0.0  0.000  0.000
  180.0  0.000  0.000
        0.0000 1.0000
 -180.0  0.010  0.010
  180.0  0.010  0.010
        0.0000 1.0000
 -180.0  0.000  0.000
  180.0  0.000  0.000
"""


@pytest.mark.parametrize("model", MODELS)
def test_a_loop_is_labelled_and_closed(model):
    loop = wf.airfoil_loop(CARADONNA, mean="8 deg", amplitude="6 deg", k=0.1, mach=0.3, model=model)
    assert all(loop[name].attrs["units"] and loop[name].attrs["long_name"] for name in loop.variables)
    assert loop.sizes["phase"] == 720
    np.testing.assert_allclose(loop.alpha, np.radians(8) + np.radians(6) * np.sin(loop.phase), rtol=0, atol=1e-15)
    assert loop.attrs["model"] == model and loop.attrs["reduced_frequency"] == 0.1
    cn = loop.cl * np.cos(loop.alpha) + loop.cd * np.sin(loop.alpha)
    np.testing.assert_allclose(loop.cn, cn, atol=1e-14)
    for name in ("cl", "cd", "cm", "alpha_effective", "separation"):
        steps = np.abs(np.diff(np.append(loop[name], loop[name][0])))
        assert steps[-1] <= steps.max()  # no jump where the cycle ends


@pytest.mark.parametrize("model", MODELS)
def test_a_slow_motion_is_the_table(model):
    slow = wf.airfoil_loop("uh60a", mean="4 deg", amplitude="12 deg", k=1e-4, mach=0.4, model=model)
    table = wf.airfoil_loop("uh60a", mean="4 deg", amplitude="12 deg", k=1e-4, mach=0.4, model="quasi-steady")
    for name in ("cl", "cd", "cm"):
        assert np.abs(slow[name] - table[name]).max() < 5e-3


def test_stall_comes_late_and_goes_late():
    loop = wf.airfoil_loop(CARADONNA, mean="10 deg", amplitude="10 deg", k=0.1, mach=0.3)
    table = wf.airfoil_loop(CARADONNA, mean="10 deg", amplitude="10 deg", k=0.1, mach=0.3, model="quasi-steady")
    assert loop.cl.max() > table.cl.max() + 0.2
    up, down = loop.cl.sel(phase=np.radians(45), method="nearest"), loop.cl.sel(phase=np.radians(135), method="nearest")
    assert up > down + 0.2
    assert list(loop.state.values) == ["shed_slow", "shed_fast", "pressure_angle", "separation"]
    assert 0.0 <= float(loop.separation.min()) < 0.3 and float(loop.separation.max()) > 0.95


def test_the_section_is_that_of_the_station():
    tip, root = (wf.airfoil_loop("bo105", station=at, k=0.05, mach=0.3, steps=72) for at in (0.9, 0.3))
    assert tip.attrs["airfoil"] != root.attrs["airfoil"]


def test_a_deck_is_a_section(tmp_path):
    path = tmp_path / "plate.c81"
    path.write_text(DECK)
    with pytest.raises(InputError, match="lift slope"):
        wf.airfoil_loop(path)
    with pytest.raises(InputError, match=r"station = 0\.5: a C81 deck is one section"):
        wf.airfoil_loop(path, station=0.5)
    with pytest.raises(InputError, match=r"airfoil = .*no such file"):
        wf.airfoil_loop(tmp_path / "none.c81")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"model": "theodorsen"}, "model = 'theodorsen': allowed: quasi-steady, attached, oye, hgm"),
        ({"motion": "heave"}, "motion = 'heave': allowed: pitch, plunge"),
        ({"mean": 10.0}, "mean = 10.0: must be text with a unit"),
        ({"amplitude": "0 deg"}, "amplitude = 0: must lie above 0"),
        ({"k": 0.0}, "k = 0: must lie between 0.0001 and 10"),
        ({"k": float("nan")}, "k = nan: must be a finite number"),
        ({"mach": 2.0}, "mach = 2: must lie between 0.001 and 1"),
        ({"steps": 3}, "steps = 3: must be a whole number between 36"),
        ({"steps": 100.5}, "steps = 100.5: must be a whole number"),
        ({"station": 1.5}, "station = 1.5: must be a number between 0 and 1"),
        ({"pitch_axis": 9.0}, "pitch_axis = 9: must lie between"),
        ({"airfoil": "uh1"}, "no such file"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(given, message):
    with pytest.raises(InputError) as raised:
        wf.airfoil_loop(**{"k": 0.1, **given})
    assert message in str(raised.value) and "\n" not in str(raised.value)
