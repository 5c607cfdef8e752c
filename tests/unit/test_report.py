"""The report stands alone: everything a reader needs in one file, nothing fetched, failures not hidden."""

import html
import re

import numpy as np
import pytest
import synthetic

from wakeflight import report
from wakeflight.condition import FlightCondition, described
from wakeflight.export import vtk
from wakeflight.results import assemble_trim


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    out = tmp_path_factory.mktemp("report")
    trim = assemble_trim(synthetic.trim_arrays(), {"aircraft": "uh60a"})
    return report.write(synthetic.run(), out, trim)


def test_the_page_fetches_nothing(written):
    page = written.read_text()
    sources = re.findall(r'(?:src|href)\s*=\s*"([^"]{0,40})', page)
    assert sources
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert "<script" not in page
    assert "@import" not in page


def test_figures_are_written_beside_the_page_and_shown_in_it(written):
    names = {path.stem for path in written.parent.glob("*.png")}
    assert {"sticks", "body-states", "forces-moments", "flapping", "inflow-maps", "wake"} <= names
    assert names == set(re.findall(r'<figure id="([^"]+)"', written.read_text()))


def test_the_summary_says_what_was_flown_and_what_it_cost(written):
    page = written.read_text()
    for text in (
        "uh60a",
        "time-marching",
        "0.00660",
        "12.00 revolutions",
        "23.00",
        "21,000",
        "11.0 in/s",
        "bdf2",
    ):
        assert text in page, text
    assert "did not finish" not in page


def test_warnings_and_monitors_are_on_the_page(tmp_path):
    told = "collective at 11.40 in, beyond its stop at 10 in\n21.6 % of the disk beyond stall"
    run = synthetic.run("dynamic", revolutions=2, warnings=told)
    run["stick_margin"] = ("time", np.linspace(1.0, -1.4, run.sizes["time"]))
    page = report.write(run, tmp_path).read_text()
    assert page.count('class="warning"') == 2
    assert "Monitors" in page and f"-1.4 at {float(run.time[-1]):.2f} s" in page


@pytest.mark.parametrize("kept", ["{% raw %}", "{" * 9000, '{"speed": "fast"}', '["speed"]'])
def test_what_is_no_condition_is_shown_as_it_stands(tmp_path, kept):
    page = report.write(synthetic.run("dynamic", revolutions=2, condition=kept, aircraft="{x"), tmp_path).read_text()
    assert kept in html.unescape(page) and ">{x<" in page


def test_a_failed_run_says_so(tmp_path):
    run = synthetic.run("dynamic", revolutions=2, failure="flight, t = 0.4 s, blade <3>: no convergence")
    page = report.write(run, tmp_path).read_text()
    assert "did not finish" in page
    assert "blade &lt;3&gt;" in page


def test_runs_are_compared_side_by_side(tmp_path):
    runs = {model: synthetic.run(model) for model in ("time-marching", "relaxation", "dynamic")}
    page = report.write(runs, tmp_path).read_text()
    assert "<th>time-marching</th><th>relaxation</th><th>dynamic</th>" in page
    assert (tmp_path / "cost.png").is_file()
    # on a narrow page, where a figure is pushed sideways, the key of its lines stays in sight
    key = page.split('<p class="key">')[1].split("</p>")[0]
    assert all(f"</svg>{model}</span>" in key for model in runs) and 'stroke="#0072B2"' in key
    alone = report.write(runs["dynamic"], tmp_path).read_text()
    assert '<p class="key">' not in alone


def test_wakes_are_exported_as_polylines(tmp_path):
    import xml.etree.ElementTree as ElementTree

    run = synthetic.run()
    series = ElementTree.parse(vtk.write(run, tmp_path)).getroot()
    entries = series.findall("./Collection/DataSet")
    assert len(entries) == run.sizes["snapshot"]
    piece = ElementTree.parse(tmp_path / entries[1].get("file")).getroot().find("./PolyData/Piece")
    n_points = run.sizes["blade"] * run.sizes["age"]
    assert int(piece.get("NumberOfPoints")) == n_points
    position = [float(x) for x in piece.find("./Points/DataArray").text.split()]
    assert position[:3] == pytest.approx(run.wake[1, 0, 0].values, rel=1e-8)
    assert {array.get("Name") for array in piece.findall("./PointData/DataArray")} == {
        "age",
        "blade",
        "circulation",
        "core_radius",
    }
    with pytest.raises(ValueError, match="no wake"):
        vtk.write(synthetic.run("dynamic"), tmp_path)


def test_a_flight_condition_is_told_with_its_units():
    condition = FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")
    assert described(condition.as_attributes()) == (
        "speed 80 kt, flight path -6 deg, altitude 1600.2 m, gross mass 7257.48 kg, turn rate 0 deg/s"
    )
    assert "altitude 5250 ft, gross mass 16000 lb," in described(condition.as_attributes(), "us")
