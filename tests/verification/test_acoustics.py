# SPDX-License-Identifier: MIT OR Apache-2.0
"""Loading noise against closed forms, and the files for PSU-WOPWOP read back byte by byte."""

import struct

import numpy as np
import pytest
from scipy.special import jv

import wakeflight as wf
from wakeflight.acoustics import (
    CENTROID,
    FULLNESS,
    Sources,
    Volumes,
    noise,
    pressure,
    sources,
    thickness_pressure,
    volumes,
)

C = 340.0


def _gutin(m, theta, force, radius, mach, distance):
    """Two-sided Fourier coefficient of a rotating constant axial force in the far field [gutin1948]."""
    omega = mach * C / radius
    return m * omega * force * abs(np.cos(theta)) / (4 * np.pi * C * distance) * abs(jv(m, m * mach * np.sin(theta)))


@pytest.mark.parametrize(("m", "degrees"), [(1, 60.0), (5, 60.0), (1, 75.0)])
def test_a_rotating_force_sounds_as_gutin_says(m, degrees):
    radius, mach, force, n = 0.8, 0.6, 100.0, 1440
    omega, theta = mach * C / radius, np.radians(degrees)
    distance = 500 * radius
    # a turn more at either end than is looked at
    time = np.arange(-n, 2 * n + 1) * 2 * np.pi / (omega * n)
    psi = omega * time
    place = radius * np.stack([np.cos(psi), np.sin(psi), 0 * psi], axis=-1)[:, None]
    load = np.zeros_like(place)
    load[..., 2] = force
    observer = distance * np.array([np.sin(theta), 0.0, np.cos(theta)])
    heard, p = pressure(Sources(time, place, load, C), observer)
    p = p[heard >= heard[0]][:n]
    found = abs(np.fft.rfft(p)[m] / n)
    expected = _gutin(m, theta, force, radius, mach, distance)
    if (m, degrees) == (1, 60.0):
        # at 500 radii, where the far field of the closed form is 1.9e-5 off
        assert found == pytest.approx(1.873616e-3, rel=2e-6)
    assert found == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(("m", "degrees"), [(1, 60.0), (5, 60.0), (1, 75.0), (4, 90.0)])
def test_a_rotating_volume_sounds_as_its_closed_form_says(m, degrees):
    # d^2/dt^2 of rho V / (r (1 - M_r)): with dt = (1 - M_r) dtau the coefficient is
    # (m omega)^2 rho V J_m(m M sin theta) / (4 pi D)
    radius, mach, volume, density, n = 0.8, 0.6, 2e-4, 1.2, 180
    omega, theta = mach * C / radius, np.radians(degrees)
    time = np.arange(-n, 2 * n + 1) * 2 * np.pi / (omega * n)
    psi = omega * time
    place = radius * np.stack([np.cos(psi), np.sin(psi), 0 * psi], axis=-1)[:, None]
    given = Volumes(time, place, np.array([volume]), density, C)
    off = {}
    for radii in (500, 5000):
        distance = radii * radius
        observer = distance * np.array([np.sin(theta), 0.0, np.cos(theta)])
        begin = (distance + 2 * radius) / C
        p = thickness_pressure(given, observer, begin + time[n : 2 * n] - time[n])
        found = abs(np.fft.rfft(p)[m] / n)
        far = density * volume * (m * omega) ** 2 * abs(jv(m, m * mach * np.sin(theta))) / (4 * np.pi * distance)
        off[radii] = found / far - 1.0
    # what is left is the distance at which the closed form holds, which falls with its square, and the steps of 2 deg
    assert abs(off[500]) < 1e-5
    assert abs(off[5000]) < 5e-7


def test_a_volume_that_comes_nearer_rarefies_and_one_at_rest_is_silent():
    time = np.linspace(0.0, 1.0, 4000)
    still = Volumes(time, np.zeros((4000, 1, 3)), np.array([1.0]), 1.2, C)
    heard = np.linspace(0.1, 0.9, 2000)
    assert abs(thickness_pressure(still, np.array([10.0, 0.0, 0.0]), heard)).max() < 1e-9
    # a blade that comes nearer sucks: the deepest pressure of a turn lies below, further than the highest above
    psi = 2 * np.pi * 8 * time
    place = 6.0 * np.stack([np.cos(psi), np.sin(psi), 0 * psi], axis=-1)[:, None]
    p = thickness_pressure(Volumes(time, place, np.array([0.1]), 1.2, C), np.array([200.0, 0.0, 0.0]), 0.7 + heard / 4)
    assert -p.min() > 2.0 * p.max() > 0.0


def test_the_sections_are_those_of_four_digits():
    x = np.linspace(0.0, 1.0, 200_001) ** 2
    half = 5 * (0.2969 * np.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
    assert np.trapezoid(2 * half, x) == pytest.approx(FULLNESS, rel=1e-8)
    assert np.trapezoid(2 * half * x, x) / FULLNESS == pytest.approx(CENTROID, rel=1e-8)


def test_a_steady_force_at_rest_has_the_field_of_a_dipole():
    # p = F.r / (4 pi r^3) for ever
    time = np.linspace(0.0, 1.0, 50)
    place, load = np.zeros((50, 1, 3)), np.zeros((50, 1, 3))
    load[..., 2] = 8.0
    observer = np.array([3.0, 0.0, 4.0])
    _, p = pressure(Sources(time, place, load, C), observer)
    assert p == pytest.approx(8.0 * 4.0 / (4 * np.pi * 125.0), rel=1e-12)


def test_what_comes_nearer_sounds_higher():
    time = np.linspace(0.0, 4.0, 4001)
    tone, speed = 20.0, 60.0
    place = np.stack([speed * time - 1000.0, 0 * time, 0 * time], axis=-1)[:, None]
    load = np.zeros_like(place)
    load[:, 0, 0] = np.sin(2 * np.pi * tone * time)
    heard, p = pressure(Sources(time, place, load, C), np.array([1000.0, 0.0, 0.0]))
    crossings = heard[1:][(p[:-1] < 0) & (p[1:] >= 0)]
    assert 1.0 / np.diff(crossings).mean() == pytest.approx(tone / (1.0 - speed / C), rel=1e-3)


@pytest.fixture(scope="module")
def flight():
    start = wf.trim(wf.load_aircraft("bo105"), inflow=wf.DynamicInflow(azimuth_step="3 deg"))
    return wf.fly(start, wf.Maneuver("still", {}, seconds=0.45), integrator="fixed")


def test_the_sources_carry_the_thrust_and_stand_on_the_blades(flight):
    data = flight.data
    found = sources(data)
    radius, omega = data.attrs["radius"], data.attrs["omega"]
    model = flight.start.model
    thrust = data.ct.values * model.density * np.pi * radius**2 * (omega * radius) ** 2
    # force on the air is down; drag and the tilt of the shaft are the rest
    assert found.force[..., 2].sum(axis=1).mean() == pytest.approx(thrust.mean(), rel=0.02)
    speed = np.linalg.norm(np.gradient(found.position, found.time, axis=0), axis=-1) / found.speed_of_sound
    assert speed[5:-5].max() == pytest.approx(float(data.mach.max()), rel=0.02)


def test_noise_has_the_blade_passage_and_falls_with_distance(flight):
    heard = noise(flight.data, [[0.0, 0.0, 100.0], [0.0, 0.0, 200.0]])
    assert heard.pressure.dims == ("time", "observer")
    assert float(heard.level[0] - heard.level[1]) == pytest.approx(6.0, abs=2.0)
    p = heard.pressure[:, 0].values
    frequency = np.fft.rfftfreq(p.size, float(np.diff(heard.time)[0]))
    loudest = frequency[np.argmax(abs(np.fft.rfft(p * np.hanning(p.size))))]
    passage = 4 * flight.data.attrs["omega"] / (2 * np.pi)
    assert loudest == pytest.approx(passage, rel=0.15)


def test_a_coarse_record_is_refused_unless_asked_for():
    start = wf.trim(wf.load_aircraft("bo105"), inflow="dynamic")
    coarse = wf.fly(start, wf.Maneuver("still", {}, seconds=0.3), integrator="fixed")
    with pytest.raises(wf.InputError, match="every 10 deg of azimuth, which resolves 18 harmonics"):
        noise(coarse.data, [[0.0, 0.0, 100.0]])
    assert noise(coarse.data, [[0.0, 0.0, 100.0]], force=True).pressure.size


def test_files_for_wopwop_hold_the_same_sources(flight, tmp_path):
    path = wf.export_wopwop(flight.data, tmp_path, observers=[[10.0, 20.0, 30.0]])
    found = sources(flight.data)
    n, stations = found.time.size, flight.data.sizes["station"]
    geometry = (tmp_path / "blade_2_geometry.dat").read_bytes()
    assert struct.unpack_from("<3i", geometry) == (42, 1, 0)
    assert geometry[12:44].strip() == b"Pa"
    assert struct.unpack_from("<8i", geometry, 1068) == (1, 1, 1, 3, 1, 1, 0, 0)
    assert struct.unpack_from("<3i", geometry, 1100 + 32) == (n, 1, stations)
    rows = np.frombuffer(geometry, "<f4", offset=1100 + 44).reshape(n, 1 + 6 * stations)
    assert rows[:, 0] == pytest.approx(found.time, abs=1e-6)
    second = found.position[:, stations : 2 * stations]
    assert rows[:, 1 : 1 + stations] == pytest.approx(second[..., 0], abs=1e-4)
    assert rows[:, 1 + 2 * stations : 1 + 3 * stations] == pytest.approx(-second[..., 2], abs=1e-4)
    loading = (tmp_path / "blade_2_loading.dat").read_bytes()
    assert struct.unpack_from("<10i", loading, 1036) == (2, 1, 1, 3, 1, 2, 1, 1, 0, 0)
    assert struct.unpack_from("<2i", loading, 1076) == (1, -1)
    loads = np.frombuffer(loading, "<f4", offset=1084 + 44).reshape(n, 1 + 3 * stations)
    widths = rows[:, 1 + 5 * stations :]
    # force per span times the span of every node: the force on the air
    assert (loads[:, 1 + 2 * stations :] * widths).sum(axis=1) == pytest.approx(
        -found.force[:, stations : 2 * stations, 2].sum(axis=1), rel=1e-5
    )
    text = path.read_text()
    assert "xLoc = 10" in text
    assert "yLoc = -20" in text
    assert text.count("&ContainerIn") == 5


def test_thickness_is_told_apart_and_silent_where_it_is_not_given(flight):
    places = [[0.0, 0.0, 100.0], [80.0, 0.0, 5.0]]
    alone, both = noise(flight.data, places), noise(flight.data, places, thickness_ratio=0.12)
    assert "thickness" not in alone
    assert np.array_equal(both.pressure, both.loading + both.thickness)
    # heard within a step of the same moments
    assert both.loading.std("time").values == pytest.approx(alone.pressure.std("time").values, rel=0.05)
    # in the plane of the rotor it counts, below it hardly
    share = (both.thickness.std("time") / both.loading.std("time")).values
    assert share[1] > 5.0 * share[0]
    displaced = volumes(flight.data, 0.12)
    # blades of the BO-105: 4.91 m, 0.27 m wide, from about a fifth of the radius on
    assert displaced.volume.sum() == pytest.approx(4 * FULLNESS * 0.12 * 0.27**2 * 0.8 * 4.91, rel=0.1)
    for wrong in (0.0, -0.1, 0.6):
        with pytest.raises(wf.InputError, match="thickness_ratio"):
            noise(flight.data, places, thickness_ratio=wrong)
