"""The schema holds what it promises: labelled, checked, finite, saved and loaded without change."""

import numpy as np
import pytest
import synthetic

from wakeflight.results import ResultsError, assemble, assemble_trim, flat_attributes, load, save
from wakeflight.results.schema import RUN, TRIM


def test_every_variable_has_a_unit_and_a_meaning():
    for dataset in (synthetic.run(), assemble_trim(synthetic.trim_arrays(), {})):
        for name, variable in dataset.variables.items():
            assert variable.attrs["units"], name
            assert variable.attrs["long_name"], name


def test_names_are_declared_once():
    for table in (RUN, TRIM):
        names = [variable.name for variable in table]
        assert len(names) == len(set(names))


def test_a_run_reads_back_as_it_was_written(tmp_path):
    run = synthetic.run()
    back = load(save(run, tmp_path / "run.nc"))
    assert back.identical(run)


def test_any_reader_sees_time_as_a_float_in_seconds(tmp_path):
    import xarray as xr

    run = synthetic.run()
    with xr.open_dataset(save(run, tmp_path / "run.nc")) as plain:
        assert plain.time.dtype.kind == "f"
        np.testing.assert_array_equal(plain.time, run.time)


def test_the_same_run_gives_the_same_bytes(tmp_path):
    first = save(synthetic.run(), tmp_path / "a.nc").read_bytes()
    assert first == save(synthetic.run(), tmp_path / "b.nc").read_bytes()


def test_a_trim_reads_back_as_it_was_written(tmp_path):
    trim = assemble_trim(synthetic.trim_arrays(), {"aircraft": "uh60a"})
    assert load(save(trim, tmp_path / "trim.nc")).identical(trim)


def test_a_long_configuration_survives(tmp_path):
    # the plain HDF5 limit of an attribute is 64 kB; an aircraft with its tables is longer
    table = {f"row {k}": list(range(200)) for k in range(300)}
    run = synthetic.run(configuration={"aircraft": table})
    assert len(run.attrs["configuration"]) > 100_000
    assert load(save(run, tmp_path / "run.nc")).attrs == run.attrs


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"lift": np.zeros(3)}, "not in the schema: lift"),
        ({"u": None}, "missing: u"),
        ({"u": np.zeros(7)}, "along time"),
        ({"u": np.zeros((2, 2))}, "expected dimensions"),
        ({"station": None}, "coordinate station"),
        ({"station": synthetic.stations()[::-1]}, "not increasing"),
        ({"beta_1c": np.full(433, np.nan)}, "beta_1c: not finite at index \\(0,\\)"),
    ],
)
def test_arrays_that_do_not_fit_are_refused_by_name(change, complaint):
    arrays = {**synthetic.run_arrays(), **change}
    arrays = {name: values for name, values in arrays.items() if values is not None}
    with pytest.raises(ResultsError, match=complaint):
        assemble(arrays, synthetic.attributes())


def test_missing_attributes_are_named():
    attributes = synthetic.attributes()
    del attributes["radius"]
    with pytest.raises(ResultsError, match="radius"):
        assemble(synthetic.run_arrays(), attributes)


def test_a_failed_run_is_marked():
    run = synthetic.run(revolutions=3, failure="flight, t = 0.7 s: corrector did not converge")
    assert run.attrs["finished"] == 0
    assert synthetic.run().attrs["finished"] == 1
    with pytest.raises(ResultsError, match="must say why"):
        synthetic.run(finished=False)


def test_nested_configuration_becomes_text_and_dotted_names():
    flat = flat_attributes({"configuration": {"wake": {"turns": 4, "far": None, "on": True, "table": [1.0]}}})
    assert flat["configuration.wake.turns"] == 4
    assert flat["configuration.wake.far"] == "none"
    assert flat["configuration.wake.on"] == 1
    assert '"table": [1.0]' in flat["configuration"]
    assert "configuration.wake.table" not in flat
    with pytest.raises(ResultsError, match="not finite"):
        flat_attributes({"seconds_trim": float("nan")})


def test_a_file_that_is_no_result_is_refused(tmp_path):
    with pytest.raises(ResultsError, match="no such file"):
        load(tmp_path / "absent.nc")
    text = tmp_path / "text.nc"
    text.write_text("not a file of this kind")
    with pytest.raises(ResultsError, match="not a NetCDF"):
        load(text)


def test_a_file_says_when_its_bytes_are_not_those_it_was_written_with(tmp_path):
    path = save(assemble(synthetic.run_arrays(2), synthetic.attributes()), tmp_path / "run.nc")
    content = path.read_bytes()
    for at in range(0, len(content) - 24, len(content) // 97):
        path.write_bytes(content[:at] + bytes([content[at] ^ 0x10]) + content[at + 1 :])
        with pytest.raises(ResultsError, match=r"run.nc: .*(damaged|not those)"):
            load(path)
    for cut in (0, 1, 24, 1000, len(content) // 2):
        path.write_bytes(content[:cut])
        with pytest.raises(ResultsError, match=r"run.nc: (the file is empty|not a NetCDF|damaged)"):
            load(path)


def test_a_file_that_another_program_copied_is_known_by_its_content(tmp_path):
    import xarray as xr

    run = assemble(synthetic.run_arrays(2), synthetic.attributes())
    with xr.open_dataset(save(run, tmp_path / "run.nc"), engine="h5netcdf") as file:
        copied = file.load()
    copied.to_netcdf(tmp_path / "copy.nc", engine="h5netcdf")
    assert load(tmp_path / "copy.nc").identical(run)
    copied["u"][3] += 1e-9
    copied.to_netcdf(tmp_path / "changed.nc", engine="h5netcdf")
    with pytest.raises(ResultsError, match="numbers are not those"):
        load(tmp_path / "changed.nc")


def test_a_result_of_another_kind_is_told_by_its_kind(tmp_path):
    trim = save(assemble_trim(synthetic.trim_arrays(), {}), tmp_path / "trim.nc")
    with pytest.raises(ResultsError, match=r"trim.nc: holds a trim; needed is the file of a flight"):
        load(trim, "flight")


def test_a_file_cannot_claim_more_than_it_can_hold(tmp_path):
    import h5netcdf

    path = tmp_path / "bomb.nc"
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"time": 10**12}
        file.create_variable("u", ("time",), "f8", chunks=(1000,))
    with pytest.raises(ResultsError, match="cannot hold"):
        load(path)
