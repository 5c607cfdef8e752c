"""Figures say what the data say: maps lie on the right azimuth, axes carry units."""

import matplotlib
import numpy as np
import pytest
import synthetic

from wakeflight import plotting
from wakeflight.errors import InputError
from wakeflight.plotting import comparison, disk, modes, style, trim_maps, wake_geometry
from wakeflight.plotting.histories import one_revolution_mean
from wakeflight.plotting.shown import check_units
from wakeflight.results.turns import revolutions


@pytest.fixture(scope="module")
def run():
    return synthetic.run()


def test_a_steady_map_is_recovered_exactly_from_the_blades(run):
    # sticks at trim in the first revolution: the map must be the closed form the blades sampled
    field = disk.revolution_map(run, "inflow", 1)
    assert field.sizes["psi"] == synthetic.STEPS
    expected = synthetic.inflow_field(field.psi.values[:, None], field.station.values)
    np.testing.assert_allclose(field, expected, atol=1e-12)


def test_a_map_of_a_changing_flight_has_no_seam(run):
    # inflow rising linearly in time everywhere: the map of any revolution must be uniform in azimuth
    ramp = run.copy()
    ramp["inflow"] = run.inflow * 0 + run.time
    field = disk.revolution_map(ramp, "inflow", 5)
    middle = 4.5 * 2 * np.pi / synthetic.OMEGA
    np.testing.assert_allclose(field, middle, rtol=1e-12)


def test_first_harmonics_of_a_linear_field_are_its_coefficients():
    import xarray as xr

    psi = np.arange(36) * np.pi / 18
    station = synthetic.stations()
    linear = 0.012 + station * (0.01 * np.cos(psi) - 0.002 * np.sin(psi))[:, None]
    field = xr.DataArray(linear, {"psi": psi, "station": station}, ("psi", "station"))
    np.testing.assert_allclose(disk.harmonics(field), (0.012, 0.01, -0.002), atol=1e-14)


def test_maps_before_the_first_revolution_are_refused(run):
    with pytest.raises(ValueError, match="revolution 0"):
        disk.revolution_map(run, "inflow", 0)
    with pytest.raises(ValueError, match="revolution 13"):
        disk.revolution_map(run, "inflow", 13)


def test_the_tail_is_drawn_on_the_right_and_the_advancing_side_at_the_top():
    # a filled contour of a field that is large only near one azimuth must lie there on the page
    import xarray as xr

    psi = np.arange(36) * np.pi / 18
    station = synthetic.stations()
    for azimuth, place in ((0.0, (1, 0)), (np.pi / 2, (0, 1))):
        values = np.maximum(np.cos(psi - azimuth), 0)[:, None] * station
        field = xr.DataArray(values, {"psi": psi, "station": station}, ("psi", "station"))
        axes = style.blank(3).subplots()
        filled = disk.draw(axes, field, (0.8, 1.0), style.SEQUENTIAL)
        points = np.concatenate([path.vertices for path in filled.get_paths() if len(path.vertices)])
        assert np.dot(points.mean(axis=0), place) > 0.8


@pytest.mark.parametrize("plot", plotting.FIGURES, ids=lambda plot: plot.name)
def test_every_figure_of_a_run_is_drawn_with_units_on_its_axes(run, plot, tmp_path):
    before = dict(matplotlib.rcParams)
    assert plot.drawable(run)
    figure = plot.figure(run)
    labelled = [axes for axes in figure.axes if axes.axison and axes.get_visible()]
    assert labelled
    for axes in labelled:
        text = axes.get_ylabel() or axes.get_xlabel()
        assert "[" in text or "/R" in text, text
    path = style.save(figure, tmp_path / "figure.png")
    assert path.stat().st_size > 5_000
    assert dict(matplotlib.rcParams) == before


def test_without_a_wake_its_figures_are_left_out():
    run = synthetic.run("dynamic")
    names = [plot.name for plot in plotting.FIGURES if plot.drawable(run)]
    assert "wake" not in names
    assert "inflow-maps" in names


def test_a_run_that_failed_early_still_has_its_histories():
    run = synthetic.run("dynamic", failure="flight, t = 0.01 s: stopped")
    short = run.isel(time=slice(0, 5))
    names = [plot.name for plot in plotting.FIGURES if plot.drawable(short)]
    assert "body-states" in names
    assert "inflow-maps" not in names
    for plot in plotting.FIGURES:
        if plot.drawable(short):
            plot.figure(short)


def test_runs_are_compared_in_one_figure_with_a_legend(run):
    runs = {"time-marching": run, "dynamic": synthetic.run("dynamic", strength=0.5)}
    for plot in plotting.COMPARISONS:
        assert plot.drawable(runs), plot.name
        figure = plot.figure(runs)
        if plot.name == "body-states":
            assert [text.get_text() for text in figure.legends[0].get_texts()] == list(runs)
    with pytest.raises(ValueError, match="in common"):
        other = run.assign(snapshot_revolution=run.snapshot_revolution + 0.5)
        comparison.wake_side_views({"a": run, "b": other})


def test_curves_of_one_figure_look_different_and_models_always_the_same():
    models = ["dynamic", "relaxation", "time-marching"]
    for extra in (["relaxation, standard", "time-marching, standard"], ["a", "b", "c", "d"]):
        for names in (models + extra, extra + models[:1], extra):
            found = style.looks(names)
            assert list(found) == names and len(set(found.values())) == len(names)
            assert all(found[name] == style.MODELS[name] for name in names if name in models)


def test_the_difference_of_two_equal_maps_is_nothing(run):
    figure = trim_maps.figure(run.inflow_trim, run.inflow_trim.roll(psi=9, roll_coords=True).sortby("psi"))
    assert "λ₀ 0.0000  λ₁c 0.0000  λ₁s 0.0000" in figure.axes[2].get_title().replace("-0.0000", "0.0000")


def test_wake_views_share_one_scale_and_show_the_rotor(run):
    figure = wake_geometry.figure(run, snapshots=[0, 3], all_blades=True)
    side = [figure.axes[0], figure.axes[3]]
    assert side[0].get_xlim() == side[1].get_xlim()
    assert side[0].get_xlim()[0] < -1 < 1 < side[0].get_xlim()[1]
    assert len([line for line in side[0].lines if line.get_label().startswith("blade")]) == synthetic.N_BLADES


def test_mode_figures_draw_every_mode():
    station = np.linspace(0.05, 1, 20)
    shape = np.stack([station, station**2, station**3])
    figure = modes.shapes(station, shape, 0.1 * shape, 0.01 * shape, [0.27, 1.03, 2.8], synthetic.RADIUS)
    assert "1.030/rev" in figure.axes[1].get_title()
    speed = np.linspace(0, 27, 8)
    fan = modes.fan_plot(speed, np.sqrt(4 + np.outer(speed**2, [0.07, 1.07])))
    assert fan.axes[0].get_ylabel() == "frequency [Hz]"
    named = modes.fan_plot(speed, np.sqrt(4 + np.outer(speed**2, [0.07, 1.07])), ["lag 1", "flap 1"])
    assert [text.get_text().split(":")[0] for text in named.legends[0].texts] == ["lag 1", "flap 1"]


def test_the_same_figure_gives_the_same_bytes(run, tmp_path):
    sticks = plotting.FIGURES[0]
    for kind in ("png", "svg"):
        first, second = (style.save(sticks.figure(run), tmp_path / f"{k}.{kind}").read_bytes() for k in "ab")
        assert first == second


def test_units_are_those_asked_for(run):
    figure = plotting.body.figure(run, units="us")
    (axes,) = (axes for axes in figure.axes if axes.get_ylabel() == "u [kt]")
    drawn = axes.lines[0].get_ydata()
    assert np.allclose(drawn, run["u"].values * 3600.0 / 1852.0)
    # angles stay in degrees, sticks in inches
    assert "p [deg/s]" in [axes.get_ylabel() for axes in figure.axes]
    labels = [axes.get_ylabel() for axes in plotting.loads.figure(run, units="us").axes]
    assert "Z [1000 lbf]" in labels and "M [1000 ft lbf]" in labels
    with pytest.raises(InputError, match=r"units = 'imperial': allowed: si, us"):
        check_units("imperial")


def test_the_mean_of_a_ramp_with_blade_passages_is_the_ramp_to_its_ends(run):
    # blades' passages leave the means of half revolutions as they are; a mean over half a window would lag at the ends
    turns = revolutions(run)
    if turns[-1] < 1.5:
        pytest.skip("the run is too short")
    ramp = 3.0 + 2.0 * turns
    assert np.allclose(one_revolution_mean(run, ramp), ramp, atol=1e-9)
    shaken = one_revolution_mean(run, ramp + np.cos(2.0 * np.pi * 4.0 * turns))
    assert abs(shaken[-1] - ramp[-1]) < 0.05 and abs(shaken[0] - ramp[0]) < 0.05


def test_a_model_without_a_part_has_no_curve_of_it(run):
    relaxed = run.assign(odd_even=0.0 * run["odd_even"])
    figure = plotting.monitors.figure({"relaxation": relaxed, "time-marching": run})
    (axes,) = (axes for axes in figure.axes if axes.get_ylabel() == "odd–even [R]")
    assert {line.get_label() for line in axes.lines if not line.get_label().startswith("_")} == {"time-marching"}
