"""A run carries all it was made of: flown again it has the same bits, changed or foreign it is refused by name."""

import json
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight import results
from wakeflight.aircraft.bundle import Bundle


def test_a_run_carries_its_whole_input(uh60a, tmp_path):
    rigid = uh60a.with_rigid_blades().discretised(n_elements=3)
    condition = wf.FlightCondition(speed="60 kt", load_factor=1.1, turn="left")
    start = wf.trim(rigid, condition, inflow=wf.DynamicInflow(n_stations=8), n_harmonics=5)
    speed = [("0.01 s", 1.0), ("0.05 s", 0.97)]
    run = wf.fly(start, wf.roll_reversal(), revolutions=0.5, integrator="fixed", rtol=1e-6, rotor_speed=speed)
    path = run.save(tmp_path / "run.nc")
    kept = json.loads(results.load(path).attrs["input"])
    assert kept["aircraft"]["files"]["uh60a.toml"] == uh60a.path.read_text()
    assert len(kept["aircraft"]["files"]) == len(kept["aircraft"]["sha256"]) > 10
    made = kept["made"]
    assert {"program_version", "commit", "command", "machine", "date", "python"} == {*made}
    assert made["machine"]["instruction_set"] == run.data.attrs["instruction_set"]
    again = wf.rerun(path)
    assert again.same and again.told == ()
    changed = run.data.copy(deep=True)
    changed.p[3] += 1e-12
    assert wf.rerun(results.save(changed, path)).differing.keys() == {"p"}


def test_a_changed_input_is_seen_and_foreign_files_refused(baseline_dynamic, tmp_path):
    run = wf.fly(baseline_dynamic, wf.roll_reversal(), integrator="fixed", revolutions=0.1)
    kept = json.loads(run.data.attrs["input"])
    text = kept["aircraft"]["files"]["uh60a.toml"]
    kept["aircraft"]["files"]["uh60a.toml"] = text.replace("ixx", "ixx ", 1)
    for spoiled, named in (
        (json.dumps(kept), "uh60a.toml.* must be the text that belongs to its sha256"),
        ("{", "must be the whole input of a flight"),
        ('{"version": 99}', "input version = 99"),
        ("[]", "must be the whole input of a flight"),
    ):
        path = results.save(run.data.assign_attrs(input=spoiled), tmp_path / "run.nc")
        with pytest.raises(wf.InputError, match=named):
            wf.rerun(path)
    stored = Path(__file__).parents[1] / "unit" / "data" / "run-schema-1.nc"
    with pytest.raises(wf.InputError, match="a file of schema 1 does not carry its input"):
        wf.rerun(stored)
    for folder, named in ((tmp_path / "none", "no such folder"), (tmp_path, "holds no flight")):
        with pytest.raises(wf.InputError, match=named):
            wf.resume(folder)


def test_a_table_outside_its_folder_is_kept_by_its_text_alone(uh60a, tmp_path):
    whole = Bundle.of(uh60a).as_dict()
    name = next(each for each in whole["files"] if each.startswith("fin"))
    for elsewhere in ("/etc/../tmp/fin.csv", "../../escaped.csv", "uh60a:fin.csv"):
        moved = json.loads(json.dumps(whole).replace(f'"{name}"', f'"{elsewhere}"'))
        main = moved["aircraft"]["files"] if "aircraft" in moved else moved["files"]
        main["uh60a.toml"] = main["uh60a.toml"].replace(f'"{name}"', f'"{elsewhere}"')
        moved["sha256"] = {}
        again = Bundle.from_dict(moved).aircraft()
        assert again.core_data() == uh60a.core_data()
