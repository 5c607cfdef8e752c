"""Sections in harmonic motion against linear theory, and the work that the air does on them."""

from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf

FOLDER = Path(__file__).resolve().parents[2] / "validation" / "l02-unsteady-sections"
PLATE = FOLDER / "plate.toml"


def theodorsen():
    """C(k) by k."""
    rows = [
        line.split(",") for line in (FOLDER / "functions.csv").read_text().splitlines() if line.startswith("theodorsen")
    ]
    return {float(k): complex(float(re), float(im)) for _, k, re, im in rows}


def harmonic(loop, name):
    """First harmonic of a variable over that of the angle, complex: X of Im(X exp(i phase))."""
    wave = 2.0 * np.mean(loop[name].values * (np.sin(loop.phase.values) + 1j * np.cos(loop.phase.values)))
    return wave / np.radians(1.0)


def small(k, mach, model, **motion):
    return wf.airfoil_loop(PLATE, mean="0 deg", amplitude="1 deg", k=k, mach=mach, model=model, **motion)


@pytest.mark.parametrize("k", [0.05, 0.1, 0.2, 0.3, 0.5, 1.0])
def test_verif_the_shed_wake_of_a_plunging_plate_is_theodorsens(k):
    # Jones's approximation is within 1.5 per cent of the steady lift
    found = harmonic(small(k, 0.001, "hgm", motion="plunge"), "alpha_effective")
    assert abs(found - theodorsen()[k]) < 0.015
    jones = 1 - sum(a * 1j * k / (b + 1j * k) for a, b in ((0.165, 0.0455), (0.335, 0.3)))
    assert abs(found - jones) < 2e-5


@pytest.mark.parametrize(
    ("k", "mach", "ours"),
    [(0.05, 0.1, 0.9663 - 0.0445j), (0.2, 0.1, 0.768 + 0.0465j)],
)
def test_verif_the_compressible_model_nears_theodorsens_pitching_plate_at_low_mach(k, mach, ours):
    found = harmonic(small(k, mach, "attached"), "cn") * np.sqrt(1 - mach**2) / (2 * np.pi)
    exact = theodorsen()[k] * (1 + 1j * k) + 0.5j * k - 0.25 * k**2
    # the constants are of compressible flow: 5 per cent at low frequency is their approximation
    assert abs(found / exact - 1.0) < 0.06
    # the same terms evaluated in closed form
    assert abs(found - ours) < 1e-3


@pytest.mark.parametrize("mach", [0.1, 0.3, 0.5, 0.65])
@pytest.mark.parametrize("k", [0.02, 0.1, 0.25, 0.5])
def test_verif_attached_flow_damps_pitch_and_plunge(mach, k):
    for motion in ("pitch", "plunge"):
        assert float(small(k, mach, "attached", motion=motion, steps=360).work) < 0.0


def test_verif_work_in_plunge_is_that_of_the_lift_in_phase_with_the_velocity():
    k = 0.2
    loop = small(k, 0.3, "hgm", motion="plunge")
    in_phase = harmonic(loop, "cn").real * np.radians(1.0)
    assert float(loop.work) == pytest.approx(-np.pi * in_phase * np.radians(1.0) / (2 * k), rel=1e-9)


def test_verif_the_cycle_has_an_error_of_second_order_in_the_step():
    rotor = FOLDER.parent / "rotors" / "caradonna-tung.toml"
    cl = {n: wf.airfoil_loop(rotor, k=0.1, mach=0.3, steps=n).cl.values for n in (90, 180, 2880)}
    coarse, fine = (np.sqrt(np.mean((cl[n] - cl[2880][:: 2880 // n]) ** 2)) for n in (90, 180))
    assert coarse / fine > 2.8 and fine < 5e-3
