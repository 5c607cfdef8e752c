"""Periodic linear systems: Floquet, Hill and multiblade coordinates agree; the mirrored helicopter has the mirrored model."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.linear.constant import averaged, decomposed
from wakeflight.linear.multiblade import columns, to_multiblade
from wakeflight.linear.names import BODY, Places
from wakeflight.linear.periodic import PeriodicSystem

LOCK, STIFFNESS, BLADES = 8.0, 1.04, 4
FLOQUET = {0.2: -0.5 + 0.119630j, 0.35: -0.5 + 0.130681j}
AVERAGED = (-0.51799 + 0.11355j, -0.5 + 0.88882j, -0.49694 + 0.85921j, -0.48507 + 1.87364j)
"""Regressing, differential, coning, progressing at mu = 0.35."""
HELD = -3.0
"""Root of the body's states, which nothing couples with the blades here [1/rev]."""


def flapping(mu, multiblade, n=36):
    """Four rigid flapping blades, flap and its rate, azimuth as time; the body decays by itself."""
    where = Places(
        motion=np.arange(6),
        attitude=np.arange(6, 10),
        modal=10 + np.arange(BLADES)[:, None] * 2,
        modal_rate=11 + np.arange(BLADES)[:, None] * 2,
        rest=np.array([], int),
        rest_names=(),
        labels=("flap_1",),
        angle=np.ones(1),
    )
    psi = 2 * np.pi * np.arange(n) / n
    a = np.zeros((n, where.size, where.size))
    a[:, range(8), range(8)] = HELD
    for b in range(BLADES):
        s, c = np.sin(psi + 2 * np.pi * b / BLADES), np.cos(psi + 2 * np.pi * b / BLADES)
        i = len(BODY) + 2 * b
        a[:, i, i + 1] = 1.0
        a[:, i + 1, i] = -STIFFNESS - LOCK / 2 * mu * c * (1 / 3 + mu * s / 2)
        a[:, i + 1, i + 1] = -LOCK / 2 * (1 / 4 + mu * s / 3)
    nothing = np.zeros((n, where.size, 0))
    if multiblade:
        a, _ = to_multiblade(where, psi, 1.0, a, nothing)
        swap = np.diag([1.0] * (where.size - 2) + [-1.0] * 2)
    else:
        order = [*range(8), *(8 + np.roll(np.arange(8), -2))]
        swap = np.eye(where.size)[order].T
    states = where.named(columns(BLADES) if multiblade else ("blade_1", "blade_2", "blade_3", "blade_4"))
    empty = np.zeros((n, 0, where.size)), np.zeros((n, 0, 0))
    return PeriodicSystem(psi, 1.0, a, nothing, nothing, *empty, states, (), (), BLADES, swap)


def of_blades(roots):
    """Roots that are not the body's."""
    return roots[np.abs(roots - HELD) > 1e-6]


def nearest(roots, value):
    return roots[np.argmin(np.abs(roots - value))]


@pytest.mark.parametrize("mu", FLOQUET)
def test_a_flapping_blade_has_the_known_characteristic_exponents(mu):
    system = flapping(mu, multiblade=False)
    exponents = of_blades(system.exponents(np.linalg.eigvals(system.a.mean(axis=0))))
    assert exponents.size == 8
    # the trace fixes the real part; of the imaginary one whole turns are unknown
    assert np.allclose(exponents.real, FLOQUET[mu].real, atol=1e-6)
    turned = np.abs(np.remainder(exponents.imag + 0.5, 1.0) - 0.5)
    assert np.allclose(turned, FLOQUET[mu].imag, atol=1e-6)


def test_averaged_multiblade_coordinates_have_the_known_roots():
    roots = np.linalg.eigvals(averaged(flapping(0.35, multiblade=True)).a)
    for value in AVERAGED:
        assert abs(nearest(roots, value) - value) < 2e-5


def test_averaging_errs_in_the_damping_of_the_regressing_mode_and_decomposition_does_not():
    system = flapping(0.35, multiblade=True)
    exact = nearest(system.exponents(np.linalg.eigvals(system.a.mean(axis=0))), AVERAGED[0])
    mean = nearest(np.linalg.eigvals(averaged(system).a), exact)
    assert abs(mean.real - exact.real) == pytest.approx(0.018, abs=5e-4)
    off = []
    for harmonics in ((2,), (2, 4), (2, 4, 6), (2, 4, 6, 8)):
        off.append(abs(nearest(np.linalg.eigvals(decomposed(system, harmonics).a), exact) - exact))
    assert (
        off[0] < 0.018 and off[-1] < 1e-6 and all(b < 0.3 * a for a, b in zip(off, off[1:], strict=False) if a > 1e-9)
    )


def test_harmonics_that_equal_blades_do_not_have_change_nothing():
    system = flapping(0.35, multiblade=True)
    few, many = (np.linalg.eigvals(decomposed(system, kept).a) for kept in ((2, 4), (1, 2, 3, 4)))
    assert few.size == many.size
    assert np.abs(np.sort_complex(few) - np.sort_complex(many)).max() < 1e-9


@pytest.fixture(scope="module")
def start():
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    return wf.trim(wf.load_aircraft("uh60a"), condition, inflow="dynamic")


def test_exponents_are_the_same_in_individual_and_multiblade_coordinates(start):
    multiblade, individual = (wf.linearize(start, blades=blades).periodic for blades in ("multiblade", "individual"))
    # the lag dampers' breaks are no trigonometric polynomials: both get the same one, that of the individual blades
    from wakeflight.linear.multiblade import rotation
    from wakeflight.linear.names import places

    where = places(start.model)
    steps = 200

    class Turned(PeriodicSystem):
        def a_at(self, psi):
            r, r_dot, left = rotation(where, psi, self.omega)
            return left @ (individual.a_at(psi) @ r - r_dot)

    turned = Turned(**{name: getattr(multiblade, name) for name in PeriodicSystem.__dataclass_fields__})
    one, other = (np.linalg.eigvals(each.renumbering @ each.transition(steps)) for each in (turned, individual))
    # a passage turns the multiblade coordinates by a quarter with it: compare over whole revolutions
    one, other = np.sort_complex(one**4), np.sort_complex(other**4)
    assert np.abs(one - other).max() < 1e-7


def test_the_mirrored_helicopter_has_the_mirrored_model(start):
    image = wf.trim(start.aircraft.mirrored(), start.condition, inflow="dynamic")
    one, other = wf.linearize(start), wf.linearize(image)
    odd = {"v", "p", "r", "roll", "turn_rate", "acceleration_y"}

    def signs(named):
        return np.array([-1.0 if name.split("_2")[0].split("_4")[0] in odd else 1.0 for name, _ in named])

    # lateral stick and pedal to the right in both
    s, y, u = signs(one.states), signs(one.outputs), np.array([-1.0, 1.0, 1.0, -1.0])
    for mine, theirs, left, right in (
        (one.A, other.A, s, s),
        (one.B, other.B, s, u),
        (one.C, other.C, y, s),
        (one.D, other.D, y, u),
    ):
        scale = np.abs(mine.values).max()
        assert np.abs(left[:, None] * mine.values * right - theirs.values).max() < 1e-10 * scale
